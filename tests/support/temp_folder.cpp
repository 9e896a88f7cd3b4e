#include "support/temp_folder.h"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace arris::test {

TempFolder::TempFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "arris-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
  path_ = name;
}

TempFolder::~TempFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace arris::test
