"""What the table says of one file, and how it is printed."""
import dataclasses

import numpy as np

COLUMNS = ("path", "verdict", "error", "format", "promised", "count", "sum_x", "sum_y", "sum_z", "min_x", "max_x",
           "min_y", "max_y", "min_z", "max_z", "intensity", "red", "digest", "problems",
           "wrong_fields")


class Refused(Exception):
    """The file's points cannot be trusted; the argument is the error class."""


@dataclasses.dataclass
class Values:
    format: str = ""
    promised: int = 0  # Points that the header counts ...
    count: int = 0  # ... and those that are there, whole.
    sums: list = dataclasses.field(default_factory=lambda: ["", "", ""])
    extent: list = dataclasses.field(default_factory=list)  # (min, max) of the finite coordinates per axis
    intensity: str = ""
    red: str = ""
    digest: str = ""
    error: str = ""  # Why there are fewer than promised.
    problems: set = dataclasses.field(default_factory=set)
    wrong_fields: dict = dataclasses.field(default_factory=dict)  # Field of the LAS header: what it should hold.


def number(value):
    return "%.17g" % value


def digest(axes):
    """Depends on every bit and on the order: the sum of (3 i + axis + 1) * bits modulo 2^64."""
    total = 0
    for axis, bits in enumerate(axes):
        weights = np.arange(len(bits), dtype=np.uint64) * np.uint64(3) + np.uint64(axis + 1)
        total += int((bits * weights).sum(dtype=np.uint64)) if len(bits) else 0
    return "%016x" % (total % 2**64)


def row(path, values, error):
    """`values` is None for files of which nothing can be told."""
    if values is None:
        return [path, "refused", error] + [""] * (len(COLUMNS) - 3)
    verdict = "refused" if error else "read"
    extent = [number(v) for pair in values.extent for v in pair] or [""] * 6
    return [path, verdict, error, values.format, str(values.promised), str(values.count), *values.sums, *extent,
            values.intensity, values.red, values.digest, " ".join(sorted(values.problems)),
            " ".join("%s=%s" % field for field in sorted(values.wrong_fields.items()))]
