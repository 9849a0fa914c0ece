#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What files for engines mean and what is said of them: colours in a space whose white is not D65,
spaces that an engine's file cannot be in, lights that are there, substitutes by their engine's name,
and every file that lightcal writes told by `validate`.

    engine_truths.py LIGHTCAL_BINARY
"""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

LIGHTCAL = str(pathlib.Path(sys.argv[1]).resolve())

# Linear Rec. 709 to ACEScg, Bradford: "Linear Rec.709 (sRGB)" of OpenColorIO's ACES configurations.
OCIO = ((0.6130974024, 0.3395231462, 0.0473794514), (0.0701937225, 0.9163538791, 0.0134523985),
        (0.0206155929, 0.1095697729, 0.8698146342))
XYZ_709 = ((0.4123907993, 0.3575843394, 0.1804807884), (0.2126390059, 0.7151686788, 0.0721923154),
           (0.0193308187, 0.1191947798, 0.9505321522))
FROM_XYZ = ((3.2409699419, -1.5373831776, -0.4986107603), (-0.9692436363, 1.8759675015, 0.0415550574),
            (0.0556300797, -0.2039769589, 1.0569715142))
# XYZ to ACEScg, nothing adapted: S-2014-004.
AP1 = ((1.6410233797, -0.3248032942, -0.2364246952), (-0.6636628587, 1.6153315917, 0.0167563477),
       (0.0117218943, -0.0082844420, 0.9883948585))
D65 = [0.3127, 0.3290]
COLORS = {"day": D65, "warm": [0.4500, 0.4080], "mint": [0.3000, 0.4500], "lilac": [0.2900, 0.2200]}

# cos^20: .366 of the axis at 18 degrees, where no cone of three.js that is right on the axis is.
BEAM = """lightcal = 1
[room]
dark = true
[[light]]
name = "beam"
kind = "spot"
beam_deg = 30
[[meter]]
name = "m"
sigma_relative = 0.02
""" + "".join(f"""[[reading]]
light = "beam"
meter = "m"
distance_m = {d}
off_axis_deg = {a}
illuminance_lx = {900 * math.cos(math.radians(a)) ** 20 / d ** 2}
""" for d, a in ((1, 0), (2, 0), (2, 18)))


def times(m, v):
    return [sum(a * b for a, b in zip(row, v)) for row in m]


def xyz(xy):
    x, y = xy
    return [x / y, 1.0, (1 - x - y) / y]


def peaked(v):
    return [max(0.0, c) / max(v) for c in v]


def uv(v):
    x, y, z = v
    return 4 * x / (x + 15 * y + 3 * z), 9 * y / (x + 15 * y + 3 * z)


def call(*arguments):
    return subprocess.run([LIGHTCAL, *arguments], capture_output=True, text=True)


def answer(*arguments):
    done = call(*arguments, "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


HEAD = 'lightcal = 1\n[room]\ndark = true\n[[meter]]\nname = "m"\nsigma_relative = 0.003\n'


def lamp(name, xy=None, kind="point", more="", readings=None):
    text = f'[[light]]\nname = "{name}"\nkind = "{kind}"\nposition_m = [0, 0, 2]\n{more}'
    for i, (d, lux, said) in enumerate(readings or [(d, 100 / d**2, "") for d in (1, 1.5, 2)]):
        text += (f'[[reading]]\nlight = "{name}"\nmeter = "m"\ndistance_m = {d}\n'
                 f"illuminance_lx = {lux}\n{said}")
        if xy and i == 0:
            text += f'xy = {list(xy)}\ncolor_source = "spectrometer"\n'
    return text


def panel_axis(d):
    """Of 800 cd, .6 x .3 m, on its axis: the sum over its face."""
    a, b = 0.3, 0.15
    p, q = math.hypot(a, d), math.hypot(b, d)
    nits = 800 / (4 * a * b)
    return 2 * nits * (a / p * math.atan(b / p) + b / q * math.atan(a / q))


class EngineTruths(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.at = pathlib.Path(cls.folder.name)
        cls.colors = cls.session("colors", *[lamp(n, xy) for n, xy in COLORS.items()])
        near = [(d, panel_axis(d), "") for d in (0.5, 0.7, 1.0, 2.0)]
        cls.kinds = cls.session(
            "kinds", lamp("bulb"), lamp("panel", kind="rect", more="size_m = [0.6, 0.3]\n"
                                        "aim = [0, 0, -1]\n", readings=near),
            lamp("beam", kind="spot", more="inner_deg = 15\nouter_deg = 30\naim = [0, 0, -1]\n"),
            lamp("globe", kind="sphere", more="diameter_m = 0.2\n"))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def session(cls, name, *lamps):
        folder = cls.at / name
        folder.mkdir()
        (folder / "session.toml").write_text(HEAD + "".join(lamps))
        answer("fit", str(folder), "-o", str(folder / f"{name}.json"))
        return str(folder)

    @staticmethod
    def fitted(session):
        return str(pathlib.Path(session) / (pathlib.Path(session).name + ".json"))

    def export(self, session, *options):
        out = self.at / f"out{len(list(self.at.iterdir()))}"
        return out, answer("export", self.fitted(session), "-o", str(out), *options).get("warnings", [])

    # ---- the space's white ----

    def test_acescg_holds_lights_as_opencolorio_holds_textures(self):
        out, _ = self.export(self.colors, "--to", "usd,blender,json", "--space", "acescg")
        usda = (out / "colors.usda").read_text()
        lights = {l["name"]: l for l in json.loads((out / "colors.preset.json").read_text())["lights"]}
        for name, xy in COLORS.items():
            wanted = peaked(times(OCIO, times(FROM_XYZ, xyz(xy))))
            prim = usda[usda.index(f'"{name}"'):]
            found = [float(t) for t in re.search(r"inputs:color = \((.*?)\)", prim).group(1).split(",")]
            for a, b in zip(found, wanted):
                self.assertAlmostEqual(a, b, delta=2e-4, msg=name)
            pipeline = lights[name]["color"]["pipeline_linear"]
            self.assertEqual(pipeline["white_xy"], D65)
        day = lights["day"]["color"]["pipeline_linear"]["max_normalised"]
        for c in (day.values() if isinstance(day, dict) else day):
            self.assertAlmostEqual(c, 1.0, delta=1e-6)
        for file in ("colors.usda", "colors.blender.py"):  # read in the space they are in
            checked = answer("check", str(out / file), "--session", self.colors)
            self.assertLess(checked["rms_relative"], 1e-3, file)

    def test_another_white_is_said(self):
        out, _ = self.export(self.colors, "--to", "usd", "--space", "acescg", "--white",
                             "0.32168,0.33767")
        usda = (out / "colors.usda").read_text()
        prim = usda[usda.index('"day"'):]
        found = [float(t) for t in re.search(r"inputs:color = \((.*?)\)", prim).group(1).split(",")]
        for a, b in zip(found, peaked(times(AP1, xyz(D65)))):  # the same XYZ
            self.assertAlmostEqual(a, b, delta=1e-4)

    def test_color_prints_both(self):
        rgb = answer("color", "0.3127,0.3290")["rgb"]
        for c in rgb["acescg_d65"]:
            self.assertAlmostEqual(c, 1.0, delta=1e-6)
        self.assertAlmostEqual(rgb["acescg"][2], 1.079, delta=1e-3)
        self.assertIn("OCIO", call("color", "0.3127,0.3290").stdout)

    def test_files_that_mean_rec_709_stay_in_it(self):
        plain, _ = self.export(self.colors, "--to", "gltf,three,filament")
        for space in ("acescg", "rec2020", "p3"):
            out, warnings = self.export(self.colors, "--to", "gltf,three,filament", "--space", space)
            said = {w["subject"] for w in warnings if w["code"] == "space_unsupported"}
            self.assertEqual(said, {"gltf", "three", "filament"})
            for file in ("colors.gltf", "colors.three.js", "colors.filament.json"):
                self.assertEqual((out / file).read_bytes(), (plain / file).read_bytes(), file)

    def test_a_clipped_colour_is_told_by_how_much(self):
        for xy, wider in ((0.10, 0.35), False), ((0.20, 0.70), True):
            session = self.session(f"gamut{xy[0]}", lamp("led", xy))
            _, warnings = self.export(session, "--to", "gltf")
            said = [w["message"] for w in warnings if w["code"] == "out_of_gamut"][0]
            left = times(XYZ_709, peaked(times(FROM_XYZ, xyz(xy))))
            far = math.dist(uv(xyz(xy)), uv(left))
            self.assertAlmostEqual(float(re.search(r"pale by ([\d.]+) in u'v'", said).group(1)), far,
                                   delta=0.02 * far)
            self.assertEqual("--space rec2020" in said, wider, said)

    # ---- lights that are there ----

    def test_a_light_that_is_there_keeps_no_cone(self):
        prims = self.at / "prims.csv"
        prims.write_text("lamp,object\n" + "".join(f"{n},/World/{n}\n" for n in
                                                   ("bulb", "panel", "beam", "globe")))
        out, _ = self.export(self.kinds, "--to", "usd", "--into", str(prims))
        text = (out / "kinds.usda").read_text()
        for name in ("bulb", "panel", "beam", "globe"):
            prim = text[text.index(f'over "{name}"'):]
            prim = prim[:prim.index("}")]
            self.assertIn("inputs:shaping:ies:file = None", prim, name)
            self.assertRegex(prim, r"inputs:shaping:focus = 0\n")
            angle = float(re.search(r"shaping:cone:angle = (\S+)", prim).group(1))
            softness = float(re.search(r"shaping:cone:softness = (\S+)", prim).group(1))
            if name == "beam":
                self.assertLess(angle, 40)
            else:
                self.assertEqual((angle, softness), (180, 0), name)
        verdict = answer("validate", str(out / "kinds.usda"))["files"][0]
        self.assertTrue(verdict["ok"] and verdict.get("checked", True), verdict)

    # ---- substitutes ----

    def test_a_substitute_is_said_by_its_engine(self):
        for targets in (["--to", "all"], ["--to", "gltf,godot,unreal"], ["--to", "gltf"], []):
            _, warnings = self.export(self.kinds, *targets)
            said = [w["message"] for w in warnings if w["code"] in ("substituted", "cone_profile")]
            self.assertTrue(said)
            for message in said:
                engines = message.split(": ")[0].split(", ")
                self.assertTrue(set(engines) <= {"gltf", "godot", "mitsuba", "pbrt", "unity", "unreal",
                                                 "usd", "blender", "three", "filament"}, message)

    def test_check_tells_what_an_engine_lacks_from_what_was_edited(self):
        out, _ = self.export(self.kinds, "--to", "gltf,filament,usd")
        for file in ("kinds.gltf", "kinds.filament.json"):
            done = call("check", str(out / file), "--session", self.kinds)
            self.assertEqual(done.returncode, 1)
            self.assertIn("nothing in it was edited", done.stderr)
            self.assertIn("panel is a flat source", done.stderr)
            self.assertRegex(done.stderr, r"Blender.*hold them within 5(\.0)? %")
            self.assertNotIn("undo", done.stderr)
        file = out / "kinds.gltf"
        file.write_text(re.sub(r'("intensity": )([\d.]+)', lambda m: f"{m[1]}{2 * float(m[2])}",
                               file.read_text()))
        self.assertIn("undo what was edited", call("check", str(file), "--session", self.kinds).stderr)

    def test_check_tells_a_cone_that_was_asked_for_from_an_edit(self):
        session, light, out = self.at / "beam.toml", self.at / "beam.json", self.at / "cone"
        session.write_text(BEAM)
        answer("fit", str(session), "-o", str(light))
        answer("export", str(light), "--to", "three", "--spots", "cone", "-o", str(out))
        done = call("check", str(out / "beam.three.js"), "--session", str(session))
        self.assertEqual(done.returncode, 1)
        self.assertIn("as exported with --spots cone, nothing in it was edited", done.stderr)
        self.assertRegex(done.stderr, r"Exported without it, it is [\d.]+ % off")
        self.assertNotIn("undo", done.stderr)

    # ---- files ----

    def test_validate_tells_every_file_that_lightcal_writes(self):
        out = self.at / "all"
        self.assertEqual(call("run", self.kinds, "-o", str(out)).returncode, 0)
        answer("export", self.fitted(self.kinds), "-o", str(out), "--rig")
        files = sorted(str(f) for f in out.iterdir())
        document = answer("validate", *files)
        verdicts = {pathlib.Path(f["file"]).name: f for f in document["files"]}
        for name, verdict in verdicts.items():
            self.assertTrue(verdict["ok"], verdict)
            self.assertIn("format", verdict)
        for name in ("kinds.gltf", "kinds.usda", "kinds.tscn", "kinds.rig.gltf", "light.json"):
            self.assertNotIn("checked", verdicts[name])
        for name in ("LightcalImporter.cs", "report.html", "kinds.filament.h", "kinds.mitsuba.xml",
                     "kinds.pbrt", "kinds.t3d", "kinds.unity.json", "kinds.unreal.py"):
            self.assertIs(verdicts[name]["checked"], False, name)
        self.assertIn("not_checked", {w["code"] for w in document["warnings"]})
        foreign = out / "notes.cs"
        foreign.write_text("// somebody's\n")
        self.assertEqual(call("validate", str(foreign)).returncode, 3)

    # ---- small ----

    def test_unreals_widest_cone_is_given_with_its_error(self):
        session = self.session("wide", lamp("flood", kind="spot", more="inner_deg = 85\n"
                                            "outer_deg = 89.5\naim = [0, 0, -1]\n"))
        _, warnings = self.export(session, "--to", "unreal")
        said = [w["message"] for w in warnings if w["code"] == "cone_clipped"][0]

        def fall(theta, inner, outer):
            i, o = math.cos(math.radians(inner)), math.cos(math.radians(outer))
            return min(1.0, max(0.0, (math.cos(math.radians(theta)) - o) / (i - o))) ** 2

        worst = max(abs(fall(t / 50, 85, 88.9) - fall(t / 50, 85, 89.5)) for t in range(4500))
        told = float(re.search(r"within ([\d.]+) % of the axial", said).group(1))
        self.assertAlmostEqual(told, 100 * worst, delta=0.2)

    def test_quick_takes_an_inner_angle_of_zero_and_names_its_options(self):
        spot = ("quick", "100lx@1m", "--kind", "spot", "--outer", "30")
        self.assertEqual(call(*spot, "--inner", "0").returncode, 0)
        for option, value in (("--inner", "-1"), ("--outer", "0")):
            done = call(*spot, f"{option}={value}")
            self.assertEqual(done.returncode, 2)
            self.assertIn(option, done.stderr)

    def test_a_plane_says_which_way_it_faces(self):
        for x, way in ((0.5, "-x"), (-0.5, "+x")):
            done = call("simulate", self.kinds, "--plane", f"x={x}", "--grid", "8")
            self.assertIn(f"facing {way}", done.stdout, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
