#!/usr/bin/env bash
# arris against PCL on the same clouds in the same run, in turn, whole processes, CPU seconds.
#   bench/compare.sh [RUNS]      needs libpcl-dev and build/bench (cmake -S . -B build/bench -G Ninja -DARRIS_BENCH=ON)
set -euo pipefail
cd "$(dirname "$0")/.."
runs=${1:-3}
bin=build/bench/bin
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
$bin/arris synth town --points 1000000 --noise 2mm -o "$work/town.las" -q
$bin/arris synth block --points 1000000 --sampling random --noise 1cm -o "$work/block.las" -q
for cloud in town block; do
  for _ in $(seq "$runs"); do
    for method in arris liu; do
      $bin/arris extract "$work/$cloud.las" -o "$work/edges.las" --method $method --overwrite --threads 1 --report "$work/report.json" -q
      awk -v cloud=$cloud -v method=$method '/"in":/ && !points { gsub(/[^0-9]/, ""); points = $0 } /"cpu_seconds"/ { gsub(/[^0-9.]/, ""); cpu = $0 }
        END { printf "%s arris extract --method %s: %.2f CPU s, %.3f M points per CPU s\n", cloud, method, cpu, points / cpu / 1e6 }' "$work/report.json"
    done
    echo "$cloud PCL $($bin/bench_pcl_peer "$work/$cloud.las" 1)"
  done
done
