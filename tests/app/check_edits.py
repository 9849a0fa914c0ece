#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`lightcal check PRESET --session`: what somebody did to one lamp of an exported file is named, and
what nobody did is not.

    check_edits.py LIGHTCAL_BINARY
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

LIGHTCAL = str(pathlib.Path(sys.argv.pop(1)).resolve())


def call(*arguments):
    return subprocess.run([LIGHTCAL, *map(str, arguments)], capture_output=True, text=True, check=False)


def light(name, keys, readings):
    return f'[[light]]\nname = "{name}"\n{keys}\n' + "".join(
        f'[[reading]]\nlight = "{name}"\nmeter = "m"\n{r}\n' for r in readings)


def falling(cd, more=""):
    """1/d^2, its colour read at 1 m."""
    return [f"distance_m = {d}\nilluminance_lx = {cd / d ** 2:.6g}\n{more if d == 1 else ''}"
            for d in (0.5, 1, 2)]


def session_text(lights):
    return ('lightcal = 1\n[room]\ndark = true\n[[meter]]\nname = "m"\nsigma_relative = 0.005\n'
            'repeatability_relative = 0.001\n' + "\n".join(lights))


MANY = [light(f"l{i:02d}", 'kind = "point"', falling(50.0 + i)) for i in range(30)]
SUN = light("sun", 'kind = "directional"\naim = [0.3, 0.4, -1]', ["illuminance_lx = 98000"])
RIG = [light("bulb", 'kind = "point"\nposition_m = [0, 0, 2]\naim = [0, 0, -1]',
             falling(47.0, "cct_K = 2700\nduv = 0")),
       light("fill", 'kind = "point"\nposition_m = [2, 0, 2]\naim = [0, 0, -1]',
             falling(120.0, "cct_K = 5600\nduv = 0")), SUN]


class Edited(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.at = pathlib.Path(cls.folder.name)
        cls.many = cls.session("many", MANY, "gltf")
        cls.rig = cls.session("rig", RIG, "gltf", "usd", "godot", "json", "ies")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def session(cls, name, lights, *targets):
        home = cls.at / name
        home.mkdir()
        (home / "session.toml").write_text(session_text(lights))
        lamps = home / f"{name}.json"
        for words in (("fit", home, "-o", lamps),
                      ("export", lamps, "--to", ",".join(targets), "-o", home / "out")):
            done = call(*words)
            assert done.returncode == 0, done.stderr
        return home

    def check(self, home, file, code=1):
        done = call("check", file, "--session", home, "--json")
        self.assertEqual(done.returncode, code, done.stdout[-600:] + done.stderr)
        answer = json.loads(done.stdout)
        return answer, answer.get("error", {}).get("message", "")

    def gltf(self, home, change):
        document = json.loads((home / "out" / f"{home.name}.gltf").read_text())
        change(document)
        edited = home / "edited.gltf"
        edited.write_text(json.dumps(document))
        return edited

    # ---- each lamp by itself ----

    def test_one_lamp_of_thirty(self):
        self.check(self.many, self.many / "out" / "many.gltf", 0)
        for factor in (0.75, 1.25):
            def change(document, factor=factor):
                definition = document["extensions"]["KHR_lights_punctual"]["lights"][7]
                self.assertEqual(definition["name"], "l07")
                definition["intensity"] *= factor
            answer, said = self.check(self.many, self.gltf(self.many, change))
            # 30 alike: the lamp's 25 % over the root of 30, which is within 5 %.
            self.assertAlmostEqual(answer["rms_relative"], 0.25 / math.sqrt(30), delta=2e-4)
            self.assertIn("of 30 lamps l07 25 %", said)
            off = [lamp for lamp in answer["lights"] if lamp["off"]]
            self.assertEqual([lamp["name"] for lamp in off], ["l07"])
            self.assertAlmostEqual(off[0]["rms_relative"], 0.25, delta=2e-3)
            self.assertEqual(len(answer["lights"]), 30)

    def test_a_turned_sun(self):
        """27 degrees from where the session has it: cos 27 of its light on a meter that faced it."""
        aim = [0.3, 0.4, -1.0]
        length = math.sqrt(sum(a * a for a in aim))
        across = [0.8, -0.6, 0.0]  # square to it
        turned = [math.cos(math.radians(27)) * a / length + math.sin(math.radians(27)) * c
                  for a, c in zip(aim, across)]
        to = (turned[0], turned[2], -turned[1])  # Y up
        # From (0, 0, -1) the shortest way: axis (0, 0, -1) x to, w = 1 + cos.
        q = [to[1], -to[0], 0.0, 1.0 - to[2]]
        size = math.sqrt(sum(v * v for v in q))

        def change(document):
            node = [n for n in document["nodes"] if n["name"] == "sun"][0]
            node["rotation"] = [v / size for v in q]
        answer, said = self.check(self.rig, self.gltf(self.rig, change))
        row = [r for r in answer["readings"] if r["light"] == "sun"][0]
        self.assertAlmostEqual(row["error"], math.cos(math.radians(27)) - 1, delta=1e-3)
        self.assertIn("sun 11 %", said)


if __name__ == "__main__":
    unittest.main()
