"""Scores of detected points against labelled points."""

import numpy as np

from .labelled_clouds import EDGE, NO_EDGE, nearest_distance


def _ratio(part, whole):
    return float(part) / float(whole) if whole else None


def _f1(precision, recall):
    if recall is None:
        return None
    return 2.0 * precision * recall / (precision + recall) if precision and recall else 0.0


class PointJudge:
    """Prepared once per cloud, asked once per detector or threshold.

    @param points  (n, 3). @param labels  EDGE, NO_EDGE or NEAR_EDGE of each. @param judged  False: the point counts
    neither as a detection nor as a label. @param tolerance  in the unit of the points.
    @param curve  points on the true edges, or None.
    """

    def __init__(self, points, labels, judged, tolerance, curve=None):
        self.labels, self.judged, self.tolerance = labels, judged, tolerance
        edge = np.flatnonzero((labels == EDGE) & judged)
        self.edge_count = len(edge)
        self.to_edge = nearest_distance(points, points[edge])
        self.near_pairs = _pairs(points[edge], points, tolerance)
        self.to_curve = None if curve is None else nearest_distance(points, curve)
        self.curve_pairs = None if curve is None else _pairs(curve, points, tolerance)
        self.curve_count = 0 if curve is None else len(curve)

    def score(self, detected):
        """Metrics of a boolean array, one entry per point. None where a denominator is 0."""
        detected = detected & self.judged
        found = int(detected.sum())
        precision = _ratio((self.to_edge[detected] <= self.tolerance).sum(), found)
        recall = _ratio(_covered(self.near_pairs, detected), self.edge_count)
        result = {
            "detections": found,
            "edge_points": self.edge_count,
            "precision": precision,
            "recall": recall,
            "f1": _f1(precision, recall),
        }
        if self.to_curve is not None:
            precision = _ratio((self.to_curve[detected] <= self.tolerance).sum(), found)
            recall = _ratio(_covered(self.curve_pairs, detected), self.curve_count)
            everything = _ratio(_covered(self.curve_pairs, self.judged), self.curve_count)
            result["curve"] = {
                "precision": precision,
                "recall": recall,
                "f1": _f1(precision, recall),
                "ceiling": everything,
            }
        result["exact"] = self._exact(detected, self.judged)
        # The band around the edges that some files name is neither edge nor surface.
        result["exact_without_band"] = self._exact(
            detected, self.judged & ((self.labels == EDGE) | (self.labels == NO_EDGE))
        )
        return result

    def _exact(self, detected, judged):
        edge = self.labels == EDGE
        tp = float((detected & edge & judged).sum())
        fp = float((detected & ~edge & judged).sum())
        fn = float((~detected & edge & judged).sum())
        tn = float((~detected & ~edge & judged).sum())
        root = np.sqrt((tp + fp) * (tp + fn) * (tn + fp) * (tn + fn))
        precision, recall = _ratio(tp, tp + fp), _ratio(tp, tp + fn)
        return {
            "precision": precision,
            "recall": recall,
            "f1": _f1(precision, recall),
            "iou": _ratio(tp, tp + fp + fn),
            "mcc": float((tp * tn - fp * fn) / root) if root > 0.0 else 0.0,
        }


def _pairs(targets, points, tolerance, block=256):
    """All (target, point) at most the tolerance apart."""
    of_target, of_point = [], []
    for begin in range(0, len(targets), block):
        part = targets[begin : begin + block]
        squared = (part**2).sum(1)[:, None] + (points**2).sum(1)[None] - 2.0 * part @ points.T
        # The expanded square is rounded; candidates a little beyond are measured again.
        t, p = np.nonzero(squared <= (1.001 * tolerance) ** 2 + 1e-12)
        close = np.linalg.norm(part[t] - points[p], axis=1) <= tolerance
        of_target.append(t[close] + begin)
        of_point.append(p[close])
    return np.concatenate(of_target), np.concatenate(of_point)


def _covered(pairs, detected):
    targets, points = pairs
    return len(np.unique(targets[detected[points]]))
