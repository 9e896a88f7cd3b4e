#include <string>

#include "core/error.h"
#include "fuzz_checks.h"
#include "fuzz_entries.h"
#include "io/ply_header.h"

namespace arris::test {
namespace {

/// The lines as the writers put them back.
std::string written(const io::PlyHeader& header) {
  std::string text;
  for (const std::string& line : header.lines) text += line + header.line_end;
  return text;
}

bool says_the_same(const io::PlyHeader& a, const io::PlyHeader& b) {
  if (a.format != b.format || a.version != b.version || a.vertex != b.vertex || a.elements.size() != b.elements.size())
    return false;
  for (std::size_t i = 0; i < a.elements.size(); ++i) {
    if (a.elements[i].name != b.elements[i].name || a.elements[i].count != b.elements[i].count ||
        a.elements[i].properties != b.elements[i].properties)
      return false;
  }
  return true;
}

}  // namespace

void fuzz_ply_header(FuzzBytes bytes) {
  const auto file = file_of(bytes);
  try {
    const io::PlyHeader header = io::read_ply_header(*file);
    require_problems(header.problems);
    require(header.body_begin <= bytes.size(), "begin of the body");
    for (const char* axis : {"x", "y", "z"}) require(header.vertices().find(axis) >= 0, "a vertex without position");
    const std::string text = written(header);
    const io::PlyHeader again =
        io::read_ply_header(*file_of({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}));
    require(says_the_same(header, again), "the header written out says something else");
  } catch (const InputError& error) {
    require_refusal(error.what());
  }
}

}  // namespace arris::test
