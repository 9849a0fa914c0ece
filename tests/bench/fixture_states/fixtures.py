# SPDX-License-Identifier: Apache-2.0
"""Fixtures whose light and colour are known at every state of their controls, written without
lightcal: CIE 1931 matching functions (CIE table), Planck's law, and how such lamps dim.

  tungsten   flux ~ V^3.4 and CCT ~ flux^.12 (IES Lighting Handbook, 10th ed., 7.2), the dimmer's
             label being the voltage or a power of it, with a threshold
  pwm        light proportional to duty, which begins at some value or only above one
  current    a few per cent more efficacy and another phosphor's share at low current
  kinks      pieces of line, and a lamp that does not go out
  bicolour   two banks crossed or both full in the middle, each dimmed as above, colour drifting
  rgbw       red, green, blue and white mixed to each label by their largest white share
  scurve     what desks and fixtures call an S-curve, of no common equation: a smooth step, a raised
             cosine, a logistic or a part of one beside a straight line; read at two levels and full,
             or more
  log        equal steps, equal ratios: two to three decades (DALI's, IEC 62386-102), to zero or not
  gamma      a power of the label, 1.4 to 3
  knee       two pieces, the lower one half as steep: a bend as no driver of `kinks` has
  two        any law of these, read at full and one level
"""
import csv
import pathlib

import numpy as np

TABLE = (pathlib.Path(__file__).resolve().parents[3] /
         "lib/lightcal/colorimetry/cie_tables/cie_1931_2deg_cmf_1nm.csv")
ROWS = np.array([[float(cell) for cell in row]
                 for row in list(csv.reader(TABLE.open(encoding="utf-8")))[1:]])
NM, CMF = ROWS[:, 0], ROWS[:, 1:4]
C2 = 1.4388e7  # nm K

KINDS = ["tungsten", "pwm", "current", "kinks", "bicolour", "rgbw"]
APART = ["scurve", "log", "gamma", "knee", "two"]  # judged when asked for, so that the others keep their seeds


def planck(kelvin):
    xyz = CMF.T @ (NM**-5.0 / np.expm1(C2 / (NM * kelvin)))
    return xyz / xyz[1]


def band(nm, width):
    xyz = CMF.T @ np.exp(-0.5 * ((NM - nm) / width)**2)
    return xyz / xyz[1]


LOCUS_MIRED = np.linspace(90.0, 900.0, 4051)
LOCUS_UV = np.array([[4 * x, 6 * y] / (x + 15 * y + 3 * z)
                     for x, y, z in (planck(1e6 / m) for m in LOCUS_MIRED)])


def cct_of(xyz):
    """Of the point of the locus nearest in CIE 1960 uv."""
    x, y, z = xyz
    uv = np.array([4 * x, 6 * y]) / (x + 15 * y + 3 * z)
    square = ((LOCUS_UV - uv)**2).sum(axis=1)
    i = int(np.clip(square.argmin(), 1, len(LOCUS_MIRED) - 2))
    a, b, c = square[i - 1:i + 2]
    step = LOCUS_MIRED[1] - LOCUS_MIRED[0]
    return 1e6 / (LOCUS_MIRED[i] + 0.5 * step * (a - c) / (a - 2 * b + c))


def uv60(xyz):
    return np.array([4 * xyz[0], 6 * xyz[1]]) / (xyz @ [1, 15, 3])


def mired_duv(xyz):
    kelvin = cct_of(xyz)
    off = uv60(xyz) - uv60(planck(kelvin))
    return 1e6 / kelvin, np.hypot(*off) * np.sign(off[1])


def of_mired_duv(mired, duv):
    """X, Y, Z of Y = 1."""
    here, there = uv60(planck(1e6 / mired)), uv60(planck(1e6 / (mired + 0.1)))
    along = (there - here) / np.hypot(*(there - here))
    u, v = here + duv * np.array([-along[1], along[0]]) * np.sign(along[0])
    return np.array([1.5 * u / v, 1.0, (4 - u - 10 * v) / (2 * v)])


def pieces(random, count, spread):
    at = np.concatenate([[0], np.sort(random.uniform(0.05, 0.95, count)), [1]])
    slopes = np.exp(random.normal(0, spread, count + 1))
    values = np.concatenate([[0], np.cumsum(slopes * np.diff(at))])
    return lambda x: np.interp(x, at, values / values[-1])


def dimmed(random, kind):
    """-> light of a dimmer 0 ... 1, and how its colour follows: kelvin times 1 + this * ln light."""
    if kind == "pwm":
        offset = random.uniform(-0.04, 0.08)
        return lambda d: offset + (1 - offset) * d, random.normal(0, 0.002)
    if kind == "current":
        offset, power = random.uniform(-0.04, 0.08), random.uniform(0.88, 1.0)
        return lambda d: max(offset + (1 - offset) * d, 1e-4)**power, random.normal(0, 0.01)
    if kind == "scurve":
        steep, line, start = random.uniform(5, 9), random.uniform(0, 0.3), random.uniform(0, 0.04)
        low, high = 1 / (1 + np.exp(steep / 2)), 1 / (1 + np.exp(-steep / 2))
        step = [lambda d: d * d * (3 - 2 * d), lambda d: 0.5 - 0.5 * np.cos(np.pi * d),
                lambda d: (1 / (1 + np.exp(-steep * (d - 0.5))) - low) / (high - low),
                lambda d: line * d + (1 - line) * d * d * (3 - 2 * d)][random.integers(4)]
        return lambda d: step(max(d - start, 0) / (1 - start)), random.normal(0, 0.002)
    if kind == "two":
        return dimmed(random, ["pwm", "gamma", "log", "kinks", "scurve", "knee"][random.integers(6)])
    if kind == "log":
        decades, to_zero = random.uniform(2, 3.2), random.random() < 0.3
        k = decades * np.log(10)
        law = (lambda d: np.expm1(k * d) / np.expm1(k)) if to_zero else lambda d: np.exp(k * (d - 1))
        return law, random.normal(0, 0.002)
    if kind == "gamma":
        power = random.uniform(1.4, 3)
        return lambda d: d**power, random.normal(0, 0.002)
    if kind == "knee":
        at, slope = random.uniform(0.1, 0.4), random.uniform(0.4, 0.8)
        return lambda d: np.interp(d, [0, at, 1], [0, at * slope, 1]), random.normal(0, 0.002)
    curve, floor = pieces(random, random.integers(1, 4), 0.15), random.uniform(0, 0.06)
    return lambda d: floor + (1 - floor) * curve(d), random.normal(0, 0.002)


def mixed(random, kind):
    """-> XYZ at full of a label in kelvin, and a factor on the emitters' kelvin."""
    if kind == "bicolour":
        warm, cool = random.uniform(2600, 3300), random.uniform(5300, 7000)
        flux_warm, flux_cool = random.uniform(0.6, 1.1), random.uniform(0.7, 1.2)
        crossed, bend = random.random() < 0.5, random.uniform(0.85, 1.15)

        def of_label(kelvin, drift):
            u = np.clip((1e6 / 2700 - 1e6 / kelvin) / (1e6 / 2700 - 1e6 / 6500), 0, 1)**bend
            a, b = (1 - u, u) if crossed else (min(1, 2 * (1 - u)), min(1, 2 * u))
            return a * flux_warm * planck(warm * drift) + b * flux_cool * planck(cool * drift)
        return of_label
    shift = random.uniform(-4, 4)
    emitters = np.array([0.5 * band(625 + shift, 9), 1.1 * band(525 + shift, 14),
                         0.12 * band(455 + shift, 10), 2.0 * planck(random.uniform(5000, 6500))]).T
    error = np.exp(random.normal(0, 0.03, 4))

    def of_rgbw(kelvin, drift):
        target = planck(kelvin * drift)
        # As much white as leaves red, green and blue at or above 0.
        least, most = 0.0, 1.0
        colors = np.linalg.inv(emitters[:, :3])
        white = emitters[:, 3] / emitters[1, 3]
        for _ in range(40):
            share = 0.5 * (least + most)
            ok = (colors @ (target - share * white) >= 0).all()
            least, most = (share, most) if ok else (least, share)
        amounts = np.append(colors @ (target - least * white), least / emitters[1, 3])
        amounts = np.maximum(amounts, 0)
        return emitters @ (amounts / amounts.max() * error)
    return of_rgbw


class Fixture:
    """xyz(dimmer in percent, label in kelvin or None), read_at: the states a person would read."""

    def __init__(self, random, kind):
        self.kind, self.colored = kind, kind in ("bicolour", "rgbw")
        if kind == "tungsten":
            kelvin, power = random.uniform(2900, 3250), 3.4 + random.normal(0, 0.1)
            label = 1.0 if random.random() < 0.5 else random.uniform(1, 2)
            offset, exponent = random.uniform(-0.05, 0.05), 0.12 + random.normal(0, 0.006)

            def xyz(dimmer, _):
                volts = max(offset + (1 - offset) * dimmer / 100, 1e-3)**label
                return volts**power * planck(kelvin * volts**(power * exponent))
        elif self.colored:
            of_label = mixed(random, kind)
            light, drift = dimmed(random, random.choice(["pwm", "current", "kinks"]))

            def xyz(dimmer, label):
                y = max(light(dimmer / 100), 1e-4)
                return y * of_label(label, 1 + 0.4 * drift * np.log(y))
        else:
            kelvin = random.uniform(2700, 6500)
            light, drift = dimmed(random, kind)

            def xyz(dimmer, _):
                y = max(light(dimmer / 100), 1e-4)
                return y * planck(kelvin * (1 + drift * np.log(y)))
        self.xyz = xyz
        levels = [85, 75, 65, 55, 45, 38, 32, 27] if kind == "tungsten" else [
            75, 50, 35, 25, 18, 12, 8, 5]
        fewest = {"scurve": 2, "log": 2, "gamma": 2, "knee": 2}.get(kind, 4)
        count = 1 if kind == "two" else int(random.integers(fewest, len(levels) + 1))
        self.levels = sorted([100] + list(random.choice(levels, count, replace=False)))
        self.labels = [None]
        self.read_at = [(level, None) for level in self.levels]
        if self.colored:
            all_labels = [2700, 3200, 3800, 4300, 5000, 5600, 6500]
            self.labels = sorted(random.choice(all_labels, int(random.integers(4, 7)),
                                               replace=False))
            middle = self.labels[len(self.labels) // 2]
            grid = random.random() < 0.5
            columns = self.labels[::2] if grid else [middle]
            self.read_at = sorted({(level, label) for level in self.levels for label in columns} |
                                  {(100, label) for label in self.labels})

    def asked(self, random):
        low = np.log(self.levels[0])
        dimmer = round(float(np.exp(random.uniform(low, np.log(100)))), 2)
        dimmer = min(max(dimmer, self.levels[0]), 100)
        label = None
        if self.colored:
            label = round(float(random.uniform(self.labels[0], self.labels[-1])))
        return dimmer, label
