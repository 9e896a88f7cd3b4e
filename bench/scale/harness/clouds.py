"""The clouds: towns of at most five million points beside each other, as surveys grow, in one LAS file."""

import json
import os
import struct
import subprocess
from types import SimpleNamespace

BLOCK_POINTS = 5_000_000
PITCH = 100  # Metres from one town to the next; each is 80 m wide.
ROW = 5
COUNT_32, COUNT_64, SCALE, OFFSET, BOUNDS, BEGIN, LENGTH = 107, 247, 131, 155, 179, 96, 105


def make_cloud(places, millions):
    """A file, its points and their spacing; made if it is not there."""
    path = os.path.join(places.work, f"town_{millions:g}M.las")
    arris = os.path.join(places.bin, "arris")
    if not os.path.exists(path):
        points = round(millions * 1e6)
        blocks = -(-points // BLOCK_POINTS)
        parts = []
        for block in range(blocks):
            parts.append(f"{path}.{block}.las")
            shift = [str(PITCH * (block % ROW)), str(PITCH * (block // ROW)), "0"]
            subprocess.run([arris, "synth", "town", "--points", str(points // blocks), "--noise", "2mm", "--seed",
                            str(block + 1), "--shift", *shift, "-o", parts[-1], "-q", "--overwrite"], check=True)
        join(parts, path)
    told = json.loads(subprocess.run([arris, "info", "--json", path], check=True, capture_output=True).stdout)["files"][0]
    return SimpleNamespace(path=path, millions=millions, points=told["points"], spacing=told["spacing"])


def join(parts, path):
    """One LAS file of several of the same layout, which are removed; coordinates are those of the first's offset."""
    import numpy

    headers = []
    for part in parts:
        with open(part, "rb") as file:
            headers.append(file.read(375))
    first = bytearray(headers[0])
    begin, = struct.unpack_from("<I", first, BEGIN)
    length, = struct.unpack_from("<H", first, LENGTH)
    record = numpy.dtype([("xyz", "<i4", 3), ("rest", f"V{length - 12}")])
    scale, offset = (numpy.array(struct.unpack_from("<3d", first, at)) for at in (SCALE, OFFSET))
    total = 0
    low, high = numpy.full(3, numpy.inf), numpy.full(3, -numpy.inf)
    with open(path + ".part", "wb") as out:
        with open(parts[0], "rb") as file:
            out.write(file.read(begin))
        for part, header in zip(parts, headers):
            if struct.unpack_from("<3d", header, SCALE) != tuple(scale) or struct.unpack_from("<H", header, LENGTH)[0] != length:
                raise RuntimeError(f"{part}: another layout than {parts[0]}")
            shift = numpy.rint((numpy.array(struct.unpack_from("<3d", header, OFFSET)) - offset) / scale).astype(numpy.int64)
            own_begin, = struct.unpack_from("<I", header, BEGIN)
            records = numpy.fromfile(part, dtype=record, offset=own_begin)
            records["xyz"] = records["xyz"] + shift
            records.tofile(out)
            total += len(records)
            bounds = struct.unpack_from("<6d", header, BOUNDS)
            high, low = numpy.maximum(high, bounds[0::2]), numpy.minimum(low, bounds[1::2])
        struct.pack_into("<6d", first, BOUNDS, *numpy.stack([high, low], axis=1).ravel())
        if first[25] >= 4:
            struct.pack_into("<2Q", first, COUNT_64, total, total)  # All are first returns.
        if struct.unpack_from("<I", first, COUNT_32)[0]:
            struct.pack_into("<I", first, COUNT_32, total)
        out.seek(0)
        out.write(first[:begin])
    os.rename(path + ".part", path)
    for part in parts:
        os.remove(part)
