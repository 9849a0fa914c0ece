#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`export --to gdtf` and `import fixture.gdtf`, judged by python's zipfile and ElementTree, by xmllint
with the official schema, and by DMX profiles worked out here from the specification's words.

    gdtf.py LIGHTCAL
"""
import io
import json
import pathlib
import random
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIGHTCAL = str(pathlib.Path(sys.argv[1]).resolve())
GDTF = ROOT / "sample_data/gdtf"
PAR = GDTF / "BlenderDMX@LED_PAR_64_RGBW@v0.3.gdtf"
HOME = pathlib.Path(tempfile.mkdtemp())
MOST_BYTES = 600 << 20  # of address space, for files nobody should trust


def run(*words, code=0, limited=False):
    limit = (lambda: resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))) \
        if limited else None
    done = subprocess.run([LIGHTCAL, *map(str, words)], capture_output=True, text=True, cwd=HOME,
                          check=False, preexec_fn=limit)
    assert done.returncode == code, f"{words}: exit {done.returncode}, not {code}: {done.stderr}"
    return done


def answer(*words):
    return json.loads(run(*words, "--json").stdout)


# ---- a panel with two controls, tungsten-like in its dimmer: E ~ (x ** 1.8) ----

DIMMERS, CCTS = (100, 80, 60, 40, 20, 10), (3200, 5600)
XY = {3200: (0.4234, 0.3990), 5600: (0.3302, 0.3411)}


def truth(dimmer, cct):
    return 1200 * (0.97 if cct == 3200 else 1.0) * (dimmer / 100) ** 1.8


def session():
    text = """lightcal = 1
[room]
dark = true
[[light]]
name = "Key & fill <2>"
kind = "spot"
inner_deg = 12
outer_deg = 25
[[light]]
name = "sun"
kind = "directional"
[[meter]]
name = "m"
sigma_relative = 0.02
[[reading]]
light = "sun"
illuminance_lx = 9000
xy = [0.33, 0.34]
"""
    for dimmer in DIMMERS:
        for cct in CCTS:
            for distance in (1.0, 2.0, 3.0) if (dimmer, cct) == (100, 5600) else (1.0,):
                x, y = XY[cct]
                text += (f'[[reading]]\nlight = "Key & fill <2>"\nmeter = "m"\n'
                         f"distance_m = {distance}\nilluminance_lx = "
                         f"{truth(dimmer, cct) / distance**2}\nxy = [{x}, {y}]\n"
                         f'color_source = "spectrometer"\n'
                         f"state = {{ dimmer = {dimmer}, cct_K = {cct} }}\n")
    (HOME / "panel").mkdir()
    (HOME / "panel/session.toml").write_text(text)


def the_archive_holds_what_was_measured():
    session()
    run("fit", "panel", "-o", "panel.json")
    done = answer("export", "panel.json", "--to", "gdtf", "-o", "out")
    assert [pathlib.Path(f).name for f in done["files"]] == ["panel-Key___fill__2_.gdtf"], done
    codes = [w["code"] for w in done["warnings"]]
    assert codes.count("no_fixture") == 1, codes
    assert "slots assumed" in "".join(done["paste"]), done
    light = next(x for x in json.loads((HOME / "panel.json").read_text())["lights"]
                 if x["name"].startswith("Key"))
    with zipfile.ZipFile(HOME / done["files"][0]) as archive:
        assert archive.testzip() is None and archive.namelist() == ["description.xml"]
        xml = archive.read("description.xml")
    (HOME / "description.xml").write_bytes(xml)
    fixture = ElementTree.fromstring(xml).find("FixtureType")
    assert fixture.get("LongName") == "Key & fill <2>"
    beam = fixture.find(".//Beam")
    assert abs(float(beam.get("LuminousFlux")) / light["flux_lm"]["value"] - 1) < 1e-9
    assert abs(float(beam.get("ColorTemperature")) - light["color"]["cct_K"]["value"]) < 1e-6
    # The engine's own spot profile, worked out here: I = t^2, t = (cos a - cos o)/(cos i - cos o).
    import math
    def angle(level):
        inner, outer = math.cos(math.radians(12)), math.cos(math.radians(25))
        return 2 * math.degrees(math.acos(outer + math.sqrt(level) * (inner - outer)))
    for name, level in (("BeamAngle", .5), ("FieldAngle", .1)):
        assert abs(float(beam.get(name)) - angle(level)) < 0.3, (name, beam.get(name), angle(level))
    # Luminous intensity by level: what was read, in both colours.
    emitters = {e.get("Name"): e for e in fixture.iter("Emitter")}
    assert sorted(emitters) == ["cct_K=3200", "cct_K=5600"]
    for cct in CCTS:
        emitter = emitters[f"cct_K={cct}"]
        x, y, _ = map(float, emitter.get("Color").split(","))
        assert abs(x - XY[cct][0]) < 1e-5 and abs(y - XY[cct][1]) < 1e-5
        levels = {float(m.get("Physical")): float(m.get("LuminousIntensity"))
                  for m in emitter.iter("Measurement")}
        assert sorted(levels) == sorted(DIMMERS)
        for dimmer, candela in levels.items():
            assert abs(candela / truth(dimmer, cct) - 1) < 0.02, (cct, dimmer, candela)
    # The dimmer's curve, by the specification's words.
    points = [{k: float(v) for k, v in p.attrib.items()} for p in fixture.iter("Point")]
    assert len(points) == 1  # the schema allows no more

    def output(percent):
        p = max((p for p in points if p["DMXPercentage"] <= percent),
                key=lambda p: p["DMXPercentage"])
        t = percent - p["DMXPercentage"]
        return p["CFC0"] + p["CFC1"] * t + p["CFC2"] * t**2 + p["CFC3"] * t**3
    for dimmer in DIMMERS:
        assert abs(output(dimmer) - (dimmer / 100) ** 1.8) < 0.01, (dimmer, output(dimmer))
    functions = {f.get("Attribute"): f for f in fixture.iter("ChannelFunction")}
    assert functions["Dimmer"].get("DMXProfile") == fixture.find(".//DMXProfile").get("Name")
    warm, cool = (float(functions["CTC"].get(k)) for k in ("PhysicalFrom", "PhysicalTo"))
    assert abs(warm - 3200) < 60 and abs(cool - 5600) < 60, (warm, cool)


def a_dimmer_that_is_no_cubic_never_falls_and_is_named():
    """Equal ratios (IEC 62386-102): a free cubic was -7 % of full at 0 and fell from 20 to 50 %."""
    text = ('lightcal = 1\n[room]\ndark = true\n[[light]]\nname = "dali"\nkind = "point"\n'
            '[[meter]]\nname = "m"\nsigma_relative = 0.02\n')
    for dimmer in (100, 75, 50, 25, 10):
        text += (f'[[reading]]\nlight = "dali"\nmeter = "m"\nstate = {{ dimmer = {dimmer} }}\n'
                 "distance_m = 2\n"
                 f"illuminance_lx = {5000 * 10 ** (3 * (dimmer / 100 - 1)):.8g}\n")
    (HOME / "dali").mkdir()
    (HOME / "dali" / "session.toml").write_text(text, encoding="utf-8")
    answer("fit", "dali", "-o", "dali.json")
    done = answer("export", "dali.json", "--to", "gdtf", "-o", "dali_out")
    with zipfile.ZipFile(HOME / done["files"][0]) as archive:
        point = ElementTree.fromstring(archive.read("description.xml")).find(".//Point")
    c = [float(point.get(f"CFC{k}")) for k in range(4)]
    curve = [sum(c[k] * x**k for k in range(4)) for x in range(101)]
    assert min(curve) > -1e-9 and all(b >= a - 1e-9 for a, b in zip(curve, curve[1:])), curve
    assert abs(curve[100] - 1) < 0.005, curve[100]
    rough = [w for w in done["warnings"] if w["code"] == "gdtf_rough_profile"]
    assert len(rough) == 1 and "of full" in rough[0]["message"], done["warnings"]


def at_nothing_a_dimmer_is_dark():
    """Whatever law the readings follow above it; unless a reading at 0 says that light is left."""
    laws = {"gamma": lambda x: x**1.3, "root": lambda x: x**0.7, "raised": lambda x: 0.03 + 0.97 * x}
    for name, law in laws.items():
        for at_0 in (False, True):
            text = ('lightcal = 1\n[room]\ndark = true\n[[light]]\nname = "a"\nkind = "point"\n'
                    '[[meter]]\nname = "m"\nsigma_relative = 0.02\n')
            for dimmer in (100, 75, 50, 25, 10) + ((0,) if at_0 and name == "raised" else ()):
                text += (f'[[reading]]\nlight = "a"\nmeter = "m"\nstate = {{ dimmer = {dimmer} }}\n'
                         f"distance_m = 2\nilluminance_lx = {5000 * law(dimmer / 100):.8g}\n")
            folder = HOME / f"{name}{at_0}"
            folder.mkdir()
            (folder / "session.toml").write_text(text, encoding="utf-8")
            answer("fit", folder, "-o", folder / "a.json")
            done = answer("export", folder / "a.json", "--to", "gdtf", "-o", folder / "out")
            with zipfile.ZipFile(HOME / done["files"][0]) as archive:
                point = ElementTree.fromstring(archive.read("description.xml")).find(".//Point")
            c = [float(point.get(f"CFC{k}")) for k in range(4)]
            left = 0.03 if at_0 and name == "raised" else 0
            off = max(abs(sum(c[k] * x**k for k in range(4)) - law(x / 100)) for x in (100, 75, 50, 25, 10))
            print(f"{name}: {100 * c[0]:.2f} % of full at 0, elsewhere off by {100 * off:.2f} %")
            assert abs(c[0] - left) < (0.003 if left else 1e-9), (name, c)
            assert off < 0.03, (name, off)


def it_is_valid_by_the_official_schema():
    xmllint = shutil.which("xmllint")
    assert xmllint, "xmllint is missing: libxml2-utils, tests/packages.txt"
    done = subprocess.run([xmllint, "--noout", "--nonet", "--schema", GDTF / "gdtf.xsd",
                           HOME / "description.xml"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def it_comes_back_as_it_went():
    done = answer("import", "out/panel-Key___fill__2_.gdtf")
    told = done["fixtures"][0]
    fixture = ElementTree.parse(HOME / "description.xml").getroot().find("FixtureType")
    beam = fixture.find(".//Beam")
    for key, name in (("flux_lm", "LuminousFlux"), ("beam_deg", "BeamAngle"),
                      ("field_deg", "FieldAngle"), ("cct_K", "ColorTemperature")):
        assert told["beams"][0][key] == float(beam.get(name)), key
    assert [[m["physical_percent"], m["intensity_cd"]] for e in told["emitters"]
            for m in e["measurements"]] == [
        [float(m.get("Physical")), float(m.get("LuminousIntensity"))]
        for m in fixture.iter("Measurement")]
    assert told["profiles"][0]["points"][0]["coefficients"] == [
        float(fixture.find(".//Point").get(f"CFC{k}")) for k in range(4)]
    assert [c["slots"] for c in told["modes"][0]["channels"]] == [[1, 2], [3, 4]]
    # Its block is a session's light, with the data sheet's figures as priors.
    text = "lightcal = 1\n" + told["light_toml"]
    for distance, lux in ((2, 300), (3, 133.3)):
        text += (f"[[reading]]\nlight = {json.dumps(told['name'])}\ndistance_m = {distance}\n"
                 f"illuminance_lx = {lux}\n")
    (HOME / "pasted").mkdir()
    (HOME / "pasted/session.toml").write_text(text)
    fitted = answer("fit", "pasted")["lights"][0]
    assert fitted["kind"] == "spot" and 1100 < fitted["intensity_cd"]["value"] < 1300, fitted
    assert "GDTF" in run("validate", "out/panel-Key___fill__2_.gdtf").stdout


def a_fixture_of_others():
    told = answer("import", PAR)
    fixture = told["fixtures"][0]
    # Its Physical="0" breaks the schema, and says nothing: left out, the fixture is taken.
    assert len(fixture["emitters"]) == 4
    assert all([m["physical_percent"] for m in e["measurements"]] == [100]
               for e in fixture["emitters"])
    assert fixture["beams"][0]["flux_lm"] == 7000 and fixture["beams"][0]["field_deg"] == 90
    assert "flux_lm = 7000" in fixture["light_toml"] and "beam_deg = 60" in fixture["light_toml"]
    assert [w["code"] for w in told["warnings"]] == ["gdtf_no_measurement"]
    channels = fixture["modes"][0]["channels"]
    assert [c["attribute"] for c in channels][:2] == ["Dimmer", "ColorAdd_R"]
    assert "LED PAR 64 RGBW by BlenderDMX" in run("import", PAR).stdout


def archive_of(xml, name="description.xml", method=zipfile.ZIP_STORED):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", method) as archive:
        archive.writestr(zipfile.ZipInfo("other/model.glb"), b"x" * 2000)
        archive.writestr(zipfile.ZipInfo(name), xml, method)
    return bytearray(out.getvalue())


def forty_damaged_archives_are_refused_in_bounded_memory():
    good = (HOME / "description.xml").read_bytes()
    files, rng = {}, random.Random(20)
    whole = archive_of(good, method=zipfile.ZIP_DEFLATED)
    start = whole.index(b"description.xml") + len("description.xml")
    for i in range(12):  # a bit of the packed description turned over: its check sum says so
        cut = bytearray(whole)
        cut[start + rng.randrange(40, 1200)] ^= 1 << rng.randrange(8)
        files[f"bit{i}"] = cut
    for i in range(8):
        files[f"cut{i}"] = whole[:rng.randrange(30, start + 400)]
    for i in range(4):
        files[f"noise{i}"] = bytearray(b"PK\x03\x04") + bytearray(rng.randbytes(3000))
    files["bomb"] = archive_of(b"<GDTF>" + b" " * (400 << 20), method=zipfile.ZIP_DEFLATED)
    files["bomb2"] = archive_of(b"<GDTF " + b"a" * (64 << 20), method=zipfile.ZIP_DEFLATED)
    lie = bytearray(archive_of(good))
    at = lie.index(b"description.xml") - 12
    lie[at:at + 8] = struct.pack("<II", 0xFFFFFFF0, 0xFFFFFFF0)
    files["sizes"] = lie
    files["none"] = archive_of(good, name="scene.xml")
    files["empty"] = bytearray()
    files["text"] = bytearray(good)
    laughs = b"".join(b'<!ENTITY l%d "%s">' % (i, b"&l%d;" % (i - 1) * 10) for i in range(1, 12))
    texts = {
        "laughs": b'<!DOCTYPE x [<!ENTITY l0 "ha">' + laughs + b"]><GDTF>&l11;</GDTF>",
        "unclosed": good[:-40], "mvr": b"<GeneralSceneDescription/>",
        "deep": good.replace(b"<Geometries>", b"<Geometries>" + b"<Geometry>" * 9000 +
                             b"</Geometry>" * 9000),
        "many": good.replace(b"<Emitters>", b"<Emitters>" + b"<Emitter/>" * 9000),
        "flux": good.replace(b'LuminousFlux="', b'LuminousFlux="-'),
        "angle": good.replace(b'BeamAngle="', b'BeamAngle="9999'),
        "nan": good.replace(b'LuminousFlux="', b'LuminousFlux="nan'),
        "slot": good.replace(b'Offset="1,2"', b'Offset="0,700"'),
        "level": good.replace(b'Physical="100"', b'Physical="101"')}
    for name, text in texts.items():
        assert text != good, name
        files[name] = archive_of(text, method=zipfile.ZIP_DEFLATED)
    assert len(files) >= 40, len(files)
    for name, data in files.items():
        (HOME / f"{name}.gdtf").write_bytes(data)
        done = run("import", f"{name}.gdtf", "--json", code=3, limited=True)
        error = json.loads(done.stdout)["error"]
        assert error["code"] in ("bad_archive", "bad_gdtf", "too_large"), (name, error)
        run("validate", f"{name}.gdtf", code=3 if name != "empty" else 3, limited=True)
    run("import", "nothing.gdtf", code=1)
    run("import", PAR, HOME / "pasted/session.toml", code=2)
    run("import", HOME / "description.xml", code=2)


if __name__ == "__main__":
    TESTS = [the_archive_holds_what_was_measured, it_is_valid_by_the_official_schema,
             a_dimmer_that_is_no_cubic_never_falls_and_is_named,
             at_nothing_a_dimmer_is_dark,
             it_comes_back_as_it_went, a_fixture_of_others,
             forty_damaged_archives_are_refused_in_bounded_memory]
    for test in TESTS:
        test()
    print(f"{len(TESTS)} tests")
