#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What goes with the number that is typed in stands where that is said: the colour with -v and in --json, as the engine's
own field takes it; the cone, Godot's attenuation, the power before Blender 4.0 and where the lamp stands beside it.

    what_goes_with_the_number.py LIGHTCAL
"""
import json
import math
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, run  # noqa: E402

LAMP = ("quick", "192lx@0.5m", "--cct", "2900K", "--room", "dark", "--fixture", "bulb")
assert not any(row.startswith("colour ") for row in run(*LAMP).stdout.splitlines())
text = run(*LAMP, "-v").stdout
line = next(row for row in text.splitlines() if row.startswith("colour "))
assert "Blender" in line, line
rgb = [float(number) for number in re.search(r"([\d.]+), ([\d.]+), ([\d.]+) \(linear\)", text).groups()]
document = answer(*LAMP)
(HOME / "q.json").write_text(json.dumps(document))
run("export", "q.json", "--to", "gltf")  # it reads as any light.json
gltf = next(row for row in document["type_in"] if row["engine"].startswith("glTF"))
assert ", ".join(f"{c:g}" for c in rgb) in gltf["note"], (rgb, gltf)
luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
assert abs(float(gltf["value"]) * luminance / document["lights"][0]["intensity_cd"]["value"] - 1) < 1e-3, gltf


def encoded(linear):
    """IEC 61966-2-1."""
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


def figures(*words):
    rows = answer(*words)["type_in"]
    return {row["engine"]: row for row in rows}, " ".join(run(*words).stdout.split())


# Unity's colour field is sRGB, glTF's factor is linear.
unity = re.search(r"Color ([\d.]+), ([\d.]+), ([\d.]+) \(sRGB\)", figures(*LAMP)[0]["Unity HDRP"]["note"])
assert unity, figures(*LAMP)[0]
for said, linear in zip(unity.groups(), rgb):
    assert abs(float(said) - encoded(linear)) < 2e-4, (unity.groups(), rgb)
assert re.search(r"Unity HDRP [\d., ]+\(sRGB\)", " ".join(text.split())), text

# A reflector whose light starts 30 cm behind the point measured from; a cone of 15 and 25 degrees.
SPOT = ("quick", "591.716lx@1m", "189.036lx@2m", "54.083lx@4m", "--fixture", "reflector", "--kind", "spot", "--inner", "15",
        "--outer", "25", "--room", "dark", "--to", "all")
rows, text = figures(*SPOT)
assert "stands 30 cm behind the point its distances were measured from" in text, text
for engine, cone in (("Unity HDRP", "Outer Angle 50°; Inner Angle 60 %"), ("Unreal Engine", "Inner Cone Angle 15°; Outer"),
                     ("glTF", f"outerConeAngle {math.radians(25):.4g} rad"), ("Godot", "Angle Attenuation 0.36"),
                     ("Blender", "Spot Size 46.58"), ("USD", "softness"), ("Mitsuba", "beam_width"), ("pbrt", "conedelta")):
    assert cone in rows[engine]["note"], (engine, rows[engine])
    assert "30 cm behind" in rows[engine]["note"], rows[engine]
assert "Unreal Inner Cone Angle 15°, Outer Cone Angle 25°" in text, text

# Godot's lights are born with Attenuation 1: 250 lx at 2 m would be 500.
rows, text = figures("quick", "250lx@2m", "--room", "dark", "--to", "godot")
assert re.search(r"Godot \d+ lm( \+ colour)? \+ Attenuation 2", text), text
assert "physical light units" in rows["Godot"]["note"], rows
assert "stands" not in rows["Godot"]["note"], rows

# An area light of P watts had P/4 on its axis before Blender 4.0, P/pi since.
rows, text = figures("quick", "1453lx@1m", "423.5lx@2m", "--kind", "rect", "--size", "120x30cm", "--room", "dark", "--to", "blender")
now, before = re.search(r"Blender ([\d.]+) W \(before Blender 4.0 ([\d.]+) W\)", text).groups()
assert abs(float(before) / float(now) * math.pi / 4 - 1) < 0.01, text

# A beam of a known angle is its .ies in Unreal, with a colour and without.
for color in ((), ("--cct", "5600K")):
    rows, text = figures("quick", "1920lx@2m", "--beam", "20", *color, "--to", "unreal")
    kelvin = r" \+ 5600 K" if color else ""
    assert re.search(r"Unreal [\d.]+ cd" + kelvin + r" \+ its \.ies", " ".join(text.split())), text
