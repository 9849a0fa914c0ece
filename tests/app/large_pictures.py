# SPDX-License-Identifier: Apache-2.0
"""Pictures of more samples than memory: refused with both figures before a sample is read; pictures
above four million samples that do fit: read whole. OpenEXR, Radiance and DNG files written here from
their published layouts, zeros left out of the disk.
  large_pictures.py LIGHTCAL"""
import json
import os
import resource
import struct
import subprocess
import sys
import tempfile
import unittest

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
    tags = {254: ("I", [0]), 256: ("I", [width]), 257: ("I", [height]), 258: ("H", [16]), 259: ("H", [1]),
            262: ("H", [32803]), 271: ("s", b"Test\0"), 272: ("s", b"Large\0"), 273: ("I", [0]),
            277: ("H", [1]), 278: ("I", [height]), 279: ("I", [2 * width * height]),
            33421: ("H", [2, 2]), 33422: ("B", bytes([0, 1, 1, 2])), 50706: ("B", bytes([1, 4, 0, 0])),
            50708: ("s", b"Test Large\0"), 50714: ("H", [0]), 50717: ("I", [65535]),
            50721: ("r", [1, 0, 0, 0, 1, 0, 0, 0, 1]), 50728: ("u", [1, 1, 1]), 50778: ("H", [21]),
            33434: ("u", [0.01]), 33437: ("u", [4]), 34855: ("H", [100])}
    kinds = {"B": (1, "B"), "s": (2, None), "H": (3, "H"), "I": (4, "I"), "u": (5, None), "r": (10, None)}
    at = 8 + 2 + 12 * len(tags) + 4
    entries, extra = b"", b""
    rows = []
    for tag in sorted(tags):
        kind, values = tags[tag]
        if kind in "sB":
            body, count = bytes(values), len(values)
        elif kind in "ur":
            body = b"".join(struct.pack("<iI" if kind == "r" else "<II", round(v * 1000), 1000) for v in values)
            count = len(values)
        else:
            body, count = struct.pack("<%d%s" % (len(values), kinds[kind][1]), *values), len(values)
        rows.append((tag, kinds[kind][0], count, body))
    first = at + sum((len(body) + 1) // 2 * 2 for _, _, _, body in rows if len(body) > 4)
    for tag, kind, count, body in rows:
        if tag == 273:
            body = struct.pack("<I", first)
        if len(body) > 4:
            place = struct.pack("<I", at + len(extra))
            extra += body + b"\0" * (len(body) % 2)
        else:
            place = body.ljust(4, b"\0")
        entries += struct.pack("<HHI", tag, kind, count) + place
    with open(path, "wb") as out:
        out.write(b"II*\0" + struct.pack("<I", 8) + struct.pack("<H", len(rows)) + entries + b"\0" * 4 + extra)
        out.write(code * (width * height))
        out.truncate(first + 2 * width * height)


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
