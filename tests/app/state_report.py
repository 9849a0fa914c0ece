#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `report` and `lights sheet` draw of lamps with controls: marks where the readings of
sample_data's dimmed_panels are, worked out here.

    state_report.py LIGHTCAL
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIGHTCAL = str(pathlib.Path(sys.argv[1]).resolve())
PANELS = ROOT / "sample_data/sessions/dimmed_panels"
HOME = pathlib.Path(tempfile.mkdtemp())
SVG = "{http://www.w3.org/2000/svg}"
# Of session.toml: lux by the dimmer's label at 4000 K, and CCT as the data has it.
LUX = {100: 9060.12, 50: 4991.49, 25: 2807.58, 12: 1584.18, 5: 907.063}


def run(*words):
    done = subprocess.run([LIGHTCAL, *map(str, words)], capture_output=True, text=True, cwd=HOME,
                          check=False, env=os.environ | {"XDG_DATA_HOME": str(HOME / "data")})
    assert done.returncode == 0, f"{words}: {done.stderr}"
    return done.stdout


def of_class(svg, tag, name):
    return [e for e in svg.iter(SVG + tag) if e.get("class") == name]


def path_points(element):
    return np.array([[float(x) for x in pair.split()]
                     for pair in re.findall(r"[ML]([-\d.]+ [-\d.]+)", element.get("d"))])


def the_figure_shows_readings_curve_band_and_promise():
    run("report", PANELS, "--light", "panel", "-o", "page.html", "--plot", "output=output.svg",
        "--plot", "cct=cct.svg", "--plot", "cct2=cct2.svg")
    svg = ElementTree.parse(HOME / "output.svg").getroot()
    legend, *marks = sorted((float(c.get("cx")), float(c.get("cy"))) for c in of_class(svg, "circle", "used"))
    assert legend == (11, 6) and len(marks) == 5, (legend, marks)
    labels = sorted(LUX)
    percent = [100 * LUX[k] / LUX[100] for k in labels]
    x, y = np.array(marks).T
    # Both axes are linear: label to px and percent to px.
    for px, values in ((x, labels), (y, percent)):
        fit = np.polyfit(values, px, 1)
        assert np.abs(np.polyval(fit, values) - px).max() < 0.05, (px, values)
    to_px = np.polyfit(percent, y, 1)
    [promise] = of_class(svg, "path", "guide")
    line = path_points(promise)
    assert abs(line[-1][1] - np.polyval(to_px, 100)) < 0.1, line[-1]
    assert abs(line[0][1] - np.polyval(to_px, 5)) < 0.1, line[0]
    [curve] = of_class(svg, "path", "model")
    points = path_points(curve)
    for px, py in marks:  # the curve goes through what was read
        assert abs(np.interp(px, points[:, 0], points[:, 1]) - py) < 0.3
    [band] = of_class(svg, "path", "band")
    assert len(path_points(band)) == 2 * len(points)
    page = (HOME / "page.html").read_text()
    # The panel's dimmer and colour, the others' one control.
    assert page.count("Light by its control") == 3 and "promise" in page
    assert page.count("Light by its second control") == 1
    # Along the colour control: 4 labels at full, promised y = x.
    svg = ElementTree.parse(HOME / "cct2.svg").getroot()
    marks = of_class(svg, "circle", "used")
    assert len(marks) >= 3, len(marks)
    assert of_class(svg, "path", "guide")
    # A lamp without controls has none.
    session = ROOT / "sample_data/sessions/three_real_lights"
    run("report", session, "-o", "plain.html")
    assert "by its control" not in (HOME / "plain.html").read_text()


def the_contact_sheet_shows_ranges():
    run("fit", PANELS, "-o", "panels.json")
    run("lights", "add", "panels.json")
    run("lights", "sheet", "-o", "sheet.svg")
    words = "".join(ElementTree.parse(HOME / "sheet.svg").getroot().itertext())
    assert "10 … 101 % by its controls" in words, words
    ends = [float(k) for k in re.search(r"(\d+) … (\d+) K", words).groups()]
    for (x, y), kelvin in (((0.444314, 0.397657), ends[0]), ((0.332523, 0.340148), ends[1])):
        n = (x - 0.3320) / (0.1858 - y)  # McCamy 1992
        assert abs(437 * n**3 + 3601 * n**2 + 6861 * n + 5517 - kelvin) < 10, (kelvin, words)


if __name__ == "__main__":
    TESTS = [the_figure_shows_readings_curve_band_and_promise, the_contact_sheet_shows_ranges]
    for test in TESTS:
        test()
    print(f"{len(TESTS)} tests")
