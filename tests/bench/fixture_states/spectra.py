#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""How often the interval of a spectrum between states holds the truth, over fixtures mixed here in numpy
of two to four emitters (narrow bands, phosphors).

    spectra.py LIGHTCAL [FIXTURES [FIRST_SEED]]

Each is read by a spectrometer of 5 nm at labels of 4 to 7 colour temperatures and 3 to 5 levels; noise
.1 to .4 % of each reading's rms, scale 2 %. lightcal is asked four states between. Judged are the
wavelengths with light (2 % of the peak), of one illuminance; one fixture's miss together, so that the
share stands beside its standard error over fixtures. Fails under 90 % of 50 fixtures or more.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

import fixtures

NM = np.arange(380.0, 781.0, 5.0)
CMF = np.array([np.interp(NM, fixtures.NM, fixtures.CMF[:, k]) for k in range(3)])
KM5 = 683.002 * 5
LABELS = [2700, 3200, 3800, 4300, 5000, 5600, 6500]
LEVELS = [70, 50, 35, 25, 15, 10]
ASKED = 4


def band(nm, width):
    return np.exp(-0.5 * ((NM - nm) / width)**2)


def of_lux(spectrum, lux=1.0):
    return spectrum * lux / (KM5 * (CMF[1] @ spectrum))


def planck(kelvin):
    return of_lux(NM**-5.0 / np.expm1(fixtures.C2 / (NM * kelvin)))


class Mixer:
    def __init__(self, random):
        pump, shift = random.uniform(448, 458), random.uniform(-4, 4)
        warm = of_lux(random.uniform(.1, .3) * band(pump, 9) + band(random.uniform(595, 612), 52))
        cool = of_lux(random.uniform(.9, 1.4) * band(pump, 9) + band(random.uniform(548, 560), 55))
        self.kind = int(random.integers(2, 5))
        if self.kind == 2:
            self.emitters = np.array([warm, cool])
        else:
            leds = [of_lux(band(628 + shift, 9)), of_lux(band(524 + shift, 15)),
                    of_lux(band(456 + shift, 10))]
            self.emitters = np.array(leds + ([cool] if self.kind == 4 else []))
        self.flux = random.uniform(500, 1500)
        self.white, self.power = random.uniform(0.3, 1.0), random.uniform(0.9, 1.3)

    def spectrum(self, dimmer, label):
        level = self.flux * (dimmer / 100)**self.power
        if self.kind == 2:
            u = (1e6 / 2600 - 1e6 / label) / (1e6 / 2600 - 1e6 / 6800)
            return level * np.array([1 - u, u]) @ self.emitters
        target, colors = CMF @ planck(label), np.linalg.inv(CMF @ self.emitters[:3].T)
        share = 0.0
        if self.kind == 4:
            white = CMF @ self.emitters[3]
            shares = np.linspace(0, 1, 2001)
            fits = [(colors @ (target - s * white) >= 0).all() for s in shares]
            share = self.white * shares[np.flatnonzero(fits)[-1]]
            target = target - share * white
        amounts = np.append(colors @ target, share)[:self.kind]
        return level * np.maximum(amounts, 0) @ self.emitters


def session(fixture, random, folder):
    labels = sorted(random.choice(LABELS, int(random.integers(4, 8)), replace=False))
    levels = [100] + sorted(random.choice(LEVELS, int(random.integers(2, 5)), replace=False))
    middle = labels[len(labels) // 2]
    states = [(100, c) for c in labels] + [(d, middle) for d in levels[1:]]
    scale, noise = np.exp(random.normal(0, 0.017)), random.uniform(0.001, 0.004)
    text = ('lightcal = 1\n[room]\ndark = true\n[[light]]\nname = "lamp"\nkind = "directional"\n'
            '[[meter]]\nname = "m"\nsigma_relative = 0.02\n')
    for i, (dimmer, label) in enumerate(states):
        there = scale * fixture.spectrum(dimmer, label)
        there = there + random.normal(0, noise * np.sqrt((there**2).mean()), len(there))
        (folder / f"{i}.csv").write_text("wavelength_nm,irradiance_W_m2_nm\n" + "".join(
            f"{nm:g},{value:.6e}\n" for nm, value in zip(NM, there)), encoding="utf-8")
        text += (f'[[reading]]\nlight = "lamp"\nmeter = "m"\nspectrum = "{i}.csv"\n'
                 f"state = {{ dimmer = {dimmer}, cct_K = {label} }}\n")
    (folder / "session.toml").write_text(text, encoding="utf-8")
    return labels, min(levels)


def judge(lightcal, fixture, random, folder):
    labels, least = session(fixture, random, folder)
    subprocess.run([lightcal, "fit", folder, "-o", folder / "light.json", "--quiet", "--force"],
                   check=True, capture_output=True)
    held, errors, found = [], [], 0
    for _ in range(ASKED):
        dimmer = round(float(np.exp(random.uniform(np.log(least), np.log(100)))), 1)
        label = round(float(random.uniform(labels[0], labels[-1])))
        told = json.loads(subprocess.run(
            [lightcal, "state", folder / "light.json", "--at", f"dimmer={dimmer},cct_K={label}",
             "--json"], check=True, capture_output=True).stdout)
        if "spectrum" not in told:
            continue
        found = told["emitters"]["found"]
        truth = np.interp(told["spectrum"]["wavelengths_nm"], NM, fixture.spectrum(dimmer, label))
        values, y = np.array(told["spectrum"]["values"]), np.interp(
            told["spectrum"]["wavelengths_nm"], NM, CMF[1])
        truth = truth * (y @ values) / (y @ truth)
        lit = truth > 0.02 * truth.max()
        held.append(np.mean((np.abs(values - truth) <= told["spectrum"]["u95"])[lit]))
        errors.append(np.sqrt(((values - truth)**2).mean() / (truth**2).mean()))
    return found, held, errors


def main():
    lightcal = sys.argv[1]
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 100
    first = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    by_kind = {2: [], 3: [], 4: []}
    for seed in range(first, first + count):
        random = np.random.default_rng(seed)
        fixture = Mixer(random)
        with tempfile.TemporaryDirectory() as name:
            by_kind[fixture.kind].append(judge(lightcal, fixture, random, pathlib.Path(name)))
    print("emitters  fixtures  found (median)  unknown  held   s.e.   rms error, median and 95 %")
    every = sum(by_kind.values(), [])
    for kind, found in [*by_kind.items(), ("all", every)]:
        told = [one for one in found if one[1]]
        if not told:
            continue
        held = [np.mean(one[1]) for one in told]
        errors = np.concatenate([one[2] for one in told])
        print(f"{kind!s:8s} {len(found):9d} {np.median([one[0] for one in told]):15.0f} "
              f"{len(found) - len(told):8d} {np.mean(held):6.1%} "
              f"{np.std(held) / np.sqrt(len(held)):5.1%} {np.median(errors):8.2%} "
              f"{np.percentile(errors, 95):7.2%}")
    held = np.mean([np.mean(one[1]) for one in every if one[1]])
    if count >= 50 and held < 0.90:
        sys.exit(f"the interval of the spectrum held {held:.1%}")


if __name__ == "__main__":
    main()
