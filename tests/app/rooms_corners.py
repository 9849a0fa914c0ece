# SPDX-License-Identifier: Apache-2.0
"""What `simulate --room` says at corners, edges, walls and on the work plane, against a radiosity written out here
(patches of equal size, kernels by their middles, rows made whole) and gathered from finer pieces. Rooms long, square
and flat, of high and low reflectance; a bulb and a panel. Written without a header of lightcal."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

LIGHTCAL = str(pathlib.Path(sys.argv[1]).resolve())
FOLDER = tempfile.TemporaryDirectory()
HEAD = ('lightcal = 1\nname = "w"\n[room]\ndark = true\n[[meter]]\nname = "m"\nsigma_relative = 0.003\n'
        'repeatability_relative = 0.002\n[[light]]\nname = "s"\n')
CANDELA = 300.0


def cut(size, finer=1):
    """Middles, inward normals and areas of patches, each cut into finer x finer; the origin lies on the floor under the
    middle of the room. Beside them whose part each is."""
    low = np.array([-size[0] / 2, -size[1] / 2, 0.0])
    parts, count = [], 0
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        n, m = (finer * max(5, round(size[k] * 1.6)) for k in (u, v))
        i, j = (x.ravel() for x in np.meshgrid(np.arange(n), np.arange(m)))
        a, b = (i + 0.5) / n * size[u] + low[u], (j + 0.5) / m * size[v] + low[v]
        for upper in (0, 1):
            point, normal = np.zeros((a.size, 3)), np.zeros((a.size, 3))
            point[:, axis], point[:, u], point[:, v] = low[axis] + upper * size[axis], a, b
            normal[:, axis] = 1 - 2 * upper
            parts.append((point, normal, np.full(a.size, size[u] * size[v] / a.size), count + i // finer + j // finer * (n // finer)))
            count += a.size // finer**2
    return [np.concatenate(x) for x in zip(*parts)]


def kernel(points, normals, patches):
    """What patches of exitance 1 cast on points."""
    middle, inward, area, _ = patches
    square = (points**2).sum(1)[:, None] + (middle**2).sum(1)[None] - 2 * points @ middle.T + 1e-9
    here = np.clip(normals @ middle.T - (normals * points).sum(1)[:, None], 0, None)
    there = np.clip(points @ inward.T - (inward * middle).sum(1)[None], 0, None)
    there[there < 1e-9] = 0
    return here * there * area / (math.pi * square**2)


def direct(points, normals, lamp, flat):
    away = points - lamp
    square = (away**2).sum(-1)
    lux = CANDELA * np.clip(-(away * normals).sum(-1), 0, None) / square**1.5
    return lux * np.clip(-away[:, 2] / np.sqrt(square), 0, None) if flat else lux


def truth(size, rho, lamp, flat):
    """What every patch of the walls sends out."""
    coarse, fine = cut(size), cut(size, 4)
    shares = kernel(coarse[0], coarse[1], coarse)
    for _ in range(30):  # both ways alike, nothing lost
        scale = 1 / np.sqrt(shares.sum(1))
        shares *= scale[:, None] * scale[None]
    shares /= shares.sum(1)[:, None]
    once = rho * direct(fine[0], fine[1], lamp, flat)
    flux = CANDELA * (math.pi if flat else 4 * math.pi)
    once *= rho * flux / (once @ fine[2])
    first = kernel(coarse[0], coarse[1], fine) @ once
    first *= rho * flux / (first @ coarse[2])
    settled = np.linalg.solve(np.eye(len(first)) - rho * shares, first)
    exitance = once + rho * settled[fine[3]]
    return exitance, fine


def session(flat, lamp):
    path = pathlib.Path(FOLDER.name) / "w.toml"
    kind = 'kind = "rect"\nsize_m = [0.02, 0.02]\naim = [0, 0, -1]\n' if flat else 'kind = "point"\n'
    text = HEAD + kind + "position_m = [%g, %g, %g]\n" % tuple(lamp)
    for d in (1, 2):
        text += f'[[reading]]\nlight = "s"\nmeter = "m"\ndistance_m = {d}\nilluminance_lx = {CANDELA / d**2}\n'
    path.write_text(text)
    light = path.with_suffix(".json")
    subprocess.run([LIGHTCAL, "fit", path, "-o", light, "--force"], check=True, capture_output=True)
    return light


def simulated(light, size, rho, at, normal):
    words = [LIGHTCAL, "simulate", light, "--room", ",".join(map(str, size)), "--reflectance", str(rho), "--at"]
    words += [",".join(f"{x:.6f}" for x in p) for p in at] + ["--normal", normal, "--effects", "all", "--json"]
    done = subprocess.run(list(map(str, words)), check=True, capture_output=True, text=True)
    return json.loads(done.stdout)["points"]


worst = 0.0
for size, rho, lamp, flat in (((5, 4, 2.6), 0.5, (1, 0.5, 2.0), False), ((5, 4, 2.6), 0.5, (-1, 0, 2.55), True),
                              ((4, 4, 3), 0.8, (0, 0, 2.0), False), ((12, 3, 2.6), 0.7, (-4.5, 0, 2.55), True),
                              ((12, 3, 2.6), 0.7, (4, 0.5, 1.5), False), ((8, 8, 3), 0.2, (2, 2, 2.95), True)):
    x, y, z = size[0] / 2, size[1] / 2, size[2]
    up = [(-x + .15, -y + .15, 0), (x - .15, -y + .15, 0), (x - .15, y - .15, 0), (0, y - .15, 0), (x - .15, 0, 0),
          (0.2, 0.1, 0), (-x + .4, y - .4, 0.8), (x - .5, -y + .5, 0.75), (0.2, 0.1, 0.85)]
    side = [(-x, 0.2, 1.2), (-x, -y + .2, 0.3), (-x, y - .2, z - .3)]
    light = session(flat, lamp)
    lamp = np.array(lamp, float)
    exitance, fine = truth(size, rho, lamp, flat)
    for at, normal, words in ((up, (0, 0, 1), "up"), (side, (1, 0, 0), "1,0,0")):
        points, normals = np.array(at, float), np.tile(np.array(normal, float), (len(at), 1))
        own, walls = direct(points, normals, lamp, flat), kernel(points, normals, fine) @ exitance
        for p, e, w, found in zip(at, own, walls, simulated(light, size, rho, at, words)):
            lux, bounce = found["illuminance_lx"], found["lights"][0]["bounce_lx"]
            off = bounce / w - 1
            worst = max(worst, abs(off))
            print(size, rho, "panel" if flat else "bulb", p, f"walls {bounce:.2f} of {w:.2f} ({100 * off:+.1f} %)")
            assert abs(lux["value"] - e - w) <= lux["u95"], (lux, e + w)
print(f"worst {100 * worst:.1f} %")
assert worst < 0.07
