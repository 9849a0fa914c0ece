# SPDX-License-Identifier: Apache-2.0
"""What a careful person writes without lightcal: reads a session, fits every light, writes presets.

    whole_run_by_hand.py SESSION.toml OUTPUT
"""
import csv
import json
import pathlib
import sys
import tomllib

import numpy
from scipy.optimize import least_squares


def fit(distance, lux, sigma):
    """ln I and the offset of E = I/(d + d0)^2 with a prior on d0; their covariance."""
    offset_sd = 0.15 * distance.min()

    def residuals(theta):
        model = theta[0] - 2 * numpy.log(distance + theta[1])
        return numpy.append((numpy.log(lux) - model) / sigma, theta[1] / offset_sd)
    start = (numpy.mean(numpy.log(lux * distance ** 2)), 0.0)
    found = least_squares(residuals, start, method="lm", ftol=1e-12, xtol=1e-12)
    return found.x, numpy.linalg.inv(found.jac.T @ found.jac)


def kelvins(x, y):
    n = (x - 0.3320) / (0.1858 - y)
    return 449 * n ** 3 + 3525 * n ** 2 + 6823.3 * n + 5520.33


def main():
    session = tomllib.loads(pathlib.Path(sys.argv[1]).read_text())
    out = pathlib.Path(sys.argv[2])
    out.mkdir(exist_ok=True)
    sigma = {meter["name"]: meter["sigma_relative"] for meter in session["meter"]}
    lights, rows = [], []
    for light in session["light"]:
        readings = [r for r in session["reading"] if r["light"] == light["name"]]
        theta, covariance = fit(numpy.array([r["distance_m"] for r in readings]),
                                numpy.array([r["illuminance_lx"] for r in readings]),
                                numpy.array([sigma[r["meter"]] for r in readings]))
        candela, u = float(numpy.exp(theta[0])), float(numpy.sqrt(covariance[0, 0]))
        x, y = numpy.mean([r["xy"] for r in readings], axis=0)
        lights.append({"name": light["name"], "intensity_cd": candela, "u95_relative": 1.96 * u,
                       "cct_K": float(kelvins(x, y)), "distance_offset_m": float(theta[1])})
        rows += [(light["name"], r["distance_m"], r["illuminance_lx"],
                  candela / (r["distance_m"] + theta[1]) ** 2) for r in readings]
    (out / "light.json").write_text(json.dumps({"lights": lights}, indent=2))
    gltf = {"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": {"KHR_lights_punctual": {"lights": [
                {"type": "point", "name": one["name"], "intensity": one["intensity_cd"]}
                for one in lights]}},
            "nodes": [{"name": one["name"], "extensions": {"KHR_lights_punctual": {"light": i}}}
                      for i, one in enumerate(lights)]}
    (out / "lights.gltf").write_text(json.dumps(gltf, indent=2))
    with open(out / "residuals.csv", "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([("light", "distance_m", "measured_lx", "model_lx"), *rows])


if __name__ == "__main__":
    main()
