# SPDX-License-Identifier: Apache-2.0
"""Lights, gels, cameras and colour differences written a second time, in numpy, from the CIE's tables
and the papers, and from nothing of lightcal's code: the world that `lightcal match` is judged in.
"""
import csv
import json
import os
import pathlib
import re
import xml.etree.ElementTree

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # small products: threads only spin
import numpy as np  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLES = ROOT / "lib/lightcal/colorimetry/cie_tables"
CAMERAS = ROOT / "sample_data/camera_sensitivities"
NM = np.arange(380, 781.0)
NODES = np.arange(380, 781.0, 5)


def table(name):
    with open(TABLES / name, newline="", encoding="utf-8") as lines:
        rows = list(csv.reader(lines))
    return rows[0][1:], np.array([[float(cell) for cell in row] for row in rows[1:]])


_, _CMF = table("cie_1931_2deg_cmf_1nm.csv")
CMF = _CMF[(_CMF[:, 0] >= 380) & (_CMF[:, 0] <= 780), 1:]


def sprague(step, values):
    """Fifth-order interpolation of equally spaced values to whole nanometres (CIE 167:2005)."""
    left = np.array([[884, -1960, 3033, -2648, 1080, -180], [508, -540, 488, -367, 144, -24]]) / 209
    before, after = left @ values[:6], (left @ values[::-1][:6])[::-1]
    y = np.concatenate([before, values, after])
    coefficients = np.array([[0, 0, 24, 0, 0, 0], [2, -16, 0, 16, -2, 0], [-1, 16, -30, 16, -1, 0],
                             [-9, 39, -70, 66, -33, 7], [13, -64, 126, -124, 61, -12],
                             [-5, 25, -50, 50, -25, 5]]) / 24
    out = []
    for i in range(len(values) - 1):
        a = coefficients @ y[i:i + 6]
        out += [sum(a[p] * (j / step)**p for p in range(6)) for j in range(step)]
    return np.array(out + [values[-1]])


def reflectances():
    """99 samples of CIE 224, sample 13 of CIE 13.3, sample 15 of JIS Z 8726, on NM."""
    _, cfi = table("cie_cfi_99_test_samples_5nm.csv")
    _, tcs = table("cie_cri_14_test_samples_5nm.csv")
    _, r15 = table("jis_z_8726_r15_reflectance.csv")
    rows = [sprague(5, cfi[:, 1 + i]) for i in range(99)]
    for whole in (tcs[:, [0, 13]], r15):
        rows.append(sprague(5, whole[:, 1])[int(380 - whole[0, 0]):][:401])
    return np.array(rows)


SAMPLES = reflectances()


# ---- lights, on NM ----

def black_body(kelvin, c2=1.4388e7, nm=NM):
    return nm**-5.0 / np.expm1(c2 / (nm * kelvin))


ILLUMINANT_A = black_body(2848.0, 1.435e7)


def daylight(kelvin, nm=NM):
    """CIE daylight: kelvin is the nominal temperature times 1.4388/1.4380."""
    t = kelvin
    x = (-4.6070e9 / t**3 + 2.9678e6 / t**2 + 0.09911e3 / t + 0.244063 if t <= 7000 else
         -2.0064e9 / t**3 + 1.9018e6 / t**2 + 0.24748e3 / t + 0.237040)
    y = -3 * x * x + 2.87 * x - 0.275
    m = 0.0241 + 0.2562 * x - 0.7341 * y
    m1 = round((-1.3515 - 1.7703 * x + 5.9114 * y) / m, 3)  # CIE 15:2018 4.1.2
    m2 = round((0.03 - 31.4424 * x + 30.0717 * y) / m, 3)
    _, day = table("cie_daylight_components_5nm.csv")
    s = day[:, 1] + m1 * day[:, 2] + m2 * day[:, 3]
    return np.interp(nm, day[:, 0], s)


D55 = daylight(5500 * 1.4388 / 1.4380)
BLUE = np.arange(375, 380.0)
A_BLUE = black_body(2848.0, 1.435e7, BLUE)
D55_BLUE = daylight(5500 * 1.4388 / 1.4380, BLUE)


def cie_lamp(name):
    """A lamp of the 5 nm tables as its plain 5 nm sum."""
    names, rows = table("cie_lamp_illuminants_5nm.csv")
    out = np.zeros(401)
    out[::5] = rows[:81, 1 + names.index(name)]
    return out


def uprtek(path):
    """A UPRtek export: W m-2 nm-1 on NM."""
    values = {}
    for line in open(path, encoding="latin-1"):
        cells = line.strip().split("\t")
        if len(cells) == 2 and cells[0].endswith("nm") and cells[0][:-2].isdigit():
            values[int(cells[0][:-2])] = float(cells[1]) / 1000
    return np.array([values[int(nm)] for nm in NM])


def sekonic(path):
    """A Sekonic CSV: its samples at every nanometre, on NM."""
    values = {}
    for line in open(path, encoding="utf-8-sig"):
        found = re.match(r"Spectral Data (\d+)\[nm\],([-+.\deE]+)", line)
        if found:
            values[int(found[1])] = float(found[2])
    return np.array([values[int(nm)] for nm in NM])


def tm27(path):
    """An IES TM-27 file: straight lines between its samples, dark beyond them."""
    rows = [(float(node.get("wavelength")), float(node.text))
            for node in xml.etree.ElementTree.parse(path).iter("{iestm2714}SpectralData")]
    return np.interp(NM, *np.array(rows).T, 0, 0)


def spectrum(path):
    path = pathlib.Path(path)
    return {".csv": sekonic, ".spdx": tm27}.get(path.suffix, uprtek)(path)


def camera(path):
    data = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    main = data["spectral_data"]["data"]["main"]
    nm = sorted(main, key=float)
    rows = np.array([main[each] for each in nm])
    return np.array([np.interp(NM, [float(each) for each in nm], rows[:, c], 0, 0)
                     for c in range(3)]).T


def cameras():
    return {path.name: camera(path) for path in sorted(CAMERAS.glob("*.json"))}


# ---- gels, at NODES ----

def at_nodes(nm, values):
    return np.interp(NODES, nm, values)


def fine(nodes):
    return np.interp(NM, NODES, nodes)


def read_gels(path):
    """A file with a row a filter: id -> (row, transmittance at NODES, known nodes)."""
    with open(path, newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    nm = [float(key[:-2]) for key in rows[0] if key.endswith("nm")]
    return {row["filter"]: (row, at_nodes(nm, [float(row[f"{n:g}nm"]) for n in nm]))
            for row in rows}, (NODES >= nm[0]) & (NODES <= nm[-1])


# ---- colours ----

def xyz(light):
    return light @ CMF


def uv76(light):
    X, Y, Z = xyz(light)
    d = X + 15 * Y + 3 * Z
    return np.array([4 * X / d, 9 * Y / d])


def cam02_ucs(colors, white):
    """J' a' b' of rows of XYZ, white of Y = 100; CIE 159:2004 and Luo et al. 2006, L_A = 100,
    Y_b = 20, average surround, D = 1."""
    cat = np.array([[.7328, .4296, -.1624], [-.7036, 1.6975, .0061], [.0030, .0136, .9834]])
    hpe = np.array([[.38971, .68898, -.07868], [-.22981, 1.18340, .04641], [0, 0, 1]])
    k = 1 / (5 * 100 + 1)
    fl = .2 * k**4 * 500 + .1 * (1 - k**4)**2 * 500**(1 / 3)
    n = .2
    nbb = .725 * (1 / n)**.2
    z = 1.48 + np.sqrt(n)

    def response(c):
        rgb = c @ cat.T * (100 / (white @ cat.T))
        p = rgb @ np.linalg.inv(cat).T @ hpe.T
        x = (fl * np.abs(p) / 100)**.42
        return np.sign(p) * 400 * x / (27.13 + x) + .1

    def achromatic(r):
        return (2 * r[..., 0] + r[..., 1] + r[..., 2] / 20 - .305) * nbb

    r = response(np.atleast_2d(colors))
    a = r[:, 0] - 12 * r[:, 1] / 11 + r[:, 2] / 11
    b = (r[:, 0] + r[:, 1] - 2 * r[:, 2]) / 9
    h = np.arctan2(b, a)
    et = .25 * (np.cos(h + 2) + 3.8)
    J = 100 * (np.maximum(achromatic(r), 0) / achromatic(response(white[None]))[0])**(.69 * z)
    total = r[:, 0] + r[:, 1] + 1.05 * r[:, 2]
    t = 50000 / 13 * nbb * et * np.hypot(a, b) / total
    M = t**.9 * np.sqrt(J / 100) * (1.64 - .29**n)**.73 * fl**.25
    Mp = np.log(1 + .0228 * M) / .0228
    return np.stack([1.7 * J / (1 + .007 * J), Mp * np.cos(h), Mp * np.sin(h)], 1)


class View:
    """A camera (401 x 3 sensitivities), or the 2 degree observer, set to a target."""

    def __init__(self, channels, target, matrix_of=None):
        colors = np.vstack([np.ones(401), SAMPLES])
        wanted = (colors * target) @ CMF
        wanted *= 100 / wanted[0, 1]
        raw = (colors * target) @ channels
        self.balance = 1 / raw[0]
        seen = raw * self.balance
        moved = seen
        if matrix_of is not None:  # the matrix of these channels instead
            seen = (colors * target) @ matrix_of
            seen = seen / seen[0]
        # Rows of M sum to the white: least squares in the two differences that are left.
        white = wanted[0]
        basis = np.stack([seen[1:, 0] - seen[1:, 2], seen[1:, 1] - seen[1:, 2]], 1)
        rest = wanted[1:] - seen[1:, 2:3] * white
        free, *_ = np.linalg.lstsq(basis, rest, rcond=None)
        self.matrix = np.vstack([free, white - free.sum(0)])
        self.white = white
        self.reference = cam02_ucs(moved[1:] @ self.matrix, white)
        # One product a light: [nanometre] x [white and samples, channel].
        self.weights = (colors.T[:, :, None] * (channels * self.balance)[:, None, :]).reshape(401, -1)

    def difference(self, light):
        seen = (light @ self.weights).reshape(-1, 3) @ self.matrix
        seen = seen[1:] * (self.white[1] / seen[0, 1])
        return float(np.linalg.norm(cam02_ucs(seen, self.white) - self.reference, axis=1).mean())


def observer(target):
    return View(CMF, target)


def ssi(test, reference, blue=None):
    """Holm et al. 2016, both on whole nanometres; blue: the reference over 375-379 nm."""
    bands = []
    for light, below in ((test, None), (reference, blue)):
        whole = np.concatenate([np.zeros(5) if below is None else below, light])  # from 375
        cells = (whole[:-1] + whole[1:]) / 2  # straight between samples
        if below is None:
            cells[:5] = 0  # and nothing before the first
        rows = cells[:300].reshape(30, 10).sum(1)
        bands.append(rows / rows.sum())
    d = (bands[0] - bands[1]) / (bands[1] + 1 / 30)
    w = np.ones(30)
    w[:5] = np.array([12, 22, 32, 40, 44]) / 45
    w[-2:] = [11 / 15, 3 / 15]
    s = np.convolve(np.concatenate([[0], d * w, [0]]), [.22, .56, .22])
    return 100 - 32 * np.sqrt((s**2).sum())


# ---- a batch of gels, as lib/lightcal/match/match_lights.h states its spread ----

def smooth_noise(rng, length_nm, count=1):
    apart = (NODES[:, None] - NODES[None]) / length_nm
    root = np.linalg.cholesky(np.exp(-apart**2 / 2) + 1e-9 * np.eye(len(NODES)))
    return rng.standard_normal((count, len(NODES))) @ root.T


def redrawn(nodes, points, rng, count):
    """`count` sheets of a gel whose batch varies by `points` (95 %)."""
    noise = smooth_noise(rng, 50.0, count)
    log = np.log(np.maximum(nodes, 1e-12))
    return np.clip(nodes + nodes * log * np.e * points / 1.959964 * noise, 0, 1)
