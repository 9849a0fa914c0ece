#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes sample_data/sessions/mixing_panel: a bicolour panel that nobody makes, read by an imagined
spectrometer at ten states of its controls. Needs numpy; seed fixed.

Two banks, blue-pumped phosphors of about 2800 and 6400 K, crossed in mired by the label; light goes with
the dimmer to the power 1.15. Noise .2 % of each spectrum's rms, 1 nm samples summed to 5 nm.
"""
import csv
import pathlib

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
OUT = ROOT / "sample_data/sessions/mixing_panel"
TABLE = ROOT / "lib/lightcal/colorimetry/cie_tables/cie_1931_2deg_cmf_1nm.csv"
NM = np.arange(378.0, 783.0)
STATES = [(100, 4300), (100, 2800), (100, 3500), (100, 5200), (100, 6400), (50, 4300), (25, 4300),
          (10, 4300), (25, 2800), (25, 6400)]
HEAD = """# SYNTHETIC: a bicolour panel that nobody makes, written by tests/tools/make_state_spectra.py.
# Read with a spectrometer 1 m away at ten states; what it mixes is found in their spectra:
#   lightcal state sample_data/sessions/mixing_panel --at dimmer=33,cct_K=3600 --spectrum there.csv
lightcal = 1
name = "Mixing panel"

[room]
dark = true

[[light]]
name = "panel"
kind = "point"

[[meter]]
name = "spectrometer"
sigma_relative = 0.02
"""


def band(nm, width):
    return np.exp(-0.5 * ((NM - nm) / width)**2)


def lux_of(spectrum):
    rows = np.array([[float(c) for c in row[:3]] for row in list(csv.reader(TABLE.open()))[1:]])
    return 683.002 * (np.interp(NM, rows[:, 0], rows[:, 2]) * spectrum).sum()


def of_lux(spectrum, lux):
    return spectrum * lux / lux_of(spectrum)


def main():
    random = np.random.default_rng(20)
    warm = of_lux(0.22 * band(451, 9) + band(608, 52) + 0.25 * band(540, 35), 900.0)
    cool = of_lux(0.95 * band(451, 9) + 0.72 * band(555, 55), 1100.0)
    (OUT / "spectra").mkdir(parents=True, exist_ok=True)
    text = HEAD
    for k, (dimmer, label) in enumerate(STATES):
        share = (1e6 / 2800 - 1e6 / label) / (1e6 / 2800 - 1e6 / 6400)
        there = (dimmer / 100)**1.15 * ((1 - share) * warm + share * cool)
        bins = there.reshape(-1, 5).mean(axis=1)
        bins = np.maximum(bins + random.normal(0, 0.002 * np.sqrt((bins**2).mean()), len(bins)), 0)
        name = f"spectra/{dimmer}_{label}K.csv"
        (OUT / name).write_text("wavelength_nm,irradiance_W_m2_nm\n" + "".join(
            f"{nm:g},{value:.4e}\n" for nm, value in zip(NM[2::5], bins)), encoding="utf-8")
        text += (f'\n[[reading]]\nlight = "panel"\nmeter = "spectrometer"\ndistance_m = 1\n'
                 f'spectrum = "{name}"\nstate = {{ dimmer = {dimmer}, cct_K = {label} }}\n')
        for distance in (2, 4) if k == 0 else ():
            lux = lux_of(there) / distance**2
            text += (f'\n[[reading]]\nlight = "panel"\nmeter = "spectrometer"\ndistance_m = {distance}\n'
                     f"illuminance_lx = {lux:.5g}\n"
                     f"state = {{ dimmer = {dimmer}, cct_K = {label} }}\n")
    (OUT / "session.toml").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
