#include "core/error.h"
#include "fuzz_checks.h"
#include "fuzz_entries.h"
#include "io/file_summary.h"

namespace arris::test {

void fuzz_ply_body(FuzzBytes bytes) {
  require_consistent_readings(bytes);
  try {
    require_problems(io::summarize_file(file_of(bytes), io::Tolerance::kSalvage).problems);
  } catch (const InputError& error) {
    require_refusal(error.what());
  }
}

}  // namespace arris::test
