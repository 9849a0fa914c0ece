#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `lightcal match` says at the ends of its world: the same lamp, lamps that cannot be brought
there, a target that is brighter, gel files of every form, names as people type them, refusals.

    match_command.py LIGHTCAL
"""
import base64
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/tools"))
import match_world as world  # noqa: E402
import numpy as np  # noqa: E402
from built_command import HOME, answer, refused, run  # noqa: E402

SPECTRA = ROOT / "sample_data/spectra/uprtek_cv600"
YUJI, NICHIA = SPECTRA / "Yuji 5000K.xls", SPECTRA / "Nichia 80 CRI.xls"


def gel_file(name, text):
    (HOME / name).write_text(text, encoding="utf-8")
    return name


def the_same_lamp_needs_no_gel():
    best = answer("match", YUJI, "--to", YUJI)["matches"][0]
    assert best["gels"] == [] and best["delta_uv"] == 0 and best["stops_lost"] == 0, best
    assert best["delta_e"]["observer"] < 1e-9 and abs(best["ssi"] - 100) < 1e-9
    # Two readings by meters are never surely the same.
    assert 0.2 < best["high95"]["delta_e"]["observer"] < 5
    assert best["dimmer_stops"] == 0 and 0.05 < best["u95"]["dimmer_stops"] < 0.2


def what_gels_cannot_do_is_refused_with_the_nearest():
    magenta = "wavelength_nm,relative\n" + "".join(
        f"{nm},{0.05 + (nm < 480) + (nm > 600)}\n" for nm in range(380, 781, 5))
    error = refused("unreachable", "match", "gaussian:530:12", "--to",
                    gel_file("magenta.csv", magenta), says=r"nearest is .* leaves 0\.\d+")
    assert "light away" in error["message"]
    assert answer("match", "gaussian:530:12", "--to", "magenta.csv", "--reach", "1")["matches"]


def every_match_is_within_reach():
    words = ("match", NICHIA, "--to", "illuminant:A", "-n", 40)
    all_of_them = answer(*words, "--reach", 1)["matches"]
    least = min(m["delta_uv"] for m in all_of_them)
    reach = 1.01 * max(least, .004)
    assert any(m["delta_uv"] > reach for m in all_of_them), "the reach leaves some out"
    near = answer(*words, "--reach", reach)["matches"]
    assert near and all(m["delta_uv"] <= reach for m in near), near


def a_spectrum_of_another_colour_than_the_lamp_is_warned_of():
    lamp = ROOT / "sample_data/lights/desk_lamp_june.json"
    light = json.loads(lamp.read_text())["lights"][0]  # of 2860 +- 103 K
    words = ("match", lamp, "--light", light["name"], "--to", "illuminant:D55", "--reach", 1)
    for spectrum, told in (("illuminant:D65", 1), ("illuminant:A", 0)):
        warnings = answer(*words, "--spectrum", spectrum).get("warnings", [])
        assert [w["code"] for w in warnings].count("color_disagrees") == told, warnings



def a_target_brighter_than_the_lamp_costs_negative_stops():
    dim = NICHIA.read_bytes().decode("latin-1")
    lines = []
    for line in dim.splitlines():
        cells = line.split("\t")
        if re.fullmatch(r"\d+nm", cells[0]) or cells[0] in ("LUX", "fc", "X", "Y", "Z"):
            cells[1] = f"{float(cells[1]) / 4:.6f}"
        lines.append("\t".join(cells))
    (HOME / "dim.xls").write_text("\r\n".join(lines), encoding="latin-1")
    document = answer("match", HOME / "dim.xls", "--to", NICHIA)
    assert abs(document["matches"][0]["dimmer_stops"] + 2) < 1e-3, document["matches"][0]
    assert [w["code"] for w in document["warnings"]].count("lamp_too_weak") == 1


def gels_as_makers_write_them():
    nm = list(range(400, 701, 10))
    values = [round(.9 * (0.3 + 0.7 * (n - 400) / 300), 4) for n in nm]
    row = gel_file("row.csv", "filter,name," + ",".join(f"{n}nm" for n in nm) + "\nL204,Full C.T. "
                   "Orange," + ",".join(map(str, values)) + "\n")
    percent = gel_file("percent.csv", "wavelength_nm;L204 transmittance_percent\n" +
                       "".join(f"{n};{100 * v}\n" for n, v in zip(nm, values)))
    spdx = gel_file("gel.spdx", '<?xml version="1.0"?><IESTM2714><Header><Description>L204'
                    "</Description></Header><SpectralDistribution><SpectralQuantity>transmittance"
                    "</SpectralQuantity>" + "".join(
                        f'<SpectralData wavelength="{n}">{v}</SpectralData>'
                        for n, v in zip(nm, values)) + "</SpectralDistribution></IESTM2714>")
    figures = [answer("match", "illuminant:D55", "--to", "illuminant:D40", "--gels", file, "--reach",
                      1, "-n", 200)["matches"] for file in (row, percent, spdx)]
    assert len(figures[0]) >= 2
    for other in figures[1:]:
        for a, b in zip(figures[0], other):
            assert a["gels"] == b["gels"] and abs(a["cct_K"] - b["cct_K"]) < 1e-6, (a, b)
    refused("units_ambiguous", "match", "3200K", "--to", "5600K", "--gels",
            gel_file("unit.csv", (HOME / percent).read_text().replace("_percent", "")),
            says="percent")
    refused("bad_gels", "match", "3200K", "--to", "5600K", "--gels",
            gel_file("narrow.csv", "filter,500nm,510nm\nX1,.5,.5\n"), says="450 to 650")
    refused("bad_gels", "match", "3200K", "--to", "5600K", "--gels",
            gel_file("negative.csv", "filter,400nm,700nm\nX1,-.5,.5\n"), says="between 0 and 1")
    refused("bad_gels", "match", "3200K", "--to", "5600K", "--gels",
            gel_file("twice.csv", "filter,400nm,700nm\nX1,.5,.5\nX1,.5,.5\n"), says="twice")


def an_unknown_range_widens_the_interval():
    nm = list(range(380, 781, 5))
    def write(name, first, last):
        kept = [n for n in nm if first <= n <= last]
        return gel_file(name, "filter," + ",".join(f"{n}nm" for n in kept) + "\nX1," +
                        ",".join(f"{.15 + .7 * (n - 380) / 400:.3f}" for n in kept) + "\n")
    def u95(file):
        words = ["match", "illuminant:D65", "--to", "3200K", "--gels", file, "-n", 9, "--reach", 1,
                 "--gel-spread", "0.01%"]
        return next(m for m in answer(*words)["matches"] if m["gels"] == ["X1"])["u95"]
    whole, cut = u95(write("whole.csv", 380, 780)), u95(write("cut.csv", 430, 660))
    assert whole["cct_K"] < 3 and cut["cct_K"] > 20 * whole["cct_K"], (whole, cut)


def cameras_are_found_and_their_matrix_stays_with_the_target():
    refused("unknown_camera", "match", "3200K", "--to", "5600K", "--camera", "Nikkon D850",
            says="Nikon D850")
    refused("ambiguous_camera", "match", "3200K", "--to", "5600K", "--camera", "canon 5d",
            says="Mark IV")
    run("match", "3200K", "--to", "5600K", "--camera", "nowhere.json", code=3)
    document = answer("match", NICHIA, "--to", "illuminant:A", "--camera", "all", "--reach", 1)
    assert document["cameras"] >= 51
    # A camera that was balanced anew on each lamp would see little of 2000 K.
    assert document["unfiltered"]["delta_e"]["camera"] > 15
    best = document["matches"][0]
    assert best["low95"]["delta_e"]["camera"] <= best["delta_e"]["camera"]
    assert best["delta_e"]["camera"] <= best["delta_e"]["camera_worst"]


def a_lamp_behind_a_gel_in_color_and_quick():
    nm = list(range(400, 701, 10))
    values = [round(.2 + .6 * (n - 400) / 300, 4) for n in nm]
    file = gel_file("warm.csv", "filter,name," + ",".join(f"{n}nm" for n in nm) + "\nL204,Full C.T. "
                    "Orange," + ",".join(map(str, values)) + "\n")
    through = world.fine(world.at_nodes(nm, values))
    light = world.uprtek(NICHIA)
    passed = world.xyz(light * through)[1] / world.xyz(light)[1]
    x, y, _ = world.xyz(light * through) / world.xyz(light * through).sum()
    one = answer("color", "--spectrum", NICHIA, "--through", f"{file}:full cto")
    assert one["through"]["gels"] == ["L204"]
    assert abs(one["through"]["Y_percent"]["value"] / 100 - passed) < 1e-5
    assert abs(one["xy"][0] - x) < 1e-5 and abs(one["xy"][1] - y) < 1e-5
    assert 0.3 < one["through"]["Y_percent"]["u95"] < 3
    plain = answer("color", "--spectrum", NICHIA)
    assert abs(one["illuminance_lx"] / plain["illuminance_lx"] - passed) < 1e-5
    twice = answer("color", "--spectrum", NICHIA, "--gels", file, "--through", "204+L204")
    assert twice["through"]["gels"] == ["L204", "L204"]
    refused("unknown_gel", "color", "--spectrum", NICHIA, "--through", f"{file}:L205", says="L204")
    # The lamp of quick: its candela and its presets behind the gel.
    reading = ("quick", "192lx@0.5m", "48lx@1m", "--room", "dark", "--cct", "4900K")
    bare = answer(*reading)["lights"][0]
    gelled = answer(*reading, "--gel", "L204", "--gels", file, "--spectrum", NICHIA, "--to", "gltf",
                    "-o", "presets")
    behind = gelled["lights"][0]
    assert abs(behind["intensity_cd"]["value"] / bare["intensity_cd"]["value"] - passed) < 1e-5
    assert behind["intensity_cd"]["u95"] / behind["intensity_cd"]["value"] > \
        bare["intensity_cd"]["u95"] / bare["intensity_cd"]["value"]
    assert abs(behind["color"]["xy"][0] - x) < 1e-5
    lamp = json.loads((HOME / "presets/light.gltf").read_text())
    shown = lamp["extensions"]["KHR_lights_punctual"]["lights"][0]["color"]
    assert shown[0] > shown[2], shown
    assert [w["code"] for w in answer(*reading, "--gel", "half cto")["warnings"]] == [
        "spectrum_assumed", "demonstration_gels"]


def two_dimmers_mix_to_the_target():
    warm = SPECTRA / "Philips Warm Glow 2200K.xls"
    mix = answer("match", NICHIA, "--with", warm, "--to", "3200K", "--reach", 1)
    a, b = world.uprtek(NICHIA), world.uprtek(warm)
    target = world.black_body(3200)
    def left(share):
        light = share * a / world.xyz(a)[1] + (1 - share) * b / world.xyz(b)[1]
        return world.observer(target).difference(light), light
    share = mix["share"]["value"]
    assert abs(left(share)[0] - mix["mixed"]["delta_e"]["observer"]) < 1e-6
    shares = np.linspace(0, 1, 201)
    best = shares[int(np.argmin([left(s)[0] for s in shares]))]
    assert abs(best - share) < 0.01, (best, share)
    # Both dimmers: the mix's shares in lux, one of them full.
    ea, eb = (683.002 * world.xyz(light)[1] for light in (a, b))
    da, db = mix["dimmer"]["lamp"]["value"], mix["dimmer"]["with"]["value"]
    assert abs(da * ea / (da * ea + db * eb) - share) < 1e-3 and abs(max(da, db) - 1) < 1e-9
    assert mix["share"]["low95"] < share < mix["share"]["high95"]
    refused("unreachable", "match", NICHIA, "--with", YUJI, "--to", "2500K", says="beside the line")


def the_gelled_lamp_and_the_sheet_are_written():
    words = ("match", NICHIA, "--to", "3200K", "--camera", "Nikon D850")
    document = answer(*words, "-o", "gelled.json", "--take", 2, "--plot", "sheet.svg")
    taken = document["matches"][1]
    light = json.loads((HOME / "gelled.json").read_text())["lights"][0]
    lux = answer("color", "--spectrum", NICHIA)["illuminance_lx"]
    assert abs(light["illuminance_lx"]["value"] / lux - 2**-taken["stops_lost"]) < 1e-9
    assert abs(light["color"]["cct_K"]["value"] - taken["cct_K"]) < 1e-6
    run("export", "gelled.json", "--to", "gltf,blender,json", "-o", "gelled")
    # The same behind a lamp whose candela are known.
    lamp = ROOT / "sample_data/lights/desk_lamp_june.json"
    run("match", lamp, "--to", "3200K", code=3)
    bare = json.loads(lamp.read_text())["lights"][0]
    answer("match", lamp, "--light", bare["name"], "--spectrum", NICHIA, "--to", "3200K", "-o",
           "desk.json")
    session = ROOT / "sample_data/sessions/three_real_lights"
    panel = answer("match", session, "--light", "led_panel_5000K", "--to", "3200K")
    assert 4900 < panel["unfiltered"]["cct_K"] < 5100, panel["unfiltered"]
    own = json.loads((HOME / "desk.json").read_text())["lights"][0]
    first = answer("match", NICHIA, "--to", "3200K")["matches"][0]
    assert abs(own["intensity_cd"]["value"] / bare["intensity_cd"]["value"] -
               2**-first["stops_lost"]) < 1e-9
    sheet = (HOME / "sheet.svg").read_text()
    # 40 patches of three stripes and an edge; a matched white shows as the screen's.
    assert len(re.findall(r'fill="#[0-9a-f]{6}"/>', sheet)) == 120 and "Nikon D850" in sheet
    fills = re.findall(r'<rect x="[^"]*" y="[^"]*" width="[^"]*" height="[^"]*" fill="(#\w+)"', sheet)
    assert fills[1] == "#ffffff" and fills[0] != "#ffffff", fills[:3]
    run(*words, "--plot", "sheet.jpg", code=2)
    run(*words, "-o", "x.json", "--take", 99, code=2)


def the_report_shows_what_a_camera_sees():
    session = ROOT / "sample_data/sessions/three_real_lights"
    words = ("report", session, "--match", "3200K", "--camera", "Nikon D850")
    run(*words, "-o", "seen.html", "--plot", "match=seen.svg")
    page, sheet = (HOME / "seen.html").read_text(), (HOME / "seen.svg").read_bytes()
    # The page carries the picture itself, of the one lamp whose spectrum was read.
    shown = re.findall(r'src="data:image/svg\+xml;base64,([^"]*)"', page)
    assert [base64.b64decode(one) for one in shown] == [sheet] and b"Nikon D850" in sheet
    run("match", session, "--light", "led_panel_5000K", "--to", "3200K", "--camera", "Nikon D850",
        "--reach", 1, "--plot", "same.svg")
    assert (HOME / "same.svg").read_bytes() == sheet
    run("report", session, "-o", "plain.html")
    assert "svg+xml;base64" not in (HOME / "plain.html").read_text()
    lamp = ROOT / "sample_data/lights/desk_lamp_june.json"
    refused("no_spectrum", "report", lamp, "--match", "3200K", "-o", "no.html", says="--spectrum")
    run("report", lamp, "--match", "3200K", "--spectrum", NICHIA, "-o", "own.html")


def the_answer_repeats_itself():
    words = ("match", NICHIA, "--to", "illuminant:A", "--camera", "Nikon D850", "--json")
    assert run(*words).stdout == run(*words).stdout


def what_is_not_there_is_said():
    run("match", "nothing.xls", "--to", "3200K", code=1)
    run("match", "3200K", code=2)
    assert "illuminant:D55" in run("match", "3200K", "--to", "D55", code=1).stderr
    demo = answer("match", "3200K", "--to", "5600K")
    assert demo["demonstration"] and demo["warnings"][0]["code"] == "demonstration_gels"
    run("match", "3200K", "--to", "5600K", "--strict", code=3)


if __name__ == "__main__":
    TESTS = [test for name, test in list(globals().items())
             if callable(test) and getattr(test, "__module__", "") == "__main__"
             and name not in ("run", "answer", "refused", "gel_file")]
    for test in TESTS:
        test()
    print(f"{len(TESTS)} tests")
    assert len(TESTS) >= 12
