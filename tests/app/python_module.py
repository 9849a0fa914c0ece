#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""import lightcal: its answers are the command's, its arrays the samples of the command's pictures,
its errors say as much; the interpreter's lock is free meanwhile.

    python_module.py LIGHTCAL FOLDER_OF_THE_PACKAGE [-k PART_OF_A_TEST'S_NAME ...]
"""
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import threading
import time
import typing
import unittest
import warnings

LIGHTCAL, PACKAGE = (os.path.abspath(path) for path in sys.argv[1:3])
sys.path.insert(0, PACKAGE)
import numpy  # noqa: E402

import lightcal  # noqa: E402
from lightcal import _documents  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
SAMPLES = HERE.parents[1] / "sample_data"
SESSIONS = sorted(path.parent for path in (SAMPLES / "sessions").glob("*/session.toml"))
FRAMES = sorted(str(path) for path in (SAMPLES / "sessions/grey_card_dng/captures").glob("*.dng"))


def command(*words, code=0):
    done = subprocess.run([LIGHTCAL, *map(str, words), "--json"], capture_output=True, text=True,
                          check=False)
    if done.returncode != code:
        raise AssertionError(f"{words}: exit {done.returncode}\n{done.stdout}{done.stderr}")
    return json.loads(done.stdout)


def without(document, *keys):
    return {key: value for key, value in document.items() if key not in keys}


def codes(document):
    """Of warnings, whose texts name options in the one and keywords in the other."""
    return [remark["code"] for remark in document.get("warnings", [])]


def uncompressed_exr(path):
    """{channel: float32 array} of scan lines without compression."""
    data = pathlib.Path(path).read_bytes()
    at, channels, window = 8, [], None
    while data[at] != 0:
        name, kind, rest = data[at:at + 300].split(b"\0", 2)[0:2] + [b""]
        at += len(name) + len(kind) + 2
        size = struct.unpack_from("<i", data, at)[0]
        value = data[at + 4:at + 4 + size]
        at += 4 + size
        if name == b"channels":
            while value[0] != 0:
                channel, value = value.split(b"\0", 1)
                assert struct.unpack_from("<i", value)[0] == 2, "float"
                channels.append(channel.decode())
                value = value[16:]
        elif name == b"dataWindow":
            window = struct.unpack("<4i", value)
        elif name == b"compression":
            assert value == b"\0", "compressed"
    width, height = window[2] - window[0] + 1, window[3] - window[1] + 1
    starts = struct.unpack_from(f"<{height}Q", data, at + 1)
    rows = [numpy.frombuffer(data, "<f4", width * len(channels), start + 8) for start in starts]
    whole = numpy.stack(rows).reshape(height, len(channels), width)
    return {name: whole[:, i, :] for i, name in enumerate(channels)}


class SameAnswers(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        warnings.simplefilter("ignore", lightcal.DataWarning)

    def same(self, answer, document, *apart):
        self.assertEqual(codes(answer), codes(document))
        self.assertEqual(without(answer, "warnings", *apart),
                         without(document, "warnings", *apart))

    def test_every_sample_session(self):
        self.assertGreaterEqual(len(SESSIONS), 10)
        for session in SESSIONS:
            with self.subTest(session.name):
                out = self.folder / session.name
                document = command("run", session, "-o", out, "--to", "gltf,ies")
                before = {path.name: path.read_bytes() for path in out.iterdir()}
                answer = lightcal.run(session, output=out, to="gltf,ies")  # replaces its like
                self.same(answer, document)
                self.assertEqual({path.name: path.read_bytes() for path in out.iterdir()}, before)
                only = lightcal.run(session)  # no presets, so that none warns
                self.assertEqual(without(only, "warnings"), without(document, "warnings", "files"))
                self.assertLessEqual(set(codes(only)), set(codes(document)))

    def test_some_of_the_lights(self):
        session = SAMPLES / "sessions/three_real_lights"
        names = [light["name"] for light in lightcal.run(session)["lights"]]
        for options, wanted in (({"lights": names[:2]}, names[:2]), ({"lights": names[2]}, names[2:]),
                                ({"without": names[0]}, names[1:])):
            with self.subTest(options):
                option, value = next(iter(options.items()))
                word = value if isinstance(value, str) else ",".join(value)
                answer = lightcal.run(session, **options)
                self.assertEqual([light["name"] for light in answer["lights"]], wanted)
                self.assertEqual(answer["lights"], command("fit", session, "--" + option, word)["lights"])
        with self.assertRaises(lightcal.Error):
            lightcal.run(session, lights=names[0], without=names[1])

    def test_quick(self):
        for words, readings, options in (
                (["192lx@0.5m"], ["192lx@0.5m"], {}),
                (["192lx@0.5m", "52lx@1m,card=5lx", "--cct", "2900K", "--at", "3m"],
                 ["192lx@0.5m", {"illuminance_lx": 52, "distance_m": 1, "card_lx": 5}],
                 {"cct": 2900, "at": 3}),
                (["58lx@1m,card=10lx", "--fixture", "bulb", "--room", "5,4,2.6", "--meter", "hobby",
                  "--plan"], ["58lx@1m,card=10lx"],
                 {"fixture": "bulb", "room": (5, 4, 2.6), "meter": "hobby", "plan": True}),
                (["--lumens", "806", "--beam", "36", "--watts", "9"], [],
                 {"lumens": 806, "beam": 36.0, "watts": numpy.float32(9)}),
                (["900lx@1m", "--kind", "spot", "--inner", "20", "--outer", "40", "--full-angles"],
                 ["900lx@1m"], {"kind": "spot", "inner": 20, "outer": 40, "full_angles": True}),
                (["192lx@0.5m", "--cct", "3200K", "--gel", "half ctb"], ["192lx@0.5m"],
                 {"cct": "3200K", "gel": "half ctb"})):
            with self.subTest(words):
                self.same(lightcal.quick(*readings, **options), command("quick", *words))

    def test_color(self):
        spectrum = SAMPLES / "spectra/uprtek_cv600/Osram Osconiq 3000K.xls"
        for words, options in (
                (["--xy", "0.4476", "0.4074"], {"xy": (0.4476, 0.4074)}),
                (["--xyz", "95", "100", "108.9", "--sigma", "1%", "--engines"],
                 {"xyz": (95, 100, 108.9), "sigma": 0.01, "engines": True}),
                (["--cct", "3200", "--duv", "0.006", "--white", "D65", "--gamut", "clip"],
                 {"cct": 3200, "duv": 0.006, "white": "D65", "gamut": "clip"}),
                (["--cct", "6500", "--locus", "daylight"], {"cct": "6500K", "locus": "daylight"}),
                (["--spectrum", spectrum], {"spectrum": spectrum}),
                (["--spectrum", "illuminant:FL11", "--adobe"],
                 {"spectrum": "illuminant:FL11", "adobe": True})):
            with self.subTest(words):
                self.same(lightcal.color(**options), command("color", *words))

    def test_merge_is_the_picture_and_no_copy(self):
        for words, options, channels in (
                ([], {}, ["Y"]),
                (["--space", "acescg"], {"space": "acescg"}, ["R", "G", "B"])):
            document = command("merge", *FRAMES, "-o", self.folder / "a.exr", "--sigma",
                               self.folder / "s.exr", "--uncompressed", "--force", *words)
            answer = lightcal.merge(FRAMES, **options)
            self.same(answer, document, "luminance", "sigma")
            picture = uncompressed_exr(self.folder / "a.exr")
            whole = numpy.stack([picture[name] for name in channels], axis=-1)
            samples = answer["luminance"].reshape(whole.shape)
            self.assertEqual((samples.dtype, samples.tobytes()), (numpy.float32, whole.tobytes()))
            sigma = uncompressed_exr(self.folder / "s.exr")["Y"]
            self.assertEqual(answer["sigma"].tobytes(), sigma.tobytes())
            for array in (answer["luminance"], answer["sigma"]):
                self.assertFalse(array.flags.owndata)  # the merge's own samples, kept alive by it
                self.assertEqual(type(array.base).__name__, "PyCapsule")
                self.assertTrue(array.flags.c_contiguous and array.flags.writeable)
        only = lightcal.merge(FRAMES[0], sigma=False, anchor=(10, 10, 20, 20, 312.0))
        self.assertNotIn("sigma", only)
        self.assertEqual(only["scale"]["source"], "anchor")
        kept = answer["luminance"][5, 5].copy()
        luminance = answer.pop("luminance")
        del answer, array
        self.assertTrue((luminance[5, 5] == kept).all())

    def test_export(self):
        lights = lightcal.run(SAMPLES / "sessions/three_real_lights")
        path = self.folder / "three.json"
        path.write_text(json.dumps({key: lights[key] for key in ("schema", "lights", "provenance")}))
        targets = "gltf,blender,unreal,usd,ies,json"
        document = command("export", path, "--to", targets, "--rig", "--white", "3200K", "-o",
                           self.folder / "by_command")
        files = {p.name: p.read_bytes() for p in (self.folder / "by_command").iterdir()}
        of_path = lightcal.export(path, targets, rig=True, white="3200K")
        of_dict = lightcal.export(lights, targets.split(","), stem="three", rig=True, white="3200K")
        self.assertEqual(of_path["contents"], files)
        self.assertEqual(of_dict["contents"], files)
        written = lightcal.export(path, targets, rig=True, white="3200K",
                                  output=self.folder / "by_command")
        self.same(written, document)

    def test_an_answer_saved_whole_is_a_light_file_and_makes_a_page(self):
        path = self.folder / "lamp.json"
        path.write_text(json.dumps(lightcal.quick("203lx@0.5m")))
        self.assertEqual(list(lightcal.export(path, "gltf")["contents"]), ["lamp.gltf"])
        if (pathlib.Path(LIGHTCAL).parent / "lightcal_page.html").exists():
            self.assertEqual(list(lightcal.export(path, "page")["contents"]), ["lamp.page.html"])

    def test_answers_hold_what_their_types_say(self):
        def check(document, kind, where):
            hints = typing.get_type_hints(kind)
            for key, value in document.items():
                self.assertIn(key, hints, where)
                hint = hints[key]
                inner = typing.get_args(hint)[:1] if typing.get_origin(hint) is list else ()
                for one, its in ([(value, hint)] if not inner else [(v, inner[0]) for v in value]):
                    if typing.is_typeddict(its):
                        check(one, its, f"{where}.{key}")
                    elif its in (int, float, str, bool):
                        self.assertIsInstance(one, (int, float) if its is float else its,
                                              f"{where}.{key}")
        vars(_documents).update(numpy=numpy, Samples=numpy.ndarray)
        for session in SESSIONS:
            check(lightcal.run(session), lightcal.RunAnswer, session.name)
        check(lightcal.quick("52lx@1m,card=5lx", at=3, plan=True, room="dark"),
              lightcal.QuickAnswer, "quick")
        check(lightcal.color(spectrum="illuminant:FL11", sigma=.01, engines=True, adobe=True,
                             white="D65"), lightcal.ColorAnswer, "color")
        check(lightcal.merge(FRAMES), lightcal.MergeAnswer, "merge")
        check(lightcal.export(lightcal.quick("52lx@1m"), "gltf"), lightcal.ExportAnswer, "export")

    def test_errors_say_what_where_and_what_to_do(self):
        def error(of, *arguments, **keywords):
            with self.assertRaises(lightcal.Error) as raised:
                of(*arguments, **keywords)
            found = raised.exception
            self.assertNotIn("--", str(found))
            return found.kind, found.code, found.subject

        self.assertEqual(error(lightcal.color, xy=(44.0, 40.0)), ("refused", "bad_chromaticity", "xy"))
        self.assertEqual(error(lightcal.color)[:2], ("usage", "usage"))
        self.assertEqual(error(lightcal.color, xy=(.3,))[:2], ("usage", "usage"))
        self.assertEqual(error(lightcal.quick)[:2], ("usage", "usage"))
        self.assertEqual(error(lightcal.quick, "192 apples")[0], "usage")
        self.assertEqual(error(lightcal.quick, "192lx@0.5m", fixture="candle"),
                         ("usage", "usage", "fixture"))
        self.assertEqual(error(lightcal.quick, {"illuminance_lx": 5}), ("usage", "usage", "readings"))
        self.assertEqual(error(lightcal.quick, "1lx@1m", meter="3%", sigma=.05)[2], "meter")
        self.assertEqual(error(lightcal.quick, {"illuminance_lx": "192lx", "distance_m": 1}),
                         ("usage", "usage", "illuminance_lx"))
        self.assertEqual(error(lightcal.quick, "1lx@1m", name="a\ud800b")[:2], ("usage", "usage"))
        for anchor in ((1, 2, 3), (1, 2, 3, 4, "bright"), (1.5, 2, 3, 4, 312.0)):
            self.assertEqual(error(lightcal.merge, FRAMES, anchor=anchor),
                             ("usage", "usage", "anchor"))
        self.assertEqual(error(lightcal.export, lightcal.quick("1lx@1m"), "blendr")[:2],
                         ("usage", "usage"))
        missing = error(lightcal.run, self.folder / "none")
        self.assertEqual(missing[0], "failed")
        self.assertEqual(missing[1], command("run", self.folder / "none", code=1)["error"]["code"])
        with self.assertRaises(TypeError):
            lightcal.quick("1lx@1m", colour=3)  # type: ignore
        with self.assertRaises(TypeError):
            lightcal.quick("1lx@1m", cct=True)
        with self.assertRaises(TypeError):
            lightcal.quick("1lx@1m", cct={})
        wide = self.folder / "wide"
        wide.mkdir()
        (wide / "session.toml").write_text(
            'lightcal = 1\n[[light]]\nname = "key"\nkind = "point"\n[[reading]]\nlight = "key"\n'
            'distance_m = 1.0\nspectrum = "../../../etc/hostname"\nilluminance_lx = 5\n')
        self.assertEqual(error(lightcal.run, wide)[1], "outside_session")

    def test_nothing_of_a_persons_is_overwritten(self):
        session = self.folder / "mine"
        shutil.copytree(SAMPLES / "sessions/godox_vl300ii_bare", session,
                        ignore=shutil.ignore_patterns("out"))
        out = session / "out"
        lightcal.run(session, output=out, to="gltf")
        mine = out / "mine.gltf"
        mine.write_text("my own")
        with self.assertRaises(lightcal.Error) as raised:
            lightcal.run(session, output=out, to="gltf")
        self.assertEqual((raised.exception.kind, raised.exception.code), ("failed", "exists"))
        self.assertEqual(mine.read_text(), "my own")
        lightcal.run(session, output=out, to="gltf", force=True)
        # What one call read, another may write; what a call reads itself, it never does.
        lightcal.export(out / "light.json", "gltf", output=out / "presets")
        lightcal.run(session, output=out, to="gltf")

    def test_warnings(self):
        (self.folder / "wide.csv").write_text(
            "wavelength_nm,relative\n" + "".join(f"{nm},1\n" for nm in range(420, 700, 5)))
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            answer = lightcal.color(spectrum=self.folder / "wide.csv")
        self.assertIn("spectrum_truncated", codes(answer))
        said = [one for one in caught if one.category is lightcal.DataWarning]
        self.assertEqual(len(said), len(answer["warnings"]))
        self.assertEqual(said[0].filename, __file__)
        with warnings.catch_warnings():
            warnings.simplefilter("error", lightcal.DataWarning)
            with self.assertRaises(lightcal.DataWarning):
                lightcal.color(spectrum=self.folder / "wide.csv")

    def test_other_threads_run_meanwhile(self):
        ended = []

        def work():
            lightcal.run(SAMPLES / "sessions/grey_card_dng", effects="all", monte_carlo=True)
            ended.append(time.monotonic())
        thread = threading.Thread(target=work)
        ticks = []
        thread.start()
        while thread.is_alive():
            ticks.append(time.monotonic())
            time.sleep(0.001)
        thread.join()
        self.assertGreater(sum(tick < ended[0] for tick in ticks), 20)

    def test_the_readmes_lines_run(self):
        readme = (HERE.parents[1] / "README.md").read_text(encoding="utf-8")
        lines = re.findall(r"```python\n(.*?)```", readme, re.S)
        self.assertEqual(len(lines), 1)
        shutil.copytree(SAMPLES / "sessions/godox_vl300ii_bare", self.folder / "desk_lamp",
                        ignore=shutil.ignore_patterns("out"))
        shutil.copy(FRAMES[0], self.folder / "a.dng")
        shutil.copy(FRAMES[1], self.folder / "b.dng")
        (self.folder / "lamp.csv").write_text(
            "wavelength_nm,relative\n" + "".join(f"{nm},1\n" for nm in range(380, 785, 5)))
        done = subprocess.run([sys.executable, "-B", "-c", lines[0]], cwd=self.folder,
                              env=dict(os.environ, PYTHONPATH=PACKAGE), capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.folder / "presets/light.json").exists())

    def test_a_pipeline_runs_and_its_types_hold(self):
        sample = HERE / "python_sample.py"
        environment = dict(os.environ, PYTHONPATH=PACKAGE, MYPYPATH=PACKAGE)
        done = subprocess.run(
            [sys.executable, "-B", sample, SAMPLES / "sessions/three_real_lights", *FRAMES],
            env=environment, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("lights.blender.py lights.gltf", done.stdout)
        self.assertIn("refused bad_chromaticity xy", done.stdout)
        for checked in (sample, pathlib.Path(PACKAGE) / "lightcal"):
            types = subprocess.run(
                [sys.executable, "-m", "mypy", "--strict", "--cache-dir", self.folder / "cache",
                 checked], env=environment, capture_output=True, text=True, check=False)
            self.assertEqual(types.returncode, 0, types.stdout + types.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
