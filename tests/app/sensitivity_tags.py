# SPDX-License-Identifier: Apache-2.0
"""Exif 2.3 says sensitivities of 65535 and more elsewhere: by SensitivityType in RecommendedExposureIndex,
StandardOutputSensitivity or ISOSpeed, of RAW files as of others, in whatever order the tags stand. PNG files with an
eXIf chunk, TIFF and DNG files, written without a header of lightcal."""
import pathlib
import struct
import sys
import zlib

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused  # noqa: E402
from plain_dng import mosaic, write_dng  # noqa: E402
from plain_png import write_png  # noqa: E402
from plain_tiff import directory, entry, head  # noqa: E402

PHOTOGRAPHIC, TYPE, STANDARD, RECOMMENDED, SPEED = 34855, 34864, 34865, 34866, 34867
PATH = HOME / "f.png"


def picture(tags):
    write_png(PATH, np.random.default_rng(9).integers(20, 200, (48, 64, 3)).astype(np.uint8))
    begins = 8 + len(directory([entry(34665, "L", 0)], 8))
    exif = (struct.pack("<2sHI", b"II", 42, 8) + directory([entry(34665, "L", begins)], 8) +
            directory([entry(33434, "R", 0.01), entry(33437, "R", 8), *tags], begins))
    chunk = struct.pack(">I", len(exif)) + b"eXIf" + exif + struct.pack(">I", zlib.crc32(b"eXIf" + exif))
    png = PATH.read_bytes()
    PATH.write_bytes(png[:33] + chunk + png[33:])  # behind the header
    return ["merge", PATH, "--response", "srgb", "-o", HOME / "o.exr", "--mains", "none", "--force"]


def tiff(tags):
    codes = np.random.default_rng(9).integers(20, 200, (48, 64, 3)).astype("<u2") * 256
    def begin(exif):
        return head([entry(256, "L", 64), entry(257, "L", 48), entry(258, "S", 16, 16, 16), entry(259, "S", 1),
                     entry(262, "S", 2), entry(277, "S", 3), entry(278, "L", 48), entry(279, "L", codes.nbytes),
                     entry(34665, "L", exif)])
    at = len(begin(0)) + codes.nbytes
    exif = directory([entry(33434, "R", 0.01), entry(33437, "R", 8), *tags], at)
    (HOME / "f.tif").write_bytes(begin(at) + codes.tobytes() + exif)
    return ["merge", HOME / "f.tif", "--response", "linear", "-o", HOME / "o.exr", "--mains", "none", "--force"]


def raw(tags):
    grey = np.random.default_rng(9).uniform(0.05, 0.6, (48, 64, 1)) * np.ones(3)
    write_dng(HOME / "f.dng", mosaic(grey), 0.01, 8, None, (1, 1, 1), more=tags)
    return ["merge", HOME / "f.dng", "--noise", "1e-4,1e-7", "-o", HOME / "o.exr", "--mains", "none", "--force"]


beyond = [entry(PHOTOGRAPHIC, "S", 65535)]
for iso, tags in ((400, [entry(PHOTOGRAPHIC, "S", 400), entry(RECOMMENDED, "L", 800)]),
                  (102400, [*beyond, entry(TYPE, "S", 2), entry(RECOMMENDED, "L", 102400)]),
                  (204800, [*beyond, entry(TYPE, "S", 1), entry(STANDARD, "L", 204800), entry(RECOMMENDED, "L", 100)]),
                  (81920, [*beyond, entry(TYPE, "S", 3), entry(SPEED, "L", 81920), entry(STANDARD, "L", 100)]),
                  (102400, [*beyond, entry(RECOMMENDED, "L", 102400)])):
    for file in (picture, tiff, raw):
        said = answer(*file(tags))["frames"][0]["iso"]
        assert said == iso, (file.__name__, said, iso)
refused("no_exposure_metadata", *picture(beyond), says="ISO speed")
