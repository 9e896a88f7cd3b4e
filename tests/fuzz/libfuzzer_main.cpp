/// @file One of the entries as a libFuzzer target; which one is ARRIS_FUZZ_ENTRY.

#include "fuzz_entries.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  arris::test::ARRIS_FUZZ_ENTRY({data, size});
  return 0;
}
