#!/usr/bin/env python3
"""render.py EDGES.las OUT.png [--under SCAN.las] [--width 1400]

Draws the contour points of a LAS file that arris wrote, seen from above and from the front: boundaries red, folds blue, both violet, on a grey
scan if one is given with --under. Needs python3-numpy.
"""
import argparse
import struct
import zlib

import numpy as np

FORMAT_BYTES = [20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67]
TYPES = {1: "u1", 2: "i1", 3: "<u2", 4: "<i2", 5: "<u4", 6: "<i4", 7: "<u8", 8: "<i8", 9: "<f4", 10: "<f8"}


def read_las(path):
    """Coordinates and EdgeClass (None if the file has none)."""
    data = np.memmap(path, np.uint8, "r")
    head = bytes(data[:400])
    header_bytes, offset, vlrs = struct.unpack_from("<HII", head, 94)
    length, count = struct.unpack_from("<HI", head, 105)
    if head[25] >= 4:
        count = struct.unpack_from("<Q", head, 247)[0]
    records = data[offset:offset + count * length].reshape(count, length)
    scale, shift = np.array(struct.unpack_from("<3d", head, 131)), np.array(struct.unpack_from("<3d", head, 155))
    xyz = records[:, :12].copy().view("<i4") * scale + shift
    edge_class, at, field = None, header_bytes, FORMAT_BYTES[head[104] & 63]
    for _ in range(vlrs):
        vlr = bytes(data[at:at + 54])
        size = struct.unpack_from("<H", vlr, 20)[0]
        if vlr[2:11] == b"LASF_Spec" and struct.unpack_from("<H", vlr, 18)[0] == 4:
            for entry in range(size // 192):
                text = bytes(data[at + 54 + 192 * entry:at + 54 + 192 * (entry + 1)])
                width = np.dtype(TYPES[text[2]]).itemsize if text[2] in TYPES else max(text[3], 1)
                if text[4:36].split(b"\0")[0] == b"EdgeClass":
                    edge_class = records[:, field].copy()
                field += width
        at += 54 + size
    return xyz, edge_class


def draw(xyz, colours, axes, depth_sign, low, high, width):
    u, v, w = axes
    pixels = (width - 1) / max(high[u] - low[u], 1e-9)
    height = int((high[v] - low[v]) * pixels) + 1
    x, y = ((xyz[:, u] - low[u]) * pixels).astype(int), ((high[v] - xyz[:, v]) * pixels).astype(int)
    seen = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    order = np.flatnonzero(seen)[np.argsort(depth_sign * xyz[seen, w], kind="stable")]
    image = np.full((height, width, 3), 16, np.uint8)
    image[y[order], x[order]] = colours[order]
    return image


def write_png(path, image):
    height, width, _ = image.shape
    rows = np.c_[np.zeros((height, 1), np.uint8), image.reshape(height, -1)].tobytes()

    def chunk(tag, body):
        return struct.pack(">I", len(body)) + tag + body + struct.pack(">I", zlib.crc32(tag + body))

    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                  chunk(b"IDAT", zlib.compress(rows, 6)) + chunk(b"IEND", b""))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("edges")
    parser.add_argument("out")
    parser.add_argument("--under")
    parser.add_argument("--width", type=int, default=1400)
    options = parser.parse_args()
    xyz, edge_class = read_las(options.edges)
    if edge_class is None:
        edge_class = np.ones(len(xyz), np.uint8)
    colours = np.full((len(xyz), 3), 90, np.uint8)
    boundary, fold = (edge_class & 3) > 0, (edge_class & 12) > 0
    colours[boundary], colours[fold], colours[boundary & fold] = (255, 60, 50), (70, 150, 255), (255, 60, 255)
    views = []
    under = read_las(options.under)[0] if options.under else np.zeros((0, 3))
    everything = np.r_[under, xyz]
    if not len(everything):
        raise SystemExit("render.py: there is nothing to draw")
    low, high = np.percentile(everything, .2, axis=0), np.percentile(everything, 99.8, axis=0)
    for axes, sign in (((0, 1, 2), 1), ((0, 2, 1), -1)):
        image = draw(xyz, colours, axes, sign, low, high, options.width)
        if len(under):
            ground = draw(under, np.full((len(under), 3), 62, np.uint8), axes, sign, low, high, options.width)
            image = np.where((image == 16).all(2)[:, :, None], ground, image)
        views.append(np.pad(image, ((0, 10), (0, 0), (0, 0)), constant_values=255))
    write_png(options.out, np.concatenate(views))


if __name__ == "__main__":
    main()
