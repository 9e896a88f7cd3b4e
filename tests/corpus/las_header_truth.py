"""Header fields of a LAS file that contradict its points, by the ASPRS specifications."""
import struct

import numpy as np

from values import number


def slashed(counts):
    return "/".join(str(int(c)) for c in counts)


def wrong_counts(data, minor, point_format, returns):
    """`returns` has the number of points per return number, index 0 for the number 0, which no header counts."""
    points = int(returns.sum())
    legacy = struct.unpack_from("<6I", data, 107)
    extended = struct.unpack_from("<16Q", data, 247) if minor >= 4 else None
    # Point formats 6 to 10 must not be counted in 32 bits; for others of LAS 1.4 the 64-bit counts alone will do.
    no_legacy = minor >= 4 and (point_format >= 6 or (legacy[0] == 0 and extended[0] != 0))
    wrong = {}
    for truth, stored, name, by_return in (
            ([0] * 6 if no_legacy else [points, *returns[1:6]], legacy, "legacy-count", "legacy-by-return"),
            ([points, *returns[1:16]], extended, "count", "by-return")):
        if stored is None:
            continue
        if stored[0] != truth[0]:
            wrong[name] = slashed(truth[:1])
        if any(a != b for a, b in zip(stored[1:], truth[1:])):
            wrong[by_return] = slashed(truth[1:])
    return wrong


def wrong_bounds(data, extent, scale):
    """Bounds are right to one step of the scale: writers round them in their own ways. Those of no points are zero."""
    wrong = {}
    for axis in range(3):
        stored = struct.unpack_from("<2d", data, 179 + 16 * axis)[::-1]
        truth = extent[axis] if extent else (0.0, 0.0)
        tolerance = abs(scale[axis]) if extent else 0.0
        for name, a, b in zip(("min-", "max-"), stored, truth):
            if not abs(a - b) <= tolerance:
                wrong[name + "xyz"[axis]] = number(b)
    return wrong


def return_numbers(records, point_format):
    numbers = records[:, 14] & (15 if point_format >= 6 else 7)
    return np.bincount(numbers.astype(np.int64), minlength=16)
