#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <numeric>
#include <stdexcept>

#include "../io/las_builder.h"
#include "strip.h"

namespace arris::test {
namespace {

constexpr std::size_t kEntryBytes = 192;
constexpr std::size_t kVlrHeader = 54;
constexpr std::size_t kEvlrHeader = 60;
constexpr std::uint16_t kExtraBytes = 4;
constexpr std::uint16_t kSuperseded = 7;

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error("strip_las: " + what);
}

std::string name_of(const std::string& entry) {
  return std::string(entry.c_str() + 4, strnlen(entry.c_str() + 4, 32));
}

/// A variable-length record as it lies in the file: header and payload.
struct Record {
  std::string bytes;
  bool is(std::uint16_t id) const {
    return get<std::uint16_t>(bytes, 18) == id &&
           std::string(bytes.c_str() + 2, strnlen(bytes.c_str() + 2, 16)) == "LASF_Spec";
  }
  std::string description() const { return std::string(bytes.c_str() + 22, strnlen(bytes.c_str() + 22, 32)); }
  std::string payload() const { return bytes.substr(kVlrHeader); }
  void set_payload(const std::string& payload) {
    bytes = bytes.substr(0, kVlrHeader) + payload;
    put<std::uint16_t>(bytes, 20, static_cast<std::uint16_t>(payload.size()));
  }
};

struct Layout {
  std::size_t header_bytes, points_at, record_bytes, vlrs_end;
  int minor;
  std::uint64_t points;
  std::vector<Record> vlrs;
};

Layout lay_out(const std::string& las) {
  Layout layout{};
  layout.minor = las.at(25);
  layout.header_bytes = get<std::uint16_t>(las, 94);
  layout.points_at = get<std::uint32_t>(las, 96);
  layout.record_bytes = get<std::uint16_t>(las, 105);
  layout.points = get<std::uint32_t>(las, 107);
  if (layout.minor >= 4) layout.points = get<std::uint64_t>(las, 247);
  std::size_t at = layout.header_bytes;
  for (std::uint32_t i = 0; i < get<std::uint32_t>(las, 100); ++i) {
    const std::size_t size = kVlrHeader + get<std::uint16_t>(las, at + 20);
    layout.vlrs.push_back({las.substr(at, size)});
    at += size;
  }
  if (at > layout.points_at || layout.points_at + layout.points * layout.record_bytes > las.size()) fail("bad layout");
  layout.vlrs_end = at;
  return layout;
}

/// Takes our descriptions out of the payload that ends with them.
std::string without_our_entries(const std::string& payload, const std::vector<AddedColumn>& columns) {
  std::size_t end = payload.size();
  for (auto column = columns.rbegin(); column != columns.rend(); ++column) {
    if (end < kEntryBytes || name_of(payload.substr(end - kEntryBytes, kEntryBytes)) != column->name) {
      fail("the last descriptions are not those of our columns");
    }
    end -= kEntryBytes;
  }
  while (end >= kEntryBytes) {  // Of bytes that nothing described before.
    const std::string entry = payload.substr(end - kEntryBytes, kEntryBytes);
    if (entry[2] != 0 || name_of(entry) != "undocumented") break;
    end -= kEntryBytes;
  }
  return payload.substr(0, end);
}

/// Returns whether descriptions of the input were replaced.
bool strip_vlrs(std::vector<Record>& vlrs, const std::vector<AddedColumn>& columns, bool superseded_evlr) {
  const auto last = std::find_if(vlrs.rbegin(), vlrs.rend(), [](const Record& r) { return r.is(kExtraBytes); });
  if (last == vlrs.rend()) fail("no description of extra bytes");
  const bool replaced =
      superseded_evlr || std::any_of(vlrs.begin(), vlrs.end(), [](const Record& r) { return r.is(kSuperseded); });
  const std::string rest = without_our_entries(last->payload(), columns);
  const bool ours = last == vlrs.rbegin() && last->description() == "Extra Bytes" && (rest.empty() || replaced);
  if (ours) {
    vlrs.pop_back();
  } else {
    last->set_payload(rest);
  }
  for (Record& record : vlrs) {
    if (record.is(kSuperseded)) put<std::uint16_t>(record.bytes, 18, kExtraBytes);
  }
  return replaced;
}

/// Marks descriptions among the extended records as valid again. Returns whether there were any.
bool restore_evlrs(std::string& las) {
  bool restored = false;
  if (las.at(25) < 4) return restored;
  std::uint64_t at = get<std::uint64_t>(las, 235);
  for (std::uint32_t i = 0; i < get<std::uint32_t>(las, 243); ++i) {
    if (Record{las.substr(at, kEvlrHeader)}.is(kSuperseded)) {
      put<std::uint16_t>(las, at + 18, kExtraBytes);
      restored = true;
    }
    at += kEvlrHeader + get<std::uint64_t>(las, at + 20);
  }
  return restored;
}

}  // namespace

const std::vector<AddedColumn>& extract_columns() {
  static const std::vector<AddedColumn> kColumns{{"EdgeClass", 1}, {"EdgeScore", 4}, {"FoldAngle", 4}};
  return kColumns;
}

std::string strip_las(const std::string& output, const std::vector<AddedColumn>& columns) {
  std::string las = output;
  const bool superseded_evlr = restore_evlrs(las);
  Layout layout = lay_out(las);
  strip_vlrs(layout.vlrs, columns, superseded_evlr);
  const std::size_t row_bytes =
      std::accumulate(columns.begin(), columns.end(), std::size_t{0},
                      [](std::size_t sum, const AddedColumn& c) { return sum + c.size_bytes; });
  const std::size_t stripped_bytes = layout.record_bytes - row_bytes;
  std::string result = las.substr(0, layout.header_bytes);
  for (const Record& record : layout.vlrs) result += record.bytes;
  const std::size_t gap_shift = layout.vlrs_end - result.size();
  result += las.substr(layout.vlrs_end, layout.points_at - layout.vlrs_end);
  put<std::uint32_t>(result, 96, static_cast<std::uint32_t>(result.size()));
  put<std::uint32_t>(result, 100, static_cast<std::uint32_t>(layout.vlrs.size()));
  put<std::uint16_t>(result, 105, static_cast<std::uint16_t>(stripped_bytes));
  for (std::uint64_t i = 0; i < layout.points; ++i) {
    result.append(las, layout.points_at + i * layout.record_bytes, stripped_bytes);
  }
  const std::size_t tail_at = layout.points_at + layout.points * layout.record_bytes;
  const std::size_t tail_shift = tail_at - result.size();
  result += las.substr(tail_at);
  const auto move_back = [&](std::size_t field) {
    const auto start = get<std::uint64_t>(result, field);
    const std::size_t shift = start >= tail_at ? tail_shift : start >= layout.vlrs_end ? gap_shift : 0;
    put<std::uint64_t>(result, field, start - shift);
  };
  if (layout.minor >= 3 && layout.header_bytes >= 235) move_back(227);
  if (layout.minor >= 4) move_back(235);
  return result;
}

}  // namespace arris::test
