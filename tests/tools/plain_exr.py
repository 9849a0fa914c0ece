# SPDX-License-Identifier: Apache-2.0
"""Scan lines of 32 bit floats from an OpenEXR file, not compressed or ZIP. Source: the OpenEXR file layout."""
import pathlib
import struct
import zlib

import numpy as np

LINES_OF = {0: 1, 2: 1, 3: 16}  # of a block, by compression: none, ZIPS, ZIP


def attributes(data):
    """By name, and where the line offsets begin."""
    found, at = {}, 8
    while data[at]:
        name_ends = data.index(b"\0", at)
        kind_ends = data.index(b"\0", name_ends + 1)
        size, = struct.unpack_from("<i", data, kind_ends + 1)
        found[data[at:name_ends].decode()] = data[kind_ends + 5:kind_ends + 5 + size]
        at = kind_ends + 5 + size
    return found, at + 1


def inflated(block):
    """ZIP keeps differences of bytes, low ones of all numbers first."""
    z = np.frombuffer(zlib.decompress(block), np.uint8).astype(np.int64)
    z[1:] -= 128
    z = (np.cumsum(z) & 255).astype(np.uint8)
    out = np.empty(len(z), np.uint8)
    half = (len(z) + 1) // 2
    out[0::2], out[1::2] = z[:half], z[half:]
    return out.tobytes()


def read_exr(path):
    """Rows, columns and, of more than one, channels in the order of the file: B, G, R."""
    data = pathlib.Path(path).read_bytes()
    found, at = attributes(data)
    x0, y0, x1, y1 = struct.unpack("<4i", found["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    channels, rest = 0, found["channels"]
    while rest[0]:
        name_ends = rest.index(b"\0")
        assert struct.unpack_from("<i", rest, name_ends + 1) == (2,), "not of 32 bit floats"
        rest, channels = rest[name_ends + 17:], channels + 1
    lines = LINES_OF[found["compression"][0]]
    rows = []
    for i, block in enumerate(struct.unpack_from(f"<{(height + lines - 1) // lines}Q", data, at)):
        size, = struct.unpack_from("<i", data, block + 4)
        samples = data[block + 8:block + 8 + size]
        count = min(lines, height - i * lines) * channels * width
        if size < 4 * count:
            samples = inflated(samples)
        rows.append(np.frombuffer(samples, "<f4", count).reshape(-1, channels, width))
    picture = np.moveaxis(np.concatenate(rows), 1, 2)
    return picture[..., 0] if channels == 1 else picture
