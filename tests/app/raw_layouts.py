# SPDX-License-Identifier: Apache-2.0
"""`lightcal merge` of DNGs of other layouts than Bayer: written here by the DNG specification 1.6
and ISO/IEC 10918-1, of no camera, without a header of lightcal. Each must lead back to the
luminances that made it, or be refused in words that name what is missing."""
import pathlib
import struct
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused  # noqa: E402
from plain_tiff import directory, entry  # noqa: E402

WIDTH, HEIGHT = 96, 72
BLACK, WHITE = 512, 15871
TIMES, N, ISO = (1 / 256, 1 / 64, 1 / 16), 8.0, 100.0
CAMERA = np.array([[0.634534, -0.059942, -0.090904], [-0.404678, 1.176181, 0.191436],
                   [-0.085712, 0.204085, 0.535040]])  # of XYZ (D65)
D65 = np.array([0.31272 / 0.32903, 1.0, (1 - 0.31272 - 0.32903) / 0.32903])
XTRANS = np.array([[1, 1, 0, 1, 1, 2], [1, 1, 2, 1, 1, 0], [2, 0, 1, 0, 2, 1],
                   [1, 1, 2, 1, 1, 0], [1, 1, 0, 1, 1, 2], [0, 2, 1, 2, 0, 1]])
BAYER = np.array([[0, 1], [1, 2]])


def scene():
    """Six by four patches from 20 to 14,000 cd/m^2, neutral under D65."""
    patch = np.arange(24).reshape(4, 6)
    nits = 20.0 * 700.0 ** (patch / 23)
    return np.repeat(np.repeat(nits, HEIGHT // 4, 0), WIDTH // 6, 1)


TRUTH = scene()


def electrons_to_codes(response, time, rng, black, white=WHITE):
    """H = q L t/N^2: full scale is 78 N^2/(q S t) cd/m^2; 60,000 electrons, 3.5 of read noise."""
    full = 78.0 * N * N / (0.65 * ISO * time)
    e = np.minimum(rng.poisson(np.minimum(response * TRUTH / full, 3.0) * 60000.0), 60000)
    e = e + rng.normal(0.0, 3.5, e.shape)
    codes = np.round(black + e / 60000.0 * (white - BLACK))
    return np.clip(codes, 0, white).astype(np.uint16)


def mosaic(pattern, rows):
    plane = np.tile(pattern, (HEIGHT // pattern.shape[0] + 1, WIDTH // pattern.shape[1] + 1))
    return (rows @ D65)[plane[:HEIGHT, :WIDTH]]


def lossless_jpeg(picture):
    """Process 14, predictor 1, two components side by side; every length of difference has a code
    of five bits (lengths 0 to 16, no code of all ones)."""
    height, width = picture.shape
    p = picture.astype(int)
    predicted = np.empty_like(p)
    predicted[:, 2:] = p[:, :-2]
    predicted[1:, :2] = p[:-1, :2]
    predicted[0, :2] = 1 << 15
    bits = []
    for d in (((p - predicted) + 32768) % 65536 - 32768).ravel():
        size = int(abs(d)).bit_length()
        bits.append(format(size, "05b"))
        if 0 < size < 16:
            bits.append(format((d if d > 0 else d - 1) & ((1 << size) - 1), f"0{size}b"))
    text = "".join(bits)
    text += "1" * (-len(text) % 8)
    data = int(text, 2).to_bytes(len(text) // 8, "big").replace(b"\xff", b"\xff\0")
    table = bytes([0, 0, 0, 0, 0, 17] + [0] * 11) + bytes(range(17))
    return (b"\xff\xd8\xff\xc4" + struct.pack(">H", 2 + len(table)) + table +
            b"\xff\xc3" + struct.pack(">HBHHB", 14, 16, height, width // 2, 2) +
            bytes([0, 0x11, 0, 1, 0x11, 0]) +
            b"\xff\xda" + struct.pack(">HB", 10, 2) + bytes([0, 0, 1, 0, 1, 0, 0]) + data +
            b"\xff\xd9")


def strip(picture, bits):
    """Rows of numbers of so many bits, the first bit highest, each row from a byte on (TIFF 6.0)."""
    if bits == 16:
        return picture.astype("<u2").tobytes()
    rows = picture.reshape(HEIGHT, -1, 1) >> np.arange(bits - 1, -1, -1, dtype=np.uint16) & 1
    return np.packbits(rows.reshape(HEIGHT, -1).astype(np.uint8), 1).tobytes()


def dng(name, picture, time, more, photometric=32803, compression=1, leave_out=(), bits=16):
    samples = 1 if picture.ndim == 2 else picture.shape[2]
    data = strip(picture, bits) if compression == 1 else lossless_jpeg(picture)
    exif = [entry(0x829A, "R", time), entry(0x829D, "R", N), entry(0x8827, "S", int(ISO))]
    entries = [entry(254, "L", 0), entry(256, "L", WIDTH), entry(257, "L", HEIGHT),
               entry(258, "S", *[bits] * samples), entry(259, "S", compression),
               entry(262, "S", photometric), entry(271, "A", "Synthetic"),
               entry(272, "A", "Synthetic Two"), entry(273, "L", 0), entry(274, "S", 1),
               entry(277, "S", samples), entry(278, "L", HEIGHT), entry(279, "L", len(data)),
               entry(284, "S", 1), entry(34665, "L", 0), entry(50706, "B", 1, 4, 0, 0),
               entry(50707, "B", 1, 1, 0, 0), entry(50708, "A", "Synthetic Two"),
               entry(50717, "L", *[WHITE] * samples)]
    tags = {e[0]: e for e in entries}
    tags.update({e[0]: e for e in more})
    entries = [e for tag, e in tags.items() if tag not in leave_out]
    exif_at = 8 + len(directory(entries, 8))
    data_at = exif_at + len(directory(exif, exif_at)) + 15 & ~15
    for tag, value in ((34665, exif_at), (273, data_at)):
        entries = [entry(tag, "L", value) if e[0] == tag else e for e in entries]
    file = b"II*\0" + struct.pack("<I", 8) + directory(entries, 8) + directory(exif, exif_at)
    (HOME / name).write_bytes(file.ljust(data_at, b"\0") + data)
    return name


def cfa(pattern):
    return [entry(33421, "S", *pattern.shape), entry(33422, "B", *pattern.ravel().tolist())]


def colors(matrix=CAMERA):
    neutral = matrix @ D65
    return [entry(50721, "r", *matrix.ravel()), entry(50778, "S", 21),
            entry(50728, "R", *(neutral / neutral.max()))]


BLACK_TAG = [entry(50714, "L", BLACK)]


def bracket(stem, response, more, black=BLACK, white=WHITE, **options):
    rng = np.random.default_rng(7)
    return [dng(f"{stem}_{i}.dng", electrons_to_codes(response, t, rng, black, white), t, more,
                **options) for i, t in enumerate(TIMES)]


def patches(path):
    """Mean, least and most of the middle of each patch."""
    rects = []
    for y in range(4):
        for x in range(6):
            rect = f"{x * WIDTH // 6 + 4},{y * HEIGHT // 4 + 4},{WIDTH // 6 - 8},{HEIGHT // 4 - 8}"
            got = answer("inspect", path, "--rect", rect)["luminance_nits"]
            rects.append((got["mean"], got["min"], got["max"]))
    return np.array(rects)


def expect_the_luminances(stem, frames, tolerance=0.01):
    said = answer("merge", *frames, "-o", stem + ".exr", "--mains", "none")
    found = patches(stem + ".exr")
    patch = TRUTH[HEIGHT // 8::HEIGHT // 4, WIDTH // 12::WIDTH // 6].ravel()
    error = found[:, 0] / patch - 1.0
    worst = np.abs(error).max()
    assert worst < tolerance, f"{stem}: {worst:.3%} off, patches {error}"
    # No pattern is left in a plain patch: its pixels differ by noise alone, whose electrons count.
    spread = (found[:, 2] - found[:, 1]) / patch
    full = 78.0 * N * N / (0.65 * ISO * TIMES[-1])
    noise = 1.0 / np.sqrt(60000.0 * np.minimum(patch / full, 1.0))
    most = (spread / noise).max()
    assert most < 12.0, f"{stem}: pixels of a plain patch differ by {most:.1f} times their noise"
    print(f"{stem}: worst patch {worst:.3%}, pixels {most:.1f} sigma apart")
    return said


def bayer_of(stem, more, **options):
    return bracket(stem, mosaic(BAYER, CAMERA), cfa(BAYER) + more, **options)


# Bayer, uncompressed and as lossless JPEG, in which LibRaw's samples must be the same.
plain = expect_the_luminances("bayer", bayer_of("bayer", colors() + BLACK_TAG))
packed = expect_the_luminances("lossless", bayer_of("lossless", colors() + BLACK_TAG,
                                                    compression=7))
assert plain["noise"] == packed["noise"]

expect_the_luminances("x_trans", bracket("x_trans", mosaic(XTRANS, CAMERA),
                                         cfa(XTRANS) + colors() + BLACK_TAG))

expect_the_luminances("monochrome", bracket("monochrome", np.ones((HEIGHT, WIDTH)), BLACK_TAG,
                                            photometric=34892))


def linear_rgb(stem, white=WHITE, **options):
    rng = np.random.default_rng(7)
    more = colors() + [entry(50714, "L", BLACK, BLACK, BLACK)]
    for i, t in enumerate(TIMES):
        planes = [electrons_to_codes(r, t, rng, BLACK, white) for r in CAMERA @ D65]
        yield dng(f"{stem}_{i}.dng", np.stack(planes, -1), t, more, photometric=34892, **options)


expect_the_luminances("linear", list(linear_rgb("linear")))

# Without WhiteLevel a picture is full at 2^BitsPerSample - 1 (DNG 1.4, tag 50717).
NO_WHITE = {"leave_out": (50717,)}
for bits, compression in ((12, 1), (14, 1), (16, 1), (12, 7), (14, 7), (16, 7)):
    stem = f"no_white_{bits}_{compression}"
    expect_the_luminances(stem, bayer_of(stem, colors() + BLACK_TAG, white=2 ** bits - 1, bits=bits,
                                         compression=compression, **NO_WHITE))
expect_the_luminances("no_white_linear", list(linear_rgb("no_white_linear", 65535, **NO_WHITE)))
# One that was full earlier is named, with the tag.
full_below = (bayer_of("full_below", colors() + BLACK_TAG, **NO_WHITE),
              list(linear_rgb("linear_below", **NO_WHITE)))
for frames in full_below:
    error = refused("unsupported_picture", "merge", *frames, "-o", "full_below.exr",
                    says="no WhiteLevel tag, which means 65535, .* are all 15871")
    assert error["subject"].endswith(("_1.dng", "_2.dng")), error
# Not what is merely bright: no sample of this bracket is full.
dim = [frames[0] for frames in full_below]
for name in dim:
    answer("inspect", name, "--rect", "4,4,8,8")


def two_illuminants(cool_first):
    warm = CAMERA * (1 + 0.08 * (np.arange(9).reshape(3, 3) % 4))
    pair = [(CAMERA, 21), (warm, 17)] if cool_first else [(warm, 17), (CAMERA, 21)]
    return colors()[2:] + [entry(50721, "r", *pair[0][0].ravel()), entry(50778, "S", pair[0][1]),
                           entry(50722, "r", *pair[1][0].ravel()), entry(50779, "S", pair[1][1])]


# The order in which a file names its two lights changes nothing.
said = [expect_the_luminances(f"dual_{first}", bayer_of(f"dual_{first}",
                                                        two_illuminants(first) + BLACK_TAG))
        for first in (True, False)]
assert said[0]["scale"] == said[1]["scale"]

# Black levels: by place of the filter, by place of a larger one, by row, by column, by both.
two = np.array([[400, 520], [560, 640]])
expect_the_luminances("black_2x2", bayer_of(
    "black_2x2", colors() + [entry(50713, "S", 2, 2), entry(50714, "L", *two.ravel().tolist())],
    black=np.tile(two, (HEIGHT // 2, WIDTH // 2))))
six = 500 + np.arange(36).reshape(6, 6)
expect_the_luminances("black_6x6", bracket(
    "black_6x6", mosaic(XTRANS, CAMERA),
    cfa(XTRANS) + colors() + [entry(50713, "S", 6, 6), entry(50714, "L", *six.ravel().tolist())],
    black=np.tile(six, (HEIGHT // 6, WIDTH // 6))))
ROWS = np.round(40 * np.sin(np.arange(HEIGHT) * 0.7) + 7, 1)
COLUMNS = np.round(30 * np.cos(np.arange(WIDTH) * 0.5) - 4, 1)
BY_ROW, BY_COLUMN = entry(50716, "r", *ROWS), entry(50715, "r", *COLUMNS)
for stem, tags, black in (("row", [BY_ROW], BLACK + ROWS[:, None] + 0 * COLUMNS),
                          ("column", [BY_COLUMN], BLACK + 0 * ROWS[:, None] + COLUMNS),
                          ("both", [BY_ROW, BY_COLUMN], BLACK + ROWS[:, None] + COLUMNS)):
    expect_the_luminances(f"black_by_{stem}",
                          bayer_of(f"black_by_{stem}", colors() + BLACK_TAG + tags, black=black))
short = bayer_of("short", colors() + BLACK_TAG + [entry(50716, "r", *ROWS[:-1])])
refused("unsupported_picture", "merge", *short, "-o", "short.exr", says="BlackLevelDelta")

# Four colours: named, never taken for three of them.
FOUR = np.vstack([CAMERA, [0.1, 0.9, 0.1]])
for name, pattern, planes in (("RGBE", [[0, 1], [3, 2]], (0, 1, 2, 3)),
                              ("GCMY", [[1, 3], [4, 5]], (1, 3, 4, 5))):
    place = np.array([[0, 1], [2, 3]]) if name == "GCMY" else np.array(pattern)
    frames = bracket(name, mosaic(place, FOUR), cfa(np.array(pattern)) + colors(FOUR) + BLACK_TAG +
                     [entry(50710, "B", *planes)])
    error = refused("unsupported_picture", "merge", *frames, "-o", name + ".exr",
                    says="other colours .* red, green and blue alone; convert it to a linear DNG")
    assert error["subject"].endswith(f"{name}_0.dng"), error

# Without a matrix the green pixels stand for luminance, and that is said.
plain = bayer_of("no_matrix", BLACK_TAG)
assert "no_colour_matrix" in {w["code"] for w in answer("merge", *plain, "-o", "plain.exr",
                                                        "--mains", "none").get("warnings", [])}
