# SPDX-License-Identifier: Apache-2.0
"""A panorama whose Orientation tag says how it is shown gives its lights where they are shown, in each of the
eight ways TIFF 6.0 has; also of grey ones. The files are written here, turned by numpy.

    turned_pictures.py LIGHTCAL
"""
import json
import pathlib
import struct
import subprocess
import sys
import tempfile

import numpy as np

# What a viewer does to the stored array, undone.
STORED = {1: lambda a: a, 2: lambda a: a[:, ::-1], 3: lambda a: a[::-1, ::-1], 4: lambda a: a[::-1],
          5: lambda a: a.swapaxes(0, 1), 6: lambda a: np.rot90(a, 1),
          7: lambda a: np.rot90(a, 2).swapaxes(0, 1), 8: lambda a: np.rot90(a, -1)}


def tiff(picture, orientation):
    """A TIFF of 32 bit floats in one strip."""
    height, width, channels = picture.shape
    entries = ((256, width), (257, height), (258, (32,) * channels), (259, 1), (262, 2 if channels == 3 else 1),
               (273, None), (274, orientation), (277, channels), (278, height), (279, 4 * picture.size), (284, 1),
               (339, (3,) * channels))
    behind = 8 + 2 + 12 * len(entries) + 4
    strip = behind + 16 * channels
    body, extra = b"", b""
    for tag, value in entries:
        if isinstance(value, tuple) and len(value) > 2:
            body += struct.pack("<HHII", tag, 3, len(value), behind + len(extra))
            extra += struct.pack(f"<{len(value)}H", *value)
        else:
            value = strip if value is None else value[0] if isinstance(value, tuple) else value
            body += struct.pack("<HHII", tag, 4 if tag in (273, 279) else 3, 1, value)
    head = b"II*\0" + struct.pack("<IH", 8, len(entries)) + body + bytes(4) + extra
    return head.ljust(strip, b"\0") + np.ascontiguousarray(picture, "<f4").tobytes()


with tempfile.TemporaryDirectory() as folder:
    for channels in (3, 1):
        shown = np.full((32, 64, channels), 10.0, np.float32)
        shown[4:7, 10:14] = np.linspace(4000, 6000, 12).reshape(3, 4, 1)
        for orientation, stored in STORED.items():
            path = pathlib.Path(folder) / "panorama.tif"
            path.write_bytes(tiff(stored(shown), orientation))
            done = subprocess.run([sys.argv[1], "dome", path, "--json", "-o", folder + "/out", "--force"],
                                  check=True, capture_output=True, text=True)
            light = json.loads(done.stdout)["lights"][0]
            found = light["azimuth_deg"], light["elevation_deg"]
            # Of columns 10 to 13 of 64 and rows 4 to 6 of 32, nearly of one brightness.
            expected = (12 / 64 - 0.5) * 360, 90 - 5.5 / 32 * 180
            print(channels, orientation, found, expected)
            assert max(abs(a - b) for a, b in zip(found, expected)) < 2, (orientation, found, expected)
