# SPDX-License-Identifier: Apache-2.0
"""A reflector whose light starts 20 cm before the mark it is measured from, cos^12 about its axis: read on
the axis and to 40 degrees from the mark, then asked of `simulate` on and off the axis, near and far. Its
light is I(angle at the source)/r^2 from the source. Written without a header of lightcal."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

LIGHTCAL = str(pathlib.Path(sys.argv[1]).resolve())
PEAK, POWER, BEFORE = 1000.0, 12, 0.20


def lux(x, y):
    """At (x, y) from the mark, x along the axis; the meter faces the mark."""
    from_source = math.hypot(x - BEFORE, y)
    turned = ((x - BEFORE) * x + y * y) / from_source / math.hypot(x, y)
    return PEAK * ((x - BEFORE) / from_source) ** POWER / from_source**2 * turned


def at(distance, degrees):
    return distance * math.cos(math.radians(degrees)), distance * math.sin(math.radians(degrees))


read = [(1, 0), (2, 0), (1, 10), (1, 15), (1, 20), (1, 30), (1, 40)]
readings = [f"{lux(*at(d, a)):.6g}lx@{d}m" + (f",{a}deg" if a else "") for d, a in read]
with tempfile.TemporaryDirectory() as folder:
    answer = subprocess.run([LIGHTCAL, "quick", *readings, "--fixture", "reflector", "--room", "dark", "--meter",
                             "2%", "--json"], check=True, capture_output=True)
    light = pathlib.Path(folder) / "light.json"
    light.write_bytes(answer.stdout)
    for distance, degrees, most in ((1.0, 0, 0.01), (3.0, 0, 0.01), (0.8, 15, 0.05), (0.8, 25, 0.05), (1.5, 25, 0.05),
                                    (3.0, 25, 0.05)):
        x, y = at(distance, degrees)
        done = subprocess.run([LIGHTCAL, "simulate", light, "--position", "0,0,1", "--aim", "1,0,0", "--at",
                               f"{x:.6f},{y:.6f},1", "--normal", f"{-x:.6f},{-y:.6f},0", "--json"], check=True,
                              capture_output=True, text=True)
        point = json.loads(done.stdout)["points"][0]
        found = point["illuminance_lx"]["value"]
        off = found / lux(x, y) - 1
        print(f"{distance} m, {degrees} degrees: {found:.1f} lx of {lux(x, y):.1f}, {off:+.1%}")
        assert abs(off) < most, (distance, degrees)
