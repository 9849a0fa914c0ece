# SPDX-License-Identifier: Apache-2.0
"""`lightcal dome` of a sun that is cut off in a pixel or two: the lux reading holds light that the picture lacks, so
the scale is said to hold that, or, of a merge that wrote how much it clipped, the sun is what the reading leaves.
The world: a sky and a disc of half a degree by numpy, eight samples a pixel each way; no header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402
from plain_png import write_png  # noqa: E402
from usdlux import write_exr  # noqa: E402

H, FINE = 128, 8
PITCH = np.pi / H


def directions(rows):
    pitch = np.pi / rows
    azimuth, polar = np.meshgrid((np.arange(2 * rows) + 0.5) * pitch - np.pi, (np.arange(rows) + 0.5) * pitch)
    return np.stack([np.sin(polar) * np.sin(azimuth), np.sin(polar) * np.cos(azimuth), np.cos(polar)], -1)


WAY = directions(H)
OMEGA = np.sqrt(1 - WAY[..., 2] ** 2) * PITCH**2
SKY = np.where(WAY[..., 2] > 0, 4000 + 3000 * WAY[..., 2] + 500 * np.sin(9 * WAY[..., 0]) * np.cos(7 * WAY[..., 1]), 1500.0)
BLUE, WARM = np.array([0.8, 1.0, 1.4]), np.array([1.2, 1.0, 0.8])
Y709 = np.array([0.2126, 0.7152, 0.0722])


def sun_at(column, row, nits=1.2e9):
    """Luminance of a disc of .53 degrees whose middle lies there, in pixels."""
    azimuth, polar = column * PITCH - np.pi, row * PITCH
    sun = np.array([np.sin(polar) * np.sin(azimuth), np.sin(polar) * np.cos(azimuth), np.cos(polar)])
    disc = directions(H * FINE) @ sun > np.cos(np.radians(0.265))
    return nits * disc.reshape(H, FINE, 2 * H, FINE).mean((1, 3))


def up(luminance):
    return float((luminance * np.clip(WAY[..., 2], 0, None) * OMEGA).sum())


def scale_of(name, sun, clip, unit=7e-4, colours=True):
    """What the dome made of pixel values, beside the truth, and what it warned of."""
    pixels = SKY[..., None] * BLUE + sun[..., None] * WARM if colours else np.repeat((SKY + sun)[..., None], 3, -1)
    lux = up(pixels @ Y709)
    pixels = np.minimum(pixels * unit, clip)
    write_exr(HOME / f"{name}.exr", pixels)
    said = answer("dome", HOME / f"{name}.exr", "--lux", f"{lux:.6g}", "-o", HOME / name)
    scale = said["scale"]
    ends = [scale.get(end, scale["factor"] * (1 + sign * scale["u95_relative"])) * unit for end, sign in (("low95", -1), ("high95", 1))]
    return scale["factor"] * unit, ends, [w["code"] for w in said.get("warnings", [])]


for name, place, clip, colours in (("pixel", (100.5, 40.5), 90.0, True), ("two", (100.0, 40.5), 90.0, True),
                                   ("four", (100.0, 40.0), 200.0, True), ("end", (30.5, 30.5), 255.0, False)):
    factor, (low, high), warned = scale_of(name, sun_at(*place), clip, colours=colours)
    print(f"sun cut off in {name}: scale {factor:.2f} of the truth, {low:.2f} to {high:.2f}, {warned}")
    assert "maybe_clipped" in warned and low < 1 < high, (name, low, high, warned)
    # As it is the picture would be that bright; its sun has some of that.
    assert high > 1.5 and factor < high / 1.5, (name, factor, high)

factor, (low, high), warned = scale_of("whole", sun_at(100.5, 40.5), np.inf)
assert abs(factor - 1) < 0.01 and low > 0.89 and high < 1.11 and "maybe_clipped" not in warned, (factor, low, high, warned)

# A smooth glow is whole, in Radiance's eight bits of mantissa too, where two pixels share its top.
def write_radiance(path, pixels):
    most = pixels.max(-1)
    mantissa, exponent = np.frexp(most)
    rgbe = np.concatenate([pixels * (mantissa * 256 / np.maximum(most, 1e-30))[..., None], (exponent + 128)[..., None]], -1)
    path.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % pixels.shape[:2] + rgbe.astype(np.uint8).tobytes())


towards = np.array([0.4, 0.5, 0.7])
for width in (4.0, 8.0, 16.0):
    glow = 2000 * np.exp(-((np.degrees(np.arccos(np.clip(WAY @ towards / np.linalg.norm(towards), -1, 1))) / width) ** 2))
    pixels = (90 + glow)[..., None] * np.array([1.0, 0.9, 0.8])
    write_radiance(HOME / f"glow{width:g}.hdr", pixels)
    lux = up(pixels @ Y709)
    said = answer("dome", HOME / f"glow{width:g}.hdr", "--lux", f"{lux:.6g}", "-o", HOME / f"glow{width:g}")
    warned = [w["code"] for w in said.get("warnings", [])]
    print(f"a smooth glow of {width:g} degrees: scale {said['scale']['factor']:.3f} of the truth, {warned}")
    assert abs(said["scale"]["factor"] - 1) < 0.02 and "maybe_clipped" not in warned, said["scale"]

# A lamp whose middle lies on the border of two rows has two pixels alike, and hardly any just below where it is small;
# nor does a nearly white one of a single pixel end there, of whose channels eight bits make two alike.
def small_lamp(middle, width, colour):
    glow = 300 * np.exp(-0.5 * (((np.arange(2 * H) - middle[1]) / width) ** 2 + ((np.arange(H)[:, None] - middle[0]) / width) ** 2))
    return SKY[..., None] * BLUE / 6000 + glow[..., None] * np.array(colour)


for name, middle, width, colour in (("tie", (31.5, 170.2), 2.6, (1.0, 0.95, 0.8)),
                                    ("alike", (31.3, 170.2), 1.2, (1.0, 0.999, 0.8))):
    pixels = small_lamp(middle, width, colour)
    write_radiance(HOME / f"{name}.hdr", pixels)
    said = answer("dome", HOME / f"{name}.hdr", "--lux", f"{up(pixels @ Y709):.6g}", "-o", HOME / name)
    print(f"a lamp of {width} pixels, {name}: scale {said['scale']['factor']:.3f} of the truth")
    assert abs(said["scale"]["factor"] - 1) < 0.02, said["scale"]
    # Cut off at six tenths it is still found, white or in the camera's white.
    for end in (pixels.max() * 0.6, pixels.reshape(-1, 3).max(0) * 0.6):
        write_radiance(HOME / f"{name}.hdr", np.minimum(pixels, end))
        said = answer("dome", HOME / f"{name}.hdr", "--lux", f"{up(pixels @ Y709):.6g}", "-o", HOME / f"{name}cut")
        assert "maybe_clipped" in [w["code"] for w in said["warnings"]], (name, end)

# A merge knows what it clipped: of its picture, in cd/m2, the sun is what the reading leaves over the sky.
sun = sun_at(100.5, 40.5)
for i, time in enumerate((1.0, 4.0)):
    write_png(HOME / f"{i}.png", np.repeat(np.round(np.minimum((SKY + sun) * time * 2, 65535))[..., None], 3, -1).astype(np.uint16))
answer("merge", HOME / "0.png", HOME / "1.png", "-o", HOME / "merged.exr", "--response", "linear", "--exposures", "1,4",
       "--f-number", "8", "--iso", "100", "--mains", "none", "--anchor", f"60,30,4,4={SKY[30:34, 60:64].mean():.6g}",
       "--anchor-sigma", "1%")
said = answer("dome", HOME / "merged.exr", "--lux", f"{up(SKY + sun):.6g}", "-o", HOME / "merged")
light = said["lights"][0]
true_lx = up(sun) / np.cos(40.5 * PITCH)
print(f"a merge's clipped sun: {light['illuminance_lx']} of {true_lx:.0f} lx")
assert light["illuminance_lx"]["value"] and abs(light["illuminance_lx"]["value"] / true_lx - 1) < 0.05, (light, true_lx)
assert abs(said["scale"].get("factor", 1.0) - 1) < 0.01, said["scale"]
