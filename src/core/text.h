#pragma once
/// @file Text that may come from files, made safe for terminals and messages.

#include <cstdint>
#include <string>
#include <string_view>

namespace arris {

/// Replaces control characters and bytes above 0x7e by '?', and cuts the text after `max_length` characters.
std::string printable(std::string_view text, std::size_t max_length = 200);

/// "1 234 567" - digits in groups of three.
std::string grouped(std::uint64_t number);

/// "1.5 GiB", "12.0 MiB", "300 B".
std::string human_bytes(std::uint64_t size_bytes);

/// "2459MiB": a budget no smaller than this, as options take it.
std::string budget_text(std::uint64_t size_bytes);

}  // namespace arris
