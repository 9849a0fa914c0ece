# SPDX-License-Identifier: Apache-2.0
"""A RAW picture as DNG, not compressed, of one RGGB mosaic of 16 bit: for worlds that include no header of
lightcal. Source: Adobe, Digital Negative specification 1.4; TIFF 6.0; Exif 2.3."""
import pathlib
import struct

import numpy as np

BYTE, ASCII, SHORT, LONG, RATIONAL, SRATIONAL = 1, 2, 3, 4, 5, 10
FORMATS = {BYTE: "B", SHORT: "H", LONG: "I"}
# IEC 61966-2-1: linear sRGB from XYZ. A camera that sees so has 1, 1, 1 of D65.
RGB_FROM_XYZ = np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]])
BLACK, WHITE = 512, 16383


def mosaic(rgb):
    """Rows, columns, R G B of 0 to 1 -> RGGB samples."""
    out = rgb[..., 1].copy()
    out[0::2, 0::2] = rgb[0::2, 0::2, 0]
    out[1::2, 1::2] = rgb[1::2, 1::2, 2]
    return np.clip(np.rint(BLACK + out * (WHITE - BLACK)), 0, WHITE).astype("<u2")


def rationals(values, scale=1000000):
    return [part for value in values for part in (round(value * scale), scale)]


def write_dng(path, samples, exposure_s, f_number, iso, neutral, model="Synthetic Card Camera"):
    height, width = samples.shape
    name = model.encode() + b"\0"
    exposure = rationals([exposure_s], 1000000 if exposure_s < 1000 else 1000)
    tags = {254: (LONG, [0]), 256: (LONG, [width]), 257: (LONG, [height]), 258: (SHORT, [16]), 259: (SHORT, [1]),
            262: (SHORT, [32803]), 271: (ASCII, b"Synthetic\0"), 272: (ASCII, name), 273: (LONG, [0]),
            274: (SHORT, [1]), 277: (SHORT, [1]), 278: (LONG, [height]), 279: (LONG, [2 * samples.size]),
            33421: (SHORT, [2, 2]), 33422: (BYTE, [0, 1, 1, 2]), 33434: (RATIONAL, exposure),
            33437: (RATIONAL, rationals([f_number], 1000)), 34855: (SHORT, [iso]), 50706: (BYTE, [1, 4, 0, 0]),
            50707: (BYTE, [1, 1, 0, 0]), 50708: (ASCII, name), 50711: (SHORT, [1]), 50714: (LONG, [BLACK]),
            50717: (LONG, [WHITE]), 50721: (SRATIONAL, rationals(RGB_FROM_XYZ.ravel(), 10000)),
            50728: (RATIONAL, rationals(neutral)), 50778: (SHORT, [21])}
    tags[273] = (LONG, [8 + 2 + 12 * len(tags) + 4])  # the strip follows the directory, long values the strip
    after = tags[273][1][0] + 2 * samples.size
    directory, rest = struct.pack("<H", len(tags)), b""
    for tag, (kind, values) in sorted(tags.items()):
        if kind in (RATIONAL, SRATIONAL):
            body, count = struct.pack(f"<{len(values)}{'I' if kind == RATIONAL else 'i'}", *values), len(values) // 2
        elif kind == ASCII:
            body, count = values, len(values)
        else:
            body, count = struct.pack(f"<{len(values)}{FORMATS[kind]}", *values), len(values)
        if len(body) > 4:
            place = struct.pack("<I", after + len(rest))
            rest += body + b"\0" * (len(body) % 2)
        else:
            place = body.ljust(4, b"\0")
        directory += struct.pack("<HHI", tag, kind, count) + place
    pathlib.Path(path).write_bytes(struct.pack("<2sHI", b"II", 42, 8) + directory + b"\0\0\0\0" +
                                   samples.tobytes() + rest)
