# SPDX-License-Identifier: Apache-2.0
"""Pictures of codes whose response somebody states: a curve kept from one bracket reads single pictures
of the same camera, srgb and linear read what a program wrote, and a stated curve that the frames contradict
is named. The camera's curve is an S over a power, by numpy. Written without a header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused  # noqa: E402
from code_camera import srgb  # noqa: E402
from plain_exr import read_exr  # noqa: E402
from plain_png import write_png  # noqa: E402

SIDE, ACROSS, DOWN = 32, 8, 5
ELECTRONS, READ_NOISE = 30_000.0, 6.0


def s_curve(signal):
    """What a camera's own style makes of light: contrast in the middle, codes of 0 to 1."""
    code = signal ** (1 / 2.2)
    return np.clip(code + 0.06 * np.sin(2 * np.pi * (code - 0.5)), 0, 1)


def patches(rng, low, high):
    nits = rng.permutation(np.geomspace(low, high, ACROSS * DOWN)).reshape(DOWN, ACROSS)
    y, x = np.mgrid[:DOWN * SIDE, :ACROSS * SIDE]
    wave = 1 + 0.2 * np.sin(x / 5.0) * np.sin(y / 7.0)
    return np.repeat(np.repeat(nits, SIDE, 0), SIDE, 1) * wave


def shoot(name, light, time, curve, rng, top=255):
    electrons = rng.poisson(np.minimum(light * time * ELECTRONS / 1.2, 2 * ELECTRONS)).astype(float)
    signal = np.clip((electrons + rng.normal(0, READ_NOISE, light.shape)) / ELECTRONS, 0, 1)
    codes = np.round(top * curve(signal))
    path = HOME / f"{name}.png"
    write_png(path, np.repeat(codes[..., None], 3, -1).astype(np.uint16 if top > 255 else np.uint8))
    return path


def of_patches(picture):
    return picture.reshape(DOWN, SIDE, ACROSS, SIDE)[:, 6:-6, :, 6:-6].mean((1, 3))


def merged(files, times, name, *more):
    out = HOME / f"{name}.exr"
    said = answer("merge", *files, "-o", out, "--f-number", "8", "--iso", "100", "--mains", "none",
                  "--exposures", ",".join(map(repr, times)), "--sigma", HOME / f"{name}.sigma.exr", *more)
    return of_patches(read_exr(out)), of_patches(read_exr(HOME / f"{name}.sigma.exr")), said


def off_by(found, light):
    """The worst patch beside the scale that all of them share."""
    ratio = found / of_patches(light)
    return float(np.max(np.abs(ratio / np.median(ratio) - 1)))


random = np.random.default_rng(20261129)
TIMES = [4.0**i / 1024 for i in range(4)]
wide = patches(random, 0.25, 128)
bracket = [shoot(f"bracket{i}", wide, time, s_curve, random) for i, time in enumerate(TIMES)]
_, _, kept = merged(bracket, TIMES, "bracket", "--save-response", HOME / "style.csv")
assert kept["response"] == "recovered", kept

# One picture of another scene, over five stops, through the curve that was kept.
narrow = patches(random, 4, 100)
single = shoot("single", narrow, 1 / 100, s_curve, random)
refused("no_response", "merge", single, "-o", HOME / "none.exr", "--exposures", "1/100", "--f-number", "8", "--iso", "100",
        says="--response")
found, sigma, said = merged([single], [1 / 100], "single", "--response", HOME / "style.csv")
off = off_by(found, narrow)
print(f"one picture through the bracket's curve: worst patch {100 * off:.2f} %, sigma {100 * np.median(sigma / found):.1f} %")
assert said["response"] == "stated" and off < 0.03, (off, said)
assert np.all(sigma / found > 0.02), "a stated curve is known to 2 % at best"

# What programs write.
for word, curve, top in (("srgb", srgb, 255), ("srgb", srgb, 65535), ("linear", lambda s: s, 65535)):
    one = shoot(f"{word}{top}", narrow, 1 / 100, curve, random, top)
    found, _, _ = merged([one], [1 / 100], f"{word}{top}", "--response", word)
    off = off_by(found, narrow)
    print(f"one picture of {word} codes up to {top}: worst patch {100 * off:.2f} %")
    assert off < 0.02, (word, top, off)

# Frames that say otherwise.
_, _, said = merged(bracket, TIMES, "wrong", "--response", "srgb")
assert "response_disagrees" in [w["code"] for w in said["warnings"]], said
_, _, said = merged(bracket, TIMES, "right", "--response", HOME / "style.csv")
assert "response_disagrees" not in [w["code"] for w in said.get("warnings", [])], said

# A session's card by one picture, its scale by the ISO speed: E = pi L / reflectance.
TRUE_LUX, REFLECTANCE = 250.0, 0.5
card = np.full((DOWN * SIDE, ACROSS * SIDE), TRUE_LUX * REFLECTANCE / np.pi)
card[:, : 4 * SIDE] *= np.geomspace(0.05, 0.6, 4).repeat(SIDE)
levels = np.linspace(0, 1, 100_001)
level_118 = levels[np.searchsorted(s_curve(levels), 118 / 255)]  # of H = 10 lx s/ISO (ISO 12232, SOS)
nits_118 = 10 / 100 * 8**2 / (0.65 * (1 / 120))
shoot("card", card * level_118 / nits_118 * 1.2 * 120, 1 / 120, s_curve, random)
SESSION = HOME / "session.toml"
TEXT = f"""lightcal = 1
[room]
dark = true
[[light]]
name = "key"
kind = "point"
[[capture]]
light = "key"
frames = "card.png"
use = "card"
reflectance = {REFLECTANCE}
distance_m = 2.0
rect = [{5 * SIDE}, 40, {2 * SIDE}, 80]
exposure_s = [{1 / 120!r}]
f_number = 8
iso = 100
"""
SESSION.write_text(TEXT)
refused("no_response", "fit", SESSION, says="response in a")
SESSION.write_text(TEXT + 'response = "style.csv"\n')
intensity = answer("fit", SESSION, "-o", HOME / "light.json")["lights"][0]["intensity_cd"]
true_cd = TRUE_LUX * 2.0**2
print(f"a card by one picture: {intensity['value']:.0f} +- {intensity['u95']:.0f} cd of {true_cd:.0f}")
assert abs(intensity["value"] / true_cd - 1) < 0.2 and intensity["u95"] > 0.3 * true_cd, intensity
SESSION.write_text(TEXT + 'response = "card.png"\n')
refused("bad_response", "fit", SESSION)

# Tables that are none.
for text, says in (("code,signal\n0,0\n255,1\n254,2\n", "rise"), ("0,1\n1,2\n", "highest code"),
                   ("0,0,1\n", "code,red,green,blue"), ("0,0\n100,3\n255,2\n", "no lower signal"),
                   ("", "highest code"), ("0,0\n255,0\n", "above 0"), ("0,0\n255,nan\n", "no numbers")):
    (HOME / "bad.csv").write_text(text)
    refused("bad_response", "merge", single, "-o", HOME / "none.exr", "--exposures", "1/100", "--response",
            HOME / "bad.csv", says=says)
    assert not (HOME / "none.exr").exists()
refused("no_codes", "merge", HOME / "bracket.exr", "-o", HOME / "none.exr", "--exposures", "1/100", "--f-number", "8",
        "--iso", "100", "--response", "srgb", says="leave --response out")
