# SPDX-License-Identifier: Apache-2.0
"""Pictures of more samples than memory: refused with both figures before a sample is read; pictures
above four million samples that do fit: read whole. OpenEXR, Radiance and DNG files written here from
their published layouts, zeros left out of the disk.
  large_pictures.py LIGHTCAL"""
import json
import os
import pathlib
import resource
import struct
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from plain_tiff import entry, head  # noqa: E402

LIGHTCAL = sys.argv[1]
LITTLE_SPACE = 900 << 20  # of addresses: the program with its libraries takes a part of it


def inspect(path, address_space):
    limit = (lambda: resource.setrlimit(resource.RLIMIT_AS, (address_space,) * 2)) if address_space else None
    return subprocess.run([LIGHTCAL, "inspect", path, "--json"], capture_output=True, text=True,
                          preexec_fn=limit)


def exr(path, width, height, half):
    """Scan lines of three half floats, not compressed (openexr.com, File Layout). `half`: the two
    bytes of every sample; none: zeros that take no disk."""
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(name + b"\0" + struct.pack("<iB3xii", 1, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    header = struct.pack("<ii", 20000630, 2)
    for name, kind, value in ((b"channels", b"chlist", channels), (b"compression", b"compression", b"\0"),
                              (b"dataWindow", b"box2i", box), (b"displayWindow", b"box2i", box),
                              (b"lineOrder", b"lineOrder", b"\0"),
                              (b"pixelAspectRatio", b"float", struct.pack("<f", 1.0)),
                              (b"screenWindowCenter", b"v2f", struct.pack("<2f", 0.0, 0.0)),
                              (b"screenWindowWidth", b"float", struct.pack("<f", 1.0))):
        header += name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value
    header += b"\0"
    line, first = 8 + 6 * width, len(header) + 8 * height
    with open(path, "wb") as out:
        out.write(header + struct.pack("<%dQ" % height, *(first + line * y for y in range(height))))
        for y in range(height):
            out.seek(first + line * y)
            out.write(struct.pack("<ii", y, 6 * width) + half * (3 * width))
        out.truncate(first + line * height)


def radiance(path, width, height, pixel):
    """Flat pixels, not run-length encoded (Radiance, File Formats)."""
    with open(path, "wb") as out:
        out.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width))
        first = out.tell()
        out.write(pixel * (width * height))
        out.truncate(first + 4 * width * height)


def dng(path, width, height, code):
    """One strip of 16 bit CFA samples, not compressed (Adobe DNG 1.4, TIFF 6.0)."""
    entries = [entry(254, "L", 0), entry(256, "L", width), entry(257, "L", height), entry(258, "S", 16),
               entry(259, "S", 1), entry(262, "S", 32803), entry(271, "A", "Test"), entry(272, "A", "Large"),
               entry(277, "S", 1), entry(278, "L", height), entry(279, "L", 2 * width * height),
               entry(33421, "S", 2, 2), entry(33422, "B", 0, 1, 1, 2), entry(50706, "B", 1, 4, 0, 0),
               entry(50708, "A", "Test Large"), entry(50714, "S", 0), entry(50717, "L", 65535),
               entry(50721, "r", 1, 0, 0, 0, 1, 0, 0, 0, 1), entry(50728, "R", 1, 1, 1), entry(50778, "S", 21),
               entry(33434, "R", 0.01), entry(33437, "R", 4), entry(34855, "S", 100)]
    before = head(entries)
    with open(path, "wb") as out:
        out.write(before + code * (width * height))
        out.truncate(len(before) + 2 * width * height)


class LargePictures(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        self.folder.cleanup()

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def test_above_four_million_samples_are_read_where_memory_allows(self):
        for write, name, value in ((exr, "a.exr", b"\x00\x38"), (radiance, "a.hdr", bytes([128] * 4)),
                                   (dng, "a.dng", b"\x00\x70")):
            write(self.path(name), 2400, 2000, value)
            done = inspect(self.path(name), None)
            self.assertEqual(done.returncode, 0, name + done.stderr)
            answer = json.loads(done.stdout)
            self.assertEqual((answer["width"], answer["height"]) if "width" in answer else (2400, 2000),
                             (2400, 2000))

    def test_what_memory_cannot_hold_is_refused_with_both_figures(self):
        for write, name, width in ((exr, "b.exr", 9000), (radiance, "b.hdr", 9000), (dng, "b.dng", 30000)):
            write(self.path(name), width, 7000, b"")
            done = inspect(self.path(name), LITTLE_SPACE)
            self.assertEqual(done.returncode, 3, name + ": " + done.stderr)
            error = json.loads(done.stdout)["error"] if done.stdout else {"code": done.stderr}
            self.assertIn("too_large", json.dumps(error), name)
            self.assertIn("memory", json.dumps(error), name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
