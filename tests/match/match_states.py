#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`lightcal match` of fixtures by their own states, judged by numpy: brute force over every setting of
lamps whose truth is a closed form written here (two emitters in mired, a dimmer that does not end at
zero), and over `lightcal state` for the real panels of sample_data.

    match_states.py LIGHTCAL
"""
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/tools"))
import numpy as np  # noqa: E402
from built_command import HOME, answer, refused, run  # noqa: E402

PANELS = ROOT / "sample_data/sessions/dimmed_panels"
NEAR = 0.0005  # in u'v', what the search calls one colour


def uv(xyz):
    d = xyz[0] + 15 * xyz[1] + 3 * xyz[2]
    return np.array([4 * xyz[0] / d, 9 * xyz[1] / d])


def xyz_of(x, y, Y):
    return np.array([x / y, np.ones_like(x / y), (1 - x - y) / y]) * Y


# ---- the truth ----

def key(dimmer, cct):
    """Two emitters, 2700 K and 6500 K (a little green), mixed in mired by the label; 600 lx in full."""
    warm, cool = xyz_of(0.4599, 0.4106, 1.0), xyz_of(0.3135, 0.3337, 1.0)
    t = (1e6 / cct - 1e6 / 6500) / (1e6 / 2700 - 1e6 / 6500)
    level = 600 * (0.06 + 0.94 * dimmer / 100)
    return np.multiply.outer(warm, t * level) + np.multiply.outer(cool, (1 - t) * level)


def rim(dial):
    """One amber emitter with a dial 0 ... 10, linear; 250 lx in full."""
    return np.multiply.outer(xyz_of(0.545, 0.408, 1.0), 250 * (0.04 + 0.096 * dial))


def reading(light, xyz, state=""):
    x, y = xyz[0] / xyz.sum(), xyz[1] / xyz.sum()
    return (f'[[reading]]\nlight = "{light}"\nmeter = "m"\nilluminance_lx = {xyz[1]:.9g}\n'
            f'xy = [{x:.9g}, {y:.9g}]\ncolor_source = "spectrometer"\n'
            + (f"state = {{ {state} }}\n" if state else ""))


def session(name, target):
    text = "lightcal = 1\n[room]\ndark = true\n"
    for light in ("key", "rim", "target"):
        text += f'[[light]]\nname = "{light}"\nkind = "directional"\n'
    text += '[[meter]]\nname = "m"\nsigma_relative = 0.02\n'
    for dimmer in (100, 75, 50, 30, 15, 5):
        for cct in (2700, 3500, 4500, 5500, 6500):
            text += reading("key", key(dimmer, cct), f"dimmer = {dimmer}, cct_K = {cct}")
    for dial in (10, 8, 6, 4, 2, 0):
        text += reading("rim", rim(dial), f"dial = {dial}")
    text += reading("target", target)
    folder = HOME / name
    folder.mkdir()
    (folder / "session.toml").write_text(text)
    return name


def distance(xyz, target):
    return np.hypot(*(uv(xyz) - uv(target).reshape(2, *([1] * (np.ndim(xyz) - 1)))))


def a_setting_is_the_best_there_is():
    # Beside the emitters' line, so that nothing is exact.
    for n, target in enumerate((xyz_of(0.386, 0.389, 210.0), xyz_of(0.35, 0.361, 420.0))):
        found = answer("match", session(f"one{n}", target), "--light", "key", "--to", f"one{n}",
                       "--to-light", "target")["matches"]
        state = found[0]["state"]
        dimmers, ccts = np.meshgrid(np.linspace(5, 100, 381), np.arange(2700, 6501, 5.0))
        off = distance(key(dimmers, ccts), target)
        least = off.min()
        assert 0.001 < least < 0.015, least
        truth = key(state["dimmer"], state["cct_K"])
        assert distance(truth, target) < least + 3 * NEAR, (distance(truth, target), least)
        assert abs(truth[1] / target[1] - 1) < 0.01, truth
        # What it says of itself is the truth, within what it says.
        assert abs(found[0]["delta_uv"] - distance(truth, target)) < 3 * NEAR
        assert abs(found[0]["dimmer_stops"]) < 0.02 and found[0]["u95"]["dimmer_stops"] > 0.02
        assert found[0]["u95"]["delta_uv"] > 0 and found[0]["state_u95"]["dimmer"] > 0
        # And after it the nearest of those that were read.
        read = [(distance(key(d, c), target), d, c) for d in (100, 75, 50, 30, 15, 5)
                for c in (2700, 3500, 4500, 5500, 6500)]
        first = next(m for m in found[1:] if m["basis"] == "measured")["state"]
        assert distance(key(first["dimmer"], first["cct_K"]), target) < min(read)[0] + NEAR


def two_dimmers_and_a_colour_are_the_best_there_are():
    target = xyz_of(0.432, 0.399, 300.0)
    mix = answer("match", session("two", target), "--light", "rim", "--to", "two", "--to-light",
                 "target", "--with", "two", "--with-light", "key")
    dial = mix["settings"]["lamp"]["state"]["dial"]
    state = mix["settings"]["with"]["state"]
    dials = np.linspace(0, 10, 41)[:, None, None]
    dimmers = np.linspace(5, 100, 96)[None, :, None]
    ccts = np.arange(2700, 6501, 25.0)[None, None, :]
    whole = np.zeros((3, 41, 96, ccts.size))
    sums = rim(dials) + key(dimmers + 0 * dials + 0 * ccts, ccts + 0 * dials + 0 * dimmers) + whole
    least = distance(sums, target).min()
    truth = rim(dial) + key(state["dimmer"], state["cct_K"])
    assert distance(truth, target) < least + 3 * NEAR, (distance(truth, target), least)
    assert abs(truth[1] / target[1] - 1) < 0.015, truth
    assert abs(mix["mixed"]["delta_uv"] - distance(truth, target)) < 3 * NEAR


def real_panels_against_every_setting():
    target_uv = uv(xyz_of(0.4053066776856688, 0.3907172461816787, 1.0))  # 3500 K
    best = answer("match", PANELS, "--light", "panel", "--to", "3500K", "-o", "set.json")
    first = best["matches"][0]

    def off(dimmer, cct):
        at = answer("state", PANELS, "--light", "panel", "--at", f"dimmer={dimmer},cct_K={cct}")
        return np.hypot(*(uv(xyz_of(*map(np.array, at["xy"]), 1.0)) - target_uv)), at
    here, at = off(first["state"]["dimmer"], first["state"]["cct_K"])
    assert abs(here - first["delta_uv"]) < 1e-6
    assert abs(at["cct_K"]["value"] - first["cct_K"]) < 0.5
    others = [off(d, c)[0] for d in (100, 50, 12) for c in range(3000, 5501, 250)]
    assert here < min(others) + NEAR, (here, min(others))
    # The label's promise is 3500 K; what was read says otherwise.
    assert first["state"]["cct_K"] > 3700 and first["cct_K"] < 3500
    light = json.loads((HOME / "set.json").read_text())["lights"][0]
    assert light["state"] == first["state"] and abs(light["color"]["cct_K"]["value"] -
                                                    first["cct_K"]) < 0.5
    run("export", "set.json", "--to", "gltf,blender", "-o", "set")


def noise_of_colour_costs_no_light():
    # A linear panel whose colour the dimmer leaves; each CCT was read within 0.4 % (1 sigma). Every
    # colour between those read at dimmer 100 is had there, in full light.
    read = ((100, 4500, 1177.3, 3850),
            (100, 2700, 898.06, 2691),
            (100, 3500, 1076.3, 3128),
            (100, 6500, 906.19, 6447),
            (50, 2700, 458.21, 2706), (50, 3500, 541.39, 3147),
            (50, 4500, 590.25, 3889), (50, 6500, 450.32, 6529),
            (20, 2700, 182.94, 2690), (20, 3500, 217.54, 3135),
            (20, 4500, 236.97, 3843), (20, 6500, 184.68, 6443),
            (5, 2700, 45.63, 2686), (5, 3500, 56.668, 3153),
            (5, 4500, 60.989, 3872), (5, 6500, 46.681, 6490))
    text = 'lightcal = 1\n[room]\ndark = true\n[[light]]\nname = "p"\nkind = "directional"\n'
    text += '[[meter]]\nname = "m"\nsigma_relative = 0.025\n'
    for dimmer, label, lux, kelvin in read:
        text += ('[[reading]]\nlight = "p"\nmeter = "m"\ncolor_source = "colorimeter"\n'
                 f'illuminance_lx = {lux}\ncct_K = {kelvin}\n'
                 f'state = {{ dimmer = {dimmer}, cct_K = {label} }}\n')
    (HOME / "noisy").mkdir()
    (HOME / "noisy/session.toml").write_text(text)
    best = answer("match", "noisy", "--to", "3800K")["matches"][0]
    assert best["delta_uv"] < 2 * NEAR, best
    assert best["stops_lost"] < 0.1, best


def what_cannot_be_is_said():
    refused("unreachable", "match", PANELS, "--light", "m9", "--to", "3000K", says="nearest")
    refused("no_spectrum", "match", PANELS, "--light", "panel", "--to", "3500K", "--camera", "all")
    refused("outside_states", "match", PANELS, "--light", "panel", "--to", PANELS, "--to-light",
            "module", "--to-state", "dimmer=5")
    weak = answer("match", PANELS, "--light", "panel", "--to", PANELS, "--to-light", "module",
                  "--to-state", "dimmer=33")
    # Beside it 18,902 lx of the module: the panel gives at most 9,180.
    assert abs(weak["matches"][0]["dimmer_stops"] + np.log2(18902 / 9180)) < 0.05
    assert [w["code"] for w in weak["warnings"]] == ["lamp_too_weak"]
    refused("no_level", "match", PANELS, "--light", "panel", "--to", "4000K", "--with",
            "illuminant:A", says="unit")
    run("match", "3200K", "--to", "3200K", "--to-state", "dimmer=5", code=2)


if __name__ == "__main__":
    TESTS = [a_setting_is_the_best_there_is, two_dimmers_and_a_colour_are_the_best_there_are,
             real_panels_against_every_setting, noise_of_colour_costs_no_light,
             what_cannot_be_is_said]
    for test in TESTS:
        test()
    print(f"{len(TESTS)} tests")
