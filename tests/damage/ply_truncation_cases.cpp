/// @file PLY files cut at every border: of words in the header, of fields in the body.

#include "damaged_file.h"
#include "sound_ply.h"

namespace arris::test {
namespace {

std::string cut_name(const std::string& what, const std::string& format, std::size_t size) {
  return "ply-cut-" + what + "-" + short_name(format) + "-at-" + std::to_string(size);
}

void add_header_cuts(DamagedFiles& files) {
  for (const std::string& format : kPlyFormats) {
    const std::string header = ply_start(format) + "comment two words\n" + kVertices + kEnd;
    for (std::size_t size = 0; size < header.size(); ++size) {
      const bool border = header[size] == ' ' || header[size] == '\n' || (size > 0 && header[size - 1] == ' ') ||
                          (size > 0 && header[size - 1] == '\n');
      if (border) files.push_back(refused(cut_name("header", format, size), header.substr(0, size)));
    }
  }
}

const std::vector<PlyColumn> kFixed{{"x"}, {"red", "uchar"}, {"y", "double"}, {"t", "short"}, {"z"}};
const std::vector<PlyColumn> kWithList{{"x"}, {"y", "double"}, {"near", "int", "uchar"}, {"z"}};

std::size_t bytes_of(const std::string& type) {
  return ply_detail::binary(type, 0.0, false).size();
}

/// Where the fields of one binary row begin, its first byte being 0; the last is its end.
std::vector<std::size_t> field_borders(const PlyTable& table, std::size_t row) {
  std::vector<std::size_t> borders{0};
  const auto add = [&](const std::string& type) { borders.push_back(borders.back() + bytes_of(type)); };
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (!table.columns[i].list.empty()) add(table.columns[i].list);
    for (std::size_t item = 0; item < table.rows[row][i].size(); ++item) add(table.columns[i].type);
  }
  return borders;
}

/// Cuts within the last two vertices, before each field.
void add_binary_cuts(DamagedFiles& files) {
  for (const std::string& format : {kPlyFormats[1], kPlyFormats[2]}) {
    for (const bool lists : {false, true}) {
      const PlyTable table = make_vertices(lists ? kWithList : kFixed, 6);
      const PlyPlan plan{format, "\n", {}, {table}};
      const std::string sound = build_ply(plan);
      std::size_t end = sound.size();
      for (std::size_t row = 5; row >= 4; --row) {
        const std::vector<std::size_t> borders = field_borders(table, row);
        const std::size_t begin = end - borders.back();
        for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
          const std::size_t size = begin + borders[i];
          files.push_back(
              refused(cut_name(lists ? "lists" : "body", format, size), sound.substr(0, size)).salvaged(row));
        }
        end = begin;
      }
    }
  }
}

/// Cuts of an ascii body before and behind each of the last six values, that is in the last two vertices. A value that
/// ends with the file may have lost digits: the vertex that it completes is not whole.
void add_ascii_cuts(DamagedFiles& files) {
  const std::string sound = build_ply({"ascii", "\n", {}, {make_vertices({{"x"}, {"y"}, {"z"}}, 6)}});
  std::size_t values_behind = 0;
  for (std::size_t size = sound.size() - 1; values_behind < 6; --size) {
    if (sound[size] != ' ' && sound[size] != '\n') continue;
    if (values_behind == 0) {
      files.push_back(read_whole(cut_name("body", "ascii", size), sound.substr(0, size), 6));
    } else {
      const std::uint64_t whole = (18 - values_behind) / 3;
      const std::uint64_t certain = (18 - values_behind - 1) / 3;
      files.push_back(refused(cut_name("body", "ascii", size), sound.substr(0, size)).salvaged(certain));
      files.push_back(refused(cut_name("body", "ascii", size + 1), sound.substr(0, size + 1)).salvaged(whole));
    }
    ++values_behind;
  }
}

/// The vertices are whole; what is lost of the faces is reported where their number alone shows it.
void add_face_cuts(DamagedFiles& files) {
  const PlyTable faces{"face", {{"vertex_indices", "int", "uchar"}}, {{{0, 1, 2}}, {{0, 1, 2}}}};
  for (const std::string& format : {kPlyFormats[1], kPlyFormats[2]}) {
    const std::string sound = build_ply({format, "\n", {}, {make_vertices(kFixed, 6), faces}});
    for (std::size_t lost = 25; lost <= 26; ++lost) {
      const std::size_t size = sound.size() - lost;
      files.push_back(reported(cut_name("faces", format, size), sound.substr(0, size), "elements-lost", 6));
    }
    const PlyTable edges{"edge", {{"from", "int"}, {"to", "int"}}, {{{0}, {1}}, {{1}, {2}}}};
    const std::string fixed = build_ply({format, "\n", {}, {make_vertices(kFixed, 6), edges}});
    for (const std::size_t lost : {1U, 4U, 8U, 12U, 16U}) {
      const std::size_t size = fixed.size() - lost;
      files.push_back(reported(cut_name("edges", format, size), fixed.substr(0, size), "elements-lost", 6));
    }
  }
}

/// Faces before the vertices: cut within them there is no telling where vertices begin.
void add_cuts_before_vertices(DamagedFiles& files) {
  const PlyTable faces{"face", {{"vertex_indices", "int", "uchar"}}, {{{0, 1, 2}}, {{0, 1, 2}}}};
  for (const std::string& format : kPlyFormats) {
    const std::string sound = build_ply({format, "\n", {}, {faces, make_vertices({{"x"}, {"y"}, {"z"}}, 2)}});
    const std::size_t body = sound.find("end_header\n") + 11;
    for (const std::size_t there : {0U, 1U, 4U, 9U, 14U})
      files.push_back(refused(cut_name("before", format, body + there), sound.substr(0, body + there)));
  }
}

}  // namespace

DamagedFiles ply_truncation_cases() {
  DamagedFiles files;
  add_header_cuts(files);
  add_binary_cuts(files);
  add_ascii_cuts(files);
  add_face_cuts(files);
  add_cuts_before_vertices(files);
  return files;
}

}  // namespace arris::test
