#include "las_builder.h"

#include <stdexcept>

namespace arris::test {
namespace {

std::string field(const std::string& text, std::size_t size) {
  std::string padded = text.substr(0, size);
  padded.resize(size, '\0');
  return padded;
}

std::string record_header(const TestVlr& vlr, bool extended) {
  std::string bytes(extended ? 60 : 54, '\0');
  bytes.replace(2, 16, field(vlr.user, 16));
  put<std::uint16_t>(bytes, 18, vlr.id);
  if (extended) put<std::uint64_t>(bytes, 20, vlr.payload.size());
  if (!extended) put<std::uint16_t>(bytes, 20, static_cast<std::uint16_t>(vlr.payload.size()));
  bytes.replace(extended ? 28 : 22, 32, field(vlr.description, 32));
  return bytes;
}

TestVlr read_record(const std::string& bytes, std::size_t& at, bool extended) {
  TestVlr vlr;
  vlr.user = std::string(bytes.c_str() + at + 2, strnlen(bytes.c_str() + at + 2, 16));
  vlr.id = get<std::uint16_t>(bytes, at + 18);
  const std::size_t size = extended ? get<std::uint64_t>(bytes, at + 20) : get<std::uint16_t>(bytes, at + 20);
  const std::size_t text = at + (extended ? 28 : 22);
  vlr.description = std::string(bytes.c_str() + text, strnlen(bytes.c_str() + text, 32));
  at += extended ? 60 : 54;
  vlr.payload = bytes.substr(at, size);
  if (vlr.payload.size() != size) throw std::runtime_error("record runs past the end");
  at += size;
  return vlr;
}

}  // namespace

LasPlan plan_of(int minor, int format, std::size_t points, std::size_t extra) {
  LasPlan plan;
  plan.minor = minor;
  plan.format = format;
  plan.record_bytes = kFormatBytes[static_cast<std::size_t>(format)] + extra;
  plan.points = make_records(points, plan.record_bytes, static_cast<unsigned>(minor * 16 + format));
  return plan;
}

std::string build_las(const LasPlan& plan) {
  std::string header(kHeaderBytes[static_cast<std::size_t>(plan.minor)] + plan.header_padding, '\x5a');
  std::fill(header.begin(), header.begin() + static_cast<std::ptrdiff_t>(header.size() - plan.header_padding), '\0');
  std::string front;
  for (const TestVlr& vlr : plan.vlrs) front += record_header(vlr, false) + vlr.payload;
  front += plan.gap;
  std::string body;
  for (const std::string& point : plan.points) body += point;
  std::string back;
  for (const TestVlr& vlr : plan.evlrs) back += record_header(vlr, true) + vlr.payload;

  header.replace(0, 4, "LASF");
  put<std::uint16_t>(header, 4, 77);
  if (plan.format >= 6) put<std::uint16_t>(header, 6, 16);
  header[24] = 1;
  header[25] = static_cast<char>(plan.minor);
  header.replace(26, 32, field("SYSTEM", 32));
  header.replace(58, 32, field("SOFTWARE", 32));
  put<std::uint16_t>(header, 90, 100);
  put<std::uint16_t>(header, 92, 2024);
  put<std::uint16_t>(header, 94, static_cast<std::uint16_t>(header.size()));
  const std::size_t offset = header.size() + front.size();
  put<std::uint32_t>(header, 96, static_cast<std::uint32_t>(offset));
  put<std::uint32_t>(header, 100, static_cast<std::uint32_t>(plan.vlrs.size()));
  header[104] = static_cast<char>(plan.format);
  put<std::uint16_t>(header, 105, static_cast<std::uint16_t>(plan.record_bytes));
  put<std::uint32_t>(header, 107,
                     plan.format >= 6 && plan.minor >= 4 ? 0 : static_cast<std::uint32_t>(plan.points.size()));
  for (std::size_t i = 0; i < 3; ++i) {
    put<double>(header, 131 + 8 * i, plan.scale[i]);
    put<double>(header, 155 + 8 * i, plan.offset[i]);
  }
  if (plan.minor >= 4) {
    put<std::uint64_t>(header, 235, plan.evlrs.empty() ? 0 : offset + body.size());
    put<std::uint32_t>(header, 243, static_cast<std::uint32_t>(plan.evlrs.size()));
    put<std::uint64_t>(header, 247, plan.points.size());
  }
  return header + front + body + back;
}

std::vector<std::string> make_records(std::size_t count, std::size_t record_bytes, unsigned seed) {
  std::vector<std::string> records;
  std::uint32_t state = seed * 2654435761U + 1;
  for (std::size_t i = 0; i < count; ++i) {
    std::string record(record_bytes, '\0');
    for (char& c : record) {
      state = state * 1664525U + 1013904223U;
      c = static_cast<char>(state >> 24);
    }
    records.push_back(std::move(record));
  }
  return records;
}

std::string extra_entry(int type, const std::string& name, int options) {
  std::string entry(192, '\0');
  entry[2] = static_cast<char>(type);
  entry[3] = static_cast<char>(options);
  entry.replace(4, 32, field(name, 32));
  entry.replace(160, 32, field("about " + name, 32));
  return entry;
}

LasParts read_parts(const std::string& bytes) {
  LasParts parts;
  if (bytes.substr(0, 4) != "LASF") throw std::runtime_error("no magic");
  parts.minor = bytes[25];
  parts.format = bytes[104];
  parts.header_bytes = get<std::uint16_t>(bytes, 94);
  parts.record_bytes = get<std::uint16_t>(bytes, 105);
  parts.legacy_points = get<std::uint32_t>(bytes, 107);
  parts.points = parts.minor >= 4 ? get<std::uint64_t>(bytes, 247) : parts.legacy_points;
  for (std::size_t i = 0; i < (parts.minor >= 4 ? 15U : 5U); ++i) {
    parts.by_return.push_back(parts.minor >= 4 ? get<std::uint64_t>(bytes, 255 + 8 * i)
                                               : get<std::uint32_t>(bytes, 111 + 4 * i));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    parts.max[i] = get<double>(bytes, 179 + 16 * i);
    parts.min[i] = get<double>(bytes, 187 + 16 * i);
  }
  if (parts.minor >= 3) parts.waveform_start = get<std::uint64_t>(bytes, 227);
  std::size_t at = parts.header_bytes;
  const std::size_t offset = get<std::uint32_t>(bytes, 96);
  for (std::uint32_t i = 0; i < get<std::uint32_t>(bytes, 100); ++i)
    parts.vlrs.push_back(read_record(bytes, at, false));
  if (at > offset) throw std::runtime_error("records run into the points");
  parts.gap = bytes.substr(at, offset - at);
  for (std::uint64_t i = 0; i < parts.points; ++i) {
    parts.records.push_back(bytes.substr(offset + i * parts.record_bytes, parts.record_bytes));
    if (parts.records.back().size() != parts.record_bytes) throw std::runtime_error("points run past the end");
  }
  if (parts.minor >= 4) {
    at = get<std::uint64_t>(bytes, 235);
    for (std::uint32_t i = 0; i < get<std::uint32_t>(bytes, 243); ++i)
      parts.evlrs.push_back(read_record(bytes, at, true));
  }
  return parts;
}

}  // namespace arris::test
