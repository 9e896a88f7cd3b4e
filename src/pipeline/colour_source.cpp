#include "pipeline/colour_source.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace arris::pipeline {
namespace {

const std::vector<std::string> kChannels{"red", "green", "blue"};
constexpr double kMostByte = 255.0;
constexpr double kMostWord = 65535.0;

std::size_t group(io::Format format) {
  return format == io::Format::kLas ? 0 : 1;
}

}  // namespace

ColourSource::ColourSource(const io::InputSet& inputs) : inputs_(inputs) {}

io::AttributeReader& ColourSource::reader(std::size_t source_index) {
  if (source_index != open_index_) {
    reader_ = std::make_unique<io::AttributeReader>(inputs_.sources()[source_index].path, kChannels);
    open_index_ = source_index;
  }
  return *reader_;
}

std::unique_ptr<ColourSource> ColourSource::open(io::InputSet& inputs, ProgressSink& progress,
                                                 const CancelToken& cancel) {
  std::unique_ptr<ColourSource> colours(new ColourSource(inputs));
  for (std::size_t i = 0; i < inputs.sources().size(); ++i) {
    io::AttributeReader& attributes = colours->reader(i);
    for (std::size_t c = 0; c < kChannels.size(); ++c) {
      if (!attributes.has(c)) return nullptr;
    }
  }
  colours->scan_ranges(inputs, progress, cancel);
  if (std::max(colours->largest_[0], colours->largest_[1]) <= 0.0) return nullptr;
  return colours;
}

void ColourSource::scan_ranges(io::InputSet& inputs, ProgressSink& progress, const CancelToken& cancel) {
  progress.phase("colours", inputs.points());
  bool wanted[2] = {false, false};
  for (const io::SourceInfo& source : inputs.sources()) wanted[group(source.format)] = true;
  inputs.rewind();
  io::PointBatch batch;
  io::ReadOptions options;
  options.records = true;
  while ((wanted[0] || wanted[1]) && inputs.read(batch, options)) {
    cancel.check();
    progress.advance(batch.count);
    const std::size_t g = group(inputs.sources()[inputs.source_index()].format);
    if (!wanted[g]) continue;
    io::AttributeReader& attributes = reader(inputs.source_index());
    for (std::size_t c = 0; c < kChannels.size(); ++c) {
      attributes.read(batch, c, channel_);
      for (const double value : channel_) {
        if (value > largest_[g]) largest_[g] = value;  // NaN is not larger.
      }
    }
    wanted[g] = largest_[g] <= kMostByte;
  }
}

double ColourSource::full(io::Format format) const {
  const double largest = largest_[group(format)];
  if (format == io::Format::kPly && largest <= 1.0) return 1.0;
  return largest <= kMostByte ? kMostByte : kMostWord;
}

void ColourSource::read(const io::PointBatch& batch, std::size_t source_index, std::vector<RawColour>& colours) {
  io::AttributeReader& attributes = reader(source_index);
  const double to_word = kMostWord / full(inputs_.sources()[source_index].format);
  colours.resize(batch.count);
  for (std::size_t c = 0; c < kChannels.size(); ++c) {
    attributes.read(batch, c, channel_);
    for (std::size_t i = 0; i < batch.count; ++i) {
      const double word = std::clamp(channel_[i] * to_word, 0.0, kMostWord);
      colours[i][c] = std::isnan(word) ? std::uint16_t{0} : static_cast<std::uint16_t>(word + 0.5);
    }
  }
}

std::unique_ptr<ColourSource> wanted_colours(io::InputSet& inputs, SupervoxelParameters::Colour wanted,
                                             ProgressSink& progress, const CancelToken& cancel) {
  if (wanted == SupervoxelParameters::Colour::kOff) return nullptr;
  std::unique_ptr<ColourSource> colours = ColourSource::open(inputs, progress, cancel);
  if (wanted == SupervoxelParameters::Colour::kOn && !colours)
    throw ConfigError("--colour on: not every input has colours that are not all black; leave it out, or --colour off");
  return colours;
}

}  // namespace arris::pipeline
