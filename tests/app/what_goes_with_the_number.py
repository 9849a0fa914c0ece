#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The colour that goes with what is typed in stands where that is said: with -v, and in --json. Its luminance times
the intensity is the lamp's own.

    colours_to_type.py LIGHTCAL
"""
import json
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
