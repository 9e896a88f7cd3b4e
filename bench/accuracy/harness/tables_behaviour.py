"""T3, T4, T7: which angles are found, what is found where nothing is, and what moving the cloud changes."""

import os

from . import scene_cells
from .tables_scenes import surface_options

DIHEDRAL_SPACING_M = 0.05
PLAIN_SPACING_M = 0.1
BLOCK_SPACING_M = 0.25
SHIFT = ("--shift", 500000, 5000000, 100)


def angle_cells(settings):
    return [{"table": "T3", "seed": seed, "sigma": sigma} for seed in settings.seeds for sigma in (0.0, 0.2)]


def angle_measure(cell, settings, folder):
    options = surface_options(DIHEDRAL_SPACING_M, cell["sigma"], "jittered")
    cloud, truth = scene_cells.synth(settings, folder, "dihedral", options, cell["seed"])
    spacing = scene_cells.truth_spacing(truth)
    by_angle = _split_by_angle(truth, folder)
    records = []
    # Recall alone has no best threshold.
    for detector, found in settings.detections(cloud, spacing, folder, f"T3, seed {cell['seed']}", best=False):
        rows = {detector.name: "all", **({detector.name + " (folds)": "fold"} if detector.typed else {})}
        for name, classes in rows.items():
            recall = {}
            for angle, part in by_angle.items():
                result = scene_cells.evaluate(settings, found.path, part, "--edges", "folds", "--classes", classes)
                recall[angle] = {t: scene_cells.row_at(result, float(t))["recall"] for t in ("1", "2")}
            everything = scene_cells.evaluate(settings, found.path, truth, "--edges", "all", "--classes", classes)
            far = scene_cells.row_at(everything, 2.0)["false_positives"]
            records.append(
                {
                    "table": "T3",
                    "seed": cell["seed"],
                    "sigma": cell["sigma"],
                    "detector": name,
                    "points": len(found.points),
                    "recall": recall,
                    "far_share": far / len(found.points),
                    "seconds": found.seconds,
                }
            )
    return records


def _split_by_angle(truth, folder):
    """A truth file per interior angle, with the folds of that angle only; keys in whole degrees, ascending."""
    with open(truth, encoding="utf-8") as file:
        lines = file.read().splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith("kind,"))
    angle_column = lines[start].split(",").index("angle_deg")
    rows = {}
    for line in lines[start + 1 :]:
        words = line.split(",")
        if "boundary" not in words[0]:
            rows.setdefault(round(float(words[angle_column])), []).append(line)
    paths = {}
    for angle in sorted(rows):
        paths[angle] = os.path.join(folder, f"truth_{angle}.csv")
        with open(paths[angle], "w", encoding="utf-8") as file:
            file.write("\n".join(lines[: start + 1] + rows[angle]) + "\n")
    return paths


def alarm_cells(settings):
    plan = [("plane", sampling, sigma) for sampling in settings.samplings for sigma in (0.0, 0.2, 0.4)]
    plan += [("sphere", sampling, sigma) for sampling in settings.samplings for sigma in (0.0, 0.2)]
    plan += [("noise", None, 0.0)]
    return [
        {"table": "T4", "scene": scene, "sampling": sampling, "sigma": sigma, "seed": seed}
        for seed in settings.seeds
        for scene, sampling, sigma in plan
    ]


def alarm_measure(cell, settings, folder):
    scene = cell["scene"]
    options = surface_options(PLAIN_SPACING_M, cell["sigma"], cell["sampling"] or "random")
    if scene == "sphere":
        options += ["--set", f"radius={50 * PLAIN_SPACING_M:g}"]
    cloud, truth = scene_cells.synth(settings, folder, scene, options, cell["seed"])
    records = []
    # Without truth there is no best threshold.
    where = f"T4, {scene}, seed {cell['seed']}"
    for detector, found in settings.detections(cloud, PLAIN_SPACING_M, folder, where, best=False):
        # The plane's border is a boundary; sphere and noise have no edges, and all detections are alarms.
        evaluation = scene_cells.evaluate(settings, found.path, truth, "--edges", "all")
        alarms = (
            scene_cells.row_at(evaluation, 2.0)["false_positives"] if scene == "plane" else evaluation["detections"]
        )
        fold = int(((found.edge_class & 4) != 0).sum()) if detector.typed else None
        records.append(
            {
                "table": "T4",
                "scene": scene,
                "sampling": cell["sampling"],
                "sigma": cell["sigma"],
                "seed": cell["seed"],
                "detector": detector.name,
                "points": len(found.points),
                "alarms": alarms,
                "share": alarms / len(found.points),
                "fold_points": fold,
                "seconds": found.seconds,
            }
        )
    return records


def motion_cells(settings):
    return [{"table": "T7", "seed": seed} for seed in settings.seeds]


def motion_measure(cell, settings, folder):
    """The block as it is, rotated, shifted, and both: F1 and the indices of the detected points."""
    base = surface_options(BLOCK_SPACING_M, 0.2, "jittered")
    variants = {"as is": (), "shifted": SHIFT, "rotated": ("--rotate",), "rotated and shifted": ("--rotate", *SHIFT)}
    still, records = {}, []
    for name, motion in variants.items():
        cloud, truth = scene_cells.synth(settings, folder, "block", [*base, *motion], cell["seed"])
        where = f"T7, {name}, seed {cell['seed']}"
        for detector, found in settings.detections(cloud, BLOCK_SPACING_M, folder, where, best=False):
            result = scene_cells.evaluate(
                settings, found.path, truth, "--edges", "folds", "--classes", scene_cells.classes_of(detector, "fold")
            )
            edge = found.edge_class != 0
            if not motion:
                still[detector.name] = found.edge_class
            reference = still.get(detector.name, ())
            comparable = len(reference) == len(edge)
            union = int((edge | (reference != 0)).sum()) if comparable else 0
            common = int((edge & (reference != 0)).sum()) if comparable else 0
            records.append(
                {
                    "table": "T7",
                    "seed": cell["seed"],
                    "variant": name,
                    "detector": detector.name,
                    "f1": scene_cells.row_at(result, 1.0)["f1"],
                    "detections": int(edge.sum()),
                    "same": bool(comparable and (found.edge_class == reference).all()),
                    "jaccard": common / union if union else (1.0 if comparable else None),
                }
            )
    return records
