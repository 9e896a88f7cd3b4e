"""A plain reading of LAS 1.0 to 1.5 by the ASPRS specifications; shares nothing with arris.

read_las(data) returns a Values; it never believes a count that the bytes do not bear out.
"""
import struct

import numpy as np

from las_header_truth import return_numbers, wrong_bounds, wrong_counts
from values import Refused, Values, digest

FORMAT_BYTES = (20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67)
RED_OFFSET = {2: 20, 3: 28, 5: 28, 7: 30, 8: 30, 10: 30}
HEADER_BYTES = (227, 227, 227, 235, 375, 393)


def text(raw):
    return raw.split(b"\0", 1)[0]


def records_between(data, begin, limit, count, header_bytes):
    """(user id, record id, payload) of each variable-length record, and whether all `count` are whole."""
    found = []
    at = begin
    while len(found) < count:
        if at + header_bytes > limit:
            return found, False
        length = struct.unpack_from("<Q" if header_bytes == 60 else "<H", data, at + 20)[0]
        end = at + header_bytes + length
        if end > limit:
            return found, False
        found.append((text(data[at + 2:at + 18]), struct.unpack_from("<H", data, at + 18)[0],
                      data[at + header_bytes:end]))
        at = end
    return found, True


def choose_count(minor, legacy, extended, room):
    """The specification asks for the 32-bit count where both are set; the bytes that are there decide a dispute."""
    if minor < 4 or legacy == extended:
        return legacy, False
    if legacy == 0 or extended == 0:
        return legacy or extended, legacy != 0
    return (extended if extended == room else legacy), True


def read_header(data):
    if data[:4] != b"LASF":
        raise Refused("header")
    if len(data) < 227:
        raise Refused("truncated")
    major, minor = data[24], data[25]
    if major != 1 or minor > 5:
        raise Refused("header")
    header_bytes, points_at, vlr_count = struct.unpack_from("<HII", data, 94)
    if header_bytes < (375 if minor >= 4 else 227) or points_at < header_bytes:
        raise Refused("header")
    if points_at > len(data):
        raise Refused("truncated")
    return minor, header_bytes, points_at, vlr_count


def read_las(data):
    values = Values()
    minor, header_bytes, points_at, vlr_count = read_header(data)
    if data[104] & 0xC0:
        raise Refused("compressed")
    point_format = data[104]
    length, legacy = struct.unpack_from("<HI", data, 105)
    if point_format > 10 or length < FORMAT_BYTES[point_format]:
        raise Refused("header")
    scale, offset = struct.unpack_from("<3d", data, 131), struct.unpack_from("<3d", data, 155)
    if not all(s != 0 and np.isfinite(abs(s) * 2.0**31 + abs(o)) for s, o in zip(scale, offset)):
        raise Refused("header")
    values.format = f"LAS 1.{minor} format {point_format}"
    evlr_at, evlr_count, extended = struct.unpack_from("<QIQ", data, 235) if minor >= 4 else (0, 0, 0)
    waves_at = struct.unpack_from("<Q", data, 227)[0] if minor >= 3 and header_bytes >= 235 else 0

    vlrs, vlrs_whole = records_between(data, header_bytes, points_at, vlr_count, 54)
    next_structure = min([len(data)] + [at for at in ((evlr_at if evlr_count else 0), waves_at) if at > points_at])
    count, disputed = choose_count(minor, legacy, extended, (next_structure - points_at) // length)
    if any(user == b"laszip encoded" and record == 22204 for user, record, _ in vlrs):
        raise Refused("compressed")  # None of the corpus is a decompressed file with a leftover of this record.
    values.promised = count
    values.count = min(count, (len(data) - points_at) // length)
    values.error = "truncated" if values.count < count else ""
    points_end = points_at + values.count * length

    evlrs, evlrs_whole = records_between(data, evlr_at, len(data), evlr_count, 60)
    note_problems(values, data, minor, points_end, evlr_count or waves_at)
    values.problems |= crs_problems(vlrs + evlrs)
    if not evlrs_whole:
        values.problems.add("evlr-overrun")
    if point_format >= 6 and minor >= 4 and legacy:
        values.problems.add("legacy-count")
    if not vlrs_whole:
        values.problems.add("vlr-overrun")
        values.wrong_fields["vlr-count"] = str(len(vlrs))
    if disputed:
        values.problems.add("count-mismatch")
    records = np.frombuffer(data, np.uint8, values.count * length, points_at).reshape(values.count, length)
    fill(values, records, point_format, scale, offset)
    values.wrong_fields |= wrong_counts(data, minor, point_format, return_numbers(records, point_format))
    values.wrong_fields |= wrong_bounds(data, values.extent, scale)
    return values


def crs_problems(records):
    crs = [(record, payload) for user, record, payload in records if user == b"LASF_Projection"]
    problems = set()
    if any(record == 2112 and not text(payload).strip() for record, payload in crs):
        problems.add("crs-empty")
    for keys in [payload for record, payload in crs if record == 34735][:1]:
        if len(keys) < 8 or len(keys) // 8 - 1 < struct.unpack_from("<H", keys, 6)[0]:
            problems.add("crs-keys")
        if any(record == 2112 for record, _ in crs):
            problems.add("crs-both")
    return problems


def note_problems(values, data, minor, points_end, has_more):
    bounds = struct.unpack_from("<6d", data, 179)  # max x, min x, max y, min y, max z, min z
    for most, least in zip(bounds[::2], bounds[1::2]):
        if values.count and not (np.isfinite(most) and np.isfinite(least) and least <= most):
            values.problems.add("bounds-invalid")
    point_format = data[104]
    if point_format >= 6 and not data[6] & 16:
        values.problems.add("wkt-bit")
    if minor < (4 if point_format >= 6 else 3 if point_format >= 4 else 2 if point_format >= 2 else 0):
        values.problems.add("point-format-version")
    header_bytes = struct.unpack_from("<H", data, 94)[0]
    if header_bytes < HEADER_BYTES[minor]:
        values.problems.add("header-size")
    if not has_more and len(data) > points_end and values.count:
        values.problems.add("trailing-bytes")


def fill(values, records, point_format, scale, offset):
    def field(at, kind):
        size = np.dtype(kind).itemsize
        return np.ascontiguousarray(records[:, at:at + size]).view(kind).reshape(-1)

    axes = [field(4 * axis, "<i4") for axis in range(3)]
    values.sums = [str(int(a.astype(np.int64).sum())) for a in axes]  # Below 2^63: fewer than 2^32 points.
    if values.count:
        world = [a.astype(np.float64) * scale[i] + offset[i] for i, a in enumerate(axes)]
        values.extent = [(float(w.min()), float(w.max())) for w in world]
    values.digest = digest([a.astype(np.int64).view(np.uint64) for a in axes])
    values.intensity = str(int(field(12, "<u2").astype(np.int64).sum()))
    if point_format in RED_OFFSET:
        values.red = str(int(field(RED_OFFSET[point_format], "<u2").astype(np.int64).sum()))
