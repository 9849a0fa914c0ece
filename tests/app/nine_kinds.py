#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Seeded sessions of all nine kinds through the built `lightcal run`, against lamps integrated piece
by piece (tests/tools/lamp_worlds.py).

usage: nine_kinds.py LIGHTCAL [SEEDS]     of fewer than twenty only the files are judged

Every session's readings hold ambient light, noise, one gain of the meter and, where given by place,
tilt; no light from walls. Over all seeds each kind's intervals must hold the truth as often as 95 %
intervals do; presets and report are there, and no NaN in any file.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from lamp_worlds import Lamp, Meter, toml_block, unit  # noqa: E402

SEEDS = 20
REPEATABILITY, CALIBRATION = 0.01, 0.02
# Of 20 intervals of 95 % fewer than 16 hold the truth in one of 400 cases.
FEWEST = 16


class World:
    def __init__(self, seed, folder):
        self.random = np.random.default_rng(seed)
        self.folder = folder
        self.meter = Meter(self.random, REPEATABILITY, CALIBRATION)
        self.text = ('lightcal = 1\nname = "nine kinds"\n[room]\ndark = true\n'
                     + self.meter.toml("m"))
        self.readings = ""
        self.truth = {}

    def uniform(self, low, high):
        return self.random.uniform(low, high)

    def light(self, name, lamp, **said):
        keys = {"name": name, "kind": lamp.kind, **said}
        self.text += toml_block("light", keys)
        if lamp.kind in ("directional", "dome"):
            self.truth[name] = {"illuminance_lx": lamp.strength}
            return
        self.truth[name] = {"intensity_cd": lamp.strength, "flux_lm": lamp.flux()}
        if lamp.luminance() is not None:
            self.truth[name]["luminance_nits"] = lamp.luminance()

    def read(self, lux, **where):
        shown = {"meter": "m", "illuminance_lx": self.meter.read(lux)}
        self.readings += toml_block("reading", {**where, **shown})

    def on_axis(self, name, lamp, distances, ambient, nearest=0.0):
        """Facing the lamp on its aim, tilted by a known angle; `nearest` = where distances begin.
        The light really starts a little before or behind there."""
        offset = 0.05 * distances[0] * self.random.standard_normal()
        side = unit(np.cross(lamp.aim, [0.3, 0.9, 0.1]))
        for d in distances:
            tilt = np.radians(self.uniform(-20, 20))
            at = lamp.position + lamp.aim * (d + nearest + offset)
            normal = -lamp.aim * np.cos(tilt) + side * np.sin(tilt)
            self.read(lamp.lux(at, normal) + ambient, light=name, distance_m=d,
                      tilt_deg=np.degrees(tilt))
        if ambient:
            self.read(ambient, light=name, lamp="off")

    def at_places(self, name, lamp, places, ambient):
        for at in places:
            facing = unit(lamp.position - at) + 0.15 * self.random.standard_normal(3)
            self.read(lamp.lux(at, facing) + ambient, light=name, position_m=list(at),
                      normal=list(unit(facing)))
        if ambient:
            self.read(ambient, light=name, lamp="off")

    def write(self):
        path = pathlib.Path(self.folder) / "nine"
        path.mkdir(exist_ok=True)
        (path / "session.toml").write_text(self.text + self.readings, encoding="utf-8")
        return path


def ies(path, angles, candela):
    text = "IESNA:LM-63-2002\n[TEST] none\n[TESTLAB] none\n[ISSUEDATE] 2026\n[MANUFAC] none\nTILT=NONE\n"
    text += f"1 -1 1 {len(angles)} 1 1 2 0 0 0\n1 1 10\n"
    text += " ".join(f"{a:g}" for a in angles) + "\n0\n" + " ".join(f"{c:.6f}" for c in candela)
    path.write_text(text + "\n", encoding="ascii")


def build(world):
    u = world.uniform
    strength = float(np.exp(world.random.normal(6.5, 1.0)))
    down = [0, 0, -1]

    sun = Lamp("directional", u(60e3, 110e3))
    world.light("sun", sun)
    sky = 0.15 * sun.strength
    for _ in range(2):
        tilt = np.radians(u(0, 25))
        world.read(sun.strength * np.cos(tilt) + sky, light="sun", tilt_deg=np.degrees(tilt))
        world.read(sky, light="sun", shadow_card=True, tilt_deg=np.degrees(tilt))

    bulb = Lamp("point", strength)
    world.light("bulb", bulb)
    world.on_axis("bulb", bulb, [0.5, 1.0, 2.0, 4.0], 0.02 * strength)

    spot = Lamp("spot", 3 * strength, [0.2, -0.1, 2.5], [0.2, 0.1, -1], inner_deg=15, outer_deg=33)
    world.light("spot", spot, position_m=spot.position, aim=spot.aim)
    foot = spot.position + spot.aim * (2.5 / -spot.aim[2])
    rim = 2.5 * np.tan(np.radians(33))
    angles = [(r, 0.5 * np.pi * i + r) for r in (0.25, 0.55, 0.8) for i in range(4)]
    places = [foot + rim * r * np.array([np.cos(f), np.sin(f), 0]) for r, f in angles]
    world.at_places("spot", spot, places, 0.0)

    globe = Lamp("sphere", strength, diameter_m=0.4)
    world.light("globe", globe, diameter_m=0.4)
    world.on_axis("globe", globe, [0.3, 0.8, 2.0], 0.03 * strength, nearest=0.2)

    disk = Lamp("disk", 2 * strength, [0, 0, 2.2], [0, 0, -1], diameter_m=0.5)
    world.light("disk", disk, diameter_m=0.5, position_m=disk.position, aim=down)
    places = [np.array([u(-0.6, 0.6), u(-0.6, 0.6), u(0.2, 1.6)]) for _ in range(6)]
    world.at_places("disk", disk, places, 0.01 * strength)

    panel = Lamp("rect", 4 * strength, size_m=[0.6, 0.3])
    world.light("panel", panel, size_m=[0.6, 0.3])
    diagonal = float(np.hypot(0.6, 0.3))
    world.on_axis("panel", panel, [diagonal], 0.0)

    wide = Lamp("rect", 4 * strength, [1, 0, 2.4], down, size_m=[1.2, 0.3], axis=[0, 1, 0])
    world.light("wide", wide, size_m=[1.2, 0.3], position_m=wide.position, aim=down, axis=[0, 1, 0])
    places = [np.array([1 + u(-0.8, 0.8), u(-0.8, 0.8), u(0.4, 1.7)]) for _ in range(6)]
    world.at_places("wide", wide, places, 0.01 * strength)

    tube = Lamp("tube", strength, [0, 0, 2.5], down, length_m=1.2, radius_m=0.013, axis=[1, 0, 0])
    world.light("tube", tube, length_m=1.2, radius_m=0.013, position_m=tube.position,
                axis=[1, 0, 0])
    places = [np.array([u(-0.5, 0.5), u(-0.5, 0.5), u(0.2, 2.0)]) for _ in range(5)]
    world.at_places("tube", tube, places, 0.02 * strength)

    angles = np.arange(0, 91, 5.0)
    candela = 800 * np.cos(np.radians(angles)) ** 3
    session = pathlib.Path(world.folder) / "nine"
    session.mkdir(exist_ok=True)
    ies(session / "down.ies", angles, candela)
    cans = Lamp("photometric", strength, [0, 0, 2.6], down, table=(angles, candela))
    world.light("can", cans, position_m=cans.position, aim=down, distribution="down.ies")
    places = [np.array([u(-1, 1), u(-1, 1), u(0, 1)]) for _ in range(4)]
    world.at_places("can", cans, places, 0.02 * strength)

    dome = Lamp("dome", u(2e3, 2e4))
    world.light("sky", dome)
    world.read(dome.strength, light="sky")
    world.read(dome.strength, light="sky")

    three_by_on_off(world, strength)


def three_by_on_off(world, strength):
    """Key, fill and rim read at two marks: all on, and one at a time off."""
    lamps = {
        "key": Lamp("point", 2 * strength, [1.5, 1.0, 2.0]),
        "fill": Lamp("point", strength, [-1.8, 1.2, 1.8]),
        "rim": Lamp("point", 3 * strength, [0.3, 2.5, 2.4]),
    }
    for name, lamp in lamps.items():
        world.light(name, lamp, position_m=lamp.position)
    ambient = 0.1 * strength
    for mark in ([0, -0.5, 1.2], [0.2, 0.2, 1.0]):
        normal = unit([0, 1, 0.5])
        where = {"position_m": mark, "normal": list(normal)}
        of = {name: lamp.lux(mark, normal) for name, lamp in lamps.items()}
        world.read(sum(of.values()) + ambient, lit=list(of), **where)
        for off in of:
            others = [name for name in of if name != off]
            world.read(sum(of[n] for n in others) + ambient, lit=others, **where)


def main():
    lightcal = sys.argv[1]
    hits = {}
    seeds = int(sys.argv[2]) if sys.argv[2:3] and sys.argv[2].isdigit() else SEEDS
    for seed in range(seeds):
        with tempfile.TemporaryDirectory() as folder:
            world = World(seed, folder)
            build(world)
            session = world.write()
            out = pathlib.Path(folder) / "out"
            ran = subprocess.run([lightcal, "run", session, "-o", out, "--to", "gltf,json",
                                  "--json"], capture_output=True, text=True, check=False)
            if ran.returncode != 0:
                sys.exit(f"seed {seed}: exit {ran.returncode}\n{ran.stderr}\n{ran.stdout}")
            document = json.loads(ran.stdout)
            for name in ("light.json", "report.html", "nine.gltf", "nine.preset.json"):
                if "NaN" in (out / name).read_text(encoding="utf-8"):
                    sys.exit(f"seed {seed}: NaN in {name}")
            compare(world, document, hits, seed)
    worst = min(hits.values(), key=sum)
    total = sum(sum(h) for h in hits.values()) / sum(len(h) for h in hits.values())
    for (name, key), h in hits.items():
        print(f"{name:6} {key:15} {sum(h):3} of {len(h)}")
    print(f"all: {100 * total:.1f} %")
    if seeds >= SEEDS and (sum(worst) < FEWEST or total < 0.93):
        sys.exit("intervals hold the truth too seldom")


def compare(world, document, hits, seed):
    found = {light["name"]: light for light in document["lights"]}
    for name, truth in world.truth.items():
        for key, value in truth.items():
            if key not in found[name]:
                sys.exit(f"seed {seed}: {name} has no {key}: {found[name]}")
            u = found[name][key]
            low, high = u.get("low95", u["value"] - u["u95"]), u.get("high95", u["value"] + u["u95"])
            hits.setdefault((name, key), []).append(low <= value <= high)
            if "-v" in sys.argv:
                print(seed, name, key, value, u)


if __name__ == "__main__":
    main()
