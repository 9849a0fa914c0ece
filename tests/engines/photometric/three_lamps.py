#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What three.js makes of an exported lamp, by its own loader, light and texture laws, against the lamp's formula; and what the
export and `check` say of it.

    three_lamps.py LIGHTCAL THREE_MODULES
"""
import json
import pathlib
import re
import subprocess
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools"))
from built_command import HOME, answer, run  # noqa: E402

LUMA = np.array([.2126, .7152, .0722])


def built(path, *more):
    module = path.with_suffix(".mjs")
    module.write_text(path.read_text())
    return json.loads(subprocess.run(["node", HERE / "three_lamps.mjs", pathlib.Path(sys.argv[2]).resolve(), module, *more],
                                     capture_output=True, text=True, check=True).stdout)


def smoothstep(a, b, x):
    t = np.clip((x - a) / (b - a), 0, 1)
    return t * t * (3 - 2 * t)


def shown(lamp, degrees):
    """Of the candela on the axis, in a plane through it (WebGLRenderer's SpotLight; IESSpotLightNode of one row)."""
    a = np.radians(degrees)
    peak = lamp["intensity"] * LUMA @ lamp["color"]
    if lamp["ies"]:
        assert len(lamp["ies"]) == 1, "a law of versions: the C0 plane, or rolled by the shadow camera"
        return peak * np.interp(a / np.pi * 179, np.arange(180), lamp["ies"][0])
    cone = smoothstep(np.cos(lamp["angle"]), np.cos(lamp["angle"] * (1 - lamp["penumbra"])), np.cos(a))
    if lamp["map"]:
        n = lamp["map"]["size"]
        at = (np.tan(np.minimum(a, 1.5)) / np.tan(lamp["angle"]) + 1) / 2 * n - .5
        cone = cone * np.interp(at, np.arange(n), lamp["map"]["row"])
    return peak * cone


def a_stated_spot_is_within_what_is_declared():
    for inner, outer in ((15, 25), (19.8, 20), (5, 40), (20, 22), (70, 79.5), (85, 89.5), (60, 85)):
        name = f"spot{inner}_{outer}"
        done = json.loads(run("quick", "900lx@2m", "--kind", "spot", "--inner", inner, "--outer", outer, "--room", "dark",
                              "--to", "three", "-o", HOME / name, "--json").stdout)
        warning = "".join(w["message"] for w in done.get("warnings", []) if w["code"] == "cone_profile")
        declared = float(re.search(r"within ([\d.]+) % of the axial|$", warning)[1] or 0) / 100
        [lamp] = built(next((HOME / name).glob("*.three.js")))
        at = np.linspace(0, 90, 36001)
        rim = np.cos(np.radians(outer))
        axial = lamp["intensity"] * LUMA @ lamp["color"]
        truth = axial * np.clip((np.cos(np.radians(at)) - rim) / (np.cos(np.radians(inner)) - rim), 0, 1) ** 2
        off = np.abs(shown(lamp, at) - truth).max() / axial
        at_worst = at[np.abs(shown(lamp, at) - truth).argmax()]
        assert off < declared + .002, (name, off, at_worst, warning)


GAMMA, C = np.arange(0, 91, 5.0), np.arange(0, 361, 15.0)


def candela(g, c):
    return 1000 * np.cos(np.radians(g)) ** 2 * (1 + .7 * np.cos(np.radians(c)) * np.sin(np.radians(g)) ** .5)


def an_asymmetric_lamp_is_its_mean_and_says_so():
    rows = "\n".join(" ".join(f"{v:.5f}" for v in candela(GAMMA, c)) for c in C)
    (HOME / "lamp.ies").write_text(f"IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {len(GAMMA)} {len(C)} 1 2 0 0 0\n1 1 50\n"
                                   f"{' '.join(map(str, GAMMA))}\n{' '.join(map(str, C))}\n{rows}\n")
    probes = [(0, 0), (20, 0), (20, 180), (40, 0), (40, 90), (40, 180), (60, 180)]
    text = ('lightcal = 1\nname = "s"\n[room]\ndark = true\n[[light]]\nname = "lamp"\nkind = "photometric"\n'
            'position_m = [1, 2, 3]\naim = [0.6, 0, -0.8]\naxis = [0.8, 0, 0.6]\ndistribution = "lamp.ies"\n')
    aim, c0 = np.array([.6, 0, -.8]), np.array([.8, 0, .6])
    for g, c in probes:
        a, t = np.radians([g, c])
        # C90 = C0 x aim: C turns counterclockwise seen against the aim.
        w = np.cos(a) * aim + np.sin(a) * (np.cos(t) * c0 + np.sin(t) * np.cross(c0, aim))
        at = np.array([1, 2, 3]) + 2 * w
        text += (f"[[reading]]\nlight = \"lamp\"\nposition_m = {at.tolist()}\nnormal = {(-w).tolist()}\n"
                 f"illuminance_lx = {candela(g, c) / 4:.6g}\n")
    (HOME / "session.toml").write_text(text)
    run("run", "session.toml", "-o", "s", "--force")
    done = answer("export", next((HOME / "s").rglob("light.json")), "--to", "three", "-o", HOME / "t", "--force")
    [warning] = [w["message"] for w in done["warnings"] if w["code"] == "substituted"]
    declared = float(re.search(r"within ([\d.]+) % of the axial", warning)[1]) / 100
    mean = 1000 * np.cos(np.radians(GAMMA)) ** 2
    worst = np.abs(candela(GAMMA[None], C[:, None]) - mean).max() / 1000
    assert abs(declared - worst) < .01, (warning, worst)
    path = next((HOME / "t").glob("*.three.js"))
    for more in ((), ("webgl",)):
        [lamp] = built(path, *more)
        fine = np.arange(0, 79.0)
        got = shown(lamp, fine)
        want = 1000 * np.cos(np.radians(fine)) ** 2
        if not lamp["map"] and not lamp["ies"]:
            continue  # wider than three projects: its cone, declared in the file
        assert np.abs(got - want).max() < 4, (more, np.abs(got - want).max())
    # check's model: the mean at every reading.
    rows = json.loads(run("check", path, "--session", HOME / "session.toml", "--json", code=1).stdout)["readings"]
    for (g, c), row in zip(probes, rows):
        want = 250 * np.cos(np.radians(g)) ** 2
        assert abs(row["predicted_lx"] / want - 1) < .01, (g, c, row)


a_stated_spot_is_within_what_is_declared()
an_asymmetric_lamp_is_its_mean_and_says_so()
