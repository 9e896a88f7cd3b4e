#!/usr/bin/python3
"""Quality of arris segment against PCL's region growing, on roofs as an airborne scanner sees them.

    cmake -S . -B build/bench -G Ninja -DARRIS_BENCH=ON && cmake --build build/bench
    bench/segment_quality.py                         # all scenes and densities, a Markdown table
    bench/segment_quality.py --scene hip --density 8 --json hip.json
    bench/segment_quality.py --peer none             # arris alone; --peer only: PCL alone
    bench/segment_quality.py --arris=--angle=10      # with options of arris segment

Every row is the mean of the seeds. arris runs with its defaults. PCL runs with every setting of the grid in
pcl_segment_search.cpp; its row is of the one with the best mean F of completeness and correctness of that very scene
and density, chosen with a look at the truth: "PCL with its best parameters" (neighbours, angle, curvature, least
points). Judge: arris evaluate --labels (docs/cookbook.md, Planes); completeness,
correctness and IoU are means over the planes of 10 m² or more, "found" and "right" are counts of the same.
"""

import argparse
import json
import os
import sys
import tempfile

from supervoxel_quality import ProgramFailed, line, run

NOISE = "0.03"
# Points per m², and the spacing that gives them.
DENSITIES = {"8": 0.354, "2.19": 0.676}
ROOFS = ["gable", "hip", "crossgable", "mansard", "dormer", "dome", "parapet"]
SEEN_FROM_ABOVE = {"parapet": ["--set", "walls=0"]}
TWO_MATERIALS = ["--set", "materials=2"]
CASES = [(roof, [roof, "--set", "tree=1", *SEEN_FROM_ABOVE.get(roof, [])]) for roof in ROOFS] + [
    ("roofs", ["roofs"]),
    ("roofs, ground", ["roofs", "--set", "ground=1"]),
    ("roofs, walls and ground", ["roofs", "--set", "ground=1", "--set", "walls=1"]),
    ("roofs, two materials", ["roofs", *TWO_MATERIALS]),
    ("roofs, two materials, intensities ± 5 %", ["roofs", *TWO_MATERIALS, "--set", "intensity_noise=0.05"]),
    ("gable, two materials", ["gable", "--set", "tree=1", *TWO_MATERIALS]),
]
MIN_AREA = "10"


class Bench:
    def __init__(self, options, work):
        self.arris = os.path.join(options.build, "bin", "arris")
        self.peer = os.path.join(options.build, "bin", "bench_pcl_segment")
        self.search = os.path.join(options.build, "bin", "bench_pcl_segment_search")
        self.work = work
        self.sampling = options.sampling
        self.seeds = options.seeds
        self.extra = options.arris

    def make_scenes(self, arguments, spacing):
        scans = []
        for seed in self.seeds:
            scan = os.path.join(self.work, f"scan_{seed}.las")
            run([self.arris, "synth", *arguments, "--spacing", repr(spacing), "--noise", NOISE, "--sampling",
                 self.sampling, "--seed", str(seed), "--labels", "-o", scan, "--overwrite", "-q"])
            scans.append(scan)
        return scans

    def judge(self, scan, result, spacing):
        text, _ = run([self.arris, "evaluate", result, "--labels", scan, "--segments", "SegmentId", "--spacing",
                       repr(spacing), "--min-area", MIN_AREA, "--json"])
        return figures_of(json.loads(text))

    def run_arris(self, scan, spacing):
        out = os.path.join(self.work, "arris.las")
        run([self.arris, "segment", scan, "-o", out, "--overwrite", "-q", *self.extra])
        return self.judge(scan, out, spacing)

    def run_peer(self, scan, spacing, settings):
        out = os.path.join(self.work, "pcl.las")
        run([self.peer, scan, *settings, out])
        return self.judge(scan, out, spacing)

    def best_settings(self, scans, spacing):
        """K, ANGLE, CURVATURE and MIN of the peer with the best mean F."""
        text, _ = run([self.search, repr(spacing), MIN_AREA, *scans])
        lines = [row.split() for row in text.splitlines()]
        return max(lines, key=lambda row: float(row[-1]))[:-1]


def figures_of(judged):
    """The figures that the table has, of one run."""
    planes = judged["planes"]
    large = planes["large"]
    result = {name: large[name] for name in ("planes", "planes_found", "segments", "segments_right", "quality",
                                             "completeness", "correctness", "iou", "one_to_one", "one_to_many",
                                             "many_to_one", "many_to_many")}
    result["ari"] = judged["adjusted_rand"]
    result["ari_all"] = planes["adjusted_rand"]
    result["unsegmented"] = planes["unsegmented_share"]
    result["trees_left"] = planes["strays_unsegmented_share"]
    result["matches"] = planes["matches"]
    complete, correct = result["completeness"] or 0.0, result["correctness"] or 0.0
    result["f"] = 2.0 * complete * correct / (complete + correct) if complete + correct > 0.0 else 0.0
    return result


def mean(runs, name):
    values = [r[name] for r in runs if r[name] is not None]
    return sum(values) / len(values) if values else None


COLUMNS = ["scene", "points per m²", "method", "planes found", "segments right", "completeness", "correctness", "F",
           "IoU", "ARI", "ARI, all points", "no segment", "trees left alone"]


def cells(name, density, method, runs):
    def text(figure):
        value = mean(runs, figure)
        return "-" if value is None else f"{value:.3f}"

    def of(part, whole):
        return f"{sum(r[part] for r in runs)}/{sum(r[whole] for r in runs)}"

    return [name, density, method, of("planes_found", "planes"), of("segments_right", "segments"),
            *(text(f) for f in ("completeness", "correctness", "f", "iou", "ari", "ari_all", "unsegmented",
                                "trees_left"))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    parser.add_argument("--build", default=os.path.join(root, "build", "bench"), help="build folder with the programs")
    parser.add_argument("--work", help="folder for the clouds (default: a temporary one)")
    parser.add_argument("--scene", action="append", help="scenes whose names begin so; may be given several times")
    parser.add_argument("--density", action="append", choices=list(DENSITIES), help="points per m² (default: both)")
    parser.add_argument("--sampling", default="random", help="of the scenes, as in arris synth")
    parser.add_argument("--seeds", type=int, nargs="+", default=[21, 22, 23], help="of the scenes")
    parser.add_argument("--peer", choices=["best", "none", "only"], default="best", help="PCL too, not, or alone")
    parser.add_argument("--arris", action="append", default=[], help="option of arris segment, as --arris=--angle=10")
    parser.add_argument("--json", help="write all figures of all runs, planes one by one")
    options = parser.parse_args()

    results = []
    print(line(COLUMNS), line(["---"] * len(COLUMNS)), sep="\n", flush=True)

    def report(name, density, method, runs, **more):
        print(line(cells(name, density, method, runs)), flush=True)
        results.append({"scene": name, "density": density, "method": method, "runs": runs, **more})

    with tempfile.TemporaryDirectory() as temporary:
        bench = Bench(options, options.work or temporary)
        os.makedirs(bench.work, exist_ok=True)
        for density in options.density or DENSITIES:
            for name, arguments in CASES:
                if options.scene and not any(name.startswith(s) for s in options.scene):
                    continue
                spacing = DENSITIES[density]
                scans = bench.make_scenes(arguments, spacing)
                if options.peer != "only":
                    report(name, density, "arris", [bench.run_arris(scan, spacing) for scan in scans])
                if options.peer != "none":
                    settings = bench.best_settings(scans, spacing)
                    k, angle, curvature, least = settings
                    runs = [bench.run_peer(scan, spacing, settings) for scan in scans]
                    report(name, density, f"PCL {k}, {angle}°, {curvature}, {least}", runs, settings=settings)
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(results, file, indent=1)


if __name__ == "__main__":
    try:
        main()
    except ProgramFailed as failure:
        sys.exit(f"segment_quality.py: {failure}")
