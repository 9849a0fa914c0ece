# SPDX-License-Identifier: Apache-2.0
"""What `engine learn` finds in pictures of renderers that misread, noise of 1 % in every pixel, and
whether the export through what it found renders right in them.
  learn.py LIGHTCAL"""
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
PI = math.pi
XY = {"xy": golden_lights.KELVIN_2700}
KINDS = {  # all in the colour of 2700 K, whose luminance is .517
    "point": dict(kind="point", cd=900.0, at=(1.0, 2.0, 3.0), **XY),
    "spot": dict(kind="spot", cd=4000.0, at=(0.0, -1.0, 2.0), aim=(0.6, 0.64, -0.48), inner=15.0,
                 outer=25.0, **XY),
    "sun": dict(kind="directional", lx=9000.0, aim=(0.0, 0.6, -0.8), **XY),
    "sphere": dict(kind="sphere", cd=50.0, at=(2.0, -1.0, 1.5), diameter=0.1, **XY),
    "disk": dict(kind="disk", cd=60.0, at=(0.0, 1.0, 2.5), aim=(0.0, 0.0, -1.0), diameter=0.1, **XY),
    "rect": dict(kind="rect", cd=900.0, at=(-1.0, 0.5, 2.0), aim=(0.8, 0.0, -0.6), width=0.2,
                 height=0.1, **XY),
    "dome": dict(kind="dome", lx=1000.0 * PI, **XY),
}
TYPE = {"point": "SphereLight", "spot": "SphereLight", "sphere": "SphereLight", "sun": "DistantLight",
        "disk": "DiskLight", "rect": "RectLight", "dome": "DomeLight"}
Y = 0.5165  # of 2700 K, within .2 %
CONE = (1 - math.cos(math.radians(25))) / (1 - math.cos(math.radians(50)))

# (kind, misreading, factor, cause)
INJECTED = [
    ("point", dict(), 1.0, "none"),
    ("sun", dict(factor=PI), PI, "times_pi"),
    ("sphere", dict(factor=4 * PI), 4 * PI, "lumens_as_candela"),
    ("disk", dict(factor=1 / PI), 1 / PI, "over_pi"),
    ("rect", dict(factor=683.0), 683.0, "times_683"),
    ("dome", dict(factor=1 / 683.0), 1 / 683.0, "over_683"),
    ("point", dict(y_of_color=True), 1 / Y, "luminance_divided_twice"),
    ("spot", dict(factor=Y), Y, "missing_luminance_division"),
    ("point", dict(metres_per_unit=0.01), 1e4, "centimetres"),
    ("sphere", dict(metres_per_unit=100.0), 1e-4, "centimetres"),
    ("rect", dict(factor=PI), PI, "times_pi"),
    ("dome", dict(factor=PI), PI, "times_pi"),
    ("disk", dict(factor=4.0), 4.0, "diameter_for_radius"),
    ("spot", dict(factor=CONE), CONE, "full_cone_for_half"),
    ("sun", dict(factor=1 / (4 * PI)), 1 / (4 * PI), "candela_as_lumens"),
    ("sun", dict(factor=683.0), 683.0, "times_683"),
]


class Learn(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.folder = self.holder.name
        self.kept = dict(golden_lights.LAMPS)
        golden_lights.LAMPS.update(KINDS)
        self.noise = np.random.default_rng(22)

    def tearDown(self):
        golden_lights.LAMPS.clear()
        golden_lights.LAMPS.update(self.kept)
        self.holder.cleanup()

    def path(self, name):
        return os.path.join(self.folder, name)

    def lightcal(self, *arguments, code=0):
        result = subprocess.run([LIGHTCAL, *arguments, "--json"], capture_output=True, text=True)
        self.assertEqual(result.returncode, code, result.stderr + result.stdout)
        return json.loads(result.stdout)

    def export(self, kind, *arguments):
        with open(self.path("lamp.json"), "w") as out:
            out.write(golden_lights.light_json([kind], distances=(2.0,)))
        self.lightcal("export", self.path("lamp.json"), "--to", "usd,json", "--rig", "-o",
                      self.folder, *arguments)
        return self.path("lamp.rig.usda")

    def picture(self, kind, misreading, name, half=False, exposed=True):
        wrong = dict(misreading)
        if "factor" in wrong:
            wrong["factor"] = {TYPE[kind]: wrong["factor"]}
        scene = usdlux.Scene(self.path("lamp.rig.usda"), None, Reader(**wrong))
        picture = scene.render(210, 140, samples=16, steps=3)
        if exposed:
            picture = picture * 2.0 ** scene.camera[0]["exposure"]
        picture = picture * (1 + 0.01 * self.noise.standard_normal(picture.shape))
        write = usdlux.write_png if name.endswith(".png") else usdlux.write_exr
        write(self.path(name), *([picture] if name.endswith(".png") else [picture, half]))
        return self.path(name)

    def ratio(self, kind, misreading):
        """Lux the cards show over the meter's."""
        verdict = self.lightcal("check", "--render", self.picture(kind, misreading, "again.exr"),
                                "--rig", self.path("lamp.preset.json"))
        return verdict["illuminance_lx"] / verdict["expected_lx"]

    def test_every_injected_misreading_comes_back_and_is_undone(self):
        for i, (kind, misreading, factor, cause) in enumerate(INJECTED):
            self.export(kind)
            picture = self.picture(kind, misreading, "a.exr", half=i % 2 == 1 and factor < 1000)
            found = self.lightcal("engine", "learn", self.path("lamp.preset.json"), picture,
                                  "--pixels", "exposed", "-o", self.path("mine.json"))
            learnt = found["kinds"][0]
            what = (kind, misreading)
            self.assertTrue(found["absolute"])
            self.assertEqual(learnt["cause"], cause, what)
            self.assertAlmostEqual(learnt["factor"] / factor, 1.0, delta=0.005, msg=what)
            self.export(kind, "--engine", self.path("mine.json"))
            self.assertAlmostEqual(self.ratio(kind, misreading), 1.0, delta=0.005, msg=what)

    def test_eight_bits_give_it_within_two_percent(self):
        for kind, misreading, factor, cause in INJECTED:
            if not 0.05 < factor < 2.6:
                continue  # beyond what eight bits hold of this colour at the rig's exposure
            self.export(kind)
            found = self.lightcal("engine", "learn", self.path("lamp.preset.json"),
                                  self.picture(kind, misreading, "a.png"))
            self.assertEqual(found["kinds"][0]["cause"], cause, (kind, misreading))
            self.assertAlmostEqual(found["kinds"][0]["factor"] / factor, 1.0, delta=0.02)
        self.export("sun")
        self.assertEqual(self.lightcal(
            "engine", "learn", self.path("lamp.preset.json"),
            self.picture("sun", dict(factor=683.0), "a.png"), code=3)["error"]["code"], "all_saturated")

    def test_of_unknown_scale_ratios_between_kinds_are_learnt_and_said(self):
        pairs = []
        for kind, misreading in (("point", dict(factor=2.3)), ("sun", dict(factor=2.3 * PI))):
            self.export(kind)
            os.rename(self.path("lamp.preset.json"), self.path(kind + ".preset.json"))
            pairs += [self.path(kind + ".preset.json"),
                      self.picture(kind, misreading, kind + ".exr", exposed=False)]
        self.assertEqual(self.lightcal("engine", "learn", *pairs[:2], code=3)["error"]["code"],
                         "scale_unknown")
        found = self.lightcal("engine", "learn", *pairs, "-o", self.path("mine.json"))
        self.assertFalse(found["absolute"])
        self.assertEqual([k["kind"] for k in found["kinds"]], ["point", "directional"])
        self.assertAlmostEqual(found["kinds"][1]["factor"] / PI, 1.0, delta=0.005)
        said = self.lightcal("export", self.path("lamp.json"), "--to", "usd", "--engine",
                             self.path("mine.json"), "-o", self.path("out"))
        self.assertIn("ratios_only", {w["code"] for w in said["warnings"]})

    def test_what_has_no_factor_is_refused(self):
        self.export("point")
        curved = usdlux.Scene(self.path("lamp.rig.usda")).render(210, 140, 16, 3)
        curved = curved * 2.0 ** math.log2(1 / max(curved.max(), 1e-9))
        usdlux.write_exr(self.path("a.exr"), curved / (curved + 1.0))
        for arguments, code, word in (
                ([self.path("lamp.preset.json"), self.path("a.exr"), "--pixels", "exposed"], 3,
                 "tone_mapped"),
                ([self.path("lamp.preset.json")], 2, "usage")):
            error = self.lightcal("engine", "learn", *arguments, code=code)["error"]
            self.assertIn(error["code"], (word, "wrong_usage"))
        with open(self.path("bad.json"), "w") as out:
            out.write('{"schema": "lightcal.engine/1", "kinds": [{"kind": "point", "factor": 0}]}')
        self.assertEqual(self.lightcal(
            "export", self.path("lamp.json"), "--to", "usd", "--engine", self.path("bad.json"), "-o",
            self.path("out"), code=3)["error"]["code"], "bad_engine")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
