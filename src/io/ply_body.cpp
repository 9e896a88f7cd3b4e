#include "io/ply_body.h"

#include <fmt/format.h>

#include <algorithm>

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
    const std::string which = fmt::format("{} {} of {}", printable(header.elements[element].name, 40), index + 1,
                                          header.elements[element].count);
    constexpr const char* kDamaged = "the file is damaged: export it again, or read what precedes this with --salvage";
    if (result == PlyRecordWalker::Result::kBad)
      refuse(file, window.position(), fmt::format("{}: {}", which, walker.problem()), kDamaged);
    if (window.full()) {
      refuse(file, window.position(), fmt::format("{} is longer than {}", which, human_bytes(FileWindow::kMaxBytes)),
             kDamaged);
    }
    refuse(file, window.position(), fmt::format("{}: the file ends at byte {} within it", which, file.size_bytes()),
           "it is cut short or has fewer values than its header says: copy or export it again, or use --salvage");
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
    const std::uint64_t room = begin > file.size_bytes() ? 0 : file.size_bytes() - begin;
    refuse(file, begin,
           fmt::format("the header counts {} {} records of {} bytes from here on, but the file ends at byte {} and "
                       "holds {}",
                       skipped.count, printable(skipped.name, 40), skipped.least_bytes(), file.size_bytes(),
                       room / skipped.least_bytes()),
           "copy or export it again, or read what is there with --salvage");
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

WholeRecords count_whole_records(const InputFile& file, const PlyHeader& header, std::size_t element,
                                 std::uint64_t begin) {
  const PlyElement& counted = header.elements[element];
  if (header.format != PlyFormat::kAscii && !counted.has_list()) {
    const std::uint64_t room = begin > file.size_bytes() ? 0 : file.size_bytes() - begin;
    const std::uint64_t count = std::min<std::uint64_t>(counted.count, room / counted.least_bytes());
    return {count, begin + count * counted.least_bytes()};
  }
  FileWindow window(file);
  window.seek(begin);
  PlyRecordWalker walker(header.format, counted, {});
  for (std::uint64_t i = 0; i < counted.count; ++i) {
    try {
      read_ply_record(file, header, element, i, window, walker);
    } catch (const InputError&) {
      return {i, window.position()};
    }
    // A number that ends with the file, before the last record, may be cut itself.
    const bool touches_end = window.position() + walker.end() == file.size_bytes();
    if (header.format == PlyFormat::kAscii && touches_end && i + 1 < counted.count) return {i, window.position()};
    window.consume(walker.end());
  }
  return {counted.count, window.position()};
}

std::uint64_t find_ply_element(const InputFile& file, const PlyHeader& header, std::size_t element) {
  std::uint64_t at = header.body_begin;
  for (std::size_t i = 0; i < element; ++i) at = skip_ply_element(file, header, i, at);
  return at;
}

}  // namespace arris::io
