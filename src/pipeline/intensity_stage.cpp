#include "pipeline/intensity_stage.h"

#include <algorithm>
#include <array>
#include <functional>
#include <memory>

#include "core/pages.h"
#include "io/attribute_reader.h"
#include "pipeline/batch_pass.h"

namespace arris::pipeline {
namespace {

constexpr std::size_t kWords = 65536;

/// LAS inputs are judged together, and PLY inputs.
std::size_t group(io::Format format) {
  return format == io::Format::kLas ? 0 : 1;
}

class IntensityPasses {
 public:
  IntensityPasses(io::InputSet& inputs, ProgressSink& progress, const CancelToken& cancel)
      : inputs_(inputs), progress_(progress), cancel_(cancel) {}

  IntensityTable run() {
    if (!find_intensities()) return std::move(table_);
    table_.of_point.resize(inputs_.points());
    PageVector<std::uint16_t> words(keeps_words() ? inputs_.points() : 0);
    // Most scans have 8 bits: with the bytes written at once they are done.
    pass("intensity", [&](std::size_t g, const io::PointBatch& batch) {
      groups_[g].add(values_);
      if (words.empty()) return store_bytes({}, batch);
      std::uint16_t* const of_batch = words.data() + batch.first_id;
      for (std::size_t i = 0; i < batch.count; ++i) of_batch[i] = static_cast<std::uint16_t>(values_[i]);
    });
    const std::array<bool, 2> refine{groups_[0].needs_refining(), groups_[1].needs_refining()};
    if (refine[0] || refine[1]) {
      pass("intensity range", [&](std::size_t g, const io::PointBatch&) {
        if (refine[g]) groups_[g].refine(values_);
      });
    }
    const std::array<IntensityScale, 2> scales{groups_[0].scale(), groups_[1].scale()};
    if (!words.empty()) {
      store_bytes(scales[0], words);
    } else if (scales[0].scaled || scales[1].scaled) {
      pass("intensity scaling", [&](std::size_t g, const io::PointBatch& batch) { store_bytes(scales[g], batch); });
    }
    for (std::size_t i = 0; i < table_.files.size(); ++i)
      table_.files[i].scale = scales[group(inputs_.sources()[i].format)];
    return std::move(table_);
  }

 private:
  /// Where there are only words, and few, they are read once.
  bool keeps_words() const {
    constexpr std::uint64_t kMostWords = 8'000'000;
    const auto& sources = inputs_.sources();
    return inputs_.points() <= kMostWords &&
           std::ranges::all_of(sources, [](const auto& source) { return source.format == io::Format::kLas; });
  }

  static std::unique_ptr<io::AttributeReader> open(const io::SourceInfo& source) {
    return std::make_unique<io::AttributeReader>(source.path, std::vector<std::string>{"intensity"});
  }

  /// False if an input with points has none.
  bool find_intensities() {
    bool all = true;
    for (const io::SourceInfo& source : inputs_.sources()) {
      table_.files.push_back({open(source)->has(0), {}});
      all = all && (table_.files.back().has || source.points == 0);
    }
    return all;
  }

  /// Calls visit(group, batch) with the intensities of each batch in values_.
  void pass(const char* name, const std::function<void(std::size_t group, const io::PointBatch& batch)>& visit) {
    std::unique_ptr<io::AttributeReader> reader;
    std::size_t open_index = 0;
    io::ReadOptions options;
    options.records = true;
    for_each_batch(inputs_, options, name, progress_, cancel_, [&](std::size_t source, const io::PointBatch& batch) {
      if (!reader || source != open_index) reader = open(inputs_.sources()[source]);
      open_index = source;
      reader->read(batch, 0, values_);
      visit(group(inputs_.sources()[source].format), batch);
    });
  }

  void store_bytes(const IntensityScale& scale, const io::PointBatch& batch) {
    std::uint8_t* const bytes = table_.of_point.data() + batch.first_id;
    for (std::size_t i = 0; i < batch.count; ++i) bytes[i] = scale.byte_of(values_[i]);
  }

  void store_bytes(const IntensityScale& scale, const PageVector<std::uint16_t>& words) {
    std::array<std::uint8_t, kWords> byte_of;
    for (std::size_t word = 0; word < kWords; ++word) byte_of[word] = scale.byte_of(static_cast<double>(word));
    std::ranges::transform(words, table_.of_point.begin(), [&](std::uint16_t word) { return byte_of[word]; });
  }

  io::InputSet& inputs_;
  ProgressSink& progress_;
  const CancelToken& cancel_;
  IntensityTable table_;
  std::array<IntensityPercentiles, 2> groups_{IntensityPercentiles(IntensityPercentiles::Values::kWords),
                                              IntensityPercentiles(IntensityPercentiles::Values::kAny)};
  std::vector<double> values_;
};

}  // namespace

IntensityTable read_intensities(io::InputSet& inputs, ProgressSink& progress, const CancelToken& cancel) {
  return IntensityPasses(inputs, progress, cancel).run();
}

}  // namespace arris::pipeline
