#!/usr/bin/python3
"""Quality of arris supervoxel against PCL's supervoxels, on scenes with known surfaces and at equal numbers.

    cmake -S . -B build/bench -G Ninja -DARRIS_BENCH=ON && cmake --build build/bench
    bench/supervoxel_quality.py                      # all scenes, a Markdown table
    bench/supervoxel_quality.py --scene stairs --refine 3 --json stairs.json
    bench/supervoxel_quality.py --peer-only          # PCL alone, with the seeds of the scenes

Measures depend on the number of supervoxels, so the seed distance of the peer is adapted until its number agrees with
that of arris within 2 %; rows where it did not are marked. Judge: arris evaluate --labels (docs/cookbook.md).
"""

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
import time

# Scene, arguments of synth, size of voxels, distance of seeds; data units. Voxels of about two spacings.
CASES = [
    ("block", ["block"], 0.5, 4.0),
    ("block", ["block"], 0.5, 2.0),
    ("block, noise 0.2 s", ["block", "--noise", "0.05"], 0.5, 2.0),
    ("block, random", ["block", "--sampling", "random"], 0.5, 2.0),
    ("stairs", ["stairs"], 0.045, 0.3),
    ("stairs", ["stairs"], 0.045, 0.15),
    ("stairs, noise 0.2 s", ["stairs", "--noise", "0.0044"], 0.045, 0.15),
    ("town, 1 M points, 2 mm", ["town", "--points", "1000000", "--noise", "2mm"], 0.08, 0.8),
    ("town, 1 M points, 2 mm", ["town", "--points", "1000000", "--noise", "2mm"], 0.08, 0.4),
]
SAME_COUNT = 0.02
MOST_TRIES = 14
# Seeds farther apart than this give the same supervoxels or hardly any: the search stays within.
LONGEST_STEP = 2.0


class ProgramFailed(Exception):
    pass


def run(arguments):
    """Runs a program to its end; returns its output, CPU seconds, wall seconds and peak resident MiB."""
    begin = time.monotonic()
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        try:
            process = subprocess.Popen(arguments, stdout=out, stderr=err)
        except FileNotFoundError:
            raise ProgramFailed(f"{arguments[0]} is not built: cmake --build build/bench") from None
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        wall = time.monotonic() - begin
        err.seek(0)
        out.seek(0)
        if process.returncode != 0:
            message = err.read().decode("utf-8", "replace").strip()
            raise ProgramFailed(f"{' '.join(arguments)}: exit code {process.returncode}: {message}")
        text = out.read().decode("utf-8", "replace")
    return text, {
        "cpu_seconds": usage.ru_utime + usage.ru_stime,
        "wall_seconds": wall,
        "peak_mib": usage.ru_maxrss / 1024.0,
    }


class Bench:
    def __init__(self, build, work, refinements):
        self.arris = os.path.join(build, "bin", "arris")
        self.peer = os.path.join(build, "bin", "bench_pcl_supervoxel")
        self.work = work
        self.refinements = refinements

    def path(self, name):
        return os.path.join(self.work, name)

    def make_scene(self, arguments, seed):
        scan = self.path("scan.las")
        run([self.arris, "synth", *arguments, "--seed", str(seed), "--labels", "-o", scan, "--overwrite", "-q"])
        return scan

    def judge(self, scan, result, voxel):
        text, _ = run([self.arris, "evaluate", result, "--labels", scan, "--segments", "SupervoxelId",
                       "--voxel", repr(voxel), "--json"])
        return json.loads(text)

    def run_arris(self, scan, voxel, seed):
        out = self.path("arris.las")
        _, cost = run([self.arris, "supervoxel", scan, "-o", out, "--voxel", repr(voxel), "--seed", repr(seed),
                       "--overwrite", "-q"])
        return {"method": "arris", "seed": seed, **cost, "figures": self.judge(scan, out, voxel)}

    def run_peer(self, scan, voxel, seed):
        out = self.path("peer.las")
        refine = ["--refine", str(self.refinements)] if self.refinements > 0 else []
        _, cost = run([self.peer, scan, repr(voxel), repr(seed), out, *refine])
        name = "PCL, refined" if refine else "PCL"
        return {"method": name, "seed": seed, **cost, "figures": self.judge(scan, out, voxel)}

    def run_peer_at_count(self, scan, voxel, seed, count):
        """The peer with the seed distance at which it makes about `count` supervoxels."""
        return closest_to_count(lambda s: self.run_peer(scan, voxel, s), seed, count)


def closest_to_count(attempt, seed, count):
    """Of attempt(seed) at several seed distances, the result whose number of segments is nearest to `count`.

    On a surface the number falls with the square of the distance: that is the step, as long as the distances tried do
    not enclose the wanted number; then the middle (of logarithms) between the nearest ones on both sides."""
    best = None
    too_many, too_few = None, None  # Largest distance with too many, smallest with too few.
    for _ in range(MOST_TRIES):
        result = attempt(seed)
        found = result["figures"]["segments"]
        if best is None or deviation(result, count) < deviation(best, count):
            best = result
        if deviation(best, count) <= SAME_COUNT:
            break
        if found > count:
            too_many = seed if too_many is None else max(seed, too_many)
        else:
            too_few = seed if too_few is None else min(seed, too_few)
        if too_many is not None and too_few is not None and too_many < too_few:
            seed = math.sqrt(too_many * too_few)
        else:
            step = math.sqrt(max(found, 1) / count)
            seed *= min(max(step, 1.0 / LONGEST_STEP), LONGEST_STEP)
    return best


def deviation(result, count):
    return abs(result["figures"]["segments"] - count) / count


COLUMNS = ["scene", "method", "R voxel", "R seed", "number", "BR(s)", "BR(2 s)", "BR(R √3)", "UE 5 %", "UE corrected",
           "accuracy", "compactness", "no label", "CPU s", "peak MiB"]


def cells(name, voxel, result):
    figures = result["figures"]

    def recall(tolerance):
        row = min(figures["boundaries"], key=lambda r: abs(r["tolerance"] - tolerance))
        return share(row["recall"])

    def share(value):
        return "-" if value is None else f"{value:.4f}"

    spacing = figures["spacing"]
    mark = "" if result.get("same_count", True) else " (!)"
    return [name, result["method"], f"{voxel:g}", f"{result['seed']:.4g}", f"{figures['segments']}{mark}",
            recall(spacing), recall(2 * spacing), recall(voxel * math.sqrt(3)), share(figures["undersegmentation"]),
            share(figures["corrected_undersegmentation"]), share(figures["achievable_accuracy"]),
            share(figures["compactness"]), share(figures["unsegmented_share"]), f"{result['cpu_seconds']:.2f}",
            f"{result['peak_mib']:.0f}"]


def line(values):
    return "| " + " | ".join(values) + " |"


def run_case(bench, case, options):
    name, arguments, voxel, seed = case
    scan = bench.make_scene(arguments, options.seed)
    if options.peer_only:
        return [bench.run_peer(scan, voxel, seed)]
    ours = bench.run_arris(scan, voxel, seed)
    count = ours["figures"]["segments"]
    peer = bench.run_peer_at_count(scan, voxel, seed, count)
    peer["same_count"] = deviation(peer, count) <= SAME_COUNT
    return [ours, peer]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    parser.add_argument("--build", default=os.path.join(root, "build", "bench"), help="build folder with the programs")
    parser.add_argument("--work", help="folder for the clouds (default: a temporary one)")
    parser.add_argument("--scene", action="append", help="scenes whose names begin so; may be given several times")
    parser.add_argument("--seed", type=int, default=21, help="of the scenes")
    parser.add_argument("--refine", type=int, default=0, help="passes of PCL's refineSupervoxels")
    parser.add_argument("--peer-only", action="store_true", help="PCL alone")
    parser.add_argument("--json", help="write all figures of all runs")
    options = parser.parse_args()

    cases = [c for c in CASES if not options.scene or any(c[0].startswith(s) for s in options.scene)]
    all_results = []
    print(line(COLUMNS), line(["---"] * len(COLUMNS)), sep="\n", flush=True)
    with tempfile.TemporaryDirectory() as temporary:
        bench = Bench(options.build, options.work or temporary, options.refine)
        os.makedirs(bench.work, exist_ok=True)
        for case in cases:
            for result in run_case(bench, case, options):
                print(line(cells(case[0], case[2], result)), flush=True)
                all_results.append({"scene": case[0], "synth": case[1], "voxel": case[2], **result})
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(all_results, file, indent=2)


if __name__ == "__main__":
    try:
        main()
    except ProgramFailed as failure:
        sys.exit(f"supervoxel_quality.py: {failure}")
