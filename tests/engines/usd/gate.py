# SPDX-License-Identifier: Apache-2.0
"""tinyusdz 0.9.0-rc10 on a .usda with every kind of light, bare and with the rig.
  gate.py LIGHTCAL MODULES"""
import os
import subprocess
import sys
import tempfile
import unittest

import golden_lights

LIGHTCAL, MODULES = sys.argv[1:3]


def load(path):
    return subprocess.run(["node", os.path.join(os.path.dirname(os.path.abspath(__file__)),
                                                "load.mjs"), MODULES, path],
                          capture_output=True, text=True)


def export(folder, *arguments):
    lamps = os.path.join(folder, "set.json")
    with open(lamps, "w") as out:
        out.write(golden_lights.light_json(golden_lights.LAMPS))
    subprocess.run([LIGHTCAL, "export", lamps, "--to", "usd", "-o", folder, *arguments],
                   check=True, capture_output=True)
    return os.path.join(folder, "set.usda")


class TinyUsdz(unittest.TestCase):
    def test_it_loads_every_kind(self):
        for arguments in (["--bare"], []):
            with tempfile.TemporaryDirectory() as folder:
                result = load(export(folder, *arguments))
                self.assertEqual(result.returncode, 0, result.stderr)
                for prim in ("SphereLight", "DistantLight", "RectLight", "DiskLight",
                             "CylinderLight", "DomeLight", "ShapingAPI", "shaping:ies:file"):
                    self.assertIn(prim, result.stdout)
                self.assertEqual("rig_camera" in result.stdout, not arguments)

    def test_it_rejects_what_is_no_usd(self):
        with tempfile.TemporaryDirectory() as folder:
            path = export(folder, "--bare")
            with open(path) as whole:
                text = whole.read()
            for wrong, right in (('inputs:intensity = "bright"', "inputs:intensity = "),
                                 ("inputs:color = (1, 1", "inputs:color = (")):
                at = text.index(right)
                end = text.index("\n", at)
                with open(path, "w") as out:
                    out.write(text[:at] + wrong + text[end:])
                self.assertNotEqual(load(path).returncode, 0, wrong)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
