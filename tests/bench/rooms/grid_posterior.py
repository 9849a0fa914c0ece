# SPDX-License-Identifier: Apache-2.0
"""What the readings of a session allow at best: the posterior of a lamp's intensity on a grid.

  E_i = I (s(d_i + d0) + b (d_i / r)^(gamma + q ln(d_i / r)) exp(t_i)) (1 + c) (1 + e_i)
Behind a card s = 0. c: the meter's common error; e_i: of a reading; t_i: scatter of the walls' light
at a place; r = 3 m, where b and gamma are nearly independent in rooms.
"""
import math

import numpy as np
from scipy.special import ndtr

from traced_table import FIXTURES

REFERENCE = 3.0  # m
# ln b there: mean, sd; gamma: mean, sd; t: sd; q. README.md of tests/tools/traced_rooms says whence.
PRIORS = {
    "bulb": (np.log(0.122), 0.42, -1.00, 0.33, 0.07, -0.27),
    "panel": (np.log(0.037), 0.45, -0.38, 0.42, 0.14, -0.37),
    "beam": (np.log(0.0033), 1.25, 0.60, 0.45, 0.25, 0.0),
}
# One bulb or panel in five stands near a wall: gamma's mean and sd there.
NEAR_WALL = 0.2
GAMMA_NEAR_WALL = {"bulb": (-1.60, 0.45), "panel": (-1.10, 0.50)}
# A lamp of unknown make: weight, kind of its spread, size of a panel, fixture whose offset it has.
UNKNOWN_KIND = ((0.42, "bulb", None, "bulb"), (0.065, "bulb", None, "softbox"),
                (0.1, "panel", (0.12, 0.09), "cob_bare"), (0.055, "panel", (0.25, 0.19), "panel"),
                (0.04, "panel", (0.42, 0.32), "panel"), (0.035, "panel", None, "softbox"),
                (0.03, "panel", (0.3, 0.24), "softbox"), (0.145, "beam", None, "reflector"),
                (0.11, "beam", None, "fresnel"))
BEAM_OVER_FLUX = 0.0092  # b at 3 m over flux over I, 1/(m^2 sr), of a beam whose angle is known
# In a stated room b = k flux / I (f / .0088)^.7, f = rho / (A (1 - rho)): k, sd of ln, flux / I (None: a
# beam's). The power is less than 1 as f says only in part what a meter sees.
ROOM_POWER, ORDINARY_ROOM = 0.7, 0.0088
IN_ROOM = {
    "bulb": (0.0113, 0.22, 0.86 * 4 * np.pi),
    "panel": (0.0120, 0.31, np.pi),
    "beam": (0.0082, 0.63, None),
}
CARD_HIDES = 0.04  # sd of ln of what a card keeps away besides the direct light
UNKNOWN_FIXTURE = ((0.5, 0.0, 0.05), (0.5, -0.08, 0.16))  # holds 95 % of the 205 tables


def rectangle(width, height, d):
    """Illuminance per cd on the axis of a Lambertian rectangle."""
    x, y = width / (2 * d), height / (2 * d)
    u, v = np.sqrt(1 + x * x), np.sqrt(1 + y * y)
    return 2 * (x / u * np.arctan(y / u) + y / v * np.arctan(x / v)) / (width * height)


def offset_nodes(mixture, nearest):
    spread = max(abs(mean) + 4.5 * sd for _, mean, sd in mixture)
    if len(mixture) == 1:
        nodes = mixture[0][1] + mixture[0][2] * np.linspace(-3.6, 3.6, 21)
    else:
        nodes = spread * np.sinh(np.linspace(-3.2, 3.2, 45)) / np.sinh(3.2)
    nodes = nodes[nodes > -0.8 * nearest]
    density = sum(w / sd * np.exp(-0.5 * ((nodes - mean) / sd) ** 2) for w, mean, sd in mixture)
    return nodes, density * np.gradient(nodes)


def grid(distances, lux, card, size, offsets, each, walls):
    """(log of the weight, mean and variance of ln I without the meter's common error) of each node.

    `walls`: a row of PRIORS, or None in the dark."""
    d0, p0 = offset_nodes(offsets, distances.min())
    d0, logp = d0[:, None], np.log(p0)[:, None]
    if walls is None:
        wall, scatter = np.zeros((1, 1, len(distances))), 0.0
    else:
        centre, sd_b, slope, sd_slope, scatter, bend = walls
        zb, zg = np.linspace(-3.6, 3.6, 27), np.linspace(-3, 3, 9)
        lnb, gamma = (a.ravel() for a in np.meshgrid(centre + sd_b * zb, slope + sd_slope * zg,
                                                     indexing="ij"))
        logp = logp - 0.5 * (zb[:, None] ** 2 + zg[None, :] ** 2).reshape(1, -1)
        x = np.log(distances / REFERENCE)
        wall = np.exp(lnb[:, None] + gamma[:, None] * x + bend * x * x)[None]
    source = rectangle(*size, distances + d0) if size else 1 / (distances + d0) ** 2
    model = source[:, None, :] + wall
    share = np.broadcast_to(wall / model, model.shape)
    r = np.log(lux) - np.log(model)
    variance = each ** 2 + (share * scatter) ** 2
    has = np.zeros(len(distances), bool) if card is None else np.isfinite(card)
    if not has.any():
        inverse = 1 / variance
        a = inverse.sum(-1)
        mean = (inverse * r).sum(-1) / a
        chi2 = (inverse * r * r).sum(-1) - a * mean ** 2
        logdet = np.log(variance).sum(-1)
    else:
        # Reading and card of a place share its t: a 2 x 2 block each. A card hides a little more.
        rc = np.where(has, np.log(np.where(has, card, 1.0)) - np.log(wall), 0.0)
        vc = each ** 2 + scatter ** 2 + CARD_HIDES ** 2
        cov = np.where(has, share * scatter ** 2, 0.0)
        det = np.where(has, variance * vc - cov ** 2, variance)
        iaa, ibb, iab = np.where(has, vc, 1.0) / det, variance / det * has, -cov / det
        a = (iaa + ibb + 2 * iab).sum(-1)
        mean = (iaa * r + ibb * rc + iab * (r + rc)).sum(-1) / a
        chi2 = (iaa * r * r + ibb * rc * rc + 2 * iab * r * rc).sum(-1) - a * mean ** 2
        logdet = np.log(det).sum(-1)
    return (logp - 0.5 * (chi2 + logdet + np.log(a))).ravel(), mean.ravel(), (1 / a).ravel()


def posterior(distances, lux, card=None, *, offsets=UNKNOWN_FIXTURE, common=0.03,
              each=0.01, walls=None, at=(0.025, 0.5, 0.975)):
    """Quantiles of I. `card`: lux behind a card at each distance (nan: not read);
    `walls`: a list of (weight, row of PRIORS, size, its own offsets or None), one of which holds;
    None: a dark room."""
    distances, lux = np.asarray(distances, float), np.asarray(lux, float)
    parts = [(math.log(w) + p, m, v) for w, (p, m, v) in (
        (weight, grid(distances, lux, card, size, own or offsets, each, row))
        for weight, row, size, own in (walls or [(1.0, None, None, None)]))]
    weight, mean, variance = (np.concatenate(column) for column in zip(*parts))
    weight = np.exp(weight - weight.max())
    weight /= weight.sum()
    keep = weight > 1e-9
    weight, mean, sd = weight[keep], mean[keep], np.sqrt(variance[keep] + common ** 2)
    out = []
    for q in at:
        low, high = (mean - 8 * sd).min(), (mean + 8 * sd).max()
        for _ in range(30):
            middle = (low + high) / 2
            if (weight * ndtr((middle - mean) / sd)).sum() < q:
                low = middle
            else:
                high = middle
        out.append(math.exp((low + high) / 2))
    return out


def offsets_of(fixture):
    return FIXTURES[fixture] if fixture else UNKNOWN_FIXTURE
