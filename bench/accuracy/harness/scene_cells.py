"""Clouds of `arris synth` with exact truth, and `arris evaluate` as the judge."""

import json
import os

from . import clouds, detectors


def synth(settings, folder, scene, options, seed):
    """Makes a cloud and its truth; paths of both."""
    cloud, truth = os.path.join(folder, "cloud.las"), os.path.join(folder, "truth.csv")
    settings.programs.arris(
        "synth", scene, *options, "--seed", seed, "-o", cloud, "--truth", truth, "--threads", 1, "--overwrite", "-q"
    )
    return cloud, truth


def truth_spacing(truth):
    """s of the scene, as its truth states it."""
    with open(truth, encoding="utf-8") as file:
        for line in file:
            if line.startswith("# spacing="):
                return float(line.split("=")[1])
    raise ValueError(f"{truth}: no spacing")


def evaluate(settings, prediction, truth, *options):
    """What `arris evaluate --json` says."""
    return json.loads(settings.programs.arris("evaluate", prediction, "--truth", truth, "--json", *options)[0])


def row_at(evaluation, tolerance_spacings):
    return next(r for r in evaluation["tolerances"] if abs(r["tolerance_spacings"] - tolerance_spacings) < 1e-9)


def summary(evaluation):
    """The figures that the report needs, by tolerance in spacings."""
    kept = (
        "precision",
        "recall",
        "f1",
        "ceiling",
        "true_positives",
        "false_positives",
        "thinness",
        "recall_by_kind",
        "average_precision",
        "offset_rms",
    )
    return {
        "detections": evaluation["detections"],
        "at": {f"{r['tolerance_spacings']:g}": {k: r[k] for k in kept} for r in evaluation["tolerances"]},
    }


def classes_of(detector, typed_classes):
    """Peers do not tell folds from boundaries: all their points count."""
    return typed_classes if detector.typed else "all"


def best_threshold(settings, found, truth, options, main_tolerance, folder):
    """The evaluation of the threshold with the best F1: an upper bound that needs the truth."""
    path = os.path.join(folder, "best.ply")
    result = evaluate(settings, found.path, truth, *options)  # The default threshold is one of those tried.
    best = (row_at(result, main_tolerance)["f1"] or 0.0, result)
    for share in detectors.BEST_SHARES[:: settings.best_stride]:
        edge = detectors.thresholded(found, share).astype(bool)
        if not edge.any():
            continue
        clouds.write_ply(path, found.points[edge], EdgeClass=edge[edge])
        result = evaluate(settings, path, truth, *options)
        f1 = row_at(result, main_tolerance)["f1"] or 0.0
        if f1 > best[0]:
            best = (f1, result)
    return best[1]


def measure(cell, settings, folder):
    """One record per detector. @param cell  table, scene, options (of synth), seed, edges, typed_classes,
    main_tolerance (spacings), key (what the report groups by), judge (more options of evaluate)."""
    cloud, truth = synth(settings, folder, cell["scene"], cell["options"], cell["seed"])
    spacing = truth_spacing(truth)
    coverage = summary(
        evaluate(settings, cloud, truth, "--edges", cell["edges"], "--input", cloud, *cell.get("judge", ()))
    )
    ceiling = {tolerance: row["ceiling"] for tolerance, row in coverage["at"].items()}
    records = []
    points = coverage["detections"]
    where = f"{cell['table']}, {cell['scene']}, seed {cell['seed']}"
    for detector, found in settings.detections(cloud, spacing, folder, where, points):
        options = (
            "--edges",
            cell["edges"],
            "--classes",
            classes_of(detector, cell["typed_classes"]),
            *cell.get("judge", ()),
        )
        if detector.best:
            result = best_threshold(settings, found, truth, options, cell["main_tolerance"], folder)
        else:
            result = evaluate(settings, found.path, truth, *options)
        records.append(
            {
                "table": cell["table"],
                "scene": cell["scene"],
                "seed": cell["seed"],
                "detector": detector.name,
                **cell["key"],
                "points": points,
                "spacing": spacing,
                "seconds": found.seconds,
                "ceiling": ceiling,
                **summary(result),
            }
        )
    return records
