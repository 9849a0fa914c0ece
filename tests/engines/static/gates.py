# SPDX-License-Identifier: Apache-2.0
"""The static gates: lightcal exports the golden lamps, readers that share nothing with its writers
read them back, and each fault that people make is put into the files to see its gate fail.
  gates.py LIGHTCAL [unittest arguments]"""
import base64
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "render"))
import golden_lights
import image_based_schema
import jsonschema
import pictures
import read_gltf
import read_godot
import read_mitsuba
import read_pbrt
import read_scripts
import read_unity
import read_unreal
import read_usd
import seen
from seen import GateError, check_rig, compare, read_ies

LIGHTCAL = None
ALL = list(golden_lights.LAMPS)


class Export:
    """lightcal export into a folder of its own; files by name."""

    def __init__(self, target, names, *arguments, distances=()):
        self.folder = tempfile.TemporaryDirectory()
        self.path = self.folder.name
        lamps = os.path.join(self.path, "set.json")
        with open(lamps, "w") as out:
            out.write(golden_lights.light_json(names, distances))
        result = subprocess.run(
            [LIGHTCAL, "export", lamps, "--to", target, "-o", self.path, "--json", *arguments],
            capture_output=True, text=True)
        if result.returncode != 0:
            raise GateError(result.stderr + result.stdout)
        self.answer = json.loads(result.stdout)
        self.stem = "set.rig" if "--rig" in arguments else "set"
        self.warnings = self.answer.get("warnings", [])

    def text(self, name):
        with open(os.path.join(self.path, name), newline="") as f:
            return f.read()


def godot(export, change=lambda t: t):
    return read_godot.read(change(export.text(export.stem + ".tscn")))


def usd(export, change=lambda t: t):
    return read_usd.read(change(export.text(export.stem + ".usda")), export.path)


def mitsuba(export, change=lambda t: t):
    return read_mitsuba.read(change(export.text(export.stem + ".mitsuba.xml")))


def pbrt(export, change=lambda t: t):
    return read_pbrt.read(change(export.text(export.stem + ".pbrt")))


def unity(export, change=lambda t: t):
    return read_unity.read(change(export.text(export.stem + ".unity.json")))


def unreal(export, change=lambda t: t):
    return read_unreal.read_script(change(export.text(export.stem + ".unreal.py")),
                                   os.path.join(export.path, "set.unreal.py"))


def gltf(export, change=lambda t: t):
    return read_gltf.read(change(export.text(export.stem + ".gltf")))


def blender(export, change=lambda t: t):
    return read_scripts.blender(change(export.text(export.stem + ".blender.py")))


def three(export, change=lambda t: t):
    return read_scripts.three(change(export.text(export.stem + ".three.js")))


def filament(export, change=lambda t: t):
    return read_scripts.filament(change(export.text(export.stem + ".filament.json")))


READERS = {"gltf": gltf, "blender": blender, "three": three, "filament": filament, "godot": godot, "usd": usd, "mitsuba": mitsuba, "pbrt": pbrt, "unity": unity,
           "unreal": unreal}
PASTED = ["blender", "godot", "usd", "mitsuba", "pbrt", "unity", "unreal"]
# Godot's default tint is known to three digits; Unreal's square centimetre is 1e-4 at 1 m.
TOLERANCE = {"gltf": 1e-4, "blender": 1e-4, "three": 1e-4, "filament": 1e-4, "godot": 6e-4, "usd": 1e-4, "mitsuba": 1e-4, "pbrt": 1e-4, "unity": 1e-4,
             "unreal": 2e-4}


def times(pattern, factor):
    """Multiplies the number that group 2 of the pattern matches first."""
    def change(text):
        changed, count = re.subn(
            pattern, lambda m: m.group(1) + repr(float(m.group(2)) * factor), text, count=1,
            flags=re.S)
        assert count == 1, pattern
        return changed
    return change


class EveryKind(unittest.TestCase):
    """All nine kinds, bare: photometry, colour, place, aim, cones, sizes."""

    def check(self, target):
        export = Export(target, ALL, "--bare")
        lights, rig = READERS[target](export)
        self.assertIsNone(rig)
        compare(lights, ALL, TOLERANCE[target])
        return export

    def test_what_runs_here(self):
        for target, lacking in (("gltf", {"panel", "globe", "downlight", "tube", "luminaire", "sky"}),
                                ("blender", {"tube"}), ("three", {"globe", "downlight", "tube"}),
                                ("filament", {"panel", "globe", "downlight", "tube", "luminaire"})):
            with self.subTest(target):
                said = {w["subject"] for w in self.check(target).warnings
                        if w["code"] == "substituted"}
                self.assertEqual(said, lacking)

    def test_godot(self):
        export = self.check("godot")
        said = {w["subject"] for w in export.warnings if w["code"] == "substituted"}
        self.assertEqual(said, {"panel", "downlight", "tube", "luminaire"})
        self.assertIn("cone_profile", {w["code"] for w in export.warnings})

    def test_usd(self):
        export = self.check("usd")
        self.assertNotIn("substituted", {w["code"] for w in export.warnings})

    def test_mitsuba(self):
        said = {w["subject"] for w in self.check("mitsuba").warnings if w["code"] == "substituted"}
        self.assertEqual(said, {"luminaire"})

    def test_a_substitute_is_said_in_the_file_with_its_error(self):
        for target, name in (("godot", "set.tscn"), ("unity", "set.unity.json"),
                             ("mitsuba", "set.mitsuba.xml"), ("pbrt", "set.pbrt"),
                             ("gltf", "set.gltf"), ("filament", "set.filament.json")):
            export = Export(target, ["luminaire"], "--bare")
            said = [w["message"] for w in export.warnings if w["code"] == "substituted"]
            self.assertEqual(len(said), 1, target)
            engine, as_held = said[0].split(": ", 1)
            self.assertEqual(engine, target)
            self.assertIn(as_held, export.text(name))
            # cos^8, whose flux is 2 pi/9: cones come near, but a smoothstep cannot.
            worst, flux = map(float, re.search(r"within ([\d.]+) % .*flux ([\d.]+) %",
                                               said[0]).groups())
            self.assertLess(worst, 21.0 if target == "pbrt" else 7.0, target)
            self.assertLess(flux, 2.5, target)
        for target, name in (("godot", "set.tscn"), ("unity", "set.unity.json"),
                             ("unreal", "set.unreal.py")):
            export = Export(target, ["tube"], "--bare")
            said = [w["message"] for w in export.warnings if w["code"] == "substituted"]
            self.assertIn("flux 27 % high", said[0])
            self.assertIn(said[0].split(": ", 1)[1], export.text(name))

    def test_pbrt(self):
        export = self.check("pbrt")
        # Included in a scene whose Y is up: (x, y, z) stands at (x, z, -y) there.
        lights, _ = pbrt(export)
        turned, _ = pbrt(export, lambda t: f"AttributeBegin\nRotate -90 1 0 0\n{t}AttributeEnd\n")
        for name, light in lights.items():
            for was, now in ((light.at, turned[name].at), (light.aim, turned[name].aim)):
                if was is not None:
                    for a, b in zip((was[0], was[2], -was[1]), now):
                        self.assertAlmostEqual(a, b, 9, name)

    def test_unity(self):
        export = self.check("unity")
        lights, _ = read_unity.read(export.text("set.unity.json"), "urp")
        compare(lights, ALL, TOLERANCE["unity"])

    def test_unreal(self):
        export = self.check("unreal")
        self.assertIn("not executed", export.text("set.unreal.py").lower())
        # UE4 normalised profiles otherwise: the multiplier is divided out.
        lights, _ = read_unreal.read_script(export.text("set.unreal.py"),
                                            os.path.join(export.path, "set.unreal.py"), 0.25)
        compare(lights, ALL, TOLERANCE["unreal"])
        compare(read_unreal.read_t3d(export.text("set.t3d")), ALL, TOLERANCE["unreal"])

    def test_each_has_a_paste_line_that_names_its_folder(self):
        for target in PASTED:
            export = Export(target, ["key"])
            self.assertEqual(len(export.answer["paste"]), 1)
            self.assertTrue(export.answer["paste"][0].startswith(target + ": "))
            self.assertIn(export.path, export.answer["paste"][0])


class PhotometricGltf(unittest.TestCase):
    """EXT_lights_ies stands in a second scene, absolute: multiplier * Y(colour) = 1."""

    def test_it(self):
        export = Export("gltf", ["key", "luminaire"], "--bare")
        root = json.loads(export.text(export.stem + ".gltf"))
        first, second = root["scenes"]
        self.assertEqual(root["scene"], 0)
        in_first = [root["nodes"][i] for i in first["nodes"]]
        self.assertTrue(all("KHR_lights_punctual" in n["extensions"] for n in in_first))
        lamp = root["nodes"][second["nodes"][1]]
        ies = lamp["extensions"]["EXT_lights_ies"]
        y = sum(w * c for w, c in zip((0.2126, 0.7152, 0.0722), ies["color"]))
        self.assertAlmostEqual(ies["multiplier"] * y, 1.0, delta=1e-4)
        uri = root["extensions"]["EXT_lights_ies"]["lights"][ies["light"]]["uri"]
        self.assertAlmostEqual(read_ies(export.text(uri)), 2000.0, delta=0.01)
        # It aims straight down, C0 along +X: -90 degrees about X in glTF's axes.
        for got, expected in zip(lamp["rotation"], (-0.5 ** 0.5, 0, 0, 0.5 ** 0.5)):
            self.assertAlmostEqual(got, expected, delta=1e-9)
        self.assertEqual(lamp["translation"], [-2.0, 2.8, -1.0])


class ImageBasedGltf(unittest.TestCase):
    """A dome is EXT_lights_image_based in the last scene, and there alone: pi L of irradiance, L in
    the mirror images, up to 255 nits in the largest component."""
    WEIGHTS = (0.2126, 0.7152, 0.0722)

    def dome(self, nits):
        with unittest.mock.patch.dict(golden_lights.LAMPS["sky"], lx=nits * math.pi):
            export = Export("gltf", ["key", "sky"], "--bare")
        root = json.loads(export.text(export.stem + ".gltf"))
        first, last = root["scenes"]
        self.assertEqual(root["scene"], 0)
        names = [[root["nodes"][i]["name"] for i in s["nodes"]] for s in (first, last)]
        self.assertEqual(names, [["key", "sky"], ["key"]])
        self.assertNotIn("extensions", first)
        self.assertEqual(image_based_schema.check(root), 1)
        at = last["extensions"]["EXT_lights_image_based"]["light"]
        light = root["extensions"]["EXT_lights_image_based"]["lights"][at]
        self.assertEqual(light["intensity"], 1.0)
        constant, *rest = light["irradianceCoefficients"]
        self.assertEqual(rest, [[0.0, 0.0, 0.0]] * 8)
        (faces,) = light["specularImages"]
        self.assertEqual(faces, [0] * 6)
        path = os.path.join(export.path, "dome.png")
        with open(path, "wb") as f:
            f.write(base64.b64decode(root["images"][0]["uri"].split(",")[1]))
        width, height, rows, channels = pictures.read_png(path)
        self.assertEqual((width, height, channels), (light["specularImageSize"],) * 2 + (4,))
        pixels = {tuple(row[4 * x:4 * x + 4]) for row in rows for x in range(width)}
        self.assertEqual(len(pixels), 1)
        *rgb, d = pixels.pop()
        return constant, [pictures.decode(v) / (d / 255.0) for v in rgb]

    def test_it(self):
        luminance = lambda rgb: sum(w * v for w, v in zip(self.WEIGHTS, rgb))
        for nits in (0.6, 100.0, 1000.0):
            constant, radiance = self.dome(nits)
            self.assertAlmostEqual(luminance(constant) * 0.28209479177387814 / (nits * math.pi), 1.0,
                                   delta=1e-4)
            if nits < 255.0:
                self.assertAlmostEqual(luminance(radiance) / nits, 1.0, delta=8e-3)
            else:
                self.assertAlmostEqual(max(radiance), 255.0, delta=0.01)

    def test_the_schema_sees_faults(self):
        export = Export("gltf", ["key", "sky"], "--bare")
        spoil = {
            "eight coefficients": lambda light: light["irradianceCoefficients"].pop(),
            "five faces": lambda light: light["specularImages"][0].pop(),
            "no size": lambda light: light.pop("specularImageSize"),
            "another key": lambda light: light.update(color=[1, 1, 1]),
            "a turn below 0": lambda light: light.update(rotation=[0, -0.5, 0, 0.8]),
            "an image that is not there": lambda light: light["specularImages"][0].__setitem__(0, 99),
        }
        for name, change in spoil.items():
            root = json.loads(export.text(export.stem + ".gltf"))
            change(root["extensions"]["EXT_lights_image_based"]["lights"][0])
            with self.subTest(name), self.assertRaises((AssertionError, jsonschema.ValidationError)):
                image_based_schema.check(root)


class ExposedRig(unittest.TestCase):
    """The 18 % card shows as .18 +- 2 % from the file's own camera, cards and exposure."""

    def test_each(self):
        for target in READERS:
            with self.subTest(target):
                export = Export(target, ["key"], "--rig", distances=(0.5, 1.0, 2.0))
                for light in READERS[target](Export(target, ["key"])):
                    self.assertNotIsInstance(light, seen.Rig)
                lights, rig = READERS[target](export)
                # Unreal's square centimetre is given back over .5 to 2 m.
                compare(lights, ["key"], max(TOLERANCE[target], 3e-4))
                check_rig(lights, rig)


class Audit(unittest.TestCase):
    """preset.json's `derived` holds the very numbers of the files."""

    def test_numbers(self):
        derived = json.loads(Export("json", ALL).text("set.preset.json"))["lights"]
        by_name = {light["name"]: light["derived"] for light in derived}
        scene = dict((head["name"], values) for kind, head, values in
                     read_godot.sections(Export("godot", ALL).text("set.tscn")) if kind == "node")
        for field in ("light_intensity_lumens", "spot_attenuation", "spot_range", "spot_angle"):
            self.assertEqual(float(scene["green spot"][field]), by_name["green spot"]["godot"][field])
        for target in READERS:
            for name in ALL:
                self.assertIn("type", by_name[name][target], target)


class InjectedFaults(unittest.TestCase):
    """Each gate sees the fault it is for, in the file that lightcal wrote."""

    def fails(self, target, names, change, word, *arguments):
        export = Export(target, names, "--bare", *arguments)
        lights, _ = READERS[target](export)
        compare(lights, names, TOLERANCE[target])
        with self.assertRaisesRegex(GateError, word):
            lights, _ = READERS[target](export, change)
            compare(lights, names, TOLERANCE[target])

    def test_missing_division_by_luminance(self):
        y = 0.52  # of 2700 K
        for target, pattern in (
                ("gltf", r'("intensity": )([-+.e\d]+)'),
                ("blender", r'("energy_W": )([-+.e\d]+)'),
                ("three", r'("intensity": )([-+.e\d]+)'),
                ("filament", r'("intensity_candela": )([-+.e\d]+)'),
                ("godot", r"(light_intensity_lumens = )([-+.e\d]+)"),
                ("usd", r"(inputs:intensity = )([-+.e\d]+)"),
                ("unity", r'("intensity": )([-+.e\d]+)'),
                ("pbrt", r'("float scale" \[ )([-+.e\d]+)')):
            with self.subTest(target):
                self.fails(target, ["key"], times(pattern, y), "candela")
        self.fails("mitsuba", ["key"],
                   lambda t: re.sub(r'(name="intensity" value=")([^"]*)',
                                    lambda m: m.group(1) + " ".join(
                                        repr(float(v) * y) for v in m.group(2).split()), t),
                   "candela")
        self.fails("unreal", ["green spot"], times(r'("intensity": )([-+.e\d]+)', 0.8), "candela")

    def test_attenuation_of_one(self):
        self.fails("godot", ["key"],
                   lambda t: t.replace("omni_attenuation = 2", "omni_attenuation = 1"),
                   "attenuation")
        self.fails("godot", ["green spot"],
                   lambda t: t.replace("spot_attenuation = 2", "spot_attenuation = 1"),
                   "attenuation")

    def test_swapped_area_factor(self):
        pi = 3.141592653589793
        for target, pattern in (("usd", r"(inputs:intensity = )([-+.e\d]+)"),
                                ("unity", r'("intensity": )([-+.e\d]+)'),
                                ("pbrt", r'("float scale" \[ )([-+.e\d]+)')):
            for factor in (pi, 4.0 / pi, 0.18):
                with self.subTest(target):
                    self.fails(target, ["panel"], times(pattern, factor), "nits")
        self.fails("unreal", ["panel"], times(r'("intensity": )([-+.e\d]+)', pi), "candela")
        for factor in (pi / 4.0, 4.0 / pi, 1.0 / pi):
            self.fails("blender", ["panel"], times(r'("energy_W": )([-+.e\d]+)', factor), "nits")
            self.fails("three", ["panel"], times(r'("intensity": )([-+.e\d]+)', factor), "nits")
            self.fails("mitsuba", ["panel"],
                       lambda t, f=factor: re.sub(
                           r'(name="radiance" value=")([^"]*)', lambda m: m.group(1) + " ".join(
                               repr(float(v) * f) for v in m.group(2).split()), t), "nits")

    def test_half_and_full_angles(self):
        for target, pattern in (("gltf", r'("outerConeAngle": )([-+.e\d]+)'),
                                ("blender", r'("spot_size_rad": )([-+.e\d]+)'),
                                ("three", r'("three": \{[^}]*"outer_rad": )([-+.e\d]+)'),
                                ("godot", r"(spot_angle = )([-+.e\d]+)"),
                                ("usd", r"(cone:angle = )([-+.e\d]+)"),
                                ("mitsuba", r'("cutoff_angle" value=")([-+.e\d]+)'),
                                ("pbrt", r'("float coneangle" \[ )([-+.e\d]+)'),
                                ("unreal", r'("outer_cone_angle": )([-+.e\d]+)')):
            with self.subTest(target):
                self.fails(target, ["green spot"], times(pattern, 2.0), "half angle", "--spots",
                           "cone")
        # Its lumens are those of the half angle.
        self.fails("filament", ["green spot"], times(r'("outer_rad": )([-+.e\d]+)', 2.0),
                   "half angle")
        self.fails("unity", ["green spot"], times(r'("spot_angle_deg": )([-+.e\d]+)', 0.5),
                   "half angle")

    def test_the_field_of_lm_63_2019(self):
        export = Export("ies", ["luminaire"])
        text = export.text("set-luminaire.ies")
        self.assertAlmostEqual(read_ies(text), 2000.0, delta=0.01)
        lines = text.split("\r\n")
        at = [i for i, line in enumerate(lines) if line.startswith("TILT=")][0] + 2
        lines[at] = lines[at].replace("1 1 ", "1 1.10000 ", 1)
        with self.assertRaisesRegex(GateError, "reserved factor"):
            read_ies("\r\n".join(lines))
        with self.assertRaisesRegex(GateError, "CRLF"):
            read_ies(text.replace("\r\n", "\n"))
        self.fails("blender", ["luminaire"],
                   lambda t: re.sub(r"(TILT=NONE(?:\\r\\n|\r\n)[^\\\r]*(?:\\r\\n|\r\n)1) 1 ",
                                    r"\1 1.1 ", t), "reserved factor")

    def test_a_name_the_engine_does_not_have(self):
        export = Export("unreal", ["key"])
        for wrong in ("intensity_unit", "attenuation"):
            script = export.text("set.unreal.py").replace(
                '"intensity_units"', '"%s"' % wrong)
            with self.assertRaises(AttributeError):
                read_unreal.read_script(script, os.path.join(export.path, "set.unreal.py"))

    def test_a_mirrored_scene(self):
        self.fails("unreal", ["green spot"],
                   lambda t: re.sub(r'("location_cm": \[\s*[-.\d]+,\s*)([-.\d]+)',
                                    lambda m: m.group(1) + repr(-float(m.group(2))), t, count=1),
                   "position")


class Pipelines(unittest.TestCase):
    def test_a_pipeline_neutralised_to_the_lamp_gets_white(self):
        lights, _ = usd(Export("usd", ["key"], "--bare", "--white", "0.45986,0.41060"))
        self.assertLess(max(abs(c - 1) for c in lights["key"].rgb), 1e-6)
        self.assertAlmostEqual(lights["key"].candela, 1000.0, delta=0.01)

    def test_a_space_an_engine_lacks_is_said(self):
        for target in ("godot", "mitsuba", "unity", "unreal", "gltf", "three", "filament"):
            export = Export(target, ["key"], "--bare", "--space", "acescg")
            self.assertIn("space_unsupported", {w["code"] for w in export.warnings})
            compare(READERS[target](export)[0], ["key"], TOLERANCE[target])

    def test_a_fixed_range_is_refitted_and_its_residual_printed(self):
        export = Export("godot", ["key"], "--range", "4m", distances=(0.5, 1.0, 3.0))
        said = [w["message"] for w in export.warnings if w["code"] == "falloff_residual"]
        self.assertEqual(len(said), 1)
        self.assertIn("--range 13.4m", said[0])


class PastedBeams(unittest.TestCase):
    def test_without_its_profile_a_beam_pastes_as_the_nearest_cone(self):
        with tempfile.TemporaryDirectory() as path:
            subprocess.run([LIGHTCAL, "quick", "--lumens", "806", "--beam", "36", "--field", "60", "--to", "unreal",
                            "-o", path], check=True, capture_output=True)
            seen = read_unreal.read_t3d(open(os.path.join(path, "light.t3d")).read())["light"]
        self.assertLess(seen.outer, 60)
        inner, outer = (math.cos(math.radians(a)) for a in (seen.inner, seen.outer))
        part = lambda c: min(max((c - outer) / (inner - outer), 0.0), 1.0) ** 2
        steps = 20000
        lumens = sum(part(1 - (i + 0.5) / steps) for i in range(steps)) * 2 * math.pi / steps * seen.candela
        self.assertAlmostEqual(lumens / 806, 1, delta=0.03)  # 25,028 lm of a point of that peak
        self.assertAlmostEqual(part(math.cos(math.radians(18))), 0.5, delta=0.08)


class Refits(unittest.TestCase):
    """Each engine's own law at every reading, at the range of the bar, from the written file."""
    DISTANCES = (0.25, 0.5, 1.0, 2.0)

    def residual(self, lux_per_candela, candela):
        return max(abs(candela * lux_per_candela(d) * d * d / 1000.0 - 1) for d in self.DISTANCES)

    def test_each_engine_within_half_a_percent(self):
        def window(d, r):
            return max(0.0, 1 - (d / r) ** 4)
        near, plain = 4.47 * 2.0, 3.76 * 2.0
        for target, r, law in (
                ("godot", near, lambda d: window(d, near) ** 2 / d ** 2),
                ("unity", near, lambda d: (window(d, near) * min(1 / d, 100.0)) ** 2),
                ("unreal", near, lambda d: window(d, near) ** 2 / (d * d + 1e-4)),
                ("three", near, lambda d: window(d, near) ** 2 / d ** 2),
                ("filament", near, lambda d: window(d, near) ** 2 / d ** 2),
                ("gltf", plain, lambda d: window(d, plain) / d ** 2)):
            export = Export(target, ["key"], "--bare", "--range", "%gm" % r,
                            distances=self.DISTANCES)
            self.assertNotIn("falloff_residual", {w["code"] for w in export.warnings})
            if target == "gltf":
                light = json.loads(export.text(export.stem + ".gltf"))["extensions"]["KHR_lights_punctual"][
                    "lights"][0]
                self.assertAlmostEqual(light["range"], r, delta=1e-9)
                candela = light["intensity"] * sum(
                    w * c for w, c in zip((0.2126, 0.7152, 0.0722), light["color"]))
            elif target == "unreal":
                candela = read_unreal.read_t3d(export.text("set.t3d"))["key"].candela
            elif target == "godot":
                text = export.text("set.tscn")
                self.assertIn("omni_range = %g\n" % r, text)
                candela = read_godot.read(text, nearest_window=0.0)[0]["key"].candela
            else:
                candela = READERS[target](export)[0]["key"].candela
            if target == "three":
                light = read_scripts.data(export.text("set.three.js"), "export const preset")["lights"][0]
                self.assertAlmostEqual(light["range_m"], r, delta=1e-9)
                # Babylon's window is not squared.
                self.assertLess(self.residual(lambda d: window(d, near) / d ** 2,
                                              candela * light["babylon_intensity_factor"]), 0.005)
            if target == "filament":
                light = json.loads(export.text(export.stem + ".filament.json"))["lights"][0]
                self.assertAlmostEqual(light["falloff_m"], r, delta=1e-9)
            self.assertLess(self.residual(law, candela), 0.005 + TOLERANCE.get(target, 1e-4), target)

    def test_cones_stray_as_little_as_their_warnings_say(self):
        want = seen.cone("squared", 15.0, 25.0)
        for target in ("godot", "mitsuba", "usd", "pbrt", "three", "blender"):
            with self.subTest(target):
                export = Export(target, ["green spot"], "--bare", "--spots", "cone")
                said = [w["message"] for w in export.warnings if w["code"] == "cone_profile"][0]
                worst, flux = (float(re.search(p, said).group(1))
                               for p in (r"within ([\d.]+) %", r"flux ([\d.]+) %"))
                light = READERS[target](export)[0]["green spot"]
                got = seen.cone(light.law, light.inner, light.outer, light.power)
                angles = [0.02 * i for i in range(1501)]
                self.assertAlmostEqual(100 * max(abs(got(a) - want(a)) for a in angles), worst, delta=0.2)
                whole = lambda f: sum(f(a) * math.sin(math.radians(a)) for a in angles)
                self.assertAlmostEqual(100 * abs(whole(got) / whole(want) - 1), flux, delta=0.1)


if __name__ == "__main__":
    LIGHTCAL = sys.argv.pop(1)
    unittest.main(warnings="ignore")
