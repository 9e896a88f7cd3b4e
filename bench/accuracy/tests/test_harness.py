"""What the table of accuracy relies on. ARRIS_BUILD names the build folder; without it the programs are not asked."""

import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
sys.dont_write_bytecode = True
try:
    import numpy as np
except ImportError as error:
    raise unittest.SkipTest("python3-numpy is absent") from error

from harness import clouds, detectors, labelled_clouds, markdown, point_scores

BASELINE = os.path.join(os.environ.get("ARRIS_BUILD", ""), "bin", "bench_baseline")
EDGE, NO_EDGE, NEAR_EDGE = labelled_clouds.EDGE, labelled_clouds.NO_EDGE, labelled_clouds.NEAR_EDGE


def row_of_points(count):
    """Points 0, 1, 2, ... on the x axis."""
    return np.stack([np.arange(count, dtype=float), np.zeros(count), np.zeros(count)], axis=1)


class Clouds(unittest.TestCase):
    def test_ply_written_and_read_is_the_same(self):
        points = np.array([[500000.125, -3.0, 1e-9], [1.0, 2.0, 3.0]])
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.ply")
            clouds.write_ply(path, points, EdgeClass=np.array([4, 0], np.uint8), EdgeScore=np.array([0.5, 0.25]))
            columns = clouds.read_ply(path)
        np.testing.assert_array_equal(clouds.positions(columns), points)
        np.testing.assert_array_equal(columns["EdgeClass"], [4, 0])
        np.testing.assert_array_equal(columns["EdgeScore"], [0.5, 0.25])

    def test_ascii_ply_with_elements_after_the_vertices(self):
        text = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
        text += "element camera 1\nproperty float view_px\nend_header\n1 2 3\n4 5 6\n9\n"
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.ply")
            with open(path, "w", encoding="ascii") as file:
                file.write(text)
            points = clouds.positions(clouds.read_ply(path))
        np.testing.assert_array_equal(points, [[1, 2, 3], [4, 5, 6]])


class PointScores(unittest.TestCase):
    def judge(self, labels, judged=None, tolerance=1.0):
        labels = np.array(labels)
        judged = np.ones(len(labels), bool) if judged is None else np.array(judged)
        points = row_of_points(len(labels))
        return point_scores.PointJudge(points, labels, judged, tolerance, points[labels == EDGE])

    def test_neighbour_of_an_edge_point_is_right_within_the_tolerance_but_not_exactly(self):
        score = self.judge([NO_EDGE, NO_EDGE, EDGE, NO_EDGE]).score(np.array([False, True, False, False]))
        self.assertEqual((score["precision"], score["recall"], score["f1"]), (1.0, 1.0, 1.0))
        self.assertEqual(score["exact"]["f1"], 0.0)
        self.assertEqual(score["curve"]["f1"], 1.0)

    def test_point_beyond_the_tolerance_is_false_and_its_edge_missed(self):
        score = self.judge([EDGE, NO_EDGE, NO_EDGE, EDGE]).score(np.array([True, False, False, False]))
        self.assertEqual((score["precision"], score["recall"]), (1.0, 0.5))
        score = self.judge([EDGE, NO_EDGE, NO_EDGE, NO_EDGE]).score(np.array([False, False, True, True]))
        self.assertEqual((score["precision"], score["recall"], score["f1"]), (0.0, 0.0, 0.0))

    def test_points_that_are_not_judged_are_neither_right_nor_wrong(self):
        judged = [True, True, True, False]
        score = self.judge([EDGE, NO_EDGE, NO_EDGE, NO_EDGE], judged).score(np.array([True, False, False, True]))
        self.assertEqual((score["detections"], score["precision"], score["exact"]["f1"]), (1, 1.0, 1.0))

    def test_band_counts_as_surface_unless_left_out(self):
        score = self.judge([EDGE, NEAR_EDGE, NO_EDGE, NO_EDGE]).score(np.array([True, True, False, False]))
        self.assertEqual(score["exact"]["precision"], 0.5)
        self.assertEqual(score["exact_without_band"]["precision"], 1.0)

    def test_nothing_detected_scores_zero(self):
        score = self.judge([EDGE, NO_EDGE]).score(np.array([False, False]))
        self.assertIsNone(score["precision"])
        self.assertEqual((score["recall"], score["f1"], score["exact"]["mcc"]), (0.0, 0.0, 0.0))

    def test_correlation_of_perfect_and_opposite_answers(self):
        judge = self.judge([EDGE, NO_EDGE, EDGE, NO_EDGE])
        self.assertEqual(judge.score(np.array([True, False, True, False]))["exact"]["mcc"], 1.0)
        self.assertEqual(judge.score(np.array([False, True, False, True]))["exact"]["mcc"], -1.0)

    def test_nearest_distance_is_that_of_a_plain_search(self):
        points, targets = np.random.default_rng(1).random((700, 3)), np.random.default_rng(2).random((90, 3))
        plain = np.array([min(np.linalg.norm(targets - p, axis=1)) for p in points])
        np.testing.assert_allclose(labelled_clouds.nearest_distance(points, targets), plain, rtol=0, atol=1e-14)


class Thresholds(unittest.TestCase):
    def test_equal_scores_enter_together(self):
        labels = detectors.Labels("", np.zeros(4, np.uint8), np.array([0.0, 0.0, 0.0, 1.0]), row_of_points(4), 0.0)
        np.testing.assert_array_equal(detectors.thresholded(labels, 0.25), [0, 0, 0, 1])
        np.testing.assert_array_equal(detectors.thresholded(labels, 0.6), [0, 0, 0, 1])


class Numbers(unittest.TestCase):
    def test_mean_and_half_range(self):
        self.assertEqual(markdown.spread([0.9, 0.92]), ".910 ±.010")
        self.assertEqual(markdown.spread([None]), "–")


@unittest.skipUnless(os.access(BASELINE, os.X_OK), "no bench_baseline in ARRIS_BUILD")
class Baseline(unittest.TestCase):
    def detect(self, method, points, *options):
        with tempfile.TemporaryDirectory() as folder:
            scan, out = os.path.join(folder, "scan.ply"), os.path.join(folder, "out.ply")
            clouds.write_ply(scan, points)
            done = subprocess.run([BASELINE, method, scan, out, *options], capture_output=True, text=True, check=False)
            return done, clouds.read_ply(out) if done.returncode == 0 else None

    @staticmethod
    def sheet(folded):
        """41 x 41 points, flat or with a right angle at x = 20; far from the origin, as surveys are."""
        u, v = (a.ravel() for a in np.meshgrid(np.arange(41.0), np.arange(41.0)))
        x, z = (np.minimum(u, 20.0), np.maximum(u - 20.0, 0.0)) if folded else (u, 0.0 * u)
        return np.stack([x + 500000.0, v + 5000000.0, z], axis=1), u, v

    def test_pcl_finds_the_border_of_a_sheet_and_nothing_inside(self):
        points, u, v = self.sheet(False)
        edge = self.detect("pcl-boundary", points)[1]["EdgeClass"] != 0
        border = np.minimum(np.minimum(u, 40 - u), np.minimum(v, 40 - v))
        self.assertGreater(edge[border == 0].mean(), 0.9)
        self.assertFalse(edge[border > 3].any())

    def test_surface_variation_and_voronoi_find_the_fold_and_not_the_faces(self):
        points, u, v = self.sheet(True)
        inside = (v > 6) & (v < 34) & (u > 6) & (u < 34)
        runs = {"lambda": ()}
        if "cgal-vcm" in subprocess.run([BASELINE, "--help"], capture_output=True, text=True, check=True).stdout:
            runs["cgal-vcm"] = ("--spacing", "1")
        for method, options in runs.items():
            columns = self.detect(method, points, *options)[1]
            edge = columns["EdgeClass"] != 0
            self.assertTrue(edge[(u == 20) & inside].all(), method)
            self.assertFalse(edge[(abs(u - 20) > 5) & inside].any(), method)
            self.assertGreater(columns["EdgeScore"][edge].min(), columns["EdgeScore"][~edge].max(), method)

    def test_point_that_is_not_finite_is_refused_with_its_number(self):
        points = row_of_points(40)
        points[7, 2] = np.nan
        done, _ = self.detect("lambda", points)
        self.assertEqual(done.returncode, 1)
        self.assertIn("point 7 is not finite", done.stderr)

    def test_wrong_usage(self):
        self.assertEqual(subprocess.run([BASELINE, "nonsense"], capture_output=True, check=False).returncode, 2)


if __name__ == "__main__":
    unittest.main()
