#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Lamps read with a spectrometer at states of their controls: their emitters found, spectra between
states, and what was read in a .gdtf, judged by the spectra they were mixed of (numpy, the CIE's
table, zipfile, ElementTree). The spectrometer's noise is .2 % of each reading's rms.

    state_emitters.py LIGHTCAL
"""
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/tools"))
import numpy as np  # noqa: E402
from built_command import HOME, answer, refused, run  # noqa: E402

NM = np.arange(380.0, 780.5, 1.0)
TABLE = ROOT / "lib/lightcal/colorimetry/cie_tables/cie_1931_2deg_cmf_1nm.csv"
ROWS = np.array([[float(c) for c in row] for row in list(csv.reader(TABLE.open()))[1:]])
CMF = np.array([np.interp(NM, ROWS[:, 0], ROWS[:, k]) for k in (1, 2, 3)])


def band(nm, width):
    return np.exp(-0.5 * ((NM - nm) / width) ** 2)


def of_lux(spectrum, lux):
    return spectrum * lux / (683.002 * (CMF[1] * spectrum).sum())


WARM = of_lux(band(452, 10) * 0.25 + band(605, 55), 1.0)
COOL = of_lux(band(452, 10) + band(560, 55) * 0.75, 1.0)
GREEN = of_lux(band(525, 16), 1.0)


def bicolour(dimmer, cct_K):
    u = (1e6 / 2700 - 1e6 / cct_K) / (1e6 / 2700 - 1e6 / 6500)
    return (dimmer / 100) ** 1.1 * (900 * (1 - u) * WARM + 1100 * u * COOL)


def with_green(dimmer, cct_K, tint):
    return bicolour(dimmer, cct_K) + (dimmer / 100) ** 1.1 * 60 * tint * GREEN


# Red, green, blue and white of a mixing fixture.
RGBW = np.array([of_lux(band(628, 9), 1.0), of_lux(band(522, 15), 1.0), of_lux(band(452, 10), 1.0),
                 of_lux(band(455, 10) * 0.45 + band(565, 52), 1.0)])


def planck(kelvin):
    return NM**-5.0 / np.expm1(1.4388e7 / (NM * kelvin))


def mixed_white(dimmer, cct_K):
    """The colour of a black body with half of all the white that its red, green and blue allow."""
    target = CMF @ of_lux(planck(cct_K), 1.0)
    colors, white = np.linalg.inv((RGBW[:3] @ CMF.T).T), CMF @ RGBW[3]
    shares = np.linspace(0, 1, 4001)
    fits = [(colors @ (target - share * white) >= 0).all() for share in shares]
    white_share = 0.5 * shares[np.flatnonzero(fits)[-1]]
    amounts = np.append(colors @ (target - white_share * white), white_share)
    return 800 * (dimmer / 100) * amounts @ RGBW


def by_channel(red, green, blue, white):
    return 3.0 * np.array([red, green, blue, white]) @ (RGBW * np.array([[.6], [1.2], [.3], [2]]))


def told(controls):
    return ",".join(f"{name}={value:g}" for name, value in controls.items())


def session(name, lamp, states, seed=1, kept=None):
    """lamp(**controls) -> spectrum at 1 m. Of `kept` states alone the spectra, of all the light."""
    random = np.random.default_rng(seed)
    (HOME / name).mkdir()
    text = ('lightcal = 1\n[room]\ndark = true\n[[light]]\nname = "key"\nkind = "point"\n'
            '[[meter]]\nname = "m"\nsigma_relative = 0.02\n')
    for i, controls in enumerate(states):
        spectrum = lamp(**controls)
        noise = random.normal(0, 0.002 * np.sqrt((spectrum**2).mean()), NM.size)
        (HOME / name / f"{i}.csv").write_text("wavelength_nm,irradiance_W_m2_nm\n" + "".join(
            f"{nm:g},{value:.8e}\n" for nm, value in zip(NM, spectrum + noise)))
        for distance in (1.0, 2.0, 4.0) if i == 0 else (1.0,):
            lux = 683.002 * (CMF[1] * spectrum).sum() / distance**2
            x, y = (CMF @ spectrum)[:2] / (CMF @ spectrum).sum()
            read = (f'spectrum = "{i}.csv"\n' if kept is None or i in kept else
                    f'xy = [{x:.6f}, {y:.6f}]\ncolor_source = "spectrometer"\n')
            text += (f'[[reading]]\nlight = "key"\nmeter = "m"\ndistance_m = {distance}\n'
                     f"illuminance_lx = {lux:.8g}\n{read if distance == 1.0 else ''}"
                     f"state = {{ {told(controls).replace(',', ', ').replace('=', ' = ')} }}\n")
    (HOME / name / "session.toml").write_text(text)
    run("fit", name, "-o", f"{name}.json")


def told_at(name, **controls):
    return answer("state", f"{name}.json", "--at", told(controls))


def light_of(name):
    return json.loads((HOME / f"{name}.json").read_text())["lights"][0]


def on_bins(nm, spectrum):
    """Means over 5 nm, as an instrument of such bins reads them."""
    return np.array([spectrum[np.abs(NM - at) <= 2.0].mean() for at in nm])


def shape_error(spectrum, truth):
    """Largest difference over the truth's peak, both of one area."""
    values = np.array(spectrum["values"])
    bins = on_bins(spectrum["wavelengths_nm"], truth)
    return np.abs(values / values.sum() - bins / bins.sum()).max() / (bins / bins.sum()).max()


def held(spectrum, truth):
    """The part of wavelengths (with light) whose interval holds the truth, of one illuminance."""
    at, values = np.array(spectrum["wavelengths_nm"]), np.array(spectrum["values"])
    bins, y = on_bins(at, truth), np.interp(at, NM, CMF[1])
    bins = bins * (y @ values) / (y @ bins)
    lit = bins > 0.02 * bins.max()
    return (np.abs(values - bins) <= np.array(spectrum["u95"]))[lit]


def xy_of(spectrum):
    return (CMF @ spectrum)[:2] / (CMF @ spectrum).sum()


def two_emitters_are_found_and_mix_between():
    states = [(100, 5000)] + [(d, c) for d in (100, 50, 20) for c in (2700, 3800, 6500)]
    session("bicolour", bicolour, [dict(dimmer=d, cct_K=c)
                                   for d, c in states + [(50, 5000), (20, 5000)]])
    for controls in (dict(dimmer=100, cct_K=4300), dict(dimmer=33, cct_K=3200)):
        found, truth = told_at("bicolour", **controls), bicolour(**controls)
        assert found["emitters"]["found"] == 2, found["emitters"]
        assert found["emitters"]["residual"] < 0.005
        assert shape_error(found["spectrum"], truth) < 0.03, shape_error(found["spectrum"], truth)
        assert held(found["spectrum"], truth).mean() > 0.9
        # Its light is the state's own, W m-2 nm-1 at 1 m.
        at = np.array(found["spectrum"]["wavelengths_nm"])
        lux = 683.002 * 5 * (np.interp(at, NM, CMF[1]) * found["spectrum"]["values"]).sum()
        assert abs(lux / found["intensity_cd"]["value"] - 1) < 0.01, lux
        assert abs(sum(found["emitters"]["shares"]) - 1) < 1e-9
    # As it was read, where it was read.
    found = told_at("bicolour", dimmer=50, cct_K=3800)
    assert found["basis"] == "measured"
    assert shape_error(found["spectrum"], bicolour(50, 3800)) < 0.01
    words = run("state", "bicolour.json", "--at", "dimmer=50,cct_K=4100").stdout
    assert "a mixture of 2 emitters, told by the spectra of 12 states" in words, words
    # Read at its two ends they are its banks.
    for emitter, bank in zip(sorted(light_of("bicolour")["emitters"]["found"],
                                    key=lambda one: one["purest"]["cct_K"]), (WARM, COOL)):
        assert emitter["purest_share"] > 0.98, emitter["purest_share"]
        grid = light_of("bicolour")["emitters"]["wavelengths_nm"]
        error = shape_error({"wavelengths_nm": grid, "values": emitter["values"]}, bank)
        assert error < 0.02, error


def a_third_is_found_only_in_spectra():
    states = [(100, 5000, 0)] + [(100, c, t) for c in (2700, 3800, 6500) for t in (0, 0.5, 1)]
    session("tinted", with_green, [dict(dimmer=d, cct_K=c, tint=t)
                                   for d, c, t in states + [(100, 5000, 1)]])
    found = told_at("tinted", dimmer=100, cct_K=4300, tint=0.25)
    assert found["emitters"]["found"] == 3, found["emitters"]
    truth = with_green(100, 4300, 0.25)
    assert shape_error(found["spectrum"], truth) < 0.05, shape_error(found["spectrum"], truth)
    assert np.abs(found["xy"] - xy_of(truth)).max() < 0.004, found["xy"]


def red_green_blue_and_white_mixed():
    labels = (2700, 3200, 3800, 4500, 5300, 6500)
    states = [dict(dimmer=100, cct_K=c) for c in labels] + [
        dict(dimmer=d, cct_K=c) for d in (50, 25, 10) for c in labels[::2]]
    session("rgbw", mixed_white, states, seed=4)
    emitters, ok = light_of("rgbw")["emitters"], []
    # None was shown alone, so they are known only as far as the states lie between them: what they
    # mix to is every spectrum between.
    columns = np.array([one["values"] for one in emitters["found"]])
    for cct in (2950, 3500, 4100, 4900, 5900):
        truth = on_bins(emitters["wavelengths_nm"], mixed_white(100, cct))
        amounts = np.linalg.lstsq(columns.T, truth, rcond=None)[0]
        left = truth - amounts @ columns
        # Twice what a reading may repeat within.
        assert np.sqrt((left**2).mean() / (truth**2).mean()) < 0.01
        for dimmer in (100, 35):
            found = told_at("rgbw", dimmer=dimmer, cct_K=cct)
            truth_there = mixed_white(dimmer, cct)
            error = shape_error(found["spectrum"], truth_there)
            ok += list(held(found["spectrum"], truth_there))
            assert error < 0.05, (cct, dimmer, error)
            assert np.abs(found["xy"] - xy_of(truth_there)).max() < 0.002, (cct, found["xy"])
    assert np.mean(ok) > 0.9, np.mean(ok)


def shown_alone_each_is_found_as_it_is():
    states = [dict(zip(("red", "green", "blue", "white"), levels)) for levels in (
        (100, 100, 100, 100), (100, 0, 0, 0), (0, 100, 0, 0), (0, 0, 100, 0), (0, 0, 0, 100),
        (50, 100, 0, 20), (30, 0, 80, 60), (100, 60, 10, 0))]
    session("channels", by_channel, states, seed=5)
    emitters = light_of("channels")["emitters"]
    assert len(emitters["found"]) == 4 and emitters["spectra"] == 8
    for name, truth in zip(("red", "green", "blue", "white"), RGBW):
        one = next(e for e in emitters["found"]
                   if e["purest"][name] == 100 and sum(e["purest"].values()) == 100)
        assert one["purest_share"] > 0.99, (name, one["purest_share"])
        error = shape_error({"wavelengths_nm": emitters["wavelengths_nm"],
                             "values": one["values"]}, truth)
        assert error < 0.015, (name, error)


def what_spectra_cannot_tell_is_refused():
    states = [dict(dimmer=100, cct_K=c) for c in (2700, 3400, 4400, 6500)]
    session("two", bicolour, states, kept=(0, 3))
    found = told_at("two", dimmer=100, cct_K=3800)
    assert "spectrum" not in found and found["cct_K"]["value"] > 3000
    words = run("state", "two.json", "--at", "dimmer=100,cct_K=3800").stdout
    assert "spectrum" in words and "not known" in words, words
    for name, code in (("two", "spectra_too_few"), ("none", "no_spectra")):
        if name == "none":
            session("none", bicolour, states, kept=())
        refused(code, "state", f"{name}.json", "--at", "dimmer=100,cct_K=3800", "--spectrum",
                "no.csv", says="spectr")
        assert not (HOME / "no.csv").exists()
    refused("usage", "state", "two.json", "--spectrum", "no.csv", says="--at", status=2)


def a_spectrum_between_is_a_file_for_what_takes_spectra():
    words = ("state", "bicolour.json", "--at", "dimmer=33,cct_K=3200", "--spectrum", "between.csv")
    assert "wrote between.csv" in run(*words).stdout
    found = told_at("bicolour", dimmer=33, cct_K=3200)
    told_color = answer("color", "--spectrum", "between.csv")
    assert abs(told_color["cct_K"] / found["cct_K"]["value"] - 1) < 0.003, told_color["cct_K"]
    assert abs(told_color["illuminance_lx"] / found["intensity_cd"]["value"] - 1) < 1e-6
    truth = xy_of(bicolour(33, 3200))
    assert np.abs(told_color["xy"] - truth).max() < 0.003
    run(*words)  # replaces its own
    (HOME / "mine.csv").write_text("mine\n")
    run(*words[:-1], "mine.csv", code=1)
    assert (HOME / "mine.csv").read_text() == "mine\n"


def gdtf_holds_the_spectra():
    run("export", "bicolour.json", "--to", "gdtf", "-o", "out")
    with zipfile.ZipFile(HOME / "out/bicolour-key.gdtf") as archive:
        xml = archive.read("description.xml")
    (HOME / "description.xml").write_bytes(xml)
    xmllint = shutil.which("xmllint")
    done = subprocess.run([xmllint, "--noout", "--nonet", "--schema",
                           ROOT / "sample_data/gdtf/gdtf.xsd", HOME / "description.xml"],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    emitters = {e.get("Name"): e for e in ElementTree.fromstring(xml).iter("Emitter")}
    assert sorted(emitters) == ["cct_K=2700", "cct_K=3800", "cct_K=5000", "cct_K=6500"], emitters
    read = answer("import", "out/bicolour-key.gdtf")["fixtures"][0]
    back = {e["name"]: e for e in read["emitters"]}
    for name, emitter in emitters.items():
        cct = int(name.split("=")[1])
        measured = {float(m.get("Physical")): m for m in emitter.iter("Measurement")}
        assert sorted(measured) == [20, 50, 100]
        for dimmer, measurement in measured.items():
            points = [(float(p.get("WaveLength")), float(p.get("Energy")))
                      for p in measurement.iter("MeasurementPoint")]
            candela = float(measurement.get("LuminousIntensity"))
            truth = bicolour(dimmer, cct)
            read_there = {"wavelengths_nm": [p[0] for p in points], "values": [p[1] for p in points]}
            assert shape_error(read_there, truth) < 0.01, (name, dimmer)
            lux = 683.002 * 5 * sum(np.interp(nm, NM, CMF[1]) * energy for nm, energy in points)
            assert abs(lux / candela - 1) < 0.01, "irradiance at 1 m of its candela"
            assert abs(candela / (683.002 * (CMF[1] * truth).sum()) - 1) < 0.02
            same = next(m for m in back[name]["measurements"] if m["physical_percent"] == dimmer)
            assert same["intensity_cd"] == candela
            assert same["wavelength_nm"] == [p[0] for p in points]
            assert same["energy"] == [p[1] for p in points]


def a_spectrum_that_is_none_is_refused():
    light = json.loads((HOME / "bicolour.json").read_text())
    light["lights"][0]["states"][0]["spectrum"]["values"].pop()
    (HOME / "short.json").write_text(json.dumps(light))
    refused("bad_light", "state", "short.json", says="spectrum")
    light = json.loads((HOME / "bicolour.json").read_text())
    light["lights"][0]["emitters"]["found"].pop()
    (HOME / "short.json").write_text(json.dumps(light))
    refused("bad_light", "state", "short.json", says="emitter")


if __name__ == "__main__":
    TESTS = [two_emitters_are_found_and_mix_between, a_third_is_found_only_in_spectra,
             red_green_blue_and_white_mixed, shown_alone_each_is_found_as_it_is,
             what_spectra_cannot_tell_is_refused,
             a_spectrum_between_is_a_file_for_what_takes_spectra,
             gdtf_holds_the_spectra, a_spectrum_that_is_none_is_refused]
    for test in TESTS:
        test()
    print(f"{len(TESTS)} tests")
