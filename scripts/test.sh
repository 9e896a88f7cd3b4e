#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests.
#   scripts/test.sh          the quick suite (minutes)
#   scripts/test.sh long     the long runs as well: the whole exact-tiling matrix, the large scan under a small budget
#   scripts/test.sh asan     the quick suite under AddressSanitizer and UBSan
#   scripts/test.sh tsan     the tests of the parallel pipeline under ThreadSanitizer
set -euo pipefail
cd "$(dirname "$0")/.."
what=${1:-quick}
case $what in
  quick) scripts/build.sh release -DARRIS_TESTS=ON; ctest --preset release -L quick -j"$(nproc)" ;;
  long) scripts/build.sh release -DARRIS_TESTS=ON; ctest --preset release -j1 ;;
  asan)
    ARRIS_TARGETS=labelled_quick scripts/build.sh asan -DARRIS_TESTS=ON
    ctest --preset asan -L quick -j"$(nproc)"
    ;;
  tsan)
    ARRIS_TARGETS=labelled_pipeline scripts/build.sh tsan -DARRIS_TESTS=ON
    ctest --preset tsan -L pipeline -j"$(nproc)"
    ;;
  *) echo "test.sh: unknown suite '$what' (quick, long, asan, tsan)" >&2; exit 2 ;;
esac
