#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What the traced rooms say of the walls' light: the figures that priors are chosen from.

  tests/bench/rooms/prior_of_rooms.py [--family unseen]

ln b(d) = ln b3 + gamma x + q x^2, x = ln(d / 3 m), by least squares over the distances of each room,
q the mean of its kind; then moments over the rooms. `formula` is flux rho / (I A (1 - rho)).
"""
import sys

import numpy as np

from traced_table import DISTANCES, KINDS, read_table, uniform_radiance


def main():
    family = "unseen" if "unseen" in sys.argv else "ordinary"
    x = np.log(np.array(DISTANCES) / 3.0)
    print(f"{family}\nlamp   rooms   b3 1/m^2  sd ln   gamma    sd      q  corr  scatter"
          "   over formula  sd ln   flux/I    sd ln   card hides")
    for kind in KINDS:
        rows = [r for r in read_table(family=family) if r["kind"] == kind]
        walls = np.log([r["wall"] for r in rows])
        whole = np.isfinite(walls).all(1)
        q = np.mean([np.polyfit(x, w, 2)[0] for w in walls[whole]])
        fits, left = [], []
        for w in walls:
            seen = np.isfinite(w)
            gamma, lnb = np.polyfit(x[seen], (w - q * x * x)[seen], 1)
            fits.append((lnb, gamma))
            left.append(w - q * x * x - lnb - gamma * x)
        lnb, gamma = np.array(fits).T
        over = lnb - np.log([uniform_radiance(r) for r in rows])
        flux = np.log([r["flux_over_intensity"] for r in rows])
        hides = np.nanmedian([1 - r["card"] / r["wall"] for r in rows], 0)
        print(f"{kind:6s} {len(rows):5d} {np.exp(lnb.mean()):10.4f} {lnb.std():6.2f} {gamma.mean():+7.2f}"
              f" {gamma.std():5.2f} {q:+6.2f} {np.corrcoef(lnb, gamma)[0, 1]:+5.2f}"
              f" {np.sqrt(np.nanmean(np.square(left))):8.3f} {np.exp(over.mean()):14.2f} {over.std():6.2f}"
              f" {np.exp(flux.mean()):8.3f} {flux.std():8.2f}  "
              + " ".join(f"{100 * h:.0f}" for h in hides) + " %")
        share = np.array([100 * r["wall"] / r["direct"] for r in rows])
        print("       walls over direct, median (90 %) at "
              + ", ".join(f"{d:g} m {m:.2g} ({n:.2g}) %" for d, m, n in
                          zip(DISTANCES, np.nanmedian(share, 0), np.nanpercentile(share, 90, 0))))


if __name__ == "__main__":
    main()
