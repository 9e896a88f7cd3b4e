#!/usr/bin/env bash
# Builds the fuzz targets of the readers (clang, AddressSanitizer, UBSan) and runs each from its saved corpus.
#   scripts/fuzz.sh [RUNS]            RUNS executions per target, 100000 unless stated
#   ARRIS_FUZZ_TARGETS='fuzz_ply_body' scripts/fuzz.sh 5000000
# What is found on the way stays in build/fuzz/found/<target>, inputs that fail in build/fuzz/failed. To bring the saved
# corpora up to date:
#   build/fuzz/bin/<target> -merge=1 -max_len=4096 NEW_FOLDER tests/fuzz/corpus/<target> build/fuzz/found/<target>
set -euo pipefail
cd "$(dirname "$0")/.."
runs=${1:-100000}
targets=${ARRIS_FUZZ_TARGETS:-fuzz_las_structure fuzz_las_points fuzz_ply_header fuzz_ply_body}
launcher=()
if command -v ccache > /dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi

cmake -S . -B build/fuzz -G Ninja -DCMAKE_CXX_COMPILER="${CXX:-clang++}" -DARRIS_FUZZ=ON -DARRIS_TESTS=OFF "${launcher[@]}"
# shellcheck disable=SC2086
cmake --build build/fuzz --target $targets write_damaged_files

# The malformed files of the tests are seeds too.
seeds=build/fuzz/seeds
rm -rf "$seeds"
build/fuzz/bin/write_damaged_files "$seeds/all" 4096
for kind in las ply; do
  mkdir -p "$seeds/$kind"
  mv "$seeds/all/$kind"-* "$seeds/$kind"
done

mkdir -p build/fuzz/failed
for target in $targets; do
  kind=${target#fuzz_}
  kind=${kind%%_*}
  mkdir -p "build/fuzz/found/$target"
  echo "== $target, $runs runs"
  "build/fuzz/bin/$target" -runs="$runs" -max_len=4096 -timeout=10 -rss_limit_mb=3000 -print_final_stats=1 \
    -dict="tests/fuzz/dictionaries/$kind.dict" -artifact_prefix="build/fuzz/failed/$target-" \
    "build/fuzz/found/$target" "tests/fuzz/corpus/$target" "$seeds/$kind" 2> "build/fuzz/$target.log" ||
    { tail -n 60 "build/fuzz/$target.log"; echo "fuzz.sh: $target failed, see build/fuzz/failed" >&2; exit 1; }
  grep -E '^stat::(number|average|peak)' "build/fuzz/$target.log"
done
