#pragma once
/// @file Parsing of quantities that users type: sizes, lengths, angles.

#include <cstdint>
#include <string_view>

namespace arris {

/// "8G", "8GiB", "512MiB", "2GB" (decimal), "1048576" (bytes), "60%" (of `whole_bytes`). Throws ConfigError.
std::uint64_t parse_size_bytes(std::string_view text, std::uint64_t whole_bytes);

/// "0.03" (data units), "5 cm", "5cm", "30mm", "1.5 m", "2ft". Units are converted to metres; plain numbers are data
/// units. Must be finite and >= 0. Throws ConfigError.
double parse_length(std::string_view text);

/// Degrees: "120", "120deg". Must be finite. Throws ConfigError.
double parse_angle_deg(std::string_view text);

}  // namespace arris
