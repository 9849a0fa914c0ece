#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes one session per fixture and accessory of sample_data/lux_tables/lux_tables.csv.

    make_lux_sessions.py OUTPUT_DIR [--check]

--check compares with what is there instead of writing (a CTest keeps the sessions honest).
"""
import csv
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEAD = """\
# Written by tests/tools/make_lux_sessions.py from sample_data/lux_tables/lux_tables.csv.
# Illuminance as the manufacturer publishes it, distances from the front of the fixture. The meter
# name "data_sheet" is reserved: 2 % (1 sigma) a figure. cct_K is the nominal value on the fixture.
# The kind is spot: candela on the axis are known; the beam's angles are not, so no lumens are claimed.
lightcal = 1
name = "{name}"
"""


def slug(text):
    text = text.lower().replace("é", "e")
    return re.sub(r"[^a-z0-9]+", "_", text).strip("_")


def sessions():
    tables = {}
    with open(ROOT / "sample_data/lux_tables/lux_tables.csv", encoding="utf-8") as rows:
        for row in csv.DictReader(rows):
            session = tables.setdefault((row["fixture"], row["accessory"]), {})
            session.setdefault(row["nominal_cct_K"], []).append(row)
    for (fixture, accessory), by_cct in tables.items():
        text = HEAD.format(name=f"{fixture}, {accessory}")
        for cct in by_cct:
            text += f'\n[[light]]\nname = "{cct}K"\nkind = "spot"\n'
        for cct, rows in by_cct.items():
            for row in rows:
                text += (
                    f'\n[[reading]]\nlight = "{cct}K"\nmeter = "data_sheet"\n'
                    f'distance_m = {float(row["distance_m"])}\n'
                    f'illuminance_lx = {float(row["illuminance_lx"])}\ncct_K = {float(cct)}\n'
                )
        yield slug(f"{fixture} {accessory}"), text


def main():
    out = pathlib.Path(sys.argv[1])
    check = "--check" in sys.argv[2:]
    differing = []
    for name, text in sessions():
        path = out / name / "session.toml"
        if check:
            if not path.exists() or path.read_text(encoding="utf-8") != text:
                differing.append(str(path))
        else:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
    if differing:
        sys.exit("not what make_lux_sessions.py writes: " + ", ".join(differing))


if __name__ == "__main__":
    main()
