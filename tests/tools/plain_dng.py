# SPDX-License-Identifier: Apache-2.0
"""A RAW picture as DNG, not compressed, of one RGGB mosaic of 16 bit: for worlds that include no header of
lightcal. Source: Adobe, Digital Negative specification 1.4; TIFF 6.0; Exif 2.3."""
import pathlib

import numpy as np

from plain_tiff import entry, head

# IEC 61966-2-1: linear sRGB from XYZ. A camera that sees so has 1, 1, 1 of D65.
RGB_FROM_XYZ = np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]])
BLACK, WHITE = 512, 16383


def mosaic(rgb):
    """Rows, columns, R G B of 0 to 1 -> RGGB samples."""
    out = rgb[..., 1].copy()
    out[0::2, 0::2] = rgb[0::2, 0::2, 0]
    out[1::2, 1::2] = rgb[1::2, 1::2, 2]
    return np.clip(np.rint(BLACK + out * (WHITE - BLACK)), 0, WHITE).astype("<u2")


def write_dng(path, samples, exposure_s, f_number, iso, neutral, model="Synthetic Card Camera",
              more=()):
    height, width = samples.shape
    entries = [entry(254, "L", 0), entry(256, "L", width), entry(257, "L", height), entry(258, "S", 16),
               entry(259, "S", 1), entry(262, "S", 32803), entry(271, "A", "Synthetic"), entry(272, "A", model),
               entry(274, "S", 1), entry(277, "S", 1), entry(278, "L", height), entry(279, "L", 2 * samples.size),
               entry(33421, "S", 2, 2), entry(33422, "B", 0, 1, 1, 2), entry(33434, "R", exposure_s),
               entry(33437, "R", f_number), *([] if iso is None else [entry(34855, "S", iso)]), *more,
               entry(50706, "B", 1, 4, 0, 0),
               entry(50707, "B", 1, 1, 0, 0), entry(50708, "A", model), entry(50711, "S", 1),
               entry(50714, "L", BLACK), entry(50717, "L", WHITE), entry(50721, "r", *RGB_FROM_XYZ.ravel()),
               entry(50728, "R", *neutral), entry(50778, "S", 21)]
    pathlib.Path(path).write_bytes(head(entries) + samples.tobytes())
