#!/usr/bin/python3
"""The table of verdicts: what an independent reader finds in every scan of a folder.

Usage: make_verdicts.py FOLDER > verdicts.csv

One line per .las, .laz and .ply file. A file that breaks off among its points is refused ("truncated", "ascii-token"),
and its values are those of the whole points before.
"""
import csv
import pathlib
import sys

from las_values import read_las
from ply_values import read_ply
from values import COLUMNS, Refused, row


def judge(data):
    try:
        values = read_ply(data) if data[:3] == b"ply" else read_las(data)
    except Refused as refused:
        return None, refused.args[0]
    return values, values.error


def main(folder):
    scans = sorted((p for p in folder.rglob("*") if p.suffix.lower() in (".las", ".laz", ".ply") and p.is_file()),
                   key=lambda p: p.relative_to(folder).as_posix().encode())
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(COLUMNS)
    for path in scans:
        name = path.relative_to(folder).as_posix()
        assert "," not in name and '"' not in name
        writer.writerow(row(name, *judge(path.read_bytes())))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
