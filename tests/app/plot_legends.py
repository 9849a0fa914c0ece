#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every plot as a file of its own says what its marks mean, below its axes and within its frame.

usage: plot_legends.py LIGHTCAL
"""
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

SVG = "{http://www.w3.org/2000/svg}"
SESSION = '''lightcal = 1
[[light]]
name = "key"
kind = "point"
fixture = "bulb"
''' + "".join(f'[[reading]]\nlight = "key"\ndistance_m = {d}\nilluminance_lx = {e}\n{more}\n' for d, e, more in
              ((0.5, 203, ""), (1, 58, "cct_K = 2900"), (2, 20, ""), (2, 8.1, "shadow_card = true")))
WANTED = {"room": ("what the walls add", "what the card took away"),
          "distance": ("reading less the walls' light",), "residuals": ("the fitted lamp",),
          "chromaticity": ("Planckian locus",), "minutes": ("as foretold",)}


def check(name, path, words):
    root = ElementTree.parse(path).getroot()
    width, height = (float(v) for v in root.get("viewBox").split()[2:])
    keys = [g for g in root.iter(SVG + "g") if g.get("class") == "keys"]
    if len(keys) != 1:
        return [f"{name}: {len(keys)} legends"]
    faults = []
    texts = list(keys[0].iter(SVG + "text"))
    said = " · ".join(t.text for t in texts)
    faults += [f"{name}: says {said!r}, not {w!r}" for w in words if w not in said]
    drawn = [float(t.get("y")) for t in root.iter(SVG + "text") if t.get("y") and t not in texts]
    if min(float(t.get("y")) for t in texts) < max(drawn) + 10:
        faults.append(f"{name}: the legend stands on the plot")
    for text in texts:
        # 7.3 px a letter is wide for 13 px.
        if float(text.get("x")) + 7.3 * len(text.text) > width or float(text.get("y")) > height - 4:
            faults.append(f"{name}: {text.text!r} leaves the picture")
    return faults


def main():
    failures = []
    with tempfile.TemporaryDirectory() as folder:
        session = os.path.join(folder, "lamp")
        os.mkdir(session)
        with open(os.path.join(session, "session.toml"), "w", encoding="utf-8") as file:
            file.write(SESSION)
        for name, words in WANTED.items():
            path = os.path.join(folder, name + ".svg")
            subprocess.run([sys.argv[1], "report", session, "--plot", f"{name}={path}"], check=True,
                           capture_output=True)
            failures += check(name, path, words)
        for name, line in (("plan", ["plan", session, "--reach", "3m", "--plot"]),
                           ("color", ["color", "0.4476,0.4074", "--plot"]),
                           ("tm30", ["color", "--spectrum", "illuminant:FL11", "--vector-graphic"])):
            path = os.path.join(folder, name + ".svg")
            subprocess.run([sys.argv[1], *line, path], check=True, capture_output=True)
            failures += check(name, path, ())
    if failures:
        sys.exit("\n".join(failures))


if __name__ == "__main__":
    main()
