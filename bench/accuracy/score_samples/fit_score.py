#!/usr/bin/env python3
"""Fits EdgeScore of arris's own method to samples (make_samples.py) and says how well it holds.

fit_score.py --work DIR            fit; prints the tables of src/features/arris/edge_score.cpp and the reliability
fit_score.py --work DIR --check    no fit: judges the scores in the samples, which the program computed

Logistic regression by Newton's method, one for folds and one for rims; needs numpy. A sample is right if its point is
within one spacing of an edge; where points come in lines, and in scans, whose lines are farther apart than the points in
them, within two (scans: of the spacings beside the edge, sqrt(area per point)).
"""

import argparse
import pathlib

import make_samples
import numpy as np

LINE_TOLERANCE = 2.0  # Spacings, where points come in lines: the sampling "scan" (its line distance), and town.
MOST_ROWS = 4000  # Per cloud in a fit.
PENALTY = 1e-4
LEAST_GAP_DEG = 105.0  # kLeastRimGap_deg.
COARSE_WEIGHT = 3.0  # Of coarse curved clouds, so that what is bent is not called a fold with confidence.
BINS = (0.0, 0.1, 0.3, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 1.0001)


def above(x, start):
    return np.maximum(x - start, 0.0)


def fold_features(d):
    """As fold_features() of src/features/arris/edge_score.cpp."""
    distance = np.minimum(d["f_distance"] / d["f_line_spacing"], 2.0)
    error = d["f_position_error"]
    curved = np.minimum(d["f_rms"] / d["f_curved_rms"], 1.0)
    margin = np.clip((1.0 - distance) / np.sqrt(error**2 + 0.01), -4.0, 6.0)
    return {
        "margin": margin,
        "margin below 0": np.minimum(margin, 0.0),
        "margin above 2": above(margin, 2.0),
        "position_error": np.minimum(error, 1.5),
        "rms_share": d["f_rms"] / d["f_all_rms"],
        "curved_share": curved,
        "curved_share above 0.8": above(curved, 0.8),
        "turn": np.minimum(180.0 - d["f_angle_deg"], 60.0) / 60.0,
        "line_spacing": d["f_line_spacing"],
        "log count": np.log(d["f_all_count"]),
        "second ball or third": (d["f_ball"] > 5.0) * 1.0,
        "third ball": (d["f_ball"] > 9.0) * 1.0,
    }


def rim_features(d):
    """As rim_features() of src/features/arris/edge_score.cpp."""
    gap = np.minimum(d["r_gap_deg"], 220.0) / 180.0
    depth = np.minimum(d["r_depth"], 1.5)
    noise = np.minimum(d["r_noise"], 1.0)
    inner, rms = d["r_inner_share"], np.minimum(d["r_rms"], 1.0)
    count = np.log(d["r_count"])
    # Beside holes and other concave rims the hull reaches over the void: what is deep in it may still be at the rim.
    empty = np.log(np.clip(d["r_empty_radius"], 0.8, 8.0))
    return {
        "gap": gap,
        "gap above 180 deg": above(gap, 1.0),
        "gap * noise": gap * noise,
        "depth": depth,
        "depth above 0.3": above(depth, 0.3),
        "depth above 0.7": above(depth, 0.7),
        "depth * noise": depth * noise,
        "log empty_radius": empty,
        "log empty_radius above 0.8": above(empty, 0.8),
        "depth above 0.3 * log empty_radius above 0.8": above(depth, 0.3) * above(empty, 0.8),
        "log count": count,
        "log count above 3.8": above(count, 3.8),
        "inner_share": inner,
        "inner_share above 0.85": above(inner, 0.85),
        "rms": rms,
        "rms above 0.3": above(rms, 0.3),
        "noise": noise,
        "offset above 0.3 gates": above(d["r_offset"] / d["r_gate"], 0.3),
    }


FEATURES = {"fold": fold_features, "rim": rim_features}


def read_samples(folder):
    """Name of cloud -> (cloud, columns)."""
    samples = {}
    for cloud in make_samples.clouds():
        path = folder / (cloud["name"] + ".csv")
        if not path.exists():
            continue
        names = path.open().readline().strip().split(",")
        rows = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
        if rows.size == 0:
            continue
        columns = {name: rows[:, i] for i, name in enumerate(names)}
        lines = cloud["scene"] == "town" or cloud["sampling"] == "scan"
        columns["right"] = columns["to_edge"] <= (LINE_TOLERANCE if lines else 1.0)
        samples[cloud["name"]] = (cloud, columns)
    return samples


def matrix(kind, columns, rows):
    features = FEATURES[kind]({name: values[rows] for name, values in columns.items()})
    return np.column_stack([np.ones(len(rows))] + list(features.values()))


def logistic(x):
    return 1.0 / (1.0 + np.exp(-np.clip(x, -30.0, 30.0)))


def newton(x, y, w):
    """Weights of the regressors (the first is constant and not penalised) of the most likely logistic model."""
    scale = np.r_[1.0, x[:, 1:].std(axis=0) + 1e-9]
    centre = np.r_[0.0, x[:, 1:].mean(axis=0)]
    z = (x - centre) / scale
    penalty = PENALTY * w.sum() * np.r_[0.0, np.ones(x.shape[1] - 1)]
    b = np.zeros(x.shape[1])
    for _ in range(50):
        p = logistic(z @ b)
        step = np.linalg.solve((z * (w * p * (1.0 - p))[:, None]).T @ z + np.diag(penalty + 1e-12),
                               z.T @ (w * (y - p)) - penalty * b)
        b += step
        if np.abs(step).max() < 1e-9:
            break
    b /= scale
    b[0] -= b[1:] @ centre[1:]
    return b


def fit(kind, samples, wanted):
    """Clouds weigh by the square root of their samples; held-out families take no part."""
    random = np.random.default_rng(1)
    x, y, w = [], [], []
    for name, (cloud, columns) in samples.items():
        if name.startswith("held"):
            continue
        rows = np.flatnonzero(wanted[name])
        if len(rows) > MOST_ROWS:
            rows = np.sort(random.choice(rows, MOST_ROWS, replace=False))
        if len(rows) == 0:
            continue
        x.append(matrix(kind, columns, rows))
        y.append(columns["right"][rows])
        weight = COARSE_WEIGHT if "coarse" in name else 1.0
        w.append(np.full(len(rows), weight / np.sqrt(len(rows) + 100.0)))
    weights = newton(np.concatenate(x), np.concatenate(y) * 1.0, np.concatenate(w))
    return np.array([float(f"{v:.5g}") for v in weights])


def print_table(kind, weights):
    names = ["constant"] + list(FEATURES[kind]({n: np.ones(1) for n in SAMPLE_COLUMNS}))
    print(f"constexpr double k{kind.capitalize()}Weights[] = {{")
    for name, weight in zip(names, weights):
        print(f"    {weight:.5g},  // {name}")
    print("};\n")


SAMPLE_COLUMNS = ("f_distance f_line_spacing f_position_error f_rms f_curved_rms f_all_rms f_angle_deg f_all_count f_ball "
                  "r_gap_deg r_depth r_noise r_inner_share r_rms r_count r_empty_radius r_offset r_gate").split()


def reliability(title, score, right):
    cells = []
    for low, high in zip(BINS[:-1], BINS[1:]):
        bin_ = (score >= low) & (score < high)
        cells.append(f"{bin_.sum()} {right[bin_].mean():.2f}" if bin_.any() else "-")
    sure = score >= 0.9
    share = f"{right[sure].mean():.3f}" if sure.any() else "-"
    recall = right[sure].sum() / max(right.sum(), 1)
    print(f"| {title} | " + " | ".join(cells) + f" | {share} | {recall:.2f} |")


def report(samples, scores):
    """scores: name -> kind -> scores of all rows, negative where the kind does not speak."""
    for kind in ("fold", "rim", "best"):
        print(f"\n{kind}: samples and share of right ones by score; right, and recall, at 0.9 and above\n")
        print("| family | " + " | ".join(f"{low:g}" for low in BINS[:-1]) + " | right >= .9 | recall >= .9 |")
        print("|---" * (len(BINS) + 2) + "|")
        families = {}
        for name, (cloud, columns) in samples.items():
            score = scores[name][kind]
            for family in (name.rsplit("-", 1)[0], name.split("-")[0] + " all"):
                part = families.setdefault(family, ([], []))
                part[0].append(score[score >= 0.0])
                part[1].append(columns["right"][score >= 0.0])
        for family, (score, right) in sorted(families.items()):
            reliability(family, np.concatenate(score), np.concatenate(right))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--check", action="store_true")
    args = parser.parse_args()
    samples = read_samples(args.work)
    scores = {name: {} for name in samples}
    asked = {name: columns["fold"] > 0 for name, (_, columns) in samples.items()}
    for kind in ("fold", "rim"):
        weights = None if args.check else fit(kind, samples, asked)
        if weights is not None:
            print_table(kind, weights)
        for name, (_, columns) in samples.items():
            rows = np.flatnonzero(asked[name])
            score = np.full(len(asked[name]), -1.0)
            score[rows] = columns[kind[0] + "_score"][rows] if args.check else logistic(
                matrix(kind, columns, rows) @ weights)
            scores[name][kind] = score
            # Rims are asked for where there is no fold that is likelier than not.
            asked[name] = (columns["rim"] > 0) & (columns["r_gap_deg"] >= LEAST_GAP_DEG) & (score < 0.5)
    for of_kind in scores.values():
        of_kind["best"] = np.maximum(of_kind["fold"], of_kind["rim"])
    report(samples, scores)


if __name__ == "__main__":
    main()
