# SPDX-License-Identifier: Apache-2.0
"""What each variant of a .usda renders to: by the specification, and in renderers that misread as
is documented of them (lib/lightcal/presets/README.md, "USD as renderers mean it").
  renderers.py LIGHTCAL"""
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import golden_lights
import usdlux
from usdlux import Reader

LIGHTCAL = sys.argv[1]
LAMPS = golden_lights.LAMPS
W = usdlux.WEIGHTS

# (misreading, the variant for it, the reader, lamps that the spec variant gets wrong in it)
MISREADINGS = [
    ("Karma: a normalised sun is lux over pi", "karma", Reader(sun="karma"), ["sun"]),
    ("RenderMan: a sun normalised relative to .53 degrees", "karma", Reader(sun="ris"), ["sun"]),
    ("Arnold: suns ignore normalize and angle", "arnold", Reader(sun="lux"), []),
    ("arnold-usd: tubes are always normalised", "arnold", Reader(tubes_normalised=True), ["tube"]),
    ("arnold-usd: a point leaves its radius out", "arnold", Reader(points=True), []),
    ("Arnold: spheres have an area of their own", "arnold", Reader(sphere_area=True), []),
    ("Arnold: a picture of no stated format is angular", "arnold", Reader(domes_angular=True), []),
    ("USD Composer 2024: suns pi brighter", "rtx_2024", Reader(sun="lux_pi"), ["sun"]),
    ("Unreal's importer: colours clip at 1", "spec", Reader(clips_colors=True), []),
]


def cards():
    """(lamp, place, normal, lux): facing it on its axis at 2 m, and the same turned by 40 degrees
    where the lamp's size leaves the cosine law."""
    for name, lamp in LAMPS.items():
        if "at" in lamp:
            aim = np.array(lamp.get("aim", (0.0, 0.0, -1.0)))
            if lamp["kind"] == "tube":
                aim = np.array((0.0, 0.0, -1.0))
            place, d = np.array(lamp["at"]) + 2.0 * aim, 2.0
            nits = lamp["cd"] / golden_lights.area(lamp) if lamp["kind"] in (
                "rect", "disk", "sphere", "tube") else None
            lux = lamp["cd"] / d ** 2
            if lamp["kind"] == "disk":
                r2 = lamp["diameter"] ** 2 / 4
                lux = math.pi * nits * r2 / (r2 + d * d)
            if lamp["kind"] == "rect":  # Lambert's formula for a corner, four times
                a, b = lamp["width"] / 2, lamp["height"] / 2
                lux = 2 * nits * (a / math.hypot(a, d) * math.atan2(b, math.hypot(a, d)) +
                                  b / math.hypot(b, d) * math.atan2(a, math.hypot(b, d)))
            if lamp["kind"] == "tube":  # of a thin one: 2 r L d^2 times the integral of 1/(d^2+x^2)^2
                h = lamp["length"] / 2
                lux = 2 * lamp["radius"] * nits * (h / (d * d + h * h) + math.atan2(h, d) / d)
            yield name, place, -aim, lux
            if lamp["kind"] in ("point", "spot", "sphere", "photometric"):
                across = np.cross(aim, (0.3, 0.9, 0.1))
                turned = (-aim * math.cos(math.radians(40)) +
                          across / np.linalg.norm(across) * math.sin(math.radians(40)))
                yield name, place, turned, lux * math.cos(math.radians(40))
        elif "aim" in lamp:
            aim = np.array(lamp["aim"])
            yield name, np.zeros(3), -aim, lamp["lx"]
        else:
            yield name, np.zeros(3), np.array((0.0, 0.6, 0.8)), lamp["lx"]


def export(folder, *arguments, names=LAMPS, distances=()):
    lamps = os.path.join(folder, "set.json")
    with open(lamps, "w") as out:
        out.write(golden_lights.light_json(names, distances))
    subprocess.run([LIGHTCAL, "export", lamps, "--to", "usd,json", "-o", folder, *arguments],
                   check=True, capture_output=True)
    return os.path.join(folder, "set.rig.usda" if "--rig" in arguments else "set.usda")


class Renderers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.usd = export(cls.folder.name, "--bare")

    def lux(self, variant, reader):
        scene = usdlux.Scene(self.usd, variant, reader)
        worst = {}
        for name, place, normal, lux in cards():
            light = scene.lights[name.replace(" ", "_")]
            off = abs(float(light.one(place, normal, 64) @ W) / lux - 1)
            worst[name] = max(worst.get(name, 0.0), off)
        return worst

    def test_the_specification_renders_every_lamp(self):
        for name, off in self.lux(None, Reader()).items():
            self.assertLess(off, 0.005, name)

    def test_every_documented_misreading_has_a_variant_that_is_right_in_it(self):
        for what, variant, reader, wrong in MISREADINGS:
            off = self.lux(variant, reader)
            for name in LAMPS:
                self.assertLess(off[name], 0.01, (what, name))
            off = self.lux("spec", reader)
            for name in wrong:  # else the variant would be there for nothing
                self.assertGreater(off[name], 0.05, (what, name))

    def test_points_said_to_be_points_would_be_wrong_in_arnold(self):
        with open(self.usd) as whole:
            text = whole.read()
        self.assertNotIn("treatAsPoint", text)
        with open(self.usd + ".usda", "w") as out:
            out.write(text.replace("float inputs:radius = 0.005",
                                   "float inputs:radius = 0.005\n    bool treatAsPoint = 1", 1))
        scene = usdlux.Scene(self.usd + ".usda", "arnold", Reader(points=True))
        lux = float(scene.lights["key"].one(np.array((1.0, 2.0, 1.0)), np.array((0.0, 0, 1)), 32) @ W)
        self.assertGreater(lux, 1000.0 * 250.0)

    def test_the_file_opens_with_the_variant_asked_for(self):
        for word in ("spec", "karma", "arnold", "rtx", "rtx_2024"):
            with tempfile.TemporaryDirectory() as folder:
                path = export(folder, *(["--bare"] if word == "spec" else
                                        ["--bare", "--renderer", word]))
                chosen = usdlux.load(path)[1]
                root = next(p for p, _ in chosen if p.name == "lightcal")
                self.assertEqual(root.meta["variants"], {"renderer": word})
                self.assertEqual(set(root.sets["renderer"]),
                                 {"spec", "karma", "arnold", "rtx", "rtx_2024"})
                for variant in root.sets["renderer"].values():
                    self.assertRegex(variant.meta["doc"], "documented|pictures of others")
                sun = next(p for p, _ in chosen if p.kind == "DistantLight").values
                self.assertEqual(sun["inputs:normalize"], 0.0 if word == "karma" else 1.0)
        with tempfile.TemporaryDirectory() as folder, self.assertRaises(
                subprocess.CalledProcessError) as refused:
            export(folder, "--renderer", "vray")
        self.assertEqual(refused.exception.returncode, 2)

    def test_its_cards_measure_right_in_every_variant(self):
        """The whole rig through its camera, in each one's own renderer, and check --render."""
        readers = {"spec": Reader(), "karma": Reader(sun="karma"), "rtx_2024": Reader(sun="lux_pi"),
                   "arnold": Reader(sun="lux", tubes_normalised=True, points=True)}
        for word, reader in readers.items():
            for lamp in ("sun", "tube", "green spot"):
                with tempfile.TemporaryDirectory() as folder:
                    path = export(folder, "--rig", "--renderer", word, names=[lamp], distances=[2.0])
                    scene = usdlux.Scene(path, None, reader)
                    picture = scene.render(150, 100) * 2.0 ** scene.camera[0]["exposure"]
                    usdlux.write_exr(os.path.join(folder, "a.exr"), picture)
                    verdict = json.loads(subprocess.run(
                        [LIGHTCAL, "check", "--render", os.path.join(folder, "a.exr"), "--rig",
                         os.path.join(folder, "set.rig.preset.json"), "--json"],
                        check=True, capture_output=True).stdout)
                    ratio = verdict["illuminance_lx"] / verdict["expected_lx"]
                    self.assertAlmostEqual(ratio, 1.0, delta=0.01 if lamp != "tube" else 0.02,
                                           msg=(word, lamp))
                    self.assertEqual(verdict["cause"]["code"], "none", (word, lamp))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
