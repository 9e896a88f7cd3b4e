"""A plain reading of PLY (Turk 1994 and the dialects in use); shares nothing with arris."""
import math
import re

import numpy as np

from values import Refused, Values, digest, number

TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4",
         "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4",
         "float32": "f4", "float64": "f8", "int64": "i8", "uint64": "u8"}
INTENSITY = ("intensity", "scalar_intensity")


class Broken(Exception):
    """The body cannot be read on; the arguments are the error class and the rows before."""


class Element:
    def __init__(self, name, count):
        self.name = name
        self.count = count
        self.properties = []  # (name, type, type of the list's length or None)


def parse_header(data):
    """Format, elements, the offset of the body, and whether all keywords are known."""
    first = re.match(rb"ply[ \t]*(\r\n|\n|\r)", data)
    if not first:
        raise Refused("header")
    end_of_line = first[1][-1:]
    at = 0
    form = None
    elements = []
    known = True
    while True:
        end = data.find(end_of_line, at)
        if end < 0:
            raise Refused("header")
        words = data[at:end].decode("latin-1").split()
        at = end + 1
        if words[:1] == ["end_header"]:
            break
        if words[:1] == ["format"]:
            form = words[1]
        elif words[:1] == ["element"]:
            elements.append(Element(words[1], int(words[2])))
        elif words[:1] == ["property"]:
            is_list = words[1] == "list"
            elements[-1].properties.append(
                (words[-1], TYPES[words[-2]], TYPES[words[2]] if is_list else None))
        elif words and words[0] not in ("ply", "comment", "obj_info"):
            known = False
    return form, elements, at, known


def fits(text, kind):
    """A value of an integer type is written as an integer."""
    try:
        int(text) if kind[0] in "iu" else float(text)
        return True
    except ValueError:
        return False


def ascii_element(tokens, at, element):
    """Scalars of each record as doubles (every digit of the text counts), and the index of the next token."""
    rows = []
    for _ in range(element.count):
        row = []
        for _, kind, list_kind in element.properties:
            if at >= len(tokens):
                raise Broken("truncated", rows)
            if list_kind is None:
                row.append(float(tokens[at]))
                at += 1
                continue
            if not fits(tokens[at], list_kind) or int(tokens[at]) < 0:
                raise Broken("ascii-token", rows)
            at += 1 + int(tokens[at])
            if at > len(tokens):
                raise Broken("truncated", rows)
            row.append(math.nan)
        rows.append(row)
    return rows, at


def binary_element(data, at, element, order):
    """Likewise, and the offset behind the element."""
    properties = element.properties
    if all(list_kind is None for _, _, list_kind in properties):
        kind = np.dtype([("f%d" % i, order + p[1]) for i, p in enumerate(properties)])
        count = min(element.count, (len(data) - at) // kind.itemsize)
        records = np.frombuffer(data, kind, count, at)
        rows = np.stack([records[name].astype(np.float64) for name in kind.names], 1).reshape(count, len(properties))
        if count < element.count:
            raise Broken("truncated", rows)
        return rows, at + count * kind.itemsize
    rows = []
    for _ in range(element.count):
        row = []
        for _, kind, list_kind in properties:
            size = np.dtype(list_kind or kind).itemsize
            if at + size > len(data):
                raise Broken("truncated", rows)
            value = np.frombuffer(data, order + (list_kind or kind), 1, at)[0]
            at += size
            if list_kind is not None:
                at += int(value) * np.dtype(kind).itemsize
                if at > len(data):
                    raise Broken("truncated", rows)
            row.append(math.nan if list_kind else float(value))
        rows.append(row)
    return rows, at


def read_elements(data, form, elements, at):
    """Rows of the vertex element, the class of the error that ends them early, and problems behind them."""
    source = data[at:].split() if form == "ascii" else data
    place = 0 if form == "ascii" else at
    vertices = None
    for element in elements:
        try:
            if form == "ascii":
                rows, place = ascii_element(source, place, element)
            else:
                rows, place = binary_element(data, place, element, "<" if form == "binary_little_endian" else ">")
        except Broken as broken:
            error, rows = broken.args
            if vertices is None:
                return (rows if element.name == "vertex" else []), error, set()
            return vertices, "", {"elements-lost"}
        if element.name == "vertex":
            vertices = rows
    return vertices, "", {"trailing-bytes"} if place < len(source) else set()


def exact_sum(column):
    return number(math.fsum(column[np.isfinite(column)]))


def read_ply(data):
    values = Values()
    form, elements, body, known = parse_header(data)
    vertex = next((e for e in elements if e.name == "vertex"), None)
    if vertex is None:
        raise Refused("no-vertex")
    names = [name for name, _, list_kind in vertex.properties if list_kind is None]
    if not all(axis in names for axis in "xyz"):
        raise Refused("no-xyz")
    rows, values.error, values.problems = read_elements(data, form, elements, body)
    values.format = "PLY " + form
    if not known:
        values.problems.add("ply-keyword")
    values.promised = vertex.count
    values.count = len(rows)
    table = np.asarray(rows, np.float64).reshape(len(rows), len(vertex.properties))

    def column(name):
        return table[:, [p[0] for p in vertex.properties].index(name)]

    axes = [column(axis) for axis in "xyz"]
    values.sums = [exact_sum(a) for a in axes]
    if all(np.isfinite(a).any() for a in axes):
        values.extent = [(float(a[np.isfinite(a)].min()), float(a[np.isfinite(a)].max())) for a in axes]
    canonical = [np.where(np.isnan(a), np.nan, a) for a in axes]
    values.digest = digest([np.ascontiguousarray(a).view(np.uint64) for a in canonical])
    for name in INTENSITY:
        if name in names:
            values.intensity = exact_sum(column(name))
    if "red" in names:
        values.red = exact_sum(column("red"))
    return values
