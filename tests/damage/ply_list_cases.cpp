/// @file Lengths of lists: negative, no integers, far beyond the file, and longer than any record may be.

#include "damaged_file.h"
#include "sound_ply.h"

namespace arris::test {
namespace {

struct Length {
  const char* type;
  double number;
};

/// One vertex of x, y, z and a list whose length is stated as given, with eight bytes behind it.
std::string binary_list(const std::string& format, const Length& length, const std::string& item) {
  const bool big = format == "binary_big_endian";
  std::string body = xyz_body(format, 1) + ply_detail::binary(length.type, length.number, big);
  return ply_start(format) + "element vertex 1\n" + kXyz + "property list " + length.type + " " + item + " l\n" + kEnd +
         body + std::string(8, '\0');
}

void add_binary_lengths(DamagedFiles& files) {
  for (const std::string& format : {kPlyFormats[1], kPlyFormats[2]}) {
    for (const Length& length : {Length{"char", -1}, Length{"char", -128}, Length{"short", -1}, Length{"int", -1},
                                 Length{"int", -2147483648.0}, Length{"uchar", 9}, Length{"uchar", 255},
                                 Length{"ushort", 65535}, Length{"int", 2147483647.0}, Length{"uint", 4294967295.0},
                                 Length{"uint", 2147483648.0}, Length{"uint", 16777217}}) {
      const std::string name = "ply-list-" + short_name(format) + "-" + length.type + "-" +
                               std::to_string(static_cast<std::int64_t>(length.number));
      files.push_back(refused(name, binary_list(format, length, "uchar")).salvaged(0));
      files.push_back(refused(name + "-doubles", binary_list(format, length, "double")).salvaged(0));
    }
    files.push_back(
        read_whole("ply-list-" + short_name(format) + "-sound", binary_list(format, {"uint", 8}, "uchar"), 1));
    files.push_back(
        read_whole("ply-list-" + short_name(format) + "-one-double", binary_list(format, {"char", 1}, "double"), 1));
  }
}

/// 64-bit lengths, which products with the size of an item could wrap.
void add_wide_lengths(DamagedFiles& files) {
  for (const char* type : {"int64", "uint64"}) {
    for (const int top : {0x80, 0xff, 0x20, 0x7f}) {
      std::string length(8, '\0');
      length[7] = static_cast<char>(top);
      const std::string header =
          ply_start(kPlyFormats[1]) + "element vertex 1\n" + kXyz + "property list " + type + " double l\n" + kEnd;
      files.push_back(refused("ply-list-" + std::string(type) + "-" + std::to_string(top),
                              header + xyz_body(kPlyFormats[1], 1) + length + std::string(64, '\0'))
                          .salvaged(0));
    }
  }
}

void add_ascii_lengths(DamagedFiles& files) {
  const std::string header = kPlyStart + "element vertex 2\n" + kXyz + "property list int int l\n" + kEnd;
  for (const std::string length : {"-1", "1e30", "1.5", "1.0", "nan", "inf", "x", "99999999999999999999",
                                   "18446744073709551615", "4294967295", "1000000", "7", "0x2", "\x1b[31m"}) {
    files.push_back(
        refused("ply-list-ascii-" + std::to_string(files.size()), header + "0 0 0 1 5\n1 1 1 " + length + " 1 2\n")
            .salvaged(1));
  }
  files.push_back(read_whole("ply-list-ascii-sound", header + "0 0 0 1 5\n1 1 1 2 1 2\n", 2));
  files.push_back(refused("ply-list-ascii-item-word", header + "0 0 0 1 5\n1 1 1 2 1 two\n").salvaged(1));
}

/// Lists before the vertices decide where these begin.
void add_faces_before(DamagedFiles& files) {
  const std::string face = "element face 2\nproperty list uchar int vertex_indices\n";
  for (const std::string& format : {kPlyFormats[1], kPlyFormats[2]}) {
    const std::string body = xyz_body(format, kSoundVertices);
    const auto file = [&](const std::string& faces) {
      return ply_start(format) + face + kVertices + kEnd + faces + body;
    };
    const std::string name = "ply-faces-before-" + short_name(format);
    files.push_back(read_whole(name + "-empty", file(std::string(2, '\0')), kSoundVertices));
    files.push_back(refused(name + "-255", file("\xff\xff")));
    files.push_back(refused(name + "-takes-vertices", file(std::string("\0\x03", 2))).salvaged(2));
  }
  files.push_back(
      refused("ply-faces-before-ascii--1", kPlyStart + face + kVertices + kEnd + "3 0 1 2\n-1\n" + kAsciiBody));
}

/// Records longer than the window that is kept of a file, whole and blank.
void add_longest_records(DamagedFiles& files) {
  constexpr std::size_t kWindow = std::size_t{16} << 20;
  const std::string format = kPlyFormats[1];
  const std::string header = ply_start(format) + "element vertex 1\n" + kXyz + "property list uint uchar l\n" + kEnd;
  const std::string items(kWindow, '\0');
  files.push_back(
      refused("ply-list-longer-than-a-record-may-be", header + xyz_body(format, 1) + std::string("\0\0\0\1", 4) + items)
          .salvaged(0));
  files.push_back(
      refused("ply-ascii-blanks-without-end", kPlyStart + kVertices + kEnd + "0 0 0\n" + std::string(kWindow + 1, ' '))
          .salvaged(1));
}

}  // namespace

DamagedFiles ply_list_cases() {
  DamagedFiles files;
  add_binary_lengths(files);
  add_wide_lengths(files);
  add_ascii_lengths(files);
  add_faces_before(files);
  add_longest_records(files);
  return files;
}

}  // namespace arris::test
