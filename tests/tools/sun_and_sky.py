# SPDX-License-Identifier: Apache-2.0
"""A sky of some kind over some ground, and discs of light in it, in cd/m2 by numpy: no header of lightcal. Discs are
drawn of 16 samples a pixel each way; +Y is the picture's middle, azimuth right of it."""
import numpy as np

Y709 = np.array([0.2126, 0.7152, 0.0722])


def direction(azimuth_deg, elevation_deg):
    a, e = np.radians([azimuth_deg, elevation_deg])
    return np.array([np.cos(e) * np.sin(a), np.cos(e) * np.cos(a), np.sin(e)])


class Panorama:
    def __init__(self, rows):
        self.rows, self.pitch = rows, np.pi / rows
        self.way = self._ways(np.arange(2 * rows) + 0.5, np.arange(rows) + 0.5)
        self.omega = np.sqrt(1 - self.way[..., 2] ** 2) * self.pitch ** 2
        self.rgb = np.zeros((rows, 2 * rows, 3))

    def _ways(self, x, y):
        azimuth, polar = np.meshgrid(x * self.pitch - np.pi, y * self.pitch)
        return np.stack([np.sin(polar) * np.sin(azimuth), np.sin(polar) * np.cos(azimuth), np.cos(polar)], -1)

    def add(self, nits, colour=(1.0, 1.0, 1.0)):
        colour = np.array(colour)
        self.rgb += np.asarray(nits)[..., None] * colour / (Y709 @ colour)

    def add_disc(self, azimuth_deg, elevation_deg, lux, diameter_deg=0.53, colour=(1.0, 1.0, 1.0)):
        """A disc that gives so many lux at normal incidence."""
        towards, fine = direction(azimuth_deg, elevation_deg), (np.arange(16) + 0.5) / 16
        half = np.radians(diameter_deg / 2)
        for y, x in zip(*np.nonzero(self.way @ towards > np.cos(half + 1.5 * self.pitch))):
            inside = (self._ways(x + fine, y + fine) @ towards > np.cos(half)).mean()
            self.rgb[y, x] += inside * lux / (np.pi * np.sin(half) ** 2) * np.array(colour) / (Y709 @ np.array(colour))

    def lux(self, normal):
        return float((self.rgb @ Y709 * np.clip(self.way @ np.asarray(normal, float), 0, None) * self.omega).sum())
