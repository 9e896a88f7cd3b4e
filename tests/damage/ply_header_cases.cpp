/// @file PLY headers: lines, keywords, names and types, in the dialects in use and beyond them.

#include "damaged_file.h"
#include "sound_ply.h"

namespace arris::test {
namespace {

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

const std::string kSound = kPlyStart + kVertices + kEnd + kAsciiBody;

void add_first_lines(DamagedFiles& files) {
  for (const std::string first : {"PLY", "Ply", "plyx", " ply", "ply ply", "ply\tbinary"}) {
    files.push_back(refused("ply-first-line-" + std::to_string(files.size()), first + kSound.substr(3)).at(0));
  }
  files.push_back(refused("ply-nothing-more", "ply").at(0));
  files.push_back(refused("ply-only-first-line", "ply\n"));
  files.push_back(refused("ply-two-bytes", "pl").at(0));
  files.push_back(read_whole("ply-first-line-blanks", "ply \t" + kSound.substr(3), kSoundVertices));
}

void add_line_ends(DamagedFiles& files) {
  files.push_back(read_whole("ply-crlf", replaced(kSound, "\n", "\r\n"), kSoundVertices));
  files.push_back(read_whole("ply-cr", replaced(kSound, "\n", "\r"), kSoundVertices));
  files.push_back(read_whole("ply-crlf-header-lf-body",
                             replaced(kPlyStart + kVertices + kEnd, "\n", "\r\n") + kAsciiBody, kSoundVertices));
  files.push_back(read_whole("ply-lf-then-crlf", "ply\n" + replaced(kSound.substr(4), "\n", "\r\n"), kSoundVertices));
  files.push_back(refused("ply-cr-then-lf", "ply\r" + kSound.substr(4)));
  files.push_back(read_whole("ply-trailing-blanks", replaced(kSound, "\n", " \t \n"), kSoundVertices));
  files.push_back(read_whole("ply-blank-lines", replaced(kSound, "\n", "\n\n"), kSoundVertices));
  files.push_back(
      read_whole("ply-indented", "ply\n" + replaced(kSound.substr(4), "property", "  \tproperty"), kSoundVertices));
}

void add_comments(DamagedFiles& files) {
  const std::string rest = kSound.substr(4);
  files.push_back(read_whole("ply-comment-before-format", "ply\ncomment early\n" + rest, kSoundVertices));
  files.push_back(read_whole("ply-comment-empty", "ply\ncomment\n" + rest, kSoundVertices));
  files.push_back(read_whole("ply-obj-info", "ply\nobj_info num_cols 3\nobj_info\n" + rest, kSoundVertices));
  files.push_back(read_whole("ply-comment-control", "ply\ncomment \x1b[2J\x07\x7f\xff\n" + rest, kSoundVertices));
  files.push_back(read_whole("ply-comment-nul", std::string("ply\ncomment a\0b\n", 16) + rest, kSoundVertices));
  files.push_back(read_whole("ply-comment-says-end", "ply\ncomment end_header\n" + rest, kSoundVertices));
  files.push_back(reported("ply-keyword-unknown", "ply\nmade by hand\n" + rest, "ply-keyword", kSoundVertices));
  files.push_back(reported("ply-keyword-control", "ply\n\x1b]0;title\x07\n" + rest, "ply-keyword", kSoundVertices));
  std::string many = "ply\n";
  for (int i = 0; i < 30; ++i) many += "noise " + std::to_string(i) + "\n";
  files.push_back(refused("ply-keywords-unknown-30", many + rest));
}

void add_formats(DamagedFiles& files) {
  const std::string rest = kVertices + kEnd + kAsciiBody;
  for (const std::string line : {"format", "format ascii", "format ascii 1.0 more", "format ASCII 1.0",
                                 "format binary 1.0", "format binary_middle_endian 1.0", "format \xff\x1b 1.0"}) {
    files.push_back(refused("ply-format-" + std::to_string(files.size()), "ply\n" + line + "\n" + rest).at(4));
  }
  files.push_back(refused("ply-format-missing", "ply\n" + rest));
  files.push_back(refused("ply-format-twice", kPlyStart + kPlyStart.substr(4) + rest).at(21));
  files.push_back(reported("ply-version-2.0", "ply\nformat ascii 2.0\n" + rest, "ply-version", kSoundVertices));
  files.push_back(reported("ply-version-noise", "ply\nformat ascii \x1b\xff\n" + rest, "ply-version", kSoundVertices));
  files.push_back(read_whole("ply-format-after-elements",
                             "ply\n" + kVertices + "format ascii 1.0\n" + kEnd + kAsciiBody, kSoundVertices));
}

void add_elements(DamagedFiles& files) {
  const auto with_line = [](const std::string& line) { return kPlyStart + line + "\n" + kXyz + kEnd + kAsciiBody; };
  for (const std::string line : {"element", "element vertex", "element vertex 3 3", "element 3 vertex",
                                 "Element vertex 3", "element vertex three"}) {
    files.push_back(refused("ply-element-" + std::to_string(files.size()), with_line(line)));
  }
  files.push_back(refused("ply-element-nul", with_line(std::string("element vertex\0 3", 17))));
  files.push_back(refused("ply-element-twice", kPlyStart + kVertices + kVertices + kEnd + kAsciiBody));
  files.push_back(refused("ply-element-face-twice",
                          kPlyStart + kVertices + "element face 0\nelement face 0\n" + kEnd + kAsciiBody));
  for (const std::string name : {"Vertex", "vertices", "point", "\x1b[31mvertex", "vertex\xff"})
    files.push_back(
        refused("ply-no-vertex-" + std::to_string(files.size()), with_line("element " + name + " 3")).at(0));
  files.push_back(refused("ply-no-elements", kPlyStart + kEnd + kAsciiBody).at(0));
  files.push_back(refused("ply-vertex-without-properties", kPlyStart + "element vertex 3\n" + kEnd + kAsciiBody));
  files.push_back(
      refused("ply-keyword-among-properties", kPlyStart + kVertices + "propertie float nx\n" + kEnd + kAsciiBody)
          .at(21 + 17 + 51));
}

void add_properties(DamagedFiles& files) {
  const auto with_line = [](const std::string& line) {
    return kPlyStart + kVertices + line + "\n" + kEnd + "0 0 0 0\n1 1 1 0\n2 2 2 0\n";
  };
  for (const std::string line :
       {"property", "property float", "property float a b", "property list", "property list uchar int",
        "property list uchar int a b", "property list list int a", "property real a", "property Float a",
        "property float128 a", "property int128 a", "property string a", "property \x1b\xff a", "property x",
        "property float x", "property list uchar int x", "property list float int a", "property list double int a",
        "property list float32 int a"}) {
    files.push_back(refused("ply-property-" + std::to_string(files.size()), with_line(line)).at(21 + 17 + 51));
  }
  for (const std::string name : {"char", "int8", "uchar", "uint8", "short", "int16", "ushort", "uint16", "int", "int32",
                                 "uint", "uint32", "float", "float32", "double", "float64", "int64", "uint64"})
    files.push_back(read_whole("ply-type-" + name, with_line("property " + name + " a"), kSoundVertices));
  files.push_back(read_whole("ply-property-name-control", with_line("property int \x1b[31m\xff"), kSoundVertices));
  files.push_back(refused("ply-property-first", kPlyStart + "property float x\n" + kVertices + kEnd + kAsciiBody));
  for (const std::string axis : {"x", "y", "z"}) {
    const std::string line = "property float " + axis + "\n";
    const std::string list = "property list uchar float " + axis + "\n";
    const std::string capital = "property float " + std::string(1, static_cast<char>(axis[0] - 'a' + 'A')) + "\n";
    files.push_back(refused("ply-without-" + axis, replaced(kSound, line, "")).at(0));
    files.push_back(refused("ply-list-of-" + axis, replaced(kSound, line, list)).at(0));
    files.push_back(refused("ply-capital-" + axis, replaced(kSound, line, capital)).at(0));
  }
}

void add_ends(DamagedFiles& files) {
  const std::string header = kPlyStart + kVertices;
  files.push_back(refused("ply-end-missing", header));
  files.push_back(refused("ply-end-missing-body-there", header + kAsciiBody));
  files.push_back(refused("ply-end-capital", header + "END_HEADER\n" + kAsciiBody));
  files.push_back(refused("ply-end-without-line-end", header + "end_header"));
  files.push_back(refused("ply-end-nul", header + std::string("end_header\0\n", 12) + kAsciiBody));
}

}  // namespace

DamagedFiles ply_header_cases() {
  DamagedFiles files;
  add_first_lines(files);
  add_line_ends(files);
  add_comments(files);
  add_formats(files);
  add_elements(files);
  add_properties(files);
  add_ends(files);
  return files;
}

}  // namespace arris::test
