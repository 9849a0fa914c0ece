# SPDX-License-Identifier: Apache-2.0
"""What a meter reads in the scenes of lightcal's gate ladder, by brute force: the lamp in small pieces,
the meter's head in rings, every wall in patches that light one another until nothing is left, air that
takes its part of every path. Nothing of lightcal is used; the scenes are typed here anew.

  ladder_truth.py                    one line a scene: lx m2/cd, that is E d2 / I
  ladder_truth.py --check SOURCE     ends with 1 where a line of SOURCE (light/gate_ladder.cc) differs

A lamp stands in the middle of its room and shines along +x, the room's longer side; the meter stands
`distance` before it and faces it, but for a tilt to the side (about z)."""
import math
import re
import sys

import numpy as np

HALL, STUDIO, OFFICE, ROOM = (40, 30, 12), (9, 7, 4), (6, 5, 2.8), (4, 3.5, 2.5)
# name: room, reflectance, distance, lamp, tilt in degrees, haze per metre, ambient over the point's light
SCENES = {
    "bare bulb, dark hall": (HALL, 0.03, 1.0, ("point",), 0, 2e-4, 1e-4),
    "spot through stage haze": (HALL, 0.03, 8.0, ("beam", 0.1, 20.0), 0, 0.01, 1e-4),
    "softbox, dark hall": (HALL, 0.03, 2.0, ("disk", 0.45), 0, 2e-4, 1e-4),
    "softbox aslant, black studio": (STUDIO, 0.05, 2.0, ("disk", 0.45), 30, 2e-4, 1e-4),
    "bare bulb, living room": (OFFICE, 0.4, 1.0, ("point",), 0, 2e-4, 1e-4),
    "tube, garage": (OFFICE, 0.4, 1.0, ("tube", 1.2), 0, 2e-4, 1e-4),
    "panel by daylight, office": (OFFICE, 0.55, 1.2, ("rect", 0.6, 0.6), 0, 2e-4, 0.02),
    "panel aslant, white room": (ROOM, 0.85, 0.8, ("rect", 1.2, 0.6), 25, 2e-4, 0.05),
}
HEAD_RADIUS_M = 0.005


def pieces(lamp, n):
    """(points, weights, candela of a direction): the pieces' shares of the axial intensity add up to 1."""
    kind = lamp[0]
    if kind == "point":
        return np.zeros((1, 3)), np.ones(1), lambda d: np.ones(d.shape[:-1])
    if kind in ("disk", "beam"):
        ring, spoke = np.meshgrid(np.sqrt((np.arange(n) + 0.5) / n), 2 * math.pi * (np.arange(2 * n) + 0.5) / (2 * n))
        at = lamp[1] * np.stack([0 * ring, ring * np.cos(spoke), ring * np.sin(spoke)], -1).reshape(-1, 3)
        power = 1.0 if kind == "disk" else math.log(0.5) / math.log(math.cos(math.radians(lamp[2] / 2)))
        return at, np.full(len(at), 1 / len(at)), lambda d: np.maximum(d[..., 0], 0) ** power
    if kind == "rect":
        y, z = np.meshgrid((np.arange(2 * n) + 0.5) / (2 * n) - 0.5, (np.arange(n) + 0.5) / n - 0.5)
        at = np.stack([0 * y, lamp[1] * y, lamp[2] * z], -1).reshape(-1, 3)
        return at, np.full(len(at), 1 / len(at)), lambda d: np.maximum(d[..., 0], 0)
    y = lamp[1] * ((np.arange(4 * n) + 0.5) / (4 * n) - 0.5)
    return (np.stack([0 * y, y, 0 * y], -1), np.full(len(y), 1 / len(y)),
            lambda d: np.sqrt(np.maximum(0, 1 - d[..., 1] ** 2)))  # a Lambertian cylinder, across its length


def lit(lamp_at, lamp, points, normal, haze, n):
    """Illuminance of the lamp's own light at points with one normal."""
    at, weights, candela = pieces(lamp, n)
    total = np.zeros(len(points))
    for place, weight in zip(at, weights):
        away = points - lamp_at - place
        r2 = np.sum(away ** 2, -1)
        r = np.sqrt(r2)
        facing = np.maximum(0, -(away @ normal) / r)
        total += weight * candela(away / r[:, None]) * facing / r2 * np.exp(-haze * r)
    return total


def patches(size, n):
    """(centres, inward normals, areas) of six walls in n x n."""
    out = [], [], []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        gu, gv = np.meshgrid((np.arange(n) + 0.5) / n - 0.5, (np.arange(n) + 0.5) / n - 0.5)
        for side in (-1, 1):
            centre = np.zeros((n * n, 3))
            centre[:, axis], centre[:, u], centre[:, v] = side * size[axis] / 2, size[u] * gu.ravel(), size[v] * gv.ravel()
            normal = np.zeros((n * n, 3))
            normal[:, axis] = -side
            out[0].append(centre), out[1].append(normal), out[2].append(np.full(n * n, size[u] * size[v] / n ** 2))
    return tuple(np.concatenate(part) for part in out)


def sent(walls, radiosity, point, normal, haze):
    """What the walls send to a point."""
    centres, normals, areas = walls
    to = centres - point
    r2 = np.sum(to ** 2, -1)
    here, there = to @ normal, -np.sum(to * normals, -1)
    seen = (here > 0) & (there > 0)
    return float(np.sum(np.where(seen, radiosity * areas * here * there / (math.pi * r2 ** 2), 0) * np.exp(-haze * np.sqrt(r2))))


def truth(room, reflectance, distance, lamp, tilt, haze, ambient, fine=112, coarse=16):
    lamp_at = np.zeros(3)
    meter = np.array([distance, 0, 0])
    t = math.radians(tilt)
    normal = np.array([-math.cos(t), math.sin(t), 0])
    across = np.cross(normal, [0, 0, 1])
    direct = []
    for ring in np.sqrt((np.arange(6) + 0.5) / 6):
        for spoke in 2 * math.pi * (np.arange(8) + 0.5) / 8:
            direct.append(meter + HEAD_RADIUS_M * ring * (math.cos(spoke) * across + math.sin(spoke) * np.array([0, 0, 1])))
    own = float(np.mean(lit(lamp_at, lamp, np.array(direct), normal, haze, 24)))
    # The first bounce by fine patches, the further ones by coarse ones.
    walls = patches(room, fine)
    first = np.zeros(len(walls[0]))
    for side in np.unique(walls[1], axis=0):
        on = np.all(walls[1] == side, 1)
        first[on] = reflectance * lit(lamp_at, lamp, walls[0][on], side, haze, 5)
    one = sent(walls, first, meter, normal, haze)
    rough = patches(room, coarse)
    k = fine // coarse
    def mean(values):
        grid = values.reshape(6, coarse, fine // coarse, coarse, fine // coarse)
        return grid.mean((2, 4)).ravel()
    assert k * coarse == fine
    start = mean(first)
    to = rough[0][None] - rough[0][:, None]
    r2 = np.sum(to ** 2, -1) + np.eye(len(rough[0]))
    here = np.einsum("ijk,ik->ij", to, rough[1])
    there = -np.einsum("ijk,jk->ij", to, rough[1])
    shares = np.where((here > 1e-9) & (there > 1e-9), here * there * rough[2][None] / (math.pi * r2 ** 2), 0)
    shares /= shares.sum(1)[:, None]  # a closed box
    shares *= np.exp(-haze * np.sqrt(r2))
    further = np.linalg.solve(np.eye(len(start)) - reflectance * shares, reflectance * shares @ start)
    smooth = np.repeat(np.repeat(further.reshape(6, coarse, coarse), k, 1), k, 2).ravel()
    rest = sent(walls, smooth, meter, normal, haze)
    return (own + one + rest) * distance ** 2 + ambient


def main():
    figures = {name: truth(*scene) for name, scene in SCENES.items()}
    if len(sys.argv) == 3 and sys.argv[1] == "--check":
        with open(sys.argv[2]) as source:
            held = {name: float(value) for name, value in re.findall(
                r'push_back\(\s*\{"([^"]+)",[^;]*?([0-9.]+)\}\);', source.read())}
        off = [name for name in figures if abs(held.get(name, 0) / figures[name] - 1) > 1e-4]
        for name in off:
            print(f"{name}: {figures[name]:.5f}, not {held.get(name)}")
        return 1 if off or not held else 0
    for name, value in figures.items():
        print(f"{value:.5f}  {name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
