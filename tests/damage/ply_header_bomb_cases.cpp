/// @file PLY headers that ask for more memory or time than their size deserves.

#include "damaged_file.h"
#include "sound_ply.h"

namespace arris::test {
namespace {

constexpr std::size_t kMebibyte = std::size_t{1} << 20;

void add_long_lines(DamagedFiles& files) {
  const std::string rest = kPlyStart.substr(4) + kVertices + kEnd + kAsciiBody;
  files.push_back(
      read_whole("ply-comment-of-100-kB", "ply\ncomment " + std::string(100'000, 'c') + "\n" + rest, kSoundVertices));
  files.push_back(
      reported("ply-keyword-of-100-kB", "ply\n" + std::string(100'000, 'k') + "\n" + rest, "ply-keyword", 3));
  files.push_back(refused("ply-comment-of-2-MiB", "ply\ncomment " + std::string(2 * kMebibyte, 'c') + "\n" + rest));
  files.push_back(refused("ply-line-without-end", "ply\n" + std::string(2 * kMebibyte, 'x')));
  files.push_back(refused("ply-nothing-but-nul", "ply\n" + std::string(2 * kMebibyte, '\0')));
  files.push_back(refused("ply-blanks-without-end", "ply\n" + std::string(2 * kMebibyte, ' ')));
  const std::string long_name(100'000, 'n');
  files.push_back(refused("ply-element-name-of-100-kB", kPlyStart + "element " + long_name + " 1\n" + kEnd));
  files.push_back(refused("ply-type-of-100-kB", kPlyStart + "element vertex 3\nproperty " + long_name + " x\n" + kEnd));
  files.push_back(refused("ply-count-of-100-kB",
                          kPlyStart + "element vertex " + std::string(100'000, '9') + "\n" + kXyz + kEnd + kAsciiBody));
  files.push_back(read_whole("ply-property-name-of-100-kB",
                             kPlyStart + "element vertex 0\n" + kXyz + "property int " + long_name + "\n" + kEnd));
}

/// Headers at and beyond the limit of 1 MiB.
void add_long_headers(DamagedFiles& files) {
  const auto of_size = [](std::size_t size) {
    std::string header = kPlyStart;
    const std::string tail = kVertices + kEnd;
    header += "comment ";
    header.resize(size - tail.size() - 1, 'c');
    return header + "\n" + tail;
  };
  files.push_back(read_whole("ply-header-of-1-MiB", of_size(kMebibyte) + kAsciiBody, kSoundVertices));
  files.push_back(refused("ply-header-of-1-MiB-and-1", of_size(kMebibyte + 1) + kAsciiBody));
  files.push_back(refused("ply-million-empty-lines", "ply\n" + std::string(1'048'000, '\n') + kPlyStart.substr(4) +
                                                         kVertices + kEnd + kAsciiBody));
  files.push_back(read_whole("ply-many-empty-lines",
                             "ply\n" + std::string(190'000, '\n') + kPlyStart.substr(4) + kVertices + kEnd + kAsciiBody,
                             kSoundVertices));
  std::string comments = "ply\n";
  for (int i = 0; i < 130'000; ++i) comments += "comment\n";
  files.push_back(read_whole("ply-130000-comments", comments + kPlyStart.substr(4) + kVertices + kEnd + kAsciiBody,
                             kSoundVertices));
}

void add_many_properties(DamagedFiles& files) {
  const auto properties = [](int count, const std::string& type) {
    std::string text;
    for (int i = 0; i < count; ++i) text += "property " + type + " " + std::to_string(i) + "\n";
    return text;
  };
  const std::string vertex = "element vertex 1\n" + kXyz;
  for (const std::string& format : kPlyFormats) {
    files.push_back(refused("ply-200000-properties-" + short_name(format),
                            ply_start(format) + vertex + properties(200'000, "int") + kEnd));
  }
  const std::string record(12 + 40'000, '\0');
  files.push_back(read_whole("ply-40000-properties",
                             ply_start(kPlyFormats[1]) + vertex + properties(40'000, "char") + kEnd + record, 1));
  files.push_back(read_whole(
      "ply-30000-lists",
      ply_start(kPlyFormats[1]) + vertex + properties(30'000, "list char int") + kEnd + record.substr(0, 12 + 30'000),
      1));
  files.push_back(refused("ply-40000-properties-cut",
                          ply_start(kPlyFormats[1]) + vertex + properties(40'000, "char") + kEnd + record.substr(1))
                      .salvaged(0));
}

void add_many_elements(DamagedFiles& files) {
  const auto elements = [](int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += "element e" + std::to_string(i) + " 0\n";
    return text;
  };
  files.push_back(
      read_whole("ply-4095-more-elements", kPlyStart + kVertices + elements(4095) + kEnd + kAsciiBody, kSoundVertices));
  files.push_back(refused("ply-4096-more-elements", kPlyStart + kVertices + elements(4096) + kEnd + kAsciiBody));
  files.push_back(refused("ply-60000-elements", kPlyStart + kVertices + elements(60'000) + kEnd + kAsciiBody));
  files.push_back(refused("ply-4000-other-elements", kPlyStart + elements(4000) + kEnd));
}

}  // namespace

DamagedFiles ply_header_bomb_cases() {
  DamagedFiles files;
  add_long_lines(files);
  add_long_headers(files);
  add_many_properties(files);
  add_many_elements(files);
  return files;
}

}  // namespace arris::test
