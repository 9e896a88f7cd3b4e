#!/usr/bin/env bash
# Installs what is missing, builds, and extracts the contours of SCAN (.las, .ply or a folder of them), or of a generated scan
# of a small town block when none is given. Leaves its results in demo-output/.
set -euo pipefail
cd "$(dirname "$0")/.."
scan=${1:-}
[ -z "$scan" ] || [ -e "$scan" ] || { echo "demo.sh: $scan does not exist" >&2; exit 1; }
[ -z "$scan" ] || scan=$(realpath "$scan")
scripts/install.sh python3-numpy
scripts/build.sh release -DARRIS_TESTS=OFF
arris=build/release/bin/arris
out=demo-output
mkdir -p "$out"

if [ -z "$scan" ]; then
  echo "== A simulated terrestrial scan of a town block (2 million points, 2 mm noise)"
  $arris synth town --points 2000000 --noise 2mm -o "$out/scan.las" --truth "$out/truth.csv" --overwrite
  scan=$out/scan.las
fi
echo "== What it is"
$arris info "$scan"
echo "== What extract would do"
$arris plan "$scan"
echo "== Contours"
$arris extract "$scan" -o "$out/edges.las" -o "$out/edges.ply" --report "$out/report.json" --overwrite
if [ -e "$out/truth.csv" ] && [ "$scan" = "$out/scan.las" ]; then
  echo "== Against the truth of the generated scene"
  $arris evaluate "$out/edges.las" --truth "$out/truth.csv"
fi
case $scan in
  *.las | *.LAS) under=(--under "$scan") ;;
  *) under=() ;;
esac
/usr/bin/python3 scripts/render.py "$out/edges.las" "$out/edges.png" "${under[@]}" && echo "Picture: $out/edges.png"
echo "Results in $out/: edges.las (CloudCompare, QGIS), edges.ply (CloudCompare, MeshLab), report.json"
