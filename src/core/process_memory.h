#pragma once
/// @file What the operating system says of this process's memory.

#include <cstdint>

namespace arris {

/// Peak resident set size since the start (VmHWM), in bytes; 0 where the system does not tell.
std::uint64_t peak_resident_bytes();
/// Current resident set size (VmRSS), in bytes.
std::uint64_t resident_bytes();

/// Tells the allocator to hand large blocks back to the system at once and to keep few arenas, so that freed memory
/// does not stay resident. Call once, early, from main(); a library must not decide this for its host.
void configure_allocator_for_budget();
/// Gives freed heap memory back to the system.
void trim_heap();
/// The same, and spare pages (core/pages.h).
void release_free_memory();

}  // namespace arris
