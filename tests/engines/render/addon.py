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
        answers = os.path.join(here, "answers.json")
        subprocess.run(["blender", "-b", "--factory-startup", "-P",
                        os.path.join(HERE, "addon_probe.py"), "--", cls.archive, lamps,
                        os.path.join(here, "next.json"), answers], check=True,
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
        self.assertEqual(sorted(code), ["lightcal/__init__.py", "lightcal/blender_manifest.toml",
                                        "lightcal/laws.py"])
        self.assertIn("bl_info = {", code["lightcal/__init__.py"])
        manifest = dict(re.findall(r'^(\w+) = "([^"]*)"', code["lightcal/blender_manifest.toml"], re.M))
        self.assertEqual((manifest["schema_version"], manifest["id"], manifest["type"]),
                         ("1.0.0", "lightcal", "add-on"))
        for name in ("lightcal/__init__.py", "lightcal/laws.py"):
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
        self.assertEqual(seen["unlinked"], [1, 8, 16])  # both files' lamps stay in the scene
        self.assertTrue(seen["timer"])
        self.assertFalse(seen["timer_after"] or seen["state_after"] or seen["folder_after"])
        self.assertEqual(seen["classes_after"], seen["classes_before"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
