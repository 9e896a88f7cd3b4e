#pragma once
/// @file Colours of points, whatever the inputs call and scale them.

#include <cstdint>
#include <memory>
#include <vector>

#include "core/cancel.h"
#include "core/progress.h"
#include "core/voxel.h"
#include "features/supervoxel/supervoxel_parameters.h"
#include "io/attribute_reader.h"
#include "io/point_source.h"

namespace arris::pipeline {

/// Reads red, green and blue as 16-bit channels. Full intensity is told from the largest channel of all LAS inputs
/// together (at most 255: 255, else 65535), and likewise of all PLY inputs (at most 1: 1): never from a single file,
/// because nothing may depend on how a scan is split into files.
class ColourSource {
 public:
  /// Looks at the inputs until it knows their ranges (usually a few batches). @return nullptr if an input has no
  /// colours, or if all are black.
  static std::unique_ptr<ColourSource> open(io::InputSet& inputs, ProgressSink& progress, const CancelToken& cancel);

  /// Colours of a batch that was read with records.
  void read(const io::PointBatch& batch, std::size_t source_index, std::vector<RawColour>& colours);

 private:
  explicit ColourSource(const io::InputSet& inputs);
  io::AttributeReader& reader(std::size_t source_index);
  void scan_ranges(io::InputSet& inputs, ProgressSink& progress, const CancelToken& cancel);
  double full(io::Format format) const;

  const io::InputSet& inputs_;
  std::size_t open_index_ = static_cast<std::size_t>(-1);
  std::unique_ptr<io::AttributeReader> reader_;
  double largest_[2] = {0.0, 0.0};  ///< Per format.
  std::vector<double> channel_;
};

/// The colours that voxels get: nullptr if they get none. Throws ConfigError if colours are demanded and an input has
/// none.
std::unique_ptr<ColourSource> wanted_colours(io::InputSet& inputs, SupervoxelParameters::Colour wanted,
                                             ProgressSink& progress, const CancelToken& cancel);

}  // namespace arris::pipeline
