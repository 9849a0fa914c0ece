#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`lightcal match` against a search without short cuts in numpy, written from the tables and the papers
alone (tests/tools/match_world.py): 40 gels, 861 stacks, the eye, one camera and all of them.

    match_in_numpy.py LIGHTCAL
"""
import itertools
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/tools"))
import match_world as world  # noqa: E402
import numpy as np  # noqa: E402

LIGHTCAL = str(pathlib.Path(sys.argv[1]).resolve())
YUJI = ROOT / "sample_data/spectra/uprtek_cv600/Yuji 5000K.xls"
NICHIA = ROOT / "sample_data/spectra/uprtek_cv600/Nichia 80 CRI.xls"
CANON = ROOT / "sample_data/camera_sensitivities/Canon_EOS_5D_Mark_IV_380_780_5.json"


def forty_gels(seed):
    """Filters of one or two smooth absorptions, 405 to 700 nm, as catalogues print them."""
    rng = np.random.default_rng(seed)
    nm = np.arange(405, 701.0, 5)
    gels = {}
    for i in range(40):
        density = np.full(len(nm), 0.04)
        for _ in range(rng.integers(1, 3)):
            centre, width = rng.uniform(380, 720), rng.uniform(25, 90)
            density += rng.uniform(0.02, 0.5) * np.exp(-((nm - centre) / width)**2 / 2)
        gels[f"T{i:03d}"] = np.round(10**-density, 5)
    return nm, gels


def write_gels(path, nm, gels):
    lines = ["filter,name," + ",".join(f"{each:g}nm" for each in nm)]
    lines += [f"{name},Test {name}," + ",".join(f"{t:.5f}" for t in values)
              for name, values in gels.items()]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def match(*words):
    done = subprocess.run([LIGHTCAL, "match", *map(str, words), "--json"], capture_output=True,
                          text=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def fair(name, ours, theirs, tolerance):
    assert abs(ours - theirs) <= tolerance, f"{name}: lightcal {ours}, numpy {theirs}"


def judge(lamp, target, blue, words, deciding, nodes):
    """The nearest stacks by brute force; then what lightcal lists of them."""
    names = list(nodes)
    stacks = [(), *itertools.combinations(names, 1),
              *itertools.combinations_with_replacement(names, 2)]
    through = {s: world.fine(np.prod([nodes[g] for g in s], 0) if s else np.ones(81)) for s in stacks}
    def stops_of(stack):
        return np.log2(world.xyz(lamp)[1] / world.xyz(lamp * through[stack])[1])

    # Steps of 0.05, fewer gels before more within one, more light before less.
    keys = {s: deciding(lamp * through[s]) for s in stacks}
    keys = {s: (np.floor(d / .05), len(s), stops_of(s), d) for s, d in keys.items()}
    ranked = sorted((key, s) for s, key in keys.items())
    # A step's edge parts nobody: fewer gels go before all more that are not .05 nearer.
    for i in range(1, len(ranked)):
        own = ranked[i][0]
        before = next((k for k in range(i) if own[1] < ranked[k][0][1] and own[3] <= ranked[k][0][3] + .05), i)
        ranked.insert(before, ranked.pop(i))
    answer = match(*words, "-n", 8, "--reach", 1)
    assert answer["stacks"] == len(stacks) == 861
    listed = [tuple(m["gels"]) for m in answer["matches"]]
    assert listed[0] == ranked[0][1], f"nearest: lightcal {listed[0]}, numpy {ranked[0][1]}"
    # The front, walked again: nothing before betters it in gels, stops and SSI at once.
    front = []
    for (_, count, stops, _), stack in ranked:
        one = (count, stops, world.ssi(lamp * through[stack], target, blue))
        if not any(f[0] <= one[0] and f[1] <= one[1] + .05 and f[2] >= one[2] - 1 for f, _ in front):
            front.append((one, stack))
        if len(front) == 8:
            break
    wanted = [stack for _, stack in front]
    if not any(len(stack) <= 1 for stack in wanted):
        single = next(s for _, s in ranked if len(s) == 1)
        wanted = [s for _, s in ranked if s in {*wanted[:-1], single}]
    assert listed == wanted, f"front: lightcal {listed}, numpy {wanted}"
    for m in answer["matches"] + [answer["unfiltered"]]:
        light = lamp * through[tuple(m["gels"])]
        key = "camera" if "camera" in m["delta_e"] else "observer"
        fair("dE", m["delta_e"][key], deciding(light), 1e-9)
        fair("eye", m["delta_e"]["observer"], world.observer(target).difference(light), 1e-9)
        fair("u'v'", m["delta_uv"], np.hypot(*(world.uv76(light) - world.uv76(target))), 3e-5)
        fair("stops", m["stops_lost"],
             np.log2(world.xyz(lamp)[1] / world.xyz(light)[1]), 1e-4)
        fair("SSI", m["ssi"], world.ssi(light, target, blue), 1e-3)
        assert m["low95"]["ssi"] <= m["ssi"] <= m["high95"]["ssi"]
    return answer


def main():
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "gels.csv"
        nm, gels = forty_gels(21)
        write_gels(file, nm, gels)
        nodes = {name: world.at_nodes(nm, values) for name, values in gels.items()}
        words = lambda lamp, target, *more: [lamp, "--to", target, "--gels", file, *more]

        yuji, nichia = world.uprtek(YUJI), world.uprtek(NICHIA)
        eye = world.observer(world.ILLUMINANT_A)
        judge(yuji, world.ILLUMINANT_A, world.A_BLUE, words(YUJI, "illuminant:A"), eye.difference, nodes)
        canon = world.View(world.camera(CANON), world.D55)
        judge(nichia, world.D55, world.D55_BLUE, words(NICHIA, "illuminant:D55", "--camera", "canon eos 5d mark iv"),
              canon.difference, nodes)
        # Many cameras: the median decides.
        some = {name: channels for name, channels in world.cameras().items() if "Canon" in name}
        cameras = pathlib.Path(folder) / "cameras"
        cameras.mkdir()
        for name in some:
            (cameras / name).symlink_to(world.CAMERAS / name)
        views = [world.View(channels, world.ILLUMINANT_A) for channels in some.values()]
        answer = judge(nichia, world.ILLUMINANT_A, world.A_BLUE, words(NICHIA, "illuminant:A", "--camera", cameras),
                       lambda light: float(np.median([v.difference(light) for v in views])), nodes)
        best = answer["matches"][0]
        light = nichia * world.fine(np.prod([nodes[g] for g in best["gels"]], 0))
        fair("worst", best["delta_e"]["camera_worst"], max(v.difference(light) for v in views), 1e-9)
    print("861 stacks by eye, by one camera, by the median of",
          f"{len(views)}: the fronts and every figure agree")


if __name__ == "__main__":
    main()
