"""T6: clouds by other authors whose edges are labelled."""

import os

import numpy as np

from . import clouds, detectors, labelled_clouds
from .point_scores import PointJudge


def cells(settings):
    found = labelled_clouds.load(settings.data)
    if not found:
        settings.notes.append("T6 is left out: the labelled clouds are absent (--data).")
    wanted = found[:1] + found[5:7] if settings.quick else found
    return [{"table": "T6", "cloud": cloud} for cloud in wanted]


def measure(cell, settings, folder):
    """One record per detector."""
    cloud = cell["cloud"]
    path = os.path.join(folder, "cloud.ply")
    clouds.write_ply(path, cloud.points)
    spacing = settings.programs.spacing(path)
    labels = cloud.labels(spacing)
    judge = PointJudge(cloud.points, labels, cloud.judged(spacing, labels), spacing, cloud.curve)
    records = []
    for detector, found in settings.detections(path, spacing, folder, f"T6, {cloud.name}"):
        if detector.best:
            tries = [judge.score(found.edge_class != 0)]
            tries += [judge.score(detectors.thresholded(found, share).astype(bool)) for share in detectors.BEST_SHARES]
            scores = {detector.name: max(tries, key=lambda s: s["f1"])}
        else:
            scores = {detector.name: judge.score(found.edge_class != 0)}
        if detector.typed:
            scores[detector.name + " (folds)"] = judge.score((found.edge_class & 4) != 0)
        records += [
            {
                "table": "T6",
                "cloud": cloud.name,
                "detector": name,
                "points": len(cloud.points),
                "spacing": spacing,
                "seconds": found.seconds,
                "band_points": int(np.sum(labels == labelled_clouds.NEAR_EDGE)),
                **score,
            }
            for name, score in scores.items()
        ]
    return records
