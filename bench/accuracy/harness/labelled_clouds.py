"""Clouds by other authors whose edges are known; what each file holds is told in bench/accuracy/README.md."""

import os
from dataclasses import dataclass

import numpy as np

from . import clouds

STORM = "STORM-IRIT+pcednet-supp/scripts/3dmodels/default/GT"
BAZAZIAN = "denabazazian+Edge_Extraction"

NO_EDGE, EDGE, NEAR_EDGE = 0, 1, 2

# Half a spacing: the two rows of points next to an edge, where there are rows.
LABEL_SPACINGS = 0.5
# Points of the open border of a cloud whose border is not labelled are not judged within so many spacings.
BORDER_SPACINGS = 2.0

_STORM_CLOUDS = ("TwoPlane90", "Frac2Guass1Noise", "Frac2Guass12Noise", "Frac2Guass14Noise", "Frac2Guass3Noise")
_BAZAZIAN_PAIRS = (  # cloud, points on its true edges
    ("ArtificialPointClouds/CubeSharpEdge.ply", "GroundTruth/ExactEdge.ply"),
    ("ArtificialPointClouds/StairsCube.ply", "GroundTruth/GroundtruthFractal1.ply"),
    ("ArtificialPointClouds/ThreeCubeFractal3.ply", "GroundTruth/GroundtruthFractal3.ply"),
    ("ArtificialPointClouds/FourCubeFractalHole2.ply", "GroundTruth/GroundtruthFractal4Two.ply"),
    ("ArtificialPointClouds/Tetrahedron.ply", "GroundTruth/GroundTruthTetrahedron.ply"),
    ("ArtificialPointClouds/AddingNoise/CubeGuass.ply", "GroundTruth/ExactEdge.ply"),
    ("ArtificialPointClouds/AddingNoise/CubewithNoise1.ply", "GroundTruth/ExactEdge.ply"),
    ("ArtificialPointClouds/AddingNoise/TetrahedronNoise35.ply", "GroundTruth/GroundTruthTetrahedron.ply"),
    ("ArtificialPointClouds/AddingNoise/TetrahedronNoise50.ply", "GroundTruth/GroundTruthTetrahedron.ply"),
    ("ArtificialPointClouds/AddingNoise/Frac2withNoise3.ply", "GroundTruth/GroundtruthFractal2.ply"),
    ("ArtificialPointClouds/AddingNoise/Frac2withNoise7.ply", "GroundTruth/GroundtruthFractal2.ply"),
)


@dataclass
class LabelledCloud:
    name: str
    points: np.ndarray  # (n, 3)
    curve: np.ndarray  # Points on the true edges, denser than the cloud.
    given: np.ndarray = None  # Labels of the file; None if they follow from the curve.
    open_unit_planes: bool = False  # The two planes x = 0 and z = 0 of TwoPlane90.

    def labels(self, spacing):
        """NO_EDGE, EDGE or NEAR_EDGE (the file's band around its edges) for every point."""
        if self.given is not None:
            return self.given
        return np.where(nearest_distance(self.points, self.curve) <= LABEL_SPACINGS * spacing, EDGE, NO_EDGE)

    def judged(self, spacing, labels):
        """False near open borders that the truth does not count as edges."""
        judged = np.ones(len(self.points), bool)
        if self.open_unit_planes:
            x, y, z = self.points.T
            border = np.minimum.reduce([y, 1.0 - y, 1.0 - np.maximum(x, z)])
            judged = (border > BORDER_SPACINGS * spacing) | (labels != NO_EDGE)
        return judged


def nearest_distance(points, targets, block=512):
    """Distance of each point to its nearest target, by comparing all with all: exact, and fast enough here."""
    result = np.empty(len(points))
    squares = (targets**2).sum(1)
    for begin in range(0, len(points), block):
        part = points[begin : begin + block]
        nearest = np.argmin(squares - 2.0 * part @ targets.T, axis=1)
        result[begin : begin + block] = np.linalg.norm(part - targets[nearest], axis=1)
    return result


def _points(data, name):
    return clouds.positions(clouds.read_columns(os.path.join(data, BAZAZIAN, name)))


def _storm(data, name):
    columns = clouds.read_ply(os.path.join(data, STORM, name + ".ply"))
    red, green, blue = (columns[c] for c in ("red", "green", "blue"))
    given = np.full(len(red), NO_EDGE)
    given[(red == 168) & (green == 0) & (blue == 0)] = EDGE
    given[(red == 255) & (green == 196) & (blue == 93)] = NEAR_EDGE
    curve = "GroundTruthTwoPlaneY" if name == "TwoPlane90" else "GroundtruthFractal2"
    return LabelledCloud(
        f"{name} (labels)",
        clouds.positions(columns),
        _points(data, f"GroundTruth/{curve}.ply"),
        given,
        open_unit_planes=name == "TwoPlane90",
    )


def load(data):
    """All labelled clouds, or an empty list where the folder is absent."""
    if not data or not os.path.isdir(os.path.join(data, BAZAZIAN)):
        return []
    found = [_storm(data, name) for name in _STORM_CLOUDS]
    for cloud, curve in _BAZAZIAN_PAIRS:
        found.append(LabelledCloud(os.path.basename(cloud)[:-4], _points(data, cloud), _points(data, curve)))
    return found
