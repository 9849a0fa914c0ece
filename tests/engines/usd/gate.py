# SPDX-License-Identifier: Apache-2.0
"""tinyusdz 0.9.0-rc10 on a .usda with every kind of light, bare and with the rig.
  gate.py LIGHTCAL MODULES"""
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest

import golden_lights

LIGHTCAL, MODULES = sys.argv[1:3]
HERE = os.path.dirname(os.path.abspath(__file__))


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
    return os.path.join(folder, "set.rig.usda" if "--rig" in arguments else "set.usda")


class TinyUsdz(unittest.TestCase):
    def test_it_loads_every_kind(self):
        for arguments in ([], ["--bare"], ["--rig"]):
            with tempfile.TemporaryDirectory() as folder:
                result = load(export(folder, *arguments))
                self.assertEqual(result.returncode, 0, result.stderr)
                for prim in ("SphereLight", "DistantLight", "RectLight", "DiskLight",
                             "CylinderLight", "DomeLight", "ShapingAPI", "shaping:ies:file"):
                    self.assertIn(prim, result.stdout)
                self.assertEqual("rig_camera" in result.stdout, "--rig" in arguments)

    def test_it_finds_the_file_of_a_name_that_holds_an_at(self):
        with tempfile.TemporaryDirectory() as folder:
            lamps = os.path.join(folder, "key@@@hall.json")
            with open(lamps, "w") as out:
                out.write(golden_lights.light_json(golden_lights.LAMPS))
            subprocess.run([LIGHTCAL, "export", lamps, "--to", "usd", "-o", folder], check=True,
                           capture_output=True)
            scene = os.path.join(folder, "key@@@hall.usda")
            with open(scene) as layer:
                named = re.findall(r"shaping:ies:file = @@@(.*)@@@$", layer.read(), re.MULTILINE)
            # The specification's grammar; tinyusdz reads it, but drops the last two characters.
            self.assertEqual([name.replace("\\@@@", "@@@") for name in named],
                             ["./" + name for name in os.listdir(folder) if name.endswith(".ies")])
            self.assertEqual(load(scene).returncode, 0)

    def test_its_own_dump_of_the_layer_gives_the_same_residuals(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "session.toml"), "w") as out:
                out.write('lightcal = 1\nname = "two"\n[room]\ndark = true\n')
                for name, keys in (("key", 'kind = "spot"\ninner_deg = 15\nouter_deg = 25\n'),
                                   ("fill", 'kind = "rect"\nsize_m = [0.6, 0.3]\n')):
                    out.write('[[light]]\nname = "%s"\n%sposition_m = [1, 2, 3]\naim = [0, 0.6, -0.8]\n'
                              % (name, keys))
                    for d, lux in ((1.0, 1003.0), (2.0, 250.6), (3.0, 110.7)):
                        out.write('[[reading]]\nlight = "%s"\ndistance_m = %g\nilluminance_lx = %g\n'
                                  'cct_K = 2700\nduv = 0.001\n' % (name, d, lux))
            subprocess.run([LIGHTCAL, "run", folder, "-o", folder, "--to", "usd"], check=True,
                           capture_output=True)
            ours = [f for f in os.listdir(folder) if f.endswith(".usda")][0]
            with open(os.path.join(folder, "dump.usda"), "w") as out:
                out.write(load(os.path.join(folder, ours)).stdout)
            rows = [json.loads(subprocess.run(
                [LIGHTCAL, "check", os.path.join(folder, name), "--session", folder, "--json"],
                check=True, capture_output=True).stdout)["readings"] for name in (ours, "dump.usda")]
            self.assertEqual(len(rows[0]), 6)
            for a, b in zip(*rows):
                self.assertAlmostEqual(a["predicted_lx"] / b["predicted_lx"], 1.0, delta=1e-5)
                self.assertLess(abs(a["error"]), 0.05)

    def test_an_over_layer_composes_on_a_persons_stage(self):
        base = """#usda 1.0
def Xform "World"
{
  def Xform "Lamps"
  {
    def SphereLight "Key"
    {
      float inputs:intensity = 3
      color3f inputs:color = (1, 0, 0)
      float inputs:radius = 0.5
      token visibility = "inherited"
      double3 xformOp:translate = (7, 8, 9)
      uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def SphereLight "Other"
    {
      float inputs:intensity = 4
    }
  }
}
"""
        with tempfile.TemporaryDirectory() as folder:
            with open(folder + "/map.csv", "w") as out:
                out.write("lamp,object\nkey,/World/Lamps/Key\npanel,/World/Window\n")
            over = export(folder, "--into", folder + "/map.csv")
            with open(over) as layer:
                text = layer.read()
            self.assertNotIn("def ", text)
            self.assertNotIn("xformOp", text)
            with open(folder + "/base.usda", "w") as out:
                out.write(base)
            with open(folder + "/stage.usda", "w") as out:
                out.write("#usda 1.0\n(\n  metersPerUnit = 1\n  subLayers = [@./set.usda@, @./base.usda@]\n)\n")
            done = subprocess.run(["node", os.path.join(HERE, "compose.mjs"), MODULES, folder + "/stage.usda",
                                   over, folder + "/base.usda"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            lamps = {name: body for name, body in re.findall(
                r'"(Key|Other|Window)"[^{"]*\{([^}]*)\}', done.stdout)}
            key = dict(re.findall(r"(inputs:\w+|xformOp:translate|treatAsPoint|visibility) = (.*)", lamps["Key"]))
            y = sum(w * float(c) for w, c in zip((0.2126, 0.7152, 0.0722), key["inputs:color"].strip("()").split(",")))
            candela = float(key["inputs:intensity"]) * math.pi * float(key["inputs:radius"]) ** 2 * y
            self.assertAlmostEqual(candela / 1000.0, 1.0, delta=1e-4)
            self.assertEqual(key["xformOp:translate"], "(7.0, 8.0, 9.0)")
            self.assertEqual(key["visibility"], '"inherited"')
            self.assertEqual(lamps["Other"].split(), "float inputs:intensity = 4".split())
            self.assertIn("inputs:width = 0.6", lamps["Window"])

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
