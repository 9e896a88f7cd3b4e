#include "io/point_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <system_error>

#include "core/error.h"
#include "core/text.h"
#include "io/bytes.h"
#include "io/input_file.h"
#include "io/las_source.h"
#include "io/ply_source.h"

namespace arris::io {
namespace {

namespace fs = std::filesystem;

/// What a file seems to be, for the message that refuses it.
std::string guess(std::string_view head) {
  if (head.empty()) return "the file is empty";
  if (head.starts_with("ASTM-E57")) return "this is an E57 file, which this version cannot read";
  if (head.starts_with("PK\3\4") || head.starts_with("\x1f\x8b")) return "this is an archive, to be unpacked first";
  if (head.starts_with("# .PCD")) return "this is a PCD file, which this version cannot read";
  return "the first bytes are those of neither LAS (\"LASF\") nor PLY (\"ply\")";
}

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

std::vector<fs::path> scans_in_folder(const fs::path& folder) {
  std::vector<fs::path> found;
  std::size_t compressed = 0;
  try {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      const std::string extension = lower_extension(entry.path());
      if (!entry.is_regular_file()) continue;
      if (extension == ".laz") ++compressed;
      if (extension == ".las" || extension == ".ply") found.push_back(entry.path());
    }
  } catch (const fs::filesystem_error& error) {
    throw IoError(fmt::format("{}: cannot be listed: {}", printable(folder.string(), 1000), error.code().message()));
  }
  if (found.empty()) {
    throw InputError(fmt::format("{}: the folder has no .las or .ply file{}", printable(folder.string(), 1000),
                                 compressed > 0 ? "; its .laz files must be decompressed first" : ""));
  }
  std::sort(found.begin(), found.end(),
            [](const fs::path& a, const fs::path& b) { return a.filename().native() < b.filename().native(); });
  return found;
}

[[noreturn]] void refuse_changed(const SourceInfo& expected, const std::string& difference) {
  throw InputError(fmt::format("{}: changed while it was in use ({}); start again when it is complete",
                               printable(expected.path.string(), 1000), difference));
}

}  // namespace

void refuse_problem(const InputFile& file, const Problem& problem) {
  refuse(file, problem.byte, fmt::format("{} [{}]", problem.text, problem.code),
         "this is refused under --strict: repair the file, or read it without");
}

std::unique_ptr<PointSource> open_point_source(std::shared_ptr<const InputFile> file, Tolerance tolerance) {
  std::array<std::byte, 8> head{};
  const std::size_t got = file->read_some(0, head);
  const std::string_view text(reinterpret_cast<const char*>(head.data()), got);
  constexpr std::string_view kBlanks = " \t\r\n";
  std::unique_ptr<PointSource> source;
  if (text.starts_with("LASF")) {
    source = open_las_source(file, tolerance);
  } else if (text.starts_with("ply") && (text.size() == 3 || kBlanks.find(text[3]) != std::string_view::npos)) {
    source = open_ply_source(file, tolerance);
  } else {
    refuse(*file, 0, guess(text), "export the scan as LAS or PLY");
  }
  if (tolerance == Tolerance::kStrict && !source->info().problems.empty()) {
    refuse_problem(*file, source->info().problems.front());
  }
  return source;
}

std::unique_ptr<PointSource> open_point_source(const fs::path& path, Tolerance tolerance) {
  return open_point_source(std::make_shared<const InputFile>(path), tolerance);
}

std::vector<fs::path> expand_inputs(std::span<const std::string> arguments) {
  std::vector<fs::path> paths;
  for (const std::string& argument : arguments) {
    std::error_code error;
    const fs::file_status status = fs::status(argument, error);
    if (status.type() == fs::file_type::not_found) {
      throw InputError(fmt::format("{}: no such file or folder", printable(argument, 1000)));
    }
    if (error) throw IoError(fmt::format("{}: cannot be examined: {}", printable(argument, 1000), error.message()));
    if (status.type() != fs::file_type::directory) {
      paths.emplace_back(argument);
      continue;
    }
    for (fs::path& path : scans_in_folder(argument)) paths.push_back(std::move(path));
  }
  return paths;
}

InputSet::InputSet(const std::vector<fs::path>& paths, Tolerance tolerance) {
  if (paths.empty()) throw ConfigError("no input files were given");
  for (const fs::path& path : paths) {
    infos_.push_back(open_point_source(path, tolerance)->info());
    const auto sum = checked_add(points_, infos_.back().points);
    if (!sum)
      throw InputError(fmt::format("{}: the inputs promise more than 2^64 points", printable(path.string(), 1000)));
    points_ = *sum;
  }
}

void InputSet::check_unchanged() const {
  for (const SourceInfo& expected : infos_) {
    const InputFile now(expected.path);
    if (now.size_bytes() != expected.size_bytes || now.modified_ns() != expected.modified_ns) {
      refuse_changed(expected, fmt::format("{} bytes, now {}", expected.size_bytes, now.size_bytes()));
    }
  }
}

void InputSet::rewind() {
  open_.reset();
  current_ = 0;
  next_ = 0;
  first_id_ = 0;
}

void InputSet::exclude(const PointExclusion& exclusion) {
  for (const SourceInfo& source : infos_) {
    if (exclusion.only_classes.none() || source.has_classes) continue;
    throw InputError(
        fmt::format("{}: has no property \"classification\", so its points are of none of the classes asked for; "
                    "classify it, or leave out --only-class",
                    printable(source.path.string(), 1000)));
  }
  exclusion_ = exclusion;
}

void InputSet::open_next() {
  const SourceInfo& expected = infos_[next_];
  open_ = open_point_source(expected.path, expected.tolerance);
  if (open_->info().size_bytes != expected.size_bytes || open_->info().points != expected.points ||
      open_->info().modified_ns != expected.modified_ns) {
    refuse_changed(expected, fmt::format("{} points, now {}", expected.points, open_->info().points));
  }
  current_ = next_++;
}

bool InputSet::skip_to(std::uint64_t id) {
  const bool is_open = open_ && id >= first_id_ && id - first_id_ < infos_[current_].points;
  if (!is_open) {
    rewind();
    while (id - first_id_ >= infos_.at(next_).points) first_id_ += infos_[next_++].points;
    open_next();
  }
  return open_->skip_to(id - first_id_);
}

bool InputSet::read(PointBatch& batch, const ReadOptions& wanted) {
  ReadOptions options = wanted;
  const bool own = !wanted.exclusion.any();
  if (own) options.exclusion = exclusion_;
  for (;;) {
    if (open_ && open_->read(batch, options)) {
      batch.first_id += first_id_;
      if (own && !filters_.empty()) {
        batch.excluded.resize(batch.count, 0);
        for (const PointFilter& filter : filters_) filter(current_, batch);
      }
      return true;
    }
    if (open_) {
      first_id_ += infos_[next_ - 1].points;
      infos_[next_ - 1].problems = open_->info().problems;
    }
    open_.reset();
    if (next_ == infos_.size()) {
      batch.count = 0;
      return false;
    }
    open_next();
  }
}

}  // namespace arris::io
