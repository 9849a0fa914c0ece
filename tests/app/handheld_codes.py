# SPDX-License-Identifier: Apache-2.0
"""`lightcal merge --align auto` of brackets shot from the hand by a camera that bends its codes (a toe and a
shoulder, as makers like them). The bend must not be taken for slopes of the scene, which moves edges. Scenes are
soft discs and bars in closed form, so that the truth is the turn that made each frame; no header of lightcal.
The large proof, on panoramas and beside Hugin, is tests/bench/handheld_brackets."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402
from plain_png import write_png  # noqa: E402

W, H, FOCAL = 480, 320, 420.0
TIMES = [4.0**i / 256 for i in range(3)]
WITHIN_PX = 0.1
SEEDS = (1, 2, 4)


def rotation(yaw, pitch, roll):
    (cy, sy), (cp, sp), (cr, sr) = ((np.cos(a), np.sin(a)) for a in (yaw, pitch, roll))
    return (np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]]) @ np.array([[1, 0, 0], [0, cp, -sp], [0, sp, cp]]) @
            np.array([[cr, -sr, 0], [sr, cr, 0], [0, 0, 1]]))


class Scene:
    """ln of light at places of the picture's plane, one unit in front of the camera."""

    def __init__(self, rng):
        self.at = rng.uniform((-0.8, -0.55), (0.8, 0.55), (40, 2))
        self.reach = rng.uniform(0.03, 0.22, 40)
        self.squash = rng.uniform(0.4, 2.5, 40)
        self.soft = rng.uniform(0.004, 0.05, 40)
        self.ln = rng.uniform(-1.6, 1.6, 40)
        self.slope = rng.uniform(-1.2, 1.2, 2)

    def __call__(self, x, y):
        ln = self.slope[0] * x + self.slope[1] * y
        for at, reach, squash, soft, own in zip(self.at, self.reach, self.squash, self.soft, self.ln):
            far = np.hypot((x - at[0]) * squash, (y - at[1]) / squash) - reach
            ln = ln + own / (1 + np.exp(np.clip(far / soft, -50, 50)))
        return ln


def tone(x, contrast, shoulder):
    s = (1 - np.exp(-shoulder * x)) / (1 - np.exp(-shoulder))
    g = s ** (1 / 2.2)
    return np.clip(g + contrast * g * (1 - g) * (2 * g - 1), 0, 1)


def worst_frame(seed):
    rng = np.random.default_rng([29, seed])
    scene, contrast, shoulder = Scene(rng), rng.uniform(0.2, 0.5), rng.uniform(1.2, 2.4)
    camera = np.array([[FOCAL, 0, W / 2], [0, FOCAL, H / 2], [0, 0, 1]])
    y, x = np.mgrid[:H, :W] + 0.5
    pixels = np.stack([x, y, np.ones_like(x)], -1)
    turns, files = [], []
    for i, time in enumerate(TIMES):
        turn = np.eye(3) if i == 1 else rotation(*np.radians(rng.uniform((-3, -2, -1.5), (3, 2, 1.5))))
        d = pixels @ np.linalg.inv(camera).T @ turn.T
        light = np.exp(scene(d[..., 0] / d[..., 2], d[..., 1] / d[..., 2])) * time / TIMES[1] * 0.12
        electrons = rng.poisson(np.minimum(light, 3.0)[..., None] * 20_000 * np.ones(3)) / 20_000
        codes = np.round(255 * tone(np.clip(electrons + rng.normal(0, 3e-4, (H, W, 3)), 0, 1), contrast, shoulder))
        files.append(HOME / f"{seed}_{i}.png")
        write_png(files[-1], codes.astype(np.uint8))
        turns.append(turn)
    found = answer("merge", *files, "-o", HOME / f"{seed}.exr", "--align", "auto", "--f-number", "8", "--iso", "100",
                   "--mains", "none", "--exposures", ",".join(map(repr, TIMES)))
    left, top, wide, high = found["crop"]
    places = np.stack(np.meshgrid(np.linspace(left, left + wide, 21), np.linspace(top, top + high, 15)) +
                      [np.ones((15, 21))], -1)
    worst = 0.0
    for frame, turn in zip(found["frames"], turns):
        a, b = (places @ np.reshape(h, (3, 3)).T for h in
                (frame["homography"], camera @ turn.T @ np.linalg.inv(camera)))
        off = a[..., :2] / a[..., 2:] - b[..., :2] / b[..., 2:]
        worst = max(worst, float(np.sqrt(np.mean(np.sum(off * off, -1)))))
    return worst


errors = [worst_frame(seed) for seed in SEEDS]
print("worst frame of each bracket, pixels:", " ".join(f"{e:.3f}" for e in errors))
assert max(errors) < WITHIN_PX, errors
