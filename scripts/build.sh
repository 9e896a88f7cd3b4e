#!/usr/bin/env bash
# Installs what is missing and builds a preset: scripts/build.sh [release|asan|tsan] [CMake options...]
# ARRIS_TARGETS="a b" builds these targets only.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
[ $# -eq 0 ] || shift
scripts/install.sh
launcher=()
export CCACHE_SLOPPINESS=pch_defines,time_macros  # Else ccache refuses what includes a precompiled header.
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
cmake --preset "$preset" "${launcher[@]}" "$@" >build-configure.log 2>&1 || { cat build-configure.log; exit 1; }
rm -f build-configure.log
# shellcheck disable=SC2086  # A list of targets.
cmake --build --preset "$preset" ${ARRIS_TARGETS:+--target $ARRIS_TARGETS}
