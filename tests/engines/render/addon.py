# SPDX-License-Identifier: Apache-2.0
"""The Blender add-on as a person has it: exported, installed from its zip, linked, its file changed.
  addon.py LIGHTCAL"""
import ast
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest
import zipfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "static"))
import golden_lights

LIGHTCAL = sys.argv[1]
HERE = os.path.dirname(os.path.abspath(__file__))
LAMPS = golden_lights.LAMPS
SAMPLES = os.path.join(HERE, os.pardir, os.pardir, os.pardir, "sample_data")
XYZ = ((0.4123908, 0.3575843, 0.1804808), (0.2126390, 0.7151687, 0.0721923),
       (0.0193308, 0.1191948, 0.9505322))  # of linear sRGB, IEC 61966-2-1

# Facing each at 2 m on its axis; areas by their closed forms, a tube as the point Blender has for it.
def expected(lamp):
    if "lx" in lamp:
        return lamp["lx"]
    if lamp["kind"] == "disk":
        r2 = lamp["diameter"] ** 2 / 4
        return lamp["cd"] / (r2 + 4)
    if lamp["kind"] == "rect":
        a, b = lamp["width"] / 2, lamp["height"] / 2
        return 2 * lamp["cd"] / (4 * a * b) * (
            a / math.hypot(a, 2) * math.atan2(b, math.hypot(a, 2)) +
            b / math.hypot(b, 2) * math.atan2(a, math.hypot(b, 2)))
    return lamp["cd"] / 4


class Addon(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        here = cls.folder.name
        lamps = os.path.join(here, "set.json")
        with open(lamps, "w") as out:
            out.write(golden_lights.light_json(LAMPS))
        brighter = json.loads(golden_lights.light_json(LAMPS))
        for light in brighter["lights"]:
            for key in ("intensity_cd", "illuminance_lx"):
                if key in light:
                    light[key] = {k: 2 * v for k, v in light[key].items()}
        with open(os.path.join(here, "next.json"), "w") as out:
            json.dump(brighter, out)
        run = [LIGHTCAL, "export", lamps, "--to", "blender-addon", "-o", here]
        subprocess.run(run, check=True, capture_output=True)
        cls.archive = os.path.join(here, "lightcal-blender-addon.zip")
        with open(cls.archive, "rb") as first:
            before = first.read()
        subprocess.run(run, check=True, capture_output=True)  # its own file is replaced freely
        with open(cls.archive, "rb") as second:
            assert second.read() == before
        os.makedirs(os.path.join(here, "scripts", "addons"))
        subprocess.run([LIGHTCAL, "run", os.path.join(SAMPLES, "sessions", "dimmed_panels"), "--to",
                        "json", "-o", os.path.join(here, "dimmed")], check=True, capture_output=True)
        cls.dimmed = os.path.join(here, "dimmed", "light.json")
        answers = os.path.join(here, "answers.json")
        subprocess.run(["blender", "-b", "--factory-startup", "-P",
                        os.path.join(HERE, "addon_probe.py"), "--", cls.archive, lamps,
                        os.path.join(here, "next.json"), cls.dimmed, answers], check=True,
                       capture_output=True,
                       env=dict(os.environ, BLENDER_USER_SCRIPTS=os.path.join(here, "scripts")))
        with open(answers) as text:
            cls.seen = json.load(text)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_the_archive_is_an_addon_and_an_extension(self):
        with zipfile.ZipFile(self.archive) as archive:
            self.assertIsNone(archive.testzip())
            code = {n: archive.read(n).decode() for n in archive.namelist()}
        python = ["lightcal/%s.py" % name for name in (
            "__init__", "cards", "lamps", "laws", "panel", "pictures", "states")]
        self.assertEqual(sorted(code), sorted(python + ["lightcal/blender_manifest.toml"]))
        self.assertIn("bl_info = {", code["lightcal/__init__.py"])
        manifest = dict(re.findall(r'^(\w+) = "([^"]*)"', code["lightcal/blender_manifest.toml"], re.M))
        self.assertEqual((manifest["schema_version"], manifest["id"], manifest["type"]),
                         ("1.0.0", "lightcal", "add-on"))
        for name in python:
            ast.parse(code[name])
            flakes = subprocess.run([sys.executable, "-m", "pyflakes"], input=code[name],
                                    capture_output=True, text=True)
            if "No module named" not in flakes.stderr:
                self.assertEqual(flakes.returncode, 0, flakes.stdout)

    def test_lamps_are_placed_and_their_light_is_the_meters(self):
        first = self.seen["first"]
        self.assertEqual(set(first), set(LAMPS) - {"sky"})  # a dome is no lamp: the script sets it
        self.assertEqual(self.seen["linked"], ["FINISHED"])
        self.assertEqual(self.seen["again"], ["CANCELLED"])
        for name, lux in self.seen["lux"].items():
            self.assertAlmostEqual(lux / expected(LAMPS[name]), 1.0, delta=0.005, msg=name)
            if "at" in LAMPS[name]:
                for got, want in zip(first[name]["at"], LAMPS[name]["at"]):
                    self.assertAlmostEqual(got, want, delta=1e-5)
        self.assertEqual(first["key"]["interval"], "1000 cd (998 to 1002)")
        self.assertEqual(first["sun"]["interval"], "98000 lx (97800 to 98200)")

    def test_a_changed_file_is_taken_and_edits_stay(self):
        seen = self.seen
        self.assertFalse(seen["quiet"])
        edited = sorted(seen["first"])[0]
        self.assertFalse(seen["torn"])
        self.assertIn("no JSON yet", seen["torn_message"])
        self.assertTrue(seen["taken"])
        for name, lamp in seen["second"].items():
            self.assertEqual(seen["while_torn"][name]["energy"], seen["first"][name]["energy"])
            if name != "luminaire":  # its candela stand in its table
                self.assertAlmostEqual(lamp["energy"] / seen["first"][name]["energy"], 2.0, delta=1e-5)
        self.assertEqual(seen["second"][edited]["object"], "my own name")
        self.assertEqual(seen["second"][edited]["at"], [7.0, 8.0, 9.0])
        self.assertIn("is gone", seen["gone"])
        self.assertEqual(seen["after_gone"], 8)

    def test_exposure_folders_and_a_clean_end(self):
        seen = self.seen
        self.assertAlmostEqual(seen["exposure"], math.log2(math.pi / 250 * 683), delta=1e-5)
        self.assertAlmostEqual(seen["exposure_kept"], seen["exposure"], delta=1e-6)
        self.assertEqual(seen["links"], ["set.json", "b.json"])
        self.assertEqual(seen["unlinked"], [1, 0, 8])  # the file's lamps stay in the scene
        self.assertTrue(seen["timer"])
        self.assertFalse(seen["timer_after"] or seen["state_after"] or seen["folder_after"])
        self.assertEqual(seen["classes_after"], seen["classes_before"])


    def test_a_folder_is_a_list_with_pictures_and_one_is_placed(self):
        seen = self.seen
        self.assertEqual(seen["folder"], ["FINISHED"])
        self.assertEqual(len(seen["listed"]), 2 * len(LAMPS))
        self.assertIn(["b.json", "key", "2000 cd (1996 to 2004)"], seen["listed"])
        self.assertEqual(seen["only_listed"], 8)  # the first file's
        self.assertEqual(seen["placed"], ["FINISHED"])
        self.assertEqual(seen["placed_lamp"], ["key", [1.0, 2.0, 3.0]])
        self.assertEqual(seen["thumbnail"][0], [64, 64])
        self.assertGreater(seen["thumbnail"][1], 1.1)  # alpha alone is 1
        self.assertIn("choose a grey card", seen["refused"][0])

    def test_sliders_give_what_lightcal_state_gives(self):
        states = self.seen["states"]
        self.assertEqual(self.seen["slider"], [18.0, 100.0, 100.0])

        def lux_and_xy(look):
            xyz = [sum(m * c for m, c in zip(row, look["color"])) for row in XYZ]
            return look["energy"] * 683 * xyz[1], [xyz[0] / sum(xyz), xyz[1] / sum(xyz)]

        for name, light, at in (("module 60", "module", "dimmer=60"),
                                ("module 25", "module", "dimmer=25"),
                                ("frame 11", "module", "dimmer=40"),
                                ("frame 1", "module", "dimmer=100"),
                                ("panel 40 4700", "panel", "dimmer=40,cct_K=4700")):
            told = json.loads(subprocess.run(
                [LIGHTCAL, "state", self.dimmed, "--light", light, "--at", at, "--json"], check=True,
                capture_output=True, text=True).stdout)
            lux, xy = lux_and_xy(states[name])
            self.assertAlmostEqual(lux / told["illuminance_lx"]["value"], 1.0, delta=2e-4, msg=name)
            for got, want in zip(xy, told["xy"]):
                self.assertAlmostEqual(got, want, delta=5e-4, msg=name)
            ends = [float(end) for end in re.findall(r"\((\S+) to (\S+)\)",
                                                     states[name]["interval"])[0]]
            for end, key in zip(ends, ("low95", "high95")):
                self.assertAlmostEqual(end / told["illuminance_lx"][key], 1.0, delta=1e-3, msg=name)
        self.assertEqual(states["module 10"]["interval"], "dimmer was read from 18 to 100")
        self.assertEqual(states["module 10"]["energy"], states["module 25"]["energy"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
