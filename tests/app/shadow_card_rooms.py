#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A shadow-card pair cancels ambient light and bounce: 250 simulated rooms through the built CLI.

usage: shadow_card_rooms.py LIGHTCAL

Truth: each room is a box of matt patches whose light is solved by radiosity (all orders of bounce,
form factors between patch middles, normalised to close the enclosure), a bare lamp in it, a window
as ambient light, and a meter that faces the lamp at five distances. The card blocks the direct beam
and what bounce comes from behind it. Readings carry 0.2 % noise. Knows nothing of lightcal's code.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

ROOMS, BATCH = 250, 50
NOISE = 0.002
PATCHES = 5  # along each side of a wall
CARD_RADIUS = 0.04  # metres, half way between lamp and meter


class Box:
    """Six walls of matt patches and what each sees of every other."""

    def __init__(self, size, reflectance):
        w = (np.arange(PATCHES) + 0.5) / PATCHES
        points, normals, areas = [], [], []
        for axis in range(3):
            a, b = [k for k in range(3) if k != axis]
            u, v = (g.ravel() for g in np.meshgrid(w * size[a], w * size[b]))
            for side in (0, 1):
                p = np.zeros((len(u), 3))
                p[:, a], p[:, b], p[:, axis] = u, v, side * size[axis]
                n = np.zeros(3)
                n[axis] = 1 - 2 * side
                points.append(p)
                normals.append(np.tile(n, (len(u), 1)))
                areas.append(np.full(len(u), size[a] * size[b] / len(u)))
        self.points, self.normals = np.vstack(points), np.vstack(normals)
        self.areas, self.reflectance = np.concatenate(areas), reflectance
        v = self.points[None] - self.points[:, None]
        r2 = np.sum(v * v, 2) + np.eye(len(self.areas))
        here = np.einsum("ijk,ik->ij", v, self.normals)
        there = -np.einsum("ijk,jk->ij", v, self.normals)
        factor = np.maximum(here, 0) * np.maximum(there, 0) / (np.pi * r2 * r2) * self.areas
        self.factor = factor / np.sum(factor, 1, keepdims=True)  # a closed box sees itself wholly

    def exitance(self, lamp, candela, window):
        """Of each patch, lm/m^2: reflected light of the lamp, and a window's own."""
        v = lamp - self.points
        r2 = np.sum(v * v, 1)
        direct = candela * np.maximum(np.sum(v * self.normals, 1), 0) / r2 ** 1.5
        own = np.zeros(len(self.areas))
        own[: PATCHES] = window
        system = np.eye(len(self.areas)) - self.reflectance * self.factor
        return np.linalg.solve(system, own + self.reflectance * direct)

    def seen(self, exitance, at, normal, card=None):
        """Lux of the walls' light on a meter, without what a card (its middle) covers."""
        v = self.points - at
        r2 = np.sum(v * v, 1)
        here = np.maximum(v @ normal, 0)
        there = np.maximum(-np.sum(v * self.normals, 1), 0)
        lux = exitance * here * there / (np.pi * r2 * r2) * self.areas
        if card is not None:
            away = np.linalg.norm(card - at)
            cosine = (v @ (card - at)) / (np.sqrt(r2) * away)
            covered = np.clip(1.5 - np.arccos(np.clip(cosine, -1, 1)) * away / CARD_RADIUS, 0, 1)
            lux = lux * (1 - covered)
        return float(np.sum(lux))


def one_room(random, name):
    size = random.uniform([3, 3, 2.4], [8, 6, 3.5])
    box = Box(size, random.uniform(0.2, 0.85))
    candela = float(np.exp(random.normal(5, 1.5)))
    lamp = size * random.uniform(0.25, 0.4, 3)
    away = size * random.uniform(0.65, 0.8, 3) - lamp
    longest = np.linalg.norm(away)
    away /= longest
    exitance = box.exitance(lamp, candela, candela * random.uniform(0, 0.3))
    text = f'\n[[light]]\nname = "{name}"\nkind = "point"\n'
    share = 0.0
    for d in np.geomspace(max(0.3, longest / 8), longest, 5):
        at = lamp + away * d
        walls = box.seen(exitance, at, -away)
        behind = box.seen(exitance, at, -away, card=lamp + away * d / 2)
        share = max(share, walls / (walls + candela / d**2))
        for lux, card in ((candela / d**2 + walls, False), (behind, True)):
            lux *= np.exp(NOISE * random.standard_normal())
            text += f'\n[[reading]]\nlight = "{name}"\nmeter = "m"\ndistance_m = {d}\n'
            text += f"illuminance_lx = {lux}\n" + ("shadow_card = true\n" if card else "")
    return text, candela, share


def main():
    random = np.random.default_rng(250)
    errors, shares, within = [], [], 0
    head = 'lightcal = 1\n[[meter]]\nname = "m"\nsigma_relative = 0.002\ncalibration_relative = 0\n'
    for _ in range(ROOMS // BATCH):
        rooms = [one_room(random, f"room{i}") for i in range(BATCH)]
        with tempfile.TemporaryDirectory() as folder:
            session = pathlib.Path(folder) / "rooms.toml"
            session.write_text(head + "".join(r[0] for r in rooms), encoding="utf-8")
            ran = subprocess.run([sys.argv[1], "fit", session, "-o", session.with_suffix(".json"),
                                  "--json"], capture_output=True, text=True, check=False)
            if ran.returncode != 0:
                sys.exit(ran.stderr)
            lights = json.loads(ran.stdout)["lights"]
        for light, (_, candela, share) in zip(lights, rooms):
            u = light["intensity_cd"]
            errors.append(abs(u["value"] / candela - 1))
            within += u["low95"] <= candela <= u["high95"]
            shares.append(share)
    print(f"rooms {len(errors)}: median error {100 * np.median(errors):.3f} %, "
          f"95th percentile {100 * np.percentile(errors, 95):.2f} %, within u95 {within}; other "
          f"light up to {100 * np.median(shares):.0f} % of the farthest reading in the median")
    if np.median(errors) >= 0.005 or np.median(shares) < 0.2:
        sys.exit("too far off, or too easy")


if __name__ == "__main__":
    main()
