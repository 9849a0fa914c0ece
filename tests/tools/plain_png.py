# SPDX-License-Identifier: Apache-2.0
"""RGB as PNG (ISO/IEC 15948), 8 or 16 bit by the array's type: for worlds that include no header of lightcal."""
import pathlib
import struct
import zlib

import numpy as np


def write_png(path, rgb):
    height, width, _ = rgb.shape
    depth = 8 * rgb.dtype.itemsize
    rows = np.zeros((height, 1 + 3 * width * rgb.dtype.itemsize), np.uint8)
    rows[:, 1:] = rgb.astype(rgb.dtype.newbyteorder(">")).reshape(height, -1).view(np.uint8)

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", width, height, depth, 2, 0, 0, 0)
    pathlib.Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                                   chunk(b"IDAT", zlib.compress(rows.tobytes(), 1)) + chunk(b"IEND", b""))
