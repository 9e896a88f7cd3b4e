#!/usr/bin/python3
"""A peer of arris extract: Open3D's normals and boundary points of a LAS file, everything in memory.

Usage: open3d_boundary.py SCAN RADIUS. 16 neighbours for normals, at most 30 within RADIUS for boundaries.
Needs Debian's python3-open3d; OMP_NUM_THREADS says how many threads.
"""

import struct
import sys

import numpy
import open3d


def read_points(path):
    """Coordinates relative to the offset, as float32."""
    with open(path, "rb") as file:
        header = file.read(375)
        begin, = struct.unpack_from("<I", header, 96)
        size, count = struct.unpack_from("<HI", header, 105)
        if header[25] >= 4:
            count, = struct.unpack_from("<Q", header, 247)
        scale = numpy.array(struct.unpack_from("<3d", header, 131))
        file.seek(begin)
        records = numpy.fromfile(file, dtype=[("xyz", "<i4", 3), ("rest", f"V{size - 12}")], count=count)
    return (records["xyz"] * scale).astype(numpy.float32)


def main():
    points = read_points(sys.argv[1])
    radius = float(sys.argv[2])
    cloud = open3d.t.geometry.PointCloud(open3d.core.Tensor(points))
    cloud.estimate_normals(max_nn=16)
    boundaries, _ = cloud.compute_boundary_points(radius, 30)
    print(f"points {len(points)}, boundary {len(boundaries.point['positions'])}")


main()
