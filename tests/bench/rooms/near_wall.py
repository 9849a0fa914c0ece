#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What one near wall adds to the walls' light: the closed form that the prior of lamps near a wall is
chosen from (no traced room is looked at).

  tests/bench/rooms/near_wall.py [LAMPS]

A lamp stands .1 to .5 m before a Lambertian wall of reflectance .25 to .8, in one place in ten before
two (and in a corner: always before two); the meter faces it from any direction before the wall. The
wall's light is integrated over the wall, E = rho / pi * sum E_wall cos cos dA / r^2, and added to an ordinary room's b(d); what ln b3 and
the slope gain is printed (traced_rooms/README.md: b = b3 exp(gamma x + q x^2), x = ln(d / 3 m)).
"""
import sys

import numpy as np

DISTANCES = np.array([0.5, 0.7, 1.0, 1.5, 2.0, 3.0])
ORDINARY = {"bulb": (0.122, -1.0, -0.27), "panel": (0.037, -0.45, -0.37)}
# Patches of the wall: fine opposite the lamp, 3.3 m away in all directions at the coarsest.
SPREAD, CELLS = 0.12, 161
U = np.linspace(-4, 4, CELLS)
X, Y = np.meshgrid(SPREAD * np.sinh(U), SPREAD * np.sinh(U))
WIDTH = SPREAD * np.cosh(U) * 8 / (CELLS - 1)
AREA = np.outer(WIDTH, WIDTH)


def light_of_wall(kind, from_wall, reflectance, cosine):
    """lx of the wall at each distance, for a lamp of 1 cd towards the meter, which stands at an angle of
    that cosine from the wall's normal."""
    towards = np.array([np.sqrt(1 - cosine ** 2), 0, cosine])
    squared = X ** 2 + Y ** 2 + from_wall ** 2
    intensity = 1.0
    if kind == "panel":
        intensity = np.clip((X * towards[0] - from_wall * towards[2]) / np.sqrt(squared), 0, None)
    on_wall = intensity * from_wall / squared ** 1.5
    lux = []
    for d in DISTANCES:
        x, y, z = d * towards[0] - X, -Y, from_wall + d * towards[2]
        r = np.sqrt(x ** 2 + y ** 2 + z ** 2)
        facing = np.clip((x * towards[0] + z * towards[2]) / r, 0, None)
        lux.append((reflectance / np.pi * on_wall * (z / r) * facing / r ** 2 * AREA).sum())
    return np.array(lux)


def main():
    lamps = int(sys.argv[1]) if len(sys.argv) > 1 else 400
    x = np.log(DISTANCES / 3)
    for place, before_two in (("near a wall", 0.1), ("in a corner", 1.0)):
        for kind, (b3, gamma, q) in ORDINARY.items():
            rng = np.random.default_rng(1)
            found = []
            for _ in range(lamps):
                reflectance = rng.uniform(0.25, 0.8)
                cosine = rng.uniform(0.1, 1)
                wall = light_of_wall(kind, rng.uniform(0.1, 0.5), reflectance, cosine)
                if rng.uniform() < before_two:
                    other = np.sqrt(1 - cosine ** 2) * abs(np.cos(rng.uniform(0, np.pi)))
                    wall = wall + light_of_wall(kind, rng.uniform(0.1, 0.5), reflectance, other)
                both = np.log(b3 * np.exp(gamma * x + q * x * x) + wall) - q * x * x
                slope, ln_b3 = np.polyfit(x, both, 1)
                found.append((ln_b3 - np.log(b3), slope))
            (more, slope), (sd_more, sd_slope) = np.mean(found, 0), np.std(found, 0)
            print(f"{kind:6s} {place}: ln b3 {more:+.2f} (sd {sd_more:.2f}), slope {slope:+.2f} (sd {sd_slope:.2f})")


if __name__ == "__main__":
    main()
