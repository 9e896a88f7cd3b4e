#pragma once
/// @file Contour records in few bytes: most have some of their fields only.

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/pages.h"
#include "features/contour/contour_record.h"

namespace arris::merge {

/// Appends the bytes of records to `out`: 7 for a boundary point, 12 for a fold point, 16 more with score and refined
/// position, a byte less or more by the distance of ids. All bits of all fields are kept.
/// @param records  ascending ids, in [first_id, first_id + 2^32).
void encode_results(std::span<const ContourRecord> records, std::uint64_t first_id, PageVector<std::byte>& out);

/// The reverse, of what one call appended: replaces `records`. Safe with any bytes.
/// @return whether the bytes were those of so many records.
bool decode_results(std::span<const std::byte> bytes, std::size_t count, std::uint64_t first_id,
                    ContourRecords& records);

}  // namespace arris::merge
