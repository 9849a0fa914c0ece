# SPDX-License-Identifier: Apache-2.0
"""Twelve beams by closed forms and by tracing, and what a lux meter reads of them. Nothing of
lightcal, seeds fixed. I(gamma) over I(0), gamma 0 to 90 degrees in steps of a half."""
import functools
import math

import numpy as np

GAMMA = np.arange(0, 90.25, 0.5)
SEED = 16


def gauss(half):
    return np.exp(-math.log(2) * (GAMMA / half) ** 2)


def cosine(power):
    return np.clip(np.cos(np.radians(GAMMA)), 0, 1) ** power


def lens(source, radius, focal, distance):
    """A uniform disc behind a thin lens, seen from far away: the part of the lens through which the
    disc is seen. A ray that leaves lens height y at slope t came from the disc's plane at
    y (1 - distance/focal) - distance t."""
    rho = np.sqrt((np.arange(200) + 0.5) / 200) * radius
    turn = (np.arange(180) + 0.5) / 180 * 2 * np.pi
    x, y = (rho[:, None] * np.cos(turn)).ravel(), (rho[:, None] * np.sin(turn)).ravel()
    s = 1 - distance / focal
    seen = []
    for gamma in GAMMA:
        t = math.tan(math.radians(min(gamma, 89.9)))
        lit = (x * s - distance * t) ** 2 + (y * s) ** 2 < source ** 2
        seen.append(lit.mean() * math.cos(math.radians(gamma)))
    return np.array(seen)


def reflector(seed, chip, focal, depth, hole, defocus=0.0, rays=2_000_000):
    """A Lambertian chip that looks into a satin paraboloid with a hole at its vertex; what the
    mirror throws back, traced ray by ray."""
    rng = np.random.default_rng(seed)
    r, a = chip * np.sqrt(rng.random(rays)), 2 * np.pi * rng.random(rays)
    o = np.stack([r * np.cos(a), r * np.sin(a), np.full(rays, focal + defocus)], 1)
    c = np.sqrt(rng.random(rays))
    s, b = np.sqrt(1 - c ** 2), 2 * np.pi * rng.random(rays)
    d = np.stack([s * np.cos(b), s * np.sin(b), -c], 1)
    qa = (d[:, 0] ** 2 + d[:, 1] ** 2) / (4 * focal) + 1e-12
    qb = (o[:, 0] * d[:, 0] + o[:, 1] * d[:, 1]) / (2 * focal) - d[:, 2]
    qc = (o[:, 0] ** 2 + o[:, 1] ** 2) / (4 * focal) - o[:, 2]
    t = (-qb + np.sqrt(np.maximum(qb ** 2 - 4 * qa * qc, 0))) / (2 * qa)
    p = o + d * t[:, None]
    hit = (t > 0) & (p[:, 2] < depth) & (np.hypot(p[:, 0], p[:, 1]) > hole)
    n = np.stack([-p[:, 0] / (2 * focal), -p[:, 1] / (2 * focal), np.ones(rays)], 1)
    n /= np.linalg.norm(n, axis=1)[:, None]
    n += rng.normal(0, math.radians(1.2), n.shape)  # satin
    n /= np.linalg.norm(n, axis=1)[:, None]
    out = (d - 2 * (d * n).sum(1)[:, None] * n)[hit]
    edges = np.radians(np.arange(0, 91.0))
    count, _ = np.histogram(np.arccos(np.clip(out[:, 2], -1, 1)), edges)
    solid = np.cos(edges[:-1]) - np.cos(edges[1:])
    kernel = np.exp(-0.5 * np.arange(-3, 4) ** 2)
    both = lambda v: np.concatenate([v[::-1], v])  # noqa: E731
    smooth = (np.convolve(both(count), kernel, "same") / np.convolve(both(solid), kernel, "same"))[90:]
    return np.interp(GAMMA, np.r_[0, np.arange(90) + 0.5], np.r_[smooth[0], smooth])


def step(edge, soft):
    return 1 / (1 + np.exp((GAMMA - edge) / soft))


@functools.cache
def shapes():
    beams = {
        "LED lens 13 deg": 0.97 * gauss(6) + 0.03 * gauss(22),
        "LED lens 65 deg": cosine(1.2) * np.exp(-0.00045 * GAMMA ** 2),
        "Fresnel spot": lens(8, 75, 120, 110) + 0.02 * cosine(4),
        "Fresnel flood": lens(10, 75, 120, 45) + 0.02 * cosine(4),
        "PAR narrow": 0.8 * gauss(5) + 0.17 * gauss(11) + 0.03 * gauss(30),
        "PAR wide": cosine(1) / (1 + (GAMMA / 16) ** 4),
        "reflector, hole": reflector(1, 4, 10, 25, 9, defocus=2.5),
        "reflector, satin": reflector(2, 5, 12, 30, 5),
        "batwing": step(60, 3) / np.maximum(np.cos(np.radians(np.minimum(GAMMA, 55))), 0.05) ** 3,
        "Lambertian": cosine(1),
        "profile spot": step(13, 0.6) * np.clip(1 - 0.15 * (GAMMA / 13) ** 2, 0, 1),
        "downlight": cosine(2) * step(38, 2.5),
    }
    return {name: beam / beam[0] for name, beam in beams.items()}


def last_above(beam, threshold):
    i = np.nonzero(beam >= threshold)[0][-1]
    if i + 1 >= len(GAMMA):
        return GAMMA[i]
    return GAMMA[i] + 0.5 * (beam[i] - threshold) / (beam[i] - beam[i + 1])


def half_angle(beam, level):
    """Where it last falls below that part of its peak, degrees."""
    return last_above(beam, level * beam.max())


def axis_angle(beam, level):
    """Where it last falls below that part of its axis, degrees."""
    return last_above(beam, level * beam[0])


def flux(beam):
    g = np.radians(GAMMA)
    y = 2 * np.pi * beam * np.sin(g)
    return float(np.sum(0.5 * (y[1:] + y[:-1]) * np.diff(g)))


def nine_angles(beam):
    """As a person would who has been told the field's edge: seven to it, two in the dark beyond."""
    edge = half_angle(beam, 0.1)
    if edge >= 70:
        return np.linspace(0, 85, 9)
    return np.r_[np.array([0, 0.2, 0.4, 0.6, 0.75, 0.88, 1]) * edge,
                 edge + (85 - edge) * np.array([0.25, 0.6])]


def readings(beam, candela, offset_m, distance_m, angles, noise, rng, set_deg=0.0, axis_deg=0.0):
    """[(angle, distance, lux)]: the meter faces the lamp, whose light starts behind its place. set_deg: 1 sigma of
    where each really stood, 0 on the axis; axis_deg: how far from the true axis angles are counted."""
    out = []
    for angle in angles:
        stood = angle + axis_deg + (set_deg * rng.normal() if set_deg else 0.0)
        x = distance_m * math.sin(math.radians(stood))
        z = distance_m * math.cos(math.radians(stood)) + offset_m
        seen = np.interp(math.degrees(math.atan2(abs(x), z)), GAMMA, beam)
        lux = candela * seen / (x * x + z * z) * (1 + noise * rng.normal())
        out.append((float(angle), distance_m, max(0.0, lux)))
    return out


def readings_on_plane(beam, candela, offset_m, distance_m, angles, noise, rng, set_m=0.0):
    """[(x, lux)] in a plane across the axis, to both sides in turn as far as 70 degrees; the meter faces
    the lamp's place, its light starts behind. set_m: 1 sigma of how far from x each really stood."""
    out = []
    for i, angle in enumerate(angles):
        said = (-1) ** i * distance_m * math.tan(math.radians(min(angle, 70.0)))
        x = said + (set_m * rng.normal() if set_m else 0.0)
        z = distance_m + offset_m
        r = math.hypot(x, z)
        facing = (x * x + z * distance_m) / (r * math.hypot(x, distance_m))
        seen = np.interp(math.degrees(math.atan2(abs(x), z)), GAMMA, beam)
        lux = candela * seen / (r * r) * facing * (1 + noise * rng.normal())
        out.append((float(said), max(0.0, lux)))
    return out
