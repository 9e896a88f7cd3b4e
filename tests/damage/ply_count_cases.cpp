/// @file Counts of PLY elements: no numbers, too large for 64 bits, for their product with a record, for the file.

#include "damaged_file.h"
#include "sound_ply.h"

namespace arris::test {
namespace {

void add_spellings(DamagedFiles& files) {
  const auto counted = [](const std::string& count) {
    return kPlyStart + "element vertex " + count + "\n" + kXyz + kEnd + kAsciiBody;
  };
  for (const std::string count :
       {"-1", "-3", "-0", "--3", "+-3", "3.0", "3e0", "0x3", "3,", "\xd9\xa3", "1.5", "nan", "inf",
        "18446744073709551616", "18446744073709551617", "99999999999999999999999999", "1e30", "-9223372036854775808"}) {
    files.push_back(refused("ply-count-spelt-" + std::to_string(files.size()), counted(count)).at(kPlyStart.size()));
  }
  files.push_back(read_whole("ply-count-plus", counted("+3"), kSoundVertices));
  files.push_back(read_whole("ply-count-zeros", counted("000000000000000000000000000003"), kSoundVertices));
}

/// Counts that no file could hold; 1537228672809129302 times 12 bytes are 8 modulo 2^64, 2^62 times 12 are 0.
const std::string kAbsurd[] = {"4",
                               "1000000",
                               "4294967295",
                               "4294967296",
                               "4294967299",
                               "1000000000000",
                               "1537228672809129302",
                               "4611686018427387904",
                               "9223372036854775807",
                               "9223372036854775808",
                               "18446744073709551614",
                               "18446744073709551615"};

void add_absurd_counts(DamagedFiles& files) {
  for (const std::string& format : kPlyFormats) {
    const std::string body = xyz_body(format, kSoundVertices);
    for (const std::string& count : kAbsurd) {
      const std::string name = "ply-count-" + short_name(format) + "-" + count;
      const std::string header = ply_start(format) + "element vertex " + count + "\n" + kXyz;
      files.push_back(refused(name, header + kEnd + body).salvaged(kSoundVertices));
      // With a list the records have no fixed size; what is taken for lengths are bytes of coordinates.
      if (format == "ascii") continue;
      files.push_back(refused(name + "-lists", header + "property list uchar int l\n" + kEnd + body).salvaged({}));
    }
  }
}

/// Fewer than there are: what is left belongs to nothing.
void add_low_counts(DamagedFiles& files) {
  for (const std::string& format : {kPlyFormats[1], kPlyFormats[2]}) {
    for (const std::uint64_t count : {0U, 1U, 2U}) {
      files.push_back(reported("ply-count-low-" + short_name(format) + "-" + std::to_string(count),
                               ply_start(format) + "element vertex " + std::to_string(count) + "\n" + kXyz + kEnd +
                                   xyz_body(format, kSoundVertices),
                               "trailing-bytes", count));
    }
  }
  for (const std::string& format : kPlyFormats) {
    files.push_back(
        read_whole("ply-no-vertices-" + short_name(format), ply_start(format) + "element vertex 0\n" + kXyz + kEnd, 0));
  }
}

/// Elements before the vertices: the vertices lie behind them, wherever that is.
void add_elements_before(DamagedFiles& files) {
  for (const std::string& format : kPlyFormats) {
    const std::string tail = kVertices + kEnd + xyz_body(format, kSoundVertices);
    const auto preceded = [&](const std::string& count, const std::string& properties) {
      return ply_start(format) + "element other " + count + "\n" + properties + tail;
    };
    const std::string name = "ply-before-" + short_name(format);
    files.push_back(read_whole(name + "-nothing", preceded("18446744073709551615", ""), kSoundVertices));
    files.push_back(read_whole(name + "-none", preceded("0", "property double a\n"), kSoundVertices));
    for (const std::string& count : kAbsurd) {
      if (format == "ascii" && count == "4") continue;  // Could be: one value would be left for the vertices.
      files.push_back(refused(name + "-" + count, preceded(count, "property double a\nproperty float b\n")));
      if (count.size() > 3)
        files.push_back(refused(name + "-lists-" + count, preceded(count, "property list char int a\n")));
    }
  }
}

/// Elements behind the vertices take no part; that they cannot be there is reported.
void add_elements_behind(DamagedFiles& files) {
  for (const std::string& format : {kPlyFormats[1], kPlyFormats[2]}) {
    for (const std::string& count : kAbsurd) {
      files.push_back(reported("ply-behind-" + short_name(format) + "-" + count,
                               ply_start(format) + kVertices + "element face " + count +
                                   "\nproperty list uchar int vertex_indices\n" + kEnd +
                                   xyz_body(format, kSoundVertices),
                               "elements-lost", kSoundVertices));
    }
  }
}

}  // namespace

DamagedFiles ply_count_cases() {
  DamagedFiles files;
  add_spellings(files);
  add_absurd_counts(files);
  add_low_counts(files);
  add_elements_before(files);
  add_elements_behind(files);
  return files;
}

}  // namespace arris::test
