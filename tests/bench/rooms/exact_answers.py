# SPDX-License-Identifier: Apache-2.0
"""Answers of the posterior on a grid to the sessions that lightcal is asked."""
import math

import numpy as np

from grid_posterior import (BEAM_OVER_FLUX, GAMMA_NEAR_WALL, IN_ROOM, NEAR_WALL, ORDINARY_ROOM,
                            PRIORS, ROOM_POWER, UNKNOWN_KIND, offsets_of, posterior)
from traced_table import area


def prior_of(kind, lamp):
    """The prior of the walls' light of one kind of lamp; a stated reflectance is known to 20 %."""
    prior = PRIORS[kind]
    beam = kind == "beam" and math.isfinite(lamp.power)
    if beam:
        flux = 2 * math.pi / (lamp.power + 1)
        prior = (math.log(BEAM_OVER_FLUX * flux), 0.75, *prior[2:])
    if not lamp.room or (kind == "beam" and not beam):
        return prior
    k, spread, stated_flux = IN_ROOM[kind]
    rho = lamp.room["reflectance"]
    formula = rho / (area(lamp.room["size_m"]) * (1 - rho))
    centre = math.log(k * (stated_flux or flux)) + ROOM_POWER * math.log(formula / ORDINARY_ROOM)
    return (centre, math.hypot(spread, ROOM_POWER * 0.1 / (1 - rho)), *prior[2:])


def walls_of(lamp):
    kinds = [(1.0, lamp.exact_kind, lamp.keys.get("size_m"), lamp.fixture)]
    if lamp.exact_kind == "point":
        kinds = UNKNOWN_KIND
    walls = []
    for weight, kind, size, fixture in kinds:
        prior, own = prior_of(kind, lamp), offsets_of(fixture)
        if kind in GAMMA_NEAR_WALL:
            walls.append((weight * NEAR_WALL, (*prior[:2], *GAMMA_NEAR_WALL[kind], *prior[4:]), size, own))
            weight *= 1 - NEAR_WALL
        walls.append((weight, prior, size, own))
    return walls


def answer_exactly(lamp):
    direct = [r for r in lamp.readings if not r.get("shadow_card")]
    cards = {r["distance_m"]: r["illuminance_lx"] for r in lamp.readings if r.get("shadow_card")}
    distances = [r["distance_m"] for r in direct]
    return (*posterior(
        distances, [r["illuminance_lx"] for r in direct],
        card=np.array([cards.get(d, math.nan) for d in distances]) if cards else None,
        offsets=offsets_of(lamp.fixture), walls=walls_of(lamp)), 0)
