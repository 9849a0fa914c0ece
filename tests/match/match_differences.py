#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a match says of the difference of two lamps, judged by lamps whose truth is a closed form in
numpy: pairs of bicolour panels, every pair read by a meter of its own that is off in x, y and lux.

    match_differences.py LIGHTCAL [PAIRS [FIRST_SEED]]

A panel mixes two emitters (2700 K and 6500 K, each a little beside the locus) by the label, in pieces
of line over the mired, and is brightest in between. Its meter is .0015 off in x and y and 2.83 % in
lux, repeats within 2.5e-4 and 1 % (all 1 sigma).
"""
import pathlib
import sys
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/tools"))
import numpy as np  # noqa: E402
from built_command import HOME, answer, run  # noqa: E402
from match_world import CMF, black_body  # noqa: E402

PAIRS = int(sys.argv[2]) if len(sys.argv) > 2 else 16
SEED = int(sys.argv[3]) if len(sys.argv) > 3 else 1
EIGHT = 8
LABELS = (2700, 3300, 4000, 4800, 5600, 6500)
OFF_XY, OFF_LUX, REPEATS_XY, REPEATS_LUX = 0.0015, 0.0283, 2.5e-4, 0.01

LOCUS_MIRED = np.linspace(120.0, 420.0, 3001)
LOCUS = np.array([CMF.T @ black_body(1e6 / mired) for mired in LOCUS_MIRED])


def uv60(xyz):
    return np.array([4 * xyz[..., 0], 6 * xyz[..., 1]]).T / (xyz @ [1, 15, 3])[..., None]


LOCUS_UV = uv60(LOCUS)


def cct_of(xyz):
    """Of the point of the locus nearest in CIE 1960 uv."""
    square = ((LOCUS_UV - uv60(xyz[None])[0])**2).sum(axis=1)
    i = int(np.clip(square.argmin(), 1, len(square) - 2))
    a, b, c = square[i - 1:i + 2]
    step = LOCUS_MIRED[1] - LOCUS_MIRED[0]
    return 1e6 / (LOCUS_MIRED[i] + 0.5 * step * (a - c) / (a - 2 * b + c))


def beside_locus(kelvin, duv):
    """XYZ of Y = 1, duv beside the locus in CIE 1960 uv."""
    at = np.searchsorted(LOCUS_MIRED, 1e6 / kelvin)
    along = LOCUS_UV[at + 1] - LOCUS_UV[at - 1]
    u, v = LOCUS_UV[at] + duv * np.array([-along[1], along[0]]) / np.hypot(*along) * np.sign(along[0])
    x, y = np.array([3 * u, 2 * v]) / (2 * u - 8 * v + 4)
    return np.array([x / y, 1.0, (1 - x - y) / y])


def apart(a, b):
    """In u'v'."""
    return np.hypot(*((uv60(a[None]) - uv60(b[None]))[0] * [1, 1.5]))


def pieces(random, count, spread):
    """0 ... 1 onto 0 ... 1, of as many kinks."""
    at = np.concatenate([[0], np.sort(random.uniform(0.1, 0.9, count)), [1]])
    values = np.concatenate([[0], np.cumsum(np.exp(random.normal(0, spread, count + 1)) * np.diff(at))])
    return lambda x: np.interp(x, at, values / values[-1])


class Panel:
    def __init__(self, random):
        self.warm = beside_locus(2700, random.normal(0, 0.002))
        self.cool = beside_locus(6500, random.normal(0, 0.002))
        self.share, self.level = pieces(random, 3, 0.4), 1000 * random.uniform(0.9, 1.1)
        self.flux = random.normal(0, 0.06, 5)

    def xyz(self, label):
        t = (1e6 / label - 1e6 / 6500) / (1e6 / 2700 - 1e6 / 6500)
        lux = self.level * (1 + t * (1 - t) + np.interp(t, np.linspace(0, 1, 5), self.flux))
        t = self.share(t)
        return lux * (t * self.warm + (1 - t) * self.cool)


def reading(name, meter, xyz, label, off=(0.0, 0.0, 0.0)):
    x, y = xyz[:2] / xyz.sum() + off[:2]
    return (f'[[reading]]\nlight = "{name}"\nmeter = "{meter}"\n'
            f"illuminance_lx = {xyz[1] * np.exp(off[2]):.8g}\nxy = [{x:.7f}, {y:.7f}]\n"
            f'color_source = "spectrometer"\n'
            + (f"state = {{ cct_K = {label} }}\n" if label else ""))


def readings(random, name, meter, off, panel):
    return "".join(reading(name, meter, panel.xyz(label), label,
                           off + random.normal(0, [REPEATS_XY, REPEATS_XY, REPEATS_LUX]))
                   for label in LABELS)


def sessions():
    """The lamps a0 b0 p0 a1 b1 p1 ..., all of an index read by one meter; pi is ai at ASKED[i], with no
    controls and read once. Eight indices a session, whose lights pairsN.json holds."""
    panels = []
    for first in range(0, PAIRS, EIGHT):
        text, rows = "lightcal = 1\n[room]\ndark = true\n", ""
        for i in range(first, min(first + EIGHT, PAIRS)):
            random = np.random.default_rng(SEED + i)
            off = random.normal(0, [OFF_XY, OFF_XY, OFF_LUX])
            panels.append((Panel(random), Panel(random)))
            text += (f'[[meter]]\nname = "m{i}"\nsigma_relative = 0.03\n'
                     f"calibration_relative = {OFF_LUX}\n")
            for name in "abp":
                text += f'[[light]]\nname = "{name}{i}"\nkind = "directional"\n'
            for name, panel in zip("ab", panels[-1]):
                rows += readings(random, f"{name}{i}", f"m{i}", off, panel)
            repeats = random.normal(0, [REPEATS_XY, REPEATS_XY, REPEATS_LUX])
            rows += reading(f"p{i}", f"m{i}", panels[-1][0].xyz(ASKED[i]), None, off + repeats)
        folder = HOME / f"pairs{first // EIGHT}"
        folder.mkdir()
        (folder / "session.toml").write_text(text + rows)
        run("fit", folder, "-o", f"{folder}.json")
    return panels


# Every other target is a state that was read.
ASKED = [int(LABELS[i // 2 % 6] if i % 2 else np.random.default_rng(SEED + i).uniform(3000, 6000))
         for i in range(PAIRS)]
PANELS = sessions()


def match_words(i, lamp, target, *words):
    file = f"pairs{i // EIGHT}.json"
    return ("match", file, "--light", lamp, "--to", file, "--to-light", target, "--reach", 0.05, *words)


def judged(one, lamp, target, label):
    """Whether each interval holds what the two lamps truly differ by, and its half width."""
    there, wanted = lamp.xyz(one["state"]["cct_K"]), target.xyz(label)
    truth = {"delta_uv": apart(there, wanted), "delta_cct_K": cct_of(there) - cct_of(wanted),
             "dimmer_stops": np.log2(there[1] / wanted[1])}
    held = {key: one["low95"][key] <= value <= one["high95"][key] for key, value in truth.items()}
    return held, {key: one["u95"][key] for key in (*truth, "cct_K")}


def judged_pairs(targets):
    """Of each pair the best there is and the lamp as it is, and what is said of their errors."""
    def one(i):
        k = targets[i]
        target = [f"p{k}"] if i == k and i % 3 == 2 else [
            f"a{k}", "--to-state", f"cct_K={ASKED[i]}"]
        found = answer(*match_words(i, f"b{i}", *target))
        rows = [found["matches"][0], found["unfiltered"]]
        return [judged(row, PANELS[i][1], PANELS[k][0], ASKED[i]) for row in rows], rows
    with ThreadPoolExecutor(2) as pool:
        found = list(pool.map(one, range(len(targets))))
    judgements = [[one[0][kind] for one in found] for kind in (0, 1)]
    said = [row["common_error"] for _, rows in found for row in rows]
    shares = [{key: np.mean([one[0][key] for one in kind]) for key in kind[0][0]}
              for kind in judgements]
    widths = [{key: np.median([one[1][key] for one in kind]) for key in kind[0][1]}
              for kind in judgements]
    for share, width in zip(shares, widths):
        print({key: f"{share[key]:.1%} ±{width[key]:.2g}" for key in share}, f'{width["cct_K"]:.3g} K')
    return shares, widths, said


def what_one_meter_is_off_by_is_in_no_difference():
    shares, widths, said = judged_pairs(range(PAIRS))
    assert all(one == {"color": "cancels", "light": "cancels"} for one in said)
    # 16 of 95 %: 15.2 +- .9; what lies between states is held in more.
    for share in shares:
        assert all(held >= 0.87 for held in share.values()), share
    assert widths[0]["delta_cct_K"] < 0.75 * widths[0]["cct_K"], widths
    assert widths[0]["delta_uv"] < 0.0013 and widths[0]["dimmer_stops"] < 0.09, widths


def what_two_meters_are_off_by_is():
    some = min(PAIRS, 200 if PAIRS > 16 else 6)
    shares, widths, said = judged_pairs([i ^ 1 for i in range(some)])
    assert all(one == {"color": "counts", "light": "counts"} for one in said)
    assert all(held >= 0.75 for share in shares for held in share.values()), shares
    assert widths[0]["delta_cct_K"] > widths[0]["cct_K"], widths
    assert widths[0]["delta_uv"] > 0.002 and widths[0]["dimmer_stops"] > 0.12, widths


def a_lamp_is_matched_to_itself_by_itself():
    for label in (4000, 4444):
        found = answer(*match_words(0, "a0", "a0", "--to-state", f"cct_K={label}"))
        best = found["matches"][0]
        assert best["state"] == {"cct_K": label}, best
        assert best["delta_uv"] == 0 and best["delta_cct_K"] == 0 and best["dimmer_stops"] == 0, best
        assert max(best["u95"][key] for key in ("delta_uv", "delta_cct_K", "dimmer_stops")) < 1e-6
        assert best["u95"]["cct_K"] > 40, best  # by itself it is as unsure as it was
    said = run(*match_words(0, "a0", "a0", "--to-state", "cct_K=4444")).stdout
    assert 'one meter, "m0", read both' in said and "0 ± 0 K" in said, said
    other = run(*match_words(0, "a0", "b1", "--to-state", "cct_K=4444")).stdout
    assert 'read by "m1", the lamp by "m0"' in other, other


def nearest_in_colour_and_the_targets_own_cct():
    """Exact lamps beside the locus, brighter on one side: the nearest in u'v' and the line of one CCT,
    by every label there is."""
    labels = np.arange(2700, 6500, 5.0)
    off_nearest, off_cct, lamps, rows = [], [], [], ""
    for seed in range(max(8, PAIRS // 2)):
        random = np.random.default_rng(SEED + seed)
        lamps.append(Panel(random))
        lamps[-1].share, lamps[-1].flux = pieces(random, 1, 0.1), random.normal(0, 0.1, 5)
        lamps[-1].warm = beside_locus(2700, -random.uniform(0.002, 0.006))
        rows += f'[[light]]\nname = "lamp{seed}"\nkind = "directional"\n'
        rows += "".join(reading(f"lamp{seed}", "m", lamps[-1].xyz(label), label)
                        for label in np.linspace(2700, 6500, 20).round())
    (HOME / "exact").mkdir()
    (HOME / "exact/session.toml").write_text(
        'lightcal = 1\n[room]\ndark = true\n[[meter]]\nname = "m"\n' + rows)
    run("fit", "exact", "-o", "exact.json")

    def one(i):
        return lamps[i], [answer("match", "exact.json", "--light", f"lamp{i}", "--to", target,
                                 "--reach", 0.05) for target in ("4400K", "5600K")]
    with ThreadPoolExecutor(2) as pool:
        found = list(pool.map(one, range(len(lamps))))
    for lamp, answers in found:
        every = np.array([lamp.xyz(label) for label in labels])
        every_uv = uv60(every) * [1, 1.5]
        for each in answers:
            x, y = each["target"]["xy"]
            target = np.array([x / y, 1.0, (1 - x - y) / y])
            nearest = every[np.hypot(*(every_uv - uv60(target[None]) * [1, 1.5]).T).argmin()]
            here = lamp.xyz(each["matches"][0]["state"]["cct_K"])
            off_nearest.append((apart(here, nearest), cct_of(here) - cct_of(nearest),
                                cct_of(nearest) - cct_of(target)))
            if "same_cct" in each:
                same = lamp.xyz(each["same_cct"]["state"]["cct_K"])
                off_cct.append((cct_of(same) - cct_of(target), apart(same, target) - apart(here, target)))
    off, kelvin, geometry = np.transpose(off_nearest)
    print(f"from the nearest: {off.max():.2g} in u'v', {kelvin.mean():.0f} ± {kelvin.std():.0f} K; it from "
          f"the target's CCT {geometry.mean():.0f} ({geometry.min():.0f} … {geometry.max():.0f}) K")
    same, farther = np.transpose(off_cct)
    print(f"{len(same)} of {len(off)} at the target's CCT: within {np.abs(same).max():.0f} K, "
          f"{farther.mean():.2g} farther in u'v'")
    assert off.max() < 0.0005 + 0.0003, off.max()
    assert len(same) > len(off) / 2 and np.abs(same).max() < 30 and farther.min() > -1e-4


if __name__ == "__main__":
    TESTS = [what_one_meter_is_off_by_is_in_no_difference, what_two_meters_are_off_by_is,
             a_lamp_is_matched_to_itself_by_itself, nearest_in_colour_and_the_targets_own_cct]
    for test in TESTS:
        test()
    print(f"{len(TESTS)} tests")
