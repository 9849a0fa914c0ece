#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Engines that light matt surfaces by nine harmonics of a panorama: export says by how much those stray from it, in the worst
direction. The truth is integrated here.

    panorama_harmonics.py LIGHTCAL
"""
import pathlib
import re
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, run  # noqa: E402
from usdlux import write_exr  # noqa: E402

H, W = 128, 256
V, U = np.meshgrid((np.arange(H) + .5) / H, (np.arange(W) + .5) / W, indexing="ij")
EL, AZ = (.5 - V) * np.pi, (U - .5) * 2 * np.pi
TO = np.stack([np.sin(AZ) * np.cos(EL), np.cos(AZ) * np.cos(EL), np.sin(EL)], -1)
SR = np.pi / H * 2 * np.pi / W * np.cos(EL)
LUMA = np.array([.2126, .7152, .0722])


def unit(v):
    return np.array(v, float) / np.linalg.norm(v)


def basis(d):
    """Ramamoorthi and Hanrahan 2001."""
    x, y, z = d[..., 0], d[..., 1], d[..., 2]
    return np.stack([.282095 + 0 * x, .488603 * y, .488603 * z, .488603 * x, 1.092548 * x * y, 1.092548 * y * z,
                     .315392 * (3 * z * z - 1), 1.092548 * x * z, .546274 * (x * x - y * y)], -1)


def strays(picture, n):
    """(relative, own lx) on planes of normal n."""
    light = (picture @ LUMA) * SR
    own = np.einsum("yx,yxn->n", light, np.clip(TO @ n.T, 0, None))
    bands = np.array([np.pi] + [2 * np.pi / 3] * 3 + [np.pi / 4] * 5)
    nine = basis(n) @ (bands * np.einsum("yx,yxk->k", light, basis(TO)))
    return nine / own - 1, own


def dome(picture):
    write_exr(HOME / "p.exr", picture)
    run("dome", HOME / "p.exr", "--lux", 420, "-o", HOME / "d", "--force")


def said(target):
    out = answer("export", HOME / "d" / "light.json", "--to", target, "-o", HOME / "e", "--force")
    return [w["message"] for w in out.get("warnings", []) if w["code"] == "panorama_harmonics"]


soft = (np.clip(TO[..., 2:], 0, None) * np.array([.3, .5, 1.]) + .05
        + np.where(TO[..., 2:] < 0, .3, 0) * np.array([.5, .3, .2]))
sun = soft + 40 * np.exp(-(1 - TO @ unit([.7, .5, .5])) / .01)[..., None] * np.array([1., .8, .5])
everywhere = np.random.default_rng(3).normal(size=(300, 3))
everywhere /= np.linalg.norm(everywhere, axis=1)[:, None]

dome(sun)
worst = np.abs(strays(sun, everywhere)[0]).max()
assert 0.1 < worst, worst
for target in ("three", "filament", "gltf", "unreal", "unity"):
    messages = said(target)
    assert len(messages) == 1, (target, messages)
    percent, way = re.search(r"at worst ([\d.]+) % too (little|much)", messages[0]).groups()
    claim = float(percent) / 100 * (1 if way == "much" else -1)
    facing = unit([float(v) for v in re.search(r"facing \(([^)]*)\)", messages[0])[1].split(",")])
    there, _ = strays(sun, facing[None])
    assert abs(there[0] - claim) < .01, (target, there, messages)
    assert worst < abs(claim) + .02, (target, worst, messages)

# Those that integrate the picture, and a picture that nine harmonics hold, have nothing to say.
assert not said("blender") and not said("pbrt")
dome(1 + .5 * TO[..., 2:] * np.ones(3))
assert not said("three")
