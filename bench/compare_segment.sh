#!/usr/bin/env bash
# arris segment against PCL's normals and region growing on the same cloud in the same run, in turn, whole processes.
#   bench/compare_segment.sh [RUNS] [POINTS] [K]     needs libpcl-dev and build/bench, as bench/compare.sh; BUILD=folder
# Both read the cloud, take the same K neighbours, and write every point with its SegmentId. One thread each.
set -euo pipefail
cd "$(dirname "$0")/.."
runs=${1:-3} points=${2:-5000000} k=${3:-8}
bin=${BUILD:-build/bench}/bin
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$bin/arris" synth town --points "$points" --noise 2mm --labels -o "$work/town.las" -q
# Runs a program and prints its CPU seconds and peak memory.
measure() {
  local name=$1
  shift
  python3 - "$name" "$points" "$@" <<'PYTHON'
import os, subprocess, sys, time
name, points, command = sys.argv[1], int(sys.argv[2]), sys.argv[3:]
begin = time.monotonic()
process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
_, status, usage = os.wait4(process.pid, 0)
if status:
    sys.exit(f"{' '.join(command)} failed")
cpu = usage.ru_utime + usage.ru_stime
print(f"{name}: {cpu:.2f} CPU s, {points / cpu / 1e6:.3f} M points per CPU s, wall {time.monotonic() - begin:.2f} s, "
      f"peak resident {usage.ru_maxrss / 1024:.0f} MiB", flush=True)
PYTHON
}
for _ in $(seq "$runs"); do
  measure "arris segment" "$bin/arris" segment "$work/town.las" -o "$work/arris.las" -k "$k" --threads 1 \
    --memory 512MiB --overwrite -q
  measure "PCL" "$bin/bench_pcl_segment" "$work/town.las" "$k" 7.2 0.2 20 "$work/pcl.las"
done
