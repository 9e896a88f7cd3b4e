#!/usr/bin/env python3
"""Makes the clouds and samples that fit_score.py fits EdgeScore to.

make_samples.py --build DIR --work DIR [--points N] [--jobs N]

Writes one CSV of samples per cloud to --work; a cloud whose CSV is there is not made again. Clouds are removed.
"""

import argparse
import concurrent.futures
import pathlib
import re
import subprocess
import tempfile

SAMPLINGS = ("jittered", "random", "poisson", "gradient", "scan")
SIGMAS = (0.0, 0.05, 0.1, 0.2, 0.4, 0.8)
OUTLIERS = (0.0, 0.01, 0.0, 0.05)
CLOUDS_PER_SCENE = 10

# Scene, options, points as a share of --points. Coarse clouds of curved scenes have radii of a few spacings, where folds
# and curved surfaces are hard to tell apart.
FIT = {
    "block": ("block", []),
    "plates2": ("plates", ["gap_spacings=2"]),
    "plates4": ("plates", ["gap_spacings=4"]),
    "plates8": ("plates", ["gap_spacings=8"]),
    "stairs": ("stairs", []),
    "gable": ("gable", []),
    "gablewalls": ("gable", ["walls=1", "ground=1", "overhang=0.5"]),
    "hip": ("hip", []),
    "dihedral": ("dihedral", []),
    "sculpture": ("sculpture", []),
    "mansard": ("mansard", []),
    "dormer": ("dormer", []),
    "dome": ("dome", []),
    "parapet": ("parapet", []),
    "corners": ("corners", []),
    "roundedge": ("roundedge", []),
    "spray": ("spray", []),
    "plane": ("plane", []),
    "sphere": ("sphere", []),
    "noise": ("noise", []),
    "town": ("town", ["stations=2"]),
    "townmixed": ("town", ["stations=3", "mixed_pixels=0.5", "registration=0.005"]),
    "blockcoarse": ("block", [], 0.1),
    "blockcoarser": ("block", [], 0.04),
    "cavitycoarse": ("block", ["cavity=1"], 0.06),
    "spherecoarse": ("sphere", [], 0.03),
    "domecoarse": ("dome", [], 0.06),
    "sculpturecoarse": ("sculpture", [], 0.4),
}
HELD_OUT = {
    "crossgable": ("crossgable", []),
    "facade": ("facade", []),
    "columns": ("columns", []),
    "townheld": ("town", ["stations=4"]),
}
FIRST_HELD_OUT_SEED = 7


def clouds():
    """One dict per cloud: samplings, noise and outliers take turns so that all pairs come up."""
    for held_out, families in ((False, FIT), (True, HELD_OUT)):
        for number, (family, (scene, settings, *share)) in enumerate(families.items()):
            for i in range(CLOUDS_PER_SCENE):
                yield {
                    "name": f"{'held' if held_out else 'fit'}-{family}-{i}",
                    "scene": scene,
                    "settings": settings,
                    "share": share[0] if share else 1.0,
                    "sampling": SAMPLINGS[i % len(SAMPLINGS)],
                    "sigma": SIGMAS[(i + 3 * (i // len(SAMPLINGS)) + number) % len(SIGMAS)],
                    "outliers": OUTLIERS[(i // 2 + number) % len(OUTLIERS)],
                    "seed": i % 3 + (FIRST_HELD_OUT_SEED if held_out else 1),
                }


def run(command, **options):
    return subprocess.run([str(c) for c in command], check=True, **options)


def make(cloud, args, folder):
    out = args.work / (cloud["name"] + ".csv")
    if out.exists():
        return
    arris = args.arris or args.build / "bin" / "arris"
    scan, truth = folder / (cloud["name"] + ".las"), folder / (cloud["name"] + ".truth.csv")
    scanned = cloud["scene"] == "town"
    command = [arris, "synth", cloud["scene"], "-o", scan, "--truth", truth, "--overwrite", "-q", "--threads", 1]
    command += ["--seed", cloud["seed"], "--outliers", cloud["outliers"]]
    for setting in cloud["settings"]:
        command += ["--set", setting]
    if scanned or cloud["sampling"] != "gradient":  # Where a gradient goes is known along x only.
        command.append("--rotate")
    if not scanned:
        command += ["--sampling", cloud["sampling"]]
    size = ["--points", round(args.points * cloud["share"] * (3 if scanned else 1))]
    if cloud["sigma"] > 0.0:
        # The noise is a share of the spacing, which follows from the number of points.
        run(command + size)
        spacing = float(re.search(r"^# spacing=(\S+)", truth.read_text(), re.M).group(1))
        size = ["--spacing", repr(spacing), "--noise", repr(cloud["sigma"] * spacing)]
    run(command + size)
    partial = out.with_suffix(".partial")
    with partial.open("w") as file:
        run([args.build / "bin" / "bench_score_samples", scan, truth], stdout=file)
    scan.unlink()
    truth.unlink()
    partial.rename(out)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, required=True, help="build folder with ARRIS_BENCH=ON")
    parser.add_argument("--arris", type=pathlib.Path, help="another arris for the scenes")
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--points", type=int, default=100000, help="about so many points per cloud; scans 3 times that")
    parser.add_argument("--jobs", type=int, default=2)
    args = parser.parse_args()
    args.work.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=args.work) as folder:
        with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
            for done in [pool.submit(make, cloud, args, pathlib.Path(folder)) for cloud in clouds()]:
                done.result()


if __name__ == "__main__":
    main()
