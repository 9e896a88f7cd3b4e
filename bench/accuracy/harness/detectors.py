"""What is compared: name, how it is run, and which of its labels count in which table."""

from dataclasses import dataclass, field
import os

import numpy as np

from . import clouds

# Shares of the points that `lambda-best` may call edges: 24 steps, a factor of 1.28 apart.
BEST_SHARES = tuple(float(share) for share in np.geomspace(0.002, 0.6, 24))


@dataclass
class Labels:
    """One entry per point of the cloud, in its order."""

    path: str  # PLY with EdgeClass of every point, as `arris evaluate` takes it.
    edge_class: np.ndarray  # uint8 bits: 1 boundary, 2 weak boundary, 4 fold; peers set 1 for any edge.
    score: np.ndarray  # Empty if the method gives none.
    points: np.ndarray  # (n, 3)
    seconds: float  # Wall, one thread, reading and writing included.


@dataclass(frozen=True)
class Detector:
    name: str
    what: str
    method: str = ""  # arris extract --method
    baseline: str = ""  # bench_baseline METHOD
    options: tuple = field(default=())
    needs_spacing: bool = False
    typed: bool = False  # Tells folds from boundaries; else all its points count in every table.
    best: bool = False  # The threshold is chosen with the truth in hand.
    most_points: int = 10**9

    def detect(self, programs, cloud, spacing, out):
        """Runs on a cloud file. @param spacing  s in the cloud's unit. @param out  PLY to write."""
        if self.method:
            _, seconds = programs.arris(
                "extract",
                cloud,
                "-o",
                out,
                "--method",
                self.method,
                *self.options,
                "--keep-all",
                "--threads",
                1,
                "--temp-dir",
                os.path.dirname(out),
                "--overwrite",
                "-q",
            )
        else:
            extra = ("--spacing", repr(spacing)) if self.needs_spacing else ()
            _, seconds = programs.baseline(self.baseline, cloud, out, *extra, *self.options)
        columns = clouds.read_ply(out)
        score = np.asarray(columns.get("EdgeScore", ()), float)
        return Labels(out, np.asarray(columns["EdgeClass"], np.uint8), score, clouds.positions(columns), seconds)


def thresholded(labels, share):
    """Labels with the `share` of the points that score highest as edges; equal scores enter together or not at all."""
    cut = np.quantile(labels.score, 1.0 - share)
    return (labels.score > cut).astype(np.uint8)


ALL = (
    Detector("liu", "arris extract --method liu, defaults", method="liu", typed=True),
    Detector("arris", "arris extract --method arris, defaults", method="arris", typed=True),
    Detector("pcl-boundary", "PCL NormalEstimation + BoundaryEstimation, k = 30, 90 degrees", baseline="pcl-boundary"),
    Detector("lambda", "surface variation of k = 30 neighbours above 0.03 (Bazazian et al. 2015)", baseline="lambda"),
    Detector(
        "lambda-best",
        "the same with the threshold that gives the best F1 on each cloud (needs the truth)",
        baseline="lambda",
        best=True,
    ),
    Detector(
        "cgal-vcm",
        "CGAL Voronoi covariance, R = 3 s, r = 1 s, threshold 0.16",
        baseline="cgal-vcm",
        options=("--offset", 3, "--convolution", 1),
        needs_spacing=True,
        most_points=200_000,
    ),
    Detector(
        "cgal-vcm-wide",
        "CGAL Voronoi covariance, R = 6 s, r = 2 s, threshold 0.16",
        baseline="cgal-vcm",
        options=("--offset", 6, "--convolution", 2),
        needs_spacing=True,
        most_points=200_000,
    ),
)
DEFAULT = ("liu", "arris", "pcl-boundary", "lambda", "lambda-best", "cgal-vcm", "cgal-vcm-wide")


def choose(names, programs, notes):
    """Detectors by name, in the order given; those that this build lacks are left out with a note."""
    known = {d.name: d for d in ALL}
    chosen = []
    for name in names:
        if name not in known:
            raise SystemExit(f"--detectors: '{name}' is none of {', '.join(known)}")
        detector = known[name]
        if detector.method and detector.method not in extract_methods(programs):
            notes.append(f"`{name}` is left out: this build of arris has no `--method {detector.method}`.")
        elif detector.baseline == "cgal-vcm" and not has_cgal(programs):
            notes.append(f"`{name}` is left out: built without CGAL (libcgal-dev).")
        else:
            chosen.append(detector)
    return chosen


def extract_methods(programs):
    line = next(l for l in programs.arris("extract", "--help")[0].splitlines() if "--method " in l)
    return line.split("{")[1].split("}")[0].split(",")


def has_cgal(programs):
    return "cgal-vcm" in programs.baseline("--help")[0]
