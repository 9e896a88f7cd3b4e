#include "io/ply_body.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "io/bytes.h"

namespace arris::io {

void read_ply_record(const InputFile& file, const PlyHeader& header, std::size_t element, std::uint64_t index,
                     FileWindow& window, PlyRecordWalker& walker) {
  for (;;) {
    const auto result = walker.walk(window.bytes(), window.at_file_end());
    if (result == PlyRecordWalker::Result::kDone) return;
    if (result == PlyRecordWalker::Result::kMore && window.extend()) continue;
    const std::string where =
        fmt::format("{}: {} {} of {}, from byte {}", file.name(), printable(header.elements[element].name, 40),
                    index + 1, header.elements[element].count, window.position());
    if (result == PlyRecordWalker::Result::kBad)
      throw InputError(fmt::format("{}: {}; the file is damaged", where, walker.problem()));
    if (window.full()) {
      throw InputError(
          fmt::format("{}: is longer than {}; the file is damaged", where, human_bytes(FileWindow::kMaxBytes)));
    }
    throw InputError(
        fmt::format("{}: the file ends at byte {} within it; it is cut short or has fewer values than its header says",
                    where, file.size_bytes()));
  }
}

std::uint64_t skip_ply_element(const InputFile& file, const PlyHeader& header, std::size_t element,
                               std::uint64_t begin) {
  const PlyElement& skipped = header.elements[element];
  if (skipped.count == 0 || skipped.properties.empty()) return begin;
  if (header.format != PlyFormat::kAscii && !skipped.has_list()) {
    const auto size = checked_multiply(skipped.count, skipped.least_bytes());
    const auto end = size ? checked_add(begin, *size) : std::nullopt;
    if (end && *end <= file.size_bytes()) return *end;
    throw InputError(fmt::format(
        "{}: the header promises {} {} records of {} bytes from byte {} on, but the file ends at byte {} and holds {}; "
        "it is cut short, copy or export it again",
        file.name(), skipped.count, printable(skipped.name, 40), skipped.least_bytes(), begin, file.size_bytes(),
        (file.size_bytes() - begin) / skipped.least_bytes()));
  }
  FileWindow window(file);
  window.seek(begin);
  PlyRecordWalker walker(header.format, skipped, {});
  for (std::uint64_t i = 0; i < skipped.count; ++i) {
    read_ply_record(file, header, element, i, window, walker);
    window.consume(walker.end());
  }
  return window.position();
}

std::uint64_t find_ply_element(const InputFile& file, const PlyHeader& header, std::size_t element) {
  std::uint64_t at = header.body_begin;
  for (std::size_t i = 0; i < element; ++i) at = skip_ply_element(file, header, i, at);
  return at;
}

}  // namespace arris::io
