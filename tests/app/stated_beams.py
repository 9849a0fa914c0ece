#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a box says of a beam is in every file: the angle at half of the middle, the lumens, and no bare point. The
files are read here, and integrated here.

    stated_beams.py LIGHTCAL
"""
import json
import math
import pathlib
import sys
import xml.etree.ElementTree as ET
import zipfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, run  # noqa: E402


def ies(path):
    """Angles in degrees and candela of a file of one plane."""
    text = path.read_text().split("TILT=NONE", 1)[1].split()
    count, planes, factor = int(text[3]), int(text[4]), float(text[2])
    assert planes == 1, text[:13]
    angles = np.array(text[13:13 + count], float)
    return angles, factor * np.array(text[14 + count:14 + 2 * count], float)


def lumens(angles, candela):
    fine = np.linspace(0, 180, 180001)
    values = 2 * np.pi * np.interp(fine, angles, candela) * np.sin(np.radians(fine))
    return np.sum((values[1:] + values[:-1]) / 2) * np.radians(fine[1])


def full_angle(angles, candela, part):
    fine = np.linspace(0, 90, 90001)
    return 2 * fine[np.argmax(np.interp(fine, angles, candela) < part * candela[0])]


def files_of(name, *words):
    run("quick", *words, "--to", "ies,gltf,gdtf,blender", "-o", HOME / name)
    light = answer("quick", *words)["lights"][0]
    return HOME / name, light, ies(next((HOME / name).glob("*.ies")))


def gltf_light(folder):
    return json.loads(next(folder.glob("*.gltf")).read_text())["extensions"]["KHR_lights_punctual"]["lights"][0]


def gdtf_beam(folder):
    with zipfile.ZipFile(next(folder.glob("*.gdtf"))) as package:
        return ET.fromstring(package.read("description.xml")).find(".//Beam").attrib


def a_stated_beam_is_what_is_exported():
    for beam in (12, 36, 60, 100, 120):
        folder, light, table = files_of(f"b{beam}", "--lumens", 806, "--beam", beam)
        assert abs(lumens(*table) / 806 - 1) < 0.005, (beam, lumens(*table))
        assert abs(full_angle(*table, 0.5) / beam - 1) < 0.01, (beam, full_angle(*table, 0.5))
        assert abs(table[1][0] / light["intensity_cd"]["value"] - 1) < 1e-3
        gltf = gltf_light(folder)
        assert gltf["type"] == "spot" and gltf["spot"]["outerConeAngle"] > math.radians(beam / 2), gltf
        gdtf = gdtf_beam(folder)
        assert abs(float(gdtf["BeamAngle"]) / beam - 1) < 0.02, gdtf
        assert abs(float(gdtf["LuminousFlux"]) / 806 - 1) < 0.01, gdtf


def that_it_is_drawn_is_said():
    said = run("quick", "--lumens", 806, "--beam", 36, "--to", "ies,gdtf", "-o", HOME / "said").stdout
    assert "drawn from its stated beam of 36°" in said, said
    words = "a beam drawn from its stated angle"
    assert words in next((HOME / "said").glob("*.ies")).read_text()
    with zipfile.ZipFile(next((HOME / "said").glob("*.gdtf"))) as package:
        assert words in package.read("description.xml").decode()
    assert "is the one of its lumens" in run("quick", "--lumens", 806, "--outer", 30).stdout


def a_stated_field_is_in_it_too():
    _, _, table = files_of("field", "--lumens", 806, "--beam", 36, "--field", 60)
    assert abs(lumens(*table) / 806 - 1) < 0.005, lumens(*table)
    assert abs(full_angle(*table, 0.5) / 36 - 1) < 0.01 and abs(full_angle(*table, 0.1) / 60 - 1) < 0.01


def an_outer_angle_carries_the_lumens():
    folder, light, table = files_of("outer", "--lumens", 806, "--outer", 30)
    assert abs(lumens(*table) / 806 - 1) < 0.005, lumens(*table)
    cone = light["cone"]
    assert 0 < cone["inner_deg"] < 30 and cone["inner_u95_deg"] >= cone["inner_deg"], cone
    assert abs(gltf_light(folder)["spot"]["outerConeAngle"] - math.radians(30)) < 1e-9


def a_reading_on_the_axis_leaves_the_beam():
    session = HOME / "key.toml"
    session.write_text('lightcal = 1\n[room]\ndark = true\n[[light]]\nname = "key"\nkind = "spot"\nfixture = "fresnel"\n'
                       'beam_deg = 40\n[[reading]]\nlight = "key"\ndistance_m = 2.0\nilluminance_lx = 1000\n'
                       '[[reading]]\nlight = "key"\ndistance_m = 4.0\nilluminance_lx = 250\n')
    run("run", session, "--to", "ies,gltf", "-o", HOME / "key")
    table = ies(next((HOME / "key").glob("*.ies")))
    assert abs(full_angle(*table, 0.5) / 40 - 1) < 0.01, full_angle(*table, 0.5)
    # Between a flat cone of those 40 degrees and one with a third of its light beside it.
    n = math.log(0.5) / math.log(math.cos(math.radians(20)))
    narrow, wide = 2 * math.pi * (1 - math.cos(math.radians(20))), 1.5 * 2 * math.pi / (n + 1)
    assert narrow < lumens(*table) / table[1][0] < wide, lumens(*table) / table[1][0]
    assert gltf_light(HOME / "key")["type"] == "spot"


def the_flux_of_a_read_beam_holds_angles_that_are_a_tenth_off():
    """Beams between the four shapes whose printed angle is 10 % (1 sigma) off, read on their axis."""
    chance, theta = np.random.default_rng(3), np.linspace(0, np.pi / 2, 2001)
    for beam in (20, 40, 90):
        session = HOME / "tenth.toml"
        session.write_text(f'lightcal = 1\n[room]\ndark = true\n[[light]]\nname = "k"\nkind = "spot"\nbeam_deg = {beam}\n'
                           '[[meter]]\nname = "m"\nsigma_relative = 0.01\n' + "".join(
                               f'[[reading]]\nlight = "k"\nmeter = "m"\ndistance_m = {d}\nilluminance_lx = {1000 / d**2}\n'
                               for d in (1, 2, 4)))
        flux = answer("fit", session)["lights"][0]["flux_lm"]
        held = 0
        for _ in range(400):
            half = np.radians(beam / 2) * np.exp(chance.normal(0, 0.1))
            n = math.log(0.5) / math.log(math.cos(half))
            cosine = np.cos(theta) ** n
            lobes = np.array([theta < half, cosine, 2 ** -((theta / half) ** 2), cosine])
            steradians = 2 * np.pi * np.sum(lobes * np.sin(theta), axis=1) * (theta[1] - theta[0])
            steradians[3] *= 1.5  # it spills a third of its light
            held += flux["low95"] <= 1000 * steradians @ chance.dirichlet(np.ones(4)) <= flux["high95"]
        print(f"beam {beam}: {flux['value']:.3g} lm, {flux['low95']:.3g} to {flux['high95']:.3g}; {held} of 400 held")
        assert 0.93 <= held / 400, (beam, held)


def the_beam_of_a_lambertian_face_is_lamberts():
    bare = answer("quick", "--lumens", 4000, "--size", "60x60cm", "--fixture", "panel")["lights"][0]
    light = answer("quick", "--lumens", 4000, "--size", "60x60cm", "--fixture", "panel", "--kind", "rect",
                   "--beam", 120)["lights"][0]
    assert abs(light["intensity_cd"]["value"] - 4000 / math.pi) < 0.5, light["intensity_cd"]
    assert abs(light["intensity_cd"]["u95"] / bare["intensity_cd"]["u95"] - 1) < 0.01, light["intensity_cd"]
    assert abs(light["luminance_nits"]["value"] * 0.36 * math.pi / light["flux_lm"]["value"] - 1) < 1e-3, light
    # Narrower: cos^n that halves at 45 degrees is cos^2, 2 pi/3 sr; surer than a beam of any shape.
    narrow = answer("quick", "--lumens", 4000, "--size", "60x60cm", "--kind", "rect", "--beam", 90)["lights"][0]
    assert abs(narrow["intensity_cd"]["value"] * 2 * math.pi / 3 / 4000 - 1) < 1e-3, narrow["intensity_cd"]
    spread = [one["intensity_cd"]["u95"] / one["intensity_cd"]["value"] for one in (bare, narrow)]
    assert 1.02 * spread[0] < spread[1] < 0.5, spread


PARTS = {"beams": (a_stated_beam_is_what_is_exported, that_it_is_drawn_is_said, a_stated_field_is_in_it_too,
                   an_outer_angle_carries_the_lumens, a_reading_on_the_axis_leaves_the_beam,
                   the_flux_of_a_read_beam_holds_angles_that_are_a_tenth_off),
         "faces": (the_beam_of_a_lambertian_face_is_lamberts,)}
for part in PARTS[sys.argv[2]]:
    part()
