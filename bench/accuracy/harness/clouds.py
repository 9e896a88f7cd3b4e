"""Point clouds as columns: PLY (ascii, binary little-endian) and ascii PCD in, PLY out."""

import numpy as np

_TYPES = {
    "char": "i1",
    "int8": "i1",
    "uchar": "u1",
    "uint8": "u1",
    "short": "<i2",
    "int16": "<i2",
    "ushort": "<u2",
    "uint16": "<u2",
    "int": "<i4",
    "int32": "<i4",
    "uint": "<u4",
    "uint32": "<u4",
    "float": "<f4",
    "float32": "<f4",
    "double": "<f8",
    "float64": "<f8",
}


def read_ply(path):
    """Columns of the vertex element (which must be the first one, without lists) as a dict of arrays."""
    with open(path, "rb") as file:
        data = file.read()
    end = data.index(b"end_header")
    body = data.index(b"\n", end) + 1
    kind, count, element, columns = None, None, None, []
    for line in data[:end].decode("latin1").splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "format":
            kind = words[1]
        elif words[0] == "element":
            element = words[1]
            if element == "vertex":
                count = int(words[2])
            elif count is None:
                raise ValueError(f"{path}: an element precedes the vertices")
        elif words[0] == "property" and element == "vertex":
            if words[1] == "list":
                raise ValueError(f"{path}: vertices with lists are not read here")
            columns.append((words[2], _TYPES[words[1]]))
    if kind == "ascii":
        rows = data[body:].split(b"\n", count)[:count]
        values = np.array([row.split() for row in rows], dtype=float)
        return {name: values[:, i] for i, (name, _) in enumerate(columns)}
    if kind != "binary_little_endian":
        raise ValueError(f"{path}: format {kind} is not read here")
    table = np.frombuffer(data, np.dtype(columns), count, body)
    return {name: table[name] for name, _ in columns}


def read_pcd(path):
    """Columns of an ascii PCD; a packed "rgba" is split into red, green, blue."""
    with open(path, encoding="latin1") as file:
        lines = file.read().splitlines()
    names = next(line.split()[1:] for line in lines if line.startswith("FIELDS"))
    start = next(i for i, line in enumerate(lines) if line.startswith("DATA"))
    if lines[start].split()[1] != "ascii":
        raise ValueError(f"{path}: only ascii PCD is read here")
    values = np.array([line.split() for line in lines[start + 1 :] if line.strip()], dtype=float)
    columns = {name: values[:, i] for i, name in enumerate(names)}
    if "rgba" in columns:
        packed = columns["rgba"].astype(np.int64)
        columns.update(red=packed >> 16 & 255, green=packed >> 8 & 255, blue=packed & 255)
    return columns


def read_columns(path):
    return read_pcd(path) if str(path).endswith(".pcd") else read_ply(path)


def positions(columns):
    """Shape (n, 3), float64."""
    return np.stack([np.asarray(columns[axis], float) for axis in "xyz"], axis=1)


def write_ply(path, points, **columns):
    """Binary PLY: x y z as double, then the columns as uchar (bool, uint8) or float."""
    fields = [(axis, "<f8") for axis in "xyz"]
    fields += [(name, "u1" if np.asarray(c).dtype.kind in "bu" else "<f4") for name, c in columns.items()]
    table = np.empty(len(points), np.dtype(fields))
    for i, axis in enumerate("xyz"):
        table[axis] = points[:, i]
    for name, column in columns.items():
        table[name] = column
    names = {"<f8": "double", "u1": "uchar", "<f4": "float"}
    header = "".join(f"property {names[kind]} {name}\n" for name, kind in fields)
    with open(path, "wb") as file:
        file.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n{header}end_header\n".encode())
        file.write(table.tobytes())
