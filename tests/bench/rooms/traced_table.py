# SPDX-License-Identifier: Apache-2.0
"""The table of tests/tools/traced_rooms, and sessions that a person could have measured in its rooms."""
import csv
import math
import pathlib

import numpy as np

TABLE = pathlib.Path(__file__).resolve().parents[2] / "tools/traced_rooms/traced_rooms.csv"
DISTANCES = (0.5, 0.7, 1.0, 1.5, 2.0, 3.0)
KINDS = ("bulb", "panel", "beam")

# Distance offsets of real lamps, metres behind the reference: (weight, mean, standard deviation).
# reference: 205 published tables of film fixtures; bulb and panel are a judgement.
FIXTURES = {
    "bulb": ((1.0, 0.0, 0.03),),
    "panel": ((1.0, 0.0, 0.03),),
    "cob_bare": ((1.0, 0.06, 0.04),),
    "reflector": ((1.0, -0.10, 0.06),),
    "fresnel": ((1.0, 0.06, 0.03),),
    "softbox": ((1.0, -0.30, 0.08),),
    "luminaire": ((1.0, 0.0, 0.02),),
}
# How the 205 tables divide, for lamps of unknown fixture.
TABLES_205 = (("cob_bare", 71), ("reflector", 79), ("softbox", 28), ("fresnel", 27))
OF_KIND = {"bulb": ("bulb",), "panel": ("panel",), "beam": ("reflector", "fresnel")}


def read_table(path=TABLE, family="ordinary"):
    """Rows of one family as dictionaries; wall, card and direct are arrays over DISTANCES (nan: none)."""
    rows = []
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            if row["family"] != family:
                continue
            out = {"room": int(row["room"]), "kind": row["kind"]}
            for key in ("width_m", "height_m", "power", "reflectance", "flux_over_intensity", "error"):
                out[key] = float(row[key] or "nan")
            out["size"] = tuple(float(row[f"size_{axis}_m"]) for axis in "xyz")
            for column in ("direct", "wall", "card"):
                out[column] = np.array([float(row[f"{column}_{d:g}"] or "nan") for d in DISTANCES])
            rows.append(out)
    return rows


def area(size):
    return 2 * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0])


def uniform_radiance(row):
    """Walls' light over intensity in a room of uniform radiance, 1/m^2, everything known exactly."""
    rho = row["reflectance"]
    return row["flux_over_intensity"] * rho / (area(row["size"]) * (1 - rho))


def beam_angle(power):
    """Full beam angle in degrees (half the peak's intensity) of a beam cos^power."""
    return 2 * math.degrees(math.acos(0.5 ** (1 / power)))


def draw_offset(rng, fixture):
    (_, mean, sd), = FIXTURES[fixture]
    return rng.normal(mean, sd)


def draw_of_205(rng):
    names, counts = zip(*TABLES_205)
    fixture = names[rng.choice(len(names), p=np.array(counts) / sum(counts))]
    return draw_offset(rng, fixture)
