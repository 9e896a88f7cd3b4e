#pragma once
/// @file Extra bytes of LAS points: reading their descriptions and adding ours (LAS 1.4 R15, "Extra Bytes", LASF_Spec /
/// 4).

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/columns.h"
#include "io/las_file.h"

namespace arris::io {

inline constexpr std::size_t kExtraBytesEntryBytes = 192;

/// One described attribute behind the fields of the point format.
struct ExtraAttribute {
  std::string name;         ///< As in the file: pass through printable() before showing it.
  std::string description;  ///< Likewise.
  std::uint8_t type = 0;    ///< Code of the specification; 0 = undocumented bytes.
  std::size_t offset = 0;   ///< In the point record.
  std::size_t size_bytes = 0;
};

/// "uint8", "float[3]", "undocumented".
std::string extra_type_name(std::uint8_t type);

/// All extra-bytes descriptions of a file, those of several records in their order.
struct ExtraBytes {
  std::vector<ExtraAttribute> attributes;  ///< Empty if not valid.
  std::vector<std::byte> entries;          ///< Whole 192-byte entries, concatenated.
  std::size_t described_bytes = 0;
  std::size_t present_bytes = 0;  ///< Record length minus size of the point format.
  /// False if the descriptions cannot be trusted: they claim more bytes than there are or use unknown types. All extra
  /// bytes are then undocumented.
  bool valid = true;
  bool whole_entries = true;       ///< False if a record's length is no multiple of 192.
  std::uint64_t record_begin = 0;  ///< Offset in the file of the first record with descriptions.
  std::vector<Problem> problems;
};
ExtraBytes read_extra_bytes(const InputFile& file, const LasFile& las);

bool is_extra_bytes_record(const LasVlr& record);

/// How to describe additional columns so that they land behind everything that is there already.
struct ExtraBytesPlan {
  int append_to = -1;  ///< Index of the VLR whose payload `appended` extends, or -1.
  std::vector<std::byte> appended;
  std::vector<std::byte> new_payload;  ///< Payload of an additional VLR; empty if none is needed.
  bool supersede_vlrs = false;   ///< Mark the present VLRs as superseded (LASF_Spec / 7): new_payload replaces them.
  bool supersede_evlrs = false;  ///< Likewise the descriptions among the extended records.
  std::vector<std::string> warnings;
};
/// Throws ConfigError if the columns do not fit the format's limits.
ExtraBytesPlan plan_extra_bytes(const InputFile& file, const LasFile& las, const std::vector<ColumnSpec>& columns);

/// 192-byte entries for columns.
std::vector<std::byte> describe_columns(const std::vector<ColumnSpec>& columns);
/// Header of a LASF_Spec / 4 record with a payload of that size.
std::vector<std::byte> extra_bytes_vlr_header(std::size_t payload_bytes);

}  // namespace arris::io
