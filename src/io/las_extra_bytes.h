#pragma once
/// @file Extra bytes of LAS points: reading their descriptions and adding ours (LAS 1.4 R15, "Extra Bytes", LASF_Spec /
/// 4).

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/columns.h"
#include "io/las_file.h"
#include "io/scalar_type.h"

namespace arris::io {

inline constexpr std::size_t kExtraBytesEntryBytes = 192;
inline constexpr std::size_t kMostExtraBytesPayload = 65535;

/// One described attribute behind the fields of the point format.
struct ExtraAttribute {
  std::string name;         ///< As in the file: pass through printable() before showing it.
  std::string description;  ///< Likewise.
  std::uint8_t type = 0;    ///< Code of the specification; 0 = undocumented bytes.
  std::size_t offset = 0;   ///< In the point record.
  std::size_t size_bytes = 0;
  /// Value = scale * stored + shift, for each of at most three parts (1 and 0 where the file says nothing sensible).
  std::array<double, 3> scale{1.0, 1.0, 1.0};
  std::array<double, 3> shift{0.0, 0.0, 0.0};

  std::size_t parts() const { return type == 0 ? 1 : (type - 1U) / 10U + 1U; }
  ScalarType part_type() const;  ///< Not for undocumented bytes.
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

/// The type code of an attribute with one part.
std::uint8_t extra_type_code(ScalarType type);
/// One 192-byte entry.
std::vector<std::byte> describe_attribute(std::uint8_t type, std::string_view name, std::string_view description);
/// 192-byte entries for columns.
std::vector<std::byte> describe_columns(const std::vector<ColumnSpec>& columns);
/// Entries that describe all extra bytes of a file: its own where they are valid, and undocumented ones for the rest.
std::vector<std::byte> whole_description(const ExtraBytes& extra);
/// Header of a variable-length record with a payload of that size.
std::vector<std::byte> vlr_header(std::string_view user_id, std::uint16_t record_id, std::size_t payload_bytes,
                                  std::string_view description);
/// Header of a LASF_Spec / 4 record.
std::vector<std::byte> extra_bytes_vlr_header(std::size_t payload_bytes);

}  // namespace arris::io
