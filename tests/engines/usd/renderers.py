# SPDX-License-Identifier: Apache-2.0
"""What each variant of a .usda renders to: by the specification, and in renderers that misread as
is documented of them (lib/lightcal/presets/README.md, "USD as renderers mean it").
  renderers.py LIGHTCAL"""
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import golden_lights
import usdlux
from usdlux import Reader

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "render"))
import panorama  # noqa: E402

LIGHTCAL = sys.argv[1]
LAMPS = golden_lights.LAMPS
W = usdlux.WEIGHTS

# (the reader by its setting, as the README's table names it, the variants for it, lamps that the spec variant
# gets wrong in it)
MISREADINGS = [
    (dict(sun="karma"), ["karma"], ["sun"]),
    (dict(sun="ris"), ["karma"], ["sun"]),
    (dict(sun="lux"), ["arnold"], []),
    (dict(tubes_normalised=True), ["arnold"], ["tube"]),
    (dict(points=True), ["arnold"], []),
    (dict(sphere_area=True), ["arnold"], []),
    (dict(cone="arnold"), ["arnold"], []),
    (dict(domes_angular=True), ["arnold"], []),
    (dict(ies_cone=90.0), ["spec", "arnold"], []),
    (dict(ies_cone=180.0), ["spec", "arnold"], []),
    (dict(), ["rtx"], []),
    (dict(sun="lux_pi"), ["rtx_2024"], ["sun"]),
    (dict(area_in_metres=True), ["spec", "arnold", "rtx"], []),
    (dict(clips_colors=True), ["spec"], []),
]
README = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../lib/lightcal/presets/README.md")


def setting(wrong):
    return ", ".join(f"{key}={value}" for key, value in wrong.items()) or "the schema"


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
        for wrongly, variants, wrong in MISREADINGS:
            reader = Reader(**wrongly)
            for variant in variants:
                off = self.lux(variant, reader)
                for name in LAMPS:
                    self.assertLess(off[name], 0.01, (wrongly, variant, name))
            off = self.lux("spec", reader)
            for name in wrong:  # else the variant would be there for nothing
                self.assertGreater(off[name], 0.05, (wrongly, name))

    def test_every_row_of_the_readme_is_shown(self):
        with open(README, encoding="utf-8") as whole:
            table = whole.read().split("## USD as renderers mean it", 1)[1].split("\n| who |", 1)[1]
        rows = [line.strip("|").split("|") for line in table.split("\n\n")[0].splitlines()[2:]]
        self.assertGreater(len(rows), 15)
        known, named = {setting(wrongly) for wrongly, _, _ in MISREADINGS}, set()
        for row in rows:
            self.assertEqual(len(row), 5, row)
            shown = re.findall("`([^`]+)`", row[4])
            named.update(shown)
            if not shown:
                self.assertRegex(row[4], "no numbers|render gates", row)
        self.assertEqual(named, known)

    def test_a_measured_light_that_shines_up_is_not_cut(self):
        document = json.loads(golden_lights.light_json(["luminaire"]))
        table = document["lights"][0]["distribution"]
        table["candela"] = [2000.0 * (0.6 + 0.4 * math.cos(math.radians(a))) for a in table["vertical_deg"]]
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "up.json"), "w") as out:
                json.dump(document, out)
            subprocess.run([LIGHTCAL, "export", os.path.join(folder, "up.json"), "--to", "usd", "-o", folder],
                           check=True, capture_output=True)
            path = os.path.join(folder, "up.usda")

            def above(variant, reader):  # 2 m over the lamp, facing down
                light = usdlux.Scene(path, variant, reader).lights["luminaire"]
                place = np.array(LAMPS["luminaire"]["at"]) + np.array((0.0, 0.0, 2.0))
                return float(light.one(place, np.array((0.0, 0.0, -1.0)), 64) @ W)
            for degrees in (90.0, 180.0):
                for variant in ("spec", "arnold"):
                    self.assertAlmostEqual(above(variant, Reader(ies_cone=degrees)) / (400.0 / 4), 1, delta=0.01)
            with open(path) as whole:
                text = whole.read()
            self.assertIn("inputs:shaping:cone:angle = 180", text)
            with open(path, "w") as out:
                out.write(text.replace("float inputs:shaping:cone:angle = 180", ""))
            self.assertEqual(above("spec", Reader(ies_cone=90.0)), 0.0)  # what stating it is for

    def test_a_panorama_is_read_as_one(self):
        truth = panorama.irradiance()
        with tempfile.TemporaryDirectory() as folder:
            panorama.write_panorama(os.path.join(folder, "place.hdr"))
            up = panorama.luminance([a + b for a, b in zip(*truth["up"])])
            for words in (["dome", os.path.join(folder, "place.hdr"), "--lux", repr(up), "--clip", panorama.DRAWN,
                           "--extract", "1", "-o", folder], ["export", os.path.join(folder, "light.json"), "--to", "usd", "-o", folder]):
                subprocess.run([LIGHTCAL, *words], check=True, capture_output=True)
            path = os.path.join(folder, "light.usda")

            def worst():
                dome = next(light for light in usdlux.Scene(path, "arnold", Reader(domes_angular=True)).lights.values()
                            if light.kind == "DomeLight")
                return max(abs(panorama.luminance(dome.one(np.zeros(3), np.array(n, float), 64)) /
                               panorama.luminance(truth[way][0]) - 1) for way, n in panorama.WAYS.items())
            self.assertLess(worst(), 0.01)
            with open(path) as whole:
                text = whole.read()
            self.assertIn('inputs:texture:format = "latlong"', text)
            with open(path, "w") as out:
                out.write(text.replace('inputs:texture:format = "latlong"', 'inputs:texture:format = "automatic"'))
            self.assertGreater(worst(), 0.1)  # what stating it is for

    def test_areas_are_the_same_in_units_and_in_metres(self):
        with open(self.usd) as whole:
            text = whole.read()
        self.assertIn("metersPerUnit = 1\n", text)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "centimetres.usda")
            with open(path, "w") as out:
                out.write(text.replace("metersPerUnit = 1\n", "metersPerUnit = 0.01\n").replace(
                    "asset inputs:shaping:ies:file", "asset gone"))

            def nits(area_in_metres):
                light = usdlux.Scene(path, "arnold", Reader(area_in_metres=area_in_metres)).lights["tube"]
                return light.base(2 * math.pi * 0.013 * 1.2)[1]
            self.assertAlmostEqual(nits(True) / nits(False), 1e4, delta=1.0)  # what the 1 is for

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
