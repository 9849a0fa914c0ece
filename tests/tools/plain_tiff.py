# SPDX-License-Identifier: Apache-2.0
"""Directories of little endian TIFF files, byte by byte: for worlds that include no header of lightcal. Source:
TIFF 6.0, section 2."""
import struct


def entry(tag, kind, *values):
    """kind: B byte, A text, S short, L long, R rational, r signed rational."""
    if kind == "A":
        data, count = values[0].encode() + b"\0", len(values[0]) + 1
    elif kind in "Rr":
        code = "i" if kind == "r" else "I"
        data = b"".join(struct.pack("<2" + code, round(v * 1e6), 1000000) for v in values)
        count = len(values)
    else:
        code = {"B": "B", "S": "H", "L": "I"}[kind]
        data, count = struct.pack(f"<{len(values)}{code}", *values), len(values)
    return tag, {"B": 1, "A": 2, "S": 3, "L": 4, "R": 5, "r": 10}[kind], count, data


def directory(entries, at):
    entries = sorted(entries)
    head, tail = struct.pack("<H", len(entries)), b""
    behind = at + 2 + 12 * len(entries) + 4
    for tag, kind, count, data in entries:
        if len(data) > 4:
            place = struct.pack("<I", behind + len(tail))
            tail += data + b"\0" * (len(data) % 2)
        else:
            place = data.ljust(4, b"\0")
        head += struct.pack("<HHI", tag, kind, count) + place
    return head + b"\0\0\0\0" + tail


def head(entries):
    """A file of one directory, up to its strip, which follows at once."""
    begins = 8 + len(directory([*entries, entry(273, "L", 0)], 8))
    return struct.pack("<2sHI", b"II", 42, 8) + directory([*entries, entry(273, "L", begins)], 8)
