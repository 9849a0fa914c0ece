#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes sample_data/spectra/own: spectra computed here, in formats of which no free real file was found.

A Planckian radiator of 2856 K, scaled to 500 lx, as ArgyllCMS writes an ambient reading (380-730 nm
every 10/3 nm, mW m^-2 nm^-1), and as CSV with two lamps (2856 K at 500 lx, 6500 K at 250 lx; 1 nm).
"""
import csv
import math
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
C2_NM_K = 1.4388e7  # c2 of the CCT scale, CIE 15:2018
KM = 683.002        # lm/W


def v_lambda():
    with open(ROOT / "lib/lightcal/colorimetry/cie_tables/cie_1931_2deg_cmf_1nm.csv") as file:
        next(file)
        return {float(row[0]): float(row[2]) for row in csv.reader(file)}


def planck(nm, kelvin):
    return nm**-5 / math.expm1(C2_NM_K / (nm * kelvin))


def irradiance(wavelengths, step, kelvin, lux, table):
    """W m^-2 nm^-1 whose sum over the grid, step times K_m V(lambda) E, is `lux`."""
    def v(nm):
        low = math.floor(nm)
        part = nm - low
        return table[low] * (1 - part) + table[low + 1] * part if part > 1e-9 else table[low]

    raw = [planck(nm, kelvin) for nm in wavelengths]
    total = KM * step * sum(e * v(nm) for e, nm in zip(raw, wavelengths))
    return [e * lux / total for e in raw]


def write_argyll(path, table):
    bands, start, end = 106, 380.0, 730.0
    step = (end - start) / (bands - 1)
    wavelengths = [start + step * i for i in range(bands)]
    values = irradiance(wavelengths, step, 2856.0, 500.0, table)
    names = [f"SPEC_{round(nm):03d}" for nm in wavelengths]
    with open(path, "w") as file:
        file.write('SPECT  \n\nDESCRIPTOR "Argyll Spectral power/reflectance information"\n')
        file.write('ORIGINATOR "Argyll CMS"\nCREATED "Sat Nov 21 12:00:00 2026"\n')
        file.write('KEYWORD "MEAS_TYPE"\nMEAS_TYPE "AMBIENT"\n')
        for key, value in (("BANDS", f"{bands}"), ("START_NM", f"{start:f}"),
                           ("END_NM", f"{end:f}"), ("NORM", f"{1.0:f}")):
            file.write(f'KEYWORD "SPECTRAL_{key}"\nSPECTRAL_{key} "{value}"\n')
        file.write(f"\nNUMBER_OF_FIELDS {bands}\nBEGIN_DATA_FORMAT\n{' '.join(names)} \n")
        file.write("END_DATA_FORMAT\n\nNUMBER_OF_SETS 1\nBEGIN_DATA\n")
        file.write(" ".join(f"{1e3 * value:.6f}" for value in values) + " \nEND_DATA\n")


def write_csv(path, table):
    wavelengths = [float(nm) for nm in range(380, 781)]
    warm = irradiance(wavelengths, 1.0, 2856.0, 500.0, table)
    cold = irradiance(wavelengths, 1.0, 6500.0, 250.0, table)
    with open(path, "w") as file:
        file.write("# Planckian radiators computed by tests/tools/make_own_spectra.py\n")
        file.write("wavelength_nm,warm irradiance_mW_m2_nm,cold irradiance_uW_cm2_nm\n")
        for nm, a, b in zip(wavelengths, warm, cold):
            file.write(f"{nm:g},{1e3 * a:.7g},{1e2 * b:.7g}\n")


def main():
    table = v_lambda()
    out = ROOT / "sample_data/spectra/own"
    out.mkdir(exist_ok=True)
    write_argyll(out / "argyll_ambient_2856K_500lx.sp", table)
    write_csv(out / "planck_2856K_6500K.csv", table)


if __name__ == "__main__":
    main()
