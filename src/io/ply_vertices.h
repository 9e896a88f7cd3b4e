#pragma once
/// @file What the readers of PLY vertices share.

#include <memory>
#include <span>

#include "io/input_file.h"
#include "io/ply_header.h"
#include "io/point_source.h"

namespace arris::io {

/// Binary vertices without lists: records of fixed size.
std::unique_ptr<PointSource> open_ply_fixed_source(std::shared_ptr<const InputFile> file, PlyHeader header,
                                                   Tolerance tolerance);
/// Ascii vertices, and binary ones with lists: records of any size.
std::unique_ptr<PointSource> open_ply_walked_source(std::shared_ptr<const InputFile> file, PlyHeader header,
                                                    Tolerance tolerance);

/// What the header says.
SourceInfo make_ply_info(const InputFile& file, const PlyHeader& header, Tolerance tolerance);

/// Under kSalvage: takes what is whole for the number of vertices.
/// @param begin  offset of the first vertex.
void salvage_vertices(const InputFile& file, const PlyHeader& header, std::uint64_t begin, SourceInfo& info);

/// Elements behind the vertices are not read; that the file is too short or too long for them shows all the same.
void note_short_elements(const InputFile& file, const PlyHeader& header, std::uint64_t vertices_end, SourceInfo& info);

/// Makes room for `count` world coordinates, and for what excludes them if PointExclusion::only_classes does: all are
/// excluded until mark_excluded() has seen their classes.
void start_ply_batch(PointBatch& batch, std::uint64_t first_id, std::size_t count, const PointExclusion& exclusion);

/// @param classes  classifications of the points from `first` on.
void mark_excluded(const PointExclusion& exclusion, std::span<const double> classes, std::size_t first,
                   PointBatch& batch);

}  // namespace arris::io
