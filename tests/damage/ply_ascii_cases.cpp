/// @file Ascii bodies whose tokens are no numbers, or go out of step with the header.

#include "damaged_file.h"
#include "sound_ply.h"

namespace arris::test {
namespace {

const std::string kHeader = kPlyStart + kVertices + kEnd;

/// The y of the second vertex is no number.
void add_bad_tokens(DamagedFiles& files) {
  for (const std::string token : {"1,5",
                                  "1.5,",
                                  "one",
                                  "x",
                                  "--1",
                                  "+-1",
                                  "-+1",
                                  "-",
                                  "+",
                                  ".",
                                  "e5",
                                  "1e",
                                  "1e+",
                                  "0x10",
                                  "1.2.3",
                                  "1 000.5x",
                                  "\xe2\x88\x92"
                                  "1",
                                  "1_000",
                                  "1'000",
                                  "NaN(x)z",
                                  "infinit",
                                  "n",
                                  "i",
                                  "1.#",
                                  "2.#INF",
                                  "--1.#INF",
                                  "\x1b[31m1",
                                  "\x07",
                                  "\xff",
                                  "1;2",
                                  "#"}) {
    files.push_back(refused("ply-token-" + std::to_string(files.size()), kHeader + "0 0 0\n1 " + token + " 1\n2 2 2\n")
                        .salvaged(1));
  }
  files.push_back(refused("ply-token-nul", kHeader + std::string("0 0 0\n1 \0 1\n2 2 2\n", 18)).salvaged(1));
  files.push_back(
      refused("ply-token-of-100-kB", kHeader + "0 0 0\n1 " + std::string(100'000, 'x') + " 1\n2 2 2\n").salvaged(1));
}

void add_odd_tokens(DamagedFiles& files) {
  for (const std::string token : {"+1", "1.", ".5", "-0", "1e400", "-1e400", "1e-400", "nan", "NaN", "-nan", "inf",
                                  "INF", "-Infinity", "1.#QNAN", "-1.#IND", "1.#INF", "00001", "1e+05", "1E5"}) {
    files.push_back(read_whole("ply-number-" + std::to_string(files.size()),
                               kHeader + "0 0 0\n1 " + token + " 1\n2 2 2\n", kSoundVertices));
  }
  files.push_back(read_whole("ply-number-of-100-kB", kHeader + "0 0 0\n1 " + std::string(100'000, '1') + " 1\n2 2 2\n",
                             kSoundVertices));
  files.push_back(read_whole("ply-number-of-100-kB-behind-point",
                             kHeader + "0 0 0\n1 0." + std::string(100'000, '1') + " 1\n2 2 2\n", kSoundVertices));
}

/// Vertices may cross lines, but the values must be as many as the header says.
void add_steps(DamagedFiles& files) {
  const auto add_sound = [&](const std::string& name, const std::string& body) {
    files.push_back(read_whole("ply-body-" + name, kHeader + body, kSoundVertices));
  };
  add_sound("one-line", "0 0 0 1 1 1 2 2 2");
  add_sound("one-value-per-line", "0\n0\n0\n1\n1\n1\n2\n2\n2\n");
  add_sound("blank-lines-and-tabs", "\n\n 0\t0\v0\f\r\n\n1  1  1\n \n2 2 2\n\n");
  add_sound("no-last-line-end", "0 0 0\n1 1 1\n2 2 2");
  files.push_back(refused("ply-body-missing", kHeader).salvaged(0));
  files.push_back(refused("ply-body-blank", kHeader + std::string(64, '\n')).salvaged(0));
  files.push_back(refused("ply-body-one-value-missing", kHeader + "0 0 0\n1 1\n2 2 2\n").salvaged(2));
  files.push_back(refused("ply-body-two-columns", kHeader + "0 0\n1 1\n2 2\n").salvaged(2));
  files.push_back(refused("ply-body-four-columns", kHeader + "0 0 0 9\n1 1 1 9\n2 2 2 9\n"));
  files.push_back(refused("ply-body-one-value-more", kHeader + "0 0 0 9 1 1 1 2 2 2\n"));
  files.push_back(refused("ply-body-binary-called-ascii", kHeader + xyz_body(kPlyFormats[1], 3)).salvaged(0));
  files.push_back(refused("ply-body-one-line-then-word", kHeader + "0 0 0 1 1 1 x 2 2").salvaged(2));
  files.push_back(refused("ply-body-one-line-cut", kHeader + "0 0 0 1 1 1 2 2").salvaged(2));
}

/// Values behind the last vertex, in files whose lines are vertices: the count is too low.
void add_rest(DamagedFiles& files) {
  files.push_back(reported("ply-body-one-vertex-more", kHeader + kAsciiBody + "3 3 3\n", "trailing-bytes", 3));
  files.push_back(reported("ply-body-text-behind", kHeader + kAsciiBody + "the end\n", "trailing-bytes", 3));
  files.push_back(read_whole("ply-body-blanks-behind", kHeader + kAsciiBody + " \r\n\n\t", kSoundVertices));
}

/// Properties that are not coordinates need not be parsed, but must be numbers all the same.
void add_other_properties(DamagedFiles& files) {
  const std::string header = kPlyStart + kVertices + "property uchar red\n" + kEnd;
  files.push_back(read_whole("ply-other-sound", header + "0 0 0 7\n1 1 1 8\n2 2 2 9\n", kSoundVertices));
  files.push_back(refused("ply-other-word", header + "0 0 0 7\n1 1 1 red\n2 2 2 9\n").salvaged(1));
  files.push_back(refused("ply-other-comma", header + "0 0 0 7\n1 1 1 8,5\n2 2 2 9\n").salvaged(1));
  files.push_back(refused("ply-other-missing", header + "0 0 0 7\n1 1 1\n2 2 2 9\n").salvaged(2));
}

}  // namespace

DamagedFiles ply_ascii_cases() {
  DamagedFiles files;
  add_bad_tokens(files);
  add_odd_tokens(files);
  add_steps(files);
  add_rest(files);
  add_other_properties(files);
  return files;
}

}  // namespace arris::test
