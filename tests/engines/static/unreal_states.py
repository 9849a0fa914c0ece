#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Lamps with controls in Unreal's script, run in the stand-in of its documented names: set_state at
five states against `lightcal state`, light within .5 %, colour within what 8 bits hold.

    unreal_states.py LIGHTCAL
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import unreal_stand_in as unreal
from seen import decoded, luminance

LIGHTCAL = str(pathlib.Path(sys.argv[1]).resolve())
PANELS = pathlib.Path(__file__).resolve().parents[3] / "sample_data/sessions/dimmed_panels/session.toml"
# Read; between two levels; between two colours, of a lamp in lux. Then a lamp in candela.
PANEL = [(100, 4000), (50, 4000), (37, 4000), (100, 3500), (100, 5000)]
LEVELS = [100, 80, 47, 20, 10]


def run(folder, *words, status=0):
    done = subprocess.run([LIGHTCAL, *map(str, words)], capture_output=True, text=True, cwd=folder,
                          check=False)
    assert done.returncode == status, f"{words}: {done.stderr}"
    return done.stdout


def exported(folder, stem):
    run(folder, "export", f"{stem}.json", "--to", "unreal", "-o", "out")
    scene = unreal.Scene()
    path = folder / f"out/{stem}.unreal.py"
    unreal.run_in(scene, path.read_text(encoding="utf-8"), str(path))
    assert not scene.errors + scene.warnings, scene.errors + scene.warnings
    name = "lightcal_" + stem
    assert any(f"py import {name}" in line for line in scene.log), scene.log
    return scene, sys.modules[name]


def seen(scene, label):
    light = next(a for a in scene.actors() if a.label == label).root
    color = light.held["light_color"]
    if light.held["use_temperature"]:
        return light.held["intensity"], None
    rgb = decoded([c / 255 for c in (color.r, color.g, color.b)])
    x, y, z = (sum(row[i] * rgb[i] for i in range(3)) for row in (
        (0.4123908, 0.3575843, 0.1804808), (0.2126390, 0.7151687, 0.0721923),
        (0.0193308, 0.1191948, 0.9505322)))
    return light.held["intensity"] * luminance(rgb), (x / (x + y + z), y / (x + y + z))


def held(told, key, scene, label):
    figure, xy = seen(scene, label)
    assert abs(figure / told[key]["value"] - 1) < 0.005, (told["state"], figure, told[key])
    if xy and "xy" in told:
        off = max(abs(a - b) for a, b in zip(xy, told["xy"]))
        assert off < 0.0015, (told["state"], xy, told["xy"])


def refused(call, text):
    try:
        call()
    except ValueError as error:
        assert text in str(error), error
        return
    raise AssertionError("not refused: " + text)


def lamp_in_candela(folder):
    text = ('lightcal = 1\n[room]\ndark = true\n[[light]]\nname = "key"\nkind = "point"\n'
            '[[meter]]\nname = "m"\nsigma_relative = 0.02\n')
    rows = [(1, 100), (2, 100), (4, 100)] + [(1, level) for level in (75, 50, 25, 10)]
    for distance, dimmer in rows:
        lux = 900 * (0.04 + 0.96 * dimmer / 100) ** 1.3 / distance**2
        text += (f'[[reading]]\nlight = "key"\nmeter = "m"\ndistance_m = {distance}\n'
                 f"illuminance_lx = {lux:.9g}\ncct_K = 3200\nduv = 0\n"
                 f"state = {{ dimmer = {dimmer} }}\n")
    (folder / "key").mkdir()
    (folder / "key/session.toml").write_text(text, encoding="utf-8")
    run(folder, "fit", "key", "-o", "key.json")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        run(folder, "fit", PANELS, "-o", "panels.json")
        scene, module = exported(folder, "panels")
        others = {a.label: seen(scene, a.label) for a in scene.actors() if a.label != "panel"}
        undone = len(scene.transactions)
        for dimmer, cct in PANEL:
            module.set_state("panel", dimmer=dimmer, cct=cct)
            told = json.loads(run(folder, "state", "panels.json", "--light", "panel", "--at",
                                  f"dimmer={dimmer},cct_K={cct}", "--json"))
            held(told, "illuminance_lx", scene, "panel")
        assert len(scene.transactions) == undone + len(PANEL), "each state is one undo"
        assert others == {label: seen(scene, label) for label in others}, "another lamp was turned"
        # What is not named stays as it was set.
        module.set_state("panel", dimmer=100, cct_K=3500)
        module.set_state("panel", dimmer=50)
        tags = [str(t) for t in next(a for a in scene.actors() if a.label == "panel").held["tags"]]
        assert "lightcal.state:cct_K=3500" in tags and "lightcal.state:dimmer=50" in tags, tags
        before = seen(scene, "panel")
        refused(lambda: module.set_state("panel", dimmer=1), "outside of what was read")
        refused(lambda: module.set_state("panel", hue=1), "has no control hue; it has dimmer, cct_K")
        refused(lambda: module.set_state("pannel", dimmer=50), "the level has panel (dimmer, cct_K)")
        assert seen(scene, "panel") == before, "a refusal sets nothing"

        lamp_in_candela(folder)
        scene, module = exported(folder, "key")
        for dimmer in LEVELS:
            module.set_state(dimmer=dimmer)
            told = json.loads(run(folder, "state", "key.json", "--at", f"dimmer={dimmer}", "--json"))
            held(told, "intensity_cd", scene, "key")
        # A lamp without controls offers none.
        text = (folder / "key/session.toml").read_text(encoding="utf-8")
        text = text[:text.index("[[reading]]")]
        (folder / "plain").mkdir()
        (folder / "plain/session.toml").write_text(
            text + '[[reading]]\nlight = "key"\nmeter = "m"\ndistance_m = 1\nilluminance_lx = 900\n',
            encoding="utf-8")
        run(folder, "fit", "plain", "-o", "plain.json")
        run(folder, "export", "plain.json", "--to", "unreal", "-o", "out")
        assert '"controls"' not in (folder / "out/plain.unreal.py").read_text().split("FOLDER")[0]


if __name__ == "__main__":
    main()
