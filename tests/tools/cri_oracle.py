#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""CIE 13.3 colour rendering computed a second time, in numpy, from the CIE tables and nothing of
lightcal's code, and compared with what lightcal says of every tabulated illuminant.

usage: cri_oracle.py LIGHTCAL CIE_TABLES_FOLDER

Exact CCT (golden-section search of the nearest Planckian point, 360-830 nm at 1 nm), reference of
that temperature, plain sum over the lamp's own 5 nm wavelengths. Ra must agree within 0.1.
"""
import csv
import json
import pathlib
import subprocess
import sys

import numpy as np

C2_NM_K = 1.4388e7
ALLOWED_RA = 0.1
ALLOWED_R = 0.5


def table(path):
    with open(path, newline="", encoding="utf-8") as lines:
        rows = list(csv.reader(lines))
    return rows[0][1:], np.array([[float(cell) for cell in row] for row in rows[1:]])


class Tables:
    def __init__(self, folder):
        folder = pathlib.Path(folder)
        _, self.cmf = table(folder / "cie_1931_2deg_cmf_1nm.csv")
        _, self.day = table(folder / "cie_daylight_components_5nm.csv")
        _, tcs = table(folder / "cie_cri_14_test_samples_5nm.csv")
        _, r15 = table(folder / "jis_z_8726_r15_reflectance.csv")
        self.samples = np.hstack([tcs, r15[:, 1:]])
        self.lamp_names, self.lamps = table(folder / "cie_lamp_illuminants_5nm.csv")


def planck(kelvin, nm):
    return nm**-5.0 / np.expm1(C2_NM_K / (nm * kelvin))


def daylight(kelvin, nm, day):
    k = 1e3 / kelvin
    if kelvin <= 7000:
        x = ((-4.6070 * k + 2.9678) * k + 0.09911) * k + 0.244063
    else:
        x = ((-2.0064 * k + 1.9018) * k + 0.24748) * k + 0.237040
    y = -3 * x * x + 2.870 * x - 0.275
    m = 0.0241 + 0.2562 * x - 0.7341 * y
    weights = np.array([1, (-1.3515 - 1.7703 * x + 5.9114 * y) / m,
                        (0.0300 - 31.4424 * x + 30.0717 * y) / m])
    return np.interp(nm, day[:, 0], day[:, 1:] @ weights)


def uv(xyz):
    x, y, z = np.asarray(xyz).T
    return np.stack([4 * x, 6 * y], axis=-1) / (x + 15 * y + 3 * z)[..., None]


def exact_cct(colour, cmf):
    """1e6 / mired of the Planckian point nearest in CIE 1960 uv: grid, then golden section."""
    def distance(mired):
        return np.hypot(*(uv(planck(1e6 / mired, cmf[:, 0]) @ cmf[:, 1:]) - colour))

    grid = np.arange(30.0, 1001.0, 2.0)
    best = grid[np.argmin([distance(m) for m in grid])]
    low, high = best - 2.0, best + 2.0
    ratio = (np.sqrt(5) - 1) / 2
    while high - low > 1e-6:
        a, b = high - ratio * (high - low), low + ratio * (high - low)
        low, high = (low, b) if distance(a) < distance(b) else (a, high)
    return 1e6 / ((low + high) / 2)


def cri(nm, power, tables):
    cmf = np.stack([np.interp(nm, tables.cmf[:, 0], c) for c in tables.cmf[:, 1:].T])
    samples = np.stack([np.interp(nm, tables.samples[:, 0], s) for s in tables.samples[:, 1:].T])
    kelvin = exact_cct(uv(cmf @ power), tables.cmf)
    reference = planck(kelvin, nm) if kelvin < 5000 else daylight(kelvin, nm, tables.day)

    def render(light):
        k = 100 / (cmf[1] @ light)
        return k * cmf @ light, k * (samples * light) @ cmf.T

    def cd(c):
        u, v = c[..., 0], c[..., 1]
        return (4 - u - 10 * v) / v, (1.708 * v + 0.404 - 1.481 * u) / v

    (white_k, under_k), (white_r, under_r) = render(power), render(reference)
    (ck, dk), (cr, dr), (ci, di) = cd(uv(white_k)), cd(uv(white_r)), cd(uv(under_k))
    c, d = cr / ck * ci, dr / dk * di
    adapted = np.stack([10.872 + 0.404 * c - 4 * d, np.full_like(c, 5.520)], axis=-1)
    adapted = adapted / (16.518 + 1.481 * c - d)[:, None]

    def uvw(chromaticity, y):
        w = 25 * np.cbrt(y) - 17
        return np.column_stack([13 * w[:, None] * (chromaticity - uv(white_r)), w])

    shift = uvw(adapted, under_k[:, 1]) - uvw(uv(under_r), under_r[:, 1])
    indices = 100 - 4.6 * np.linalg.norm(shift, axis=1)
    return kelvin, indices[:8].mean(), indices


def main():
    binary, folder = sys.argv[1:]
    tables = Tables(folder)
    worst_ra = worst_r = worst_kelvin = 0.0
    for column, name in enumerate(tables.lamp_names):
        kelvin, ra, indices = cri(tables.lamps[:, 0], tables.lamps[:, column + 1], tables)
        answer = json.loads(subprocess.run(
            [binary, "color", "--spectrum", "illuminant:" + name, "--json"],
            check=True, capture_output=True, text=True).stdout)
        off_ra = abs(answer["cri"]["Ra"] - ra)
        off_r = np.abs(np.array(answer["cri"]["R"]) - indices).max()
        if off_ra > ALLOWED_RA or off_r > ALLOWED_R:
            sys.exit(f"{name}: Ra {answer['cri']['Ra']} but the oracle says {ra}; "
                     f"the largest difference of R1-R15 is {off_r}")
        worst_ra, worst_r = max(worst_ra, off_ra), max(worst_r, off_r)
        worst_kelvin = max(worst_kelvin, abs(answer["cct_K"] - kelvin))
    print(f"{len(tables.lamp_names)} lamps: Ra within {worst_ra:.2g}, R1-R15 within {worst_r:.2g}, "
          f"CCT within {worst_kelvin:.2g} K of the oracle")
    if worst_kelvin > 0.01:
        sys.exit("CCT differs by more than 0.01 K")


if __name__ == "__main__":
    main()
