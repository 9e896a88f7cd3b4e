#!/usr/bin/python3
"""PCL's reading of the real PLY files against the table of verdicts.

Usage: compare_pcl.py BENCH_PCL_PLY_VALUES FOLDER

Prints the files that PCL refuses, does not survive, or reads otherwise than the table says, and how many agree. PCL
reads into float, so values agree to float's precision.
"""
import collections
import csv
import math
import pathlib
import subprocess
import sys

FLOAT_STEP = 2.0**-23
LIMIT_S = 60


def outcome(program, path, row):
    try:
        run = subprocess.run([program, path], capture_output=True, text=True, errors="replace", timeout=LIMIT_S)
    except subprocess.TimeoutExpired:
        return "hangs", f"no answer in {LIMIT_S} s"
    if run.returncode != 0:
        said = (run.stderr or run.stdout).strip().splitlines()
        return ("dies" if run.returncode < 0 else "refused"), f"exit {run.returncode}: " + (said[-1] if said else "")
    values = run.stdout.strip().splitlines()[-1].split(",")
    if values[0] != row["count"]:
        return "misread", f"{values[0]} points, not {row['count']}"
    for i, axis in enumerate("xyz"):
        least, most, total = (float(v) for v in values[1 + 3 * i:4 + 3 * i])
        if not row["min_" + axis]:
            continue
        lower, upper = float(row["min_" + axis]), float(row["max_" + axis])
        scale = max(abs(lower), abs(upper))
        near = all(math.isclose(a, b, rel_tol=0, abs_tol=scale * FLOAT_STEP) for a, b in ((least, lower), (most, upper)))
        if not near:
            return "misread", f"{axis} from {least} to {most}, not from {lower} to {upper}"
        if not math.isclose(total, float(row["sum_" + axis]), rel_tol=0, abs_tol=scale * FLOAT_STEP * int(row["count"])):
            return "misread", f"sum of {axis} {total}, not {row['sum_' + axis]}"
    return "agrees", ""


def main(program, folder):
    with open(pathlib.Path(__file__).parent / "verdicts.csv", newline="") as table:
        rows = [row for row in csv.DictReader(table) if row["verdict"] == "read" and row["format"].startswith("PLY")]
    counts = collections.Counter()
    for row in rows:
        kind, why = outcome(program, folder / row["path"], row)
        counts[kind] += 1
        if kind != "agrees":
            print(f"{kind}: {row['path']} ({row['format']}): {why}")
    print(", ".join(f"{n} {kind}" for kind, n in counts.most_common()), f"of {len(rows)}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], pathlib.Path(sys.argv[2]))
