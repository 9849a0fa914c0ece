#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws lib/house.svg: the rooms, and the arrows that their #includes really make.

    draw_house.py            writes lib/house.svg
    draw_house.py --check    exit 1 when lib/house.svg is not what it would write

An arrow that follows from others (report includes light, but also records, which includes light) is
left out.
"""
import html
import pathlib
import sys

from check_includes import INCLUDE, room_of

ROOT = pathlib.Path(__file__).resolve().parents[2]
PICTURE = ROOT / "lib/house.svg"
WIDTH, ROW, BOX_HEIGHT, TOP = 932, 104, 58, 48
# Room: row from above, centre, width, what it holds.
ROOMS = {
    "app": (0, 466, 902, "commands, the terminal, every file that is written"),
    "calibrate": (1, 558, 718, "session to lights, bracket to luminance, panorama to dome"),
    "devices": (2, 100, 168, "wires, pictures, files"),
    "imaging": (2, 268, 138, "frames to nits"),
    "fit": (2, 408, 112, "readings to lamp"),
    "presets": (2, 536, 116, "lamp to engine"),
    "report": (2, 660, 104, "plots, page"),
    "tradeoff": (2, 782, 112, "accuracy, time"),
    "match": (2, 881, 72, "gels"),
    "records": (3, 466, 902, "Reading, Frame, Session, FittedLight and their files"),
    "light": (4, 600, 290, "models of sources, effects, the gate"),
    "colorimetry": (4, 310, 260, "spectra, XYZ, CCT, CRI, RGB"),
    "photometry": (5, 600, 290, "I = E d², cones, exposure"),
    "core": (6, 466, 902, "units, Result, numbers as text"),
}
# Row: what stands in it, its colour.
BANDS = [("mouth and ears", "#e8e4db"), ("where verbs meet", "#f7d9c4"), ("verbs", "#fbe3b5"), ("nouns", "#cfe3f5"),
         ("laws: no file, no third party", "#d9ecd2"), ("", "#d9ecd2"), ("", "#ece9e3")]


def target_of(header):
    parts = header.split("/")
    if parts[0] == "lightcal_devices":
        return "devices"
    return parts[1] if parts[0] == "lightcal" and len(parts) > 2 else None


def arrows():
    """room -> the rooms its files include."""
    found = {room: set() for room in ROOMS}
    for house in ("lib", "devices", "app"):
        for path in (ROOT / house).rglob("*"):
            if path.suffix not in (".h", ".cc"):
                continue
            place, room = room_of(path.relative_to(ROOT).as_posix())
            own = room or place
            for header in INCLUDE.findall(path.read_text(encoding="utf-8")):
                target = target_of(header)
                if target and target != own:
                    found[own].add(target)
    return found


def reach(found, start):
    below, todo = set(), [start]
    while todo:
        for room in found[todo.pop()]:
            if room not in below:
                below.add(room)
                todo.append(room)
    return below


def drawn(found):
    return sorted((room, target) for room, targets in found.items() for target in targets
                  if not any(target in reach(found, other) for other in targets))


def top_of(room):
    return TOP + ROOMS[room][0] * ROW


def text(x, y, words, size, fill="#26231f", weight=400, anchor="middle"):
    return (f'<text x="{x:g}" y="{y:g}" font-size="{size}" fill="{fill}" font-weight="{weight}" '
            f'text-anchor="{anchor}">{html.escape(words)}</text>')


def arrow(room, target):
    """Straight down where the boxes stand over each other, else in a bow."""
    spans = [(ROOMS[name][1] - ROOMS[name][2] / 2 + 14, ROOMS[name][1] + ROOMS[name][2] / 2 - 14)
             for name in (room, target)]
    low, high = max(spans[0][0], spans[1][0]), min(spans[0][1], spans[1][1])
    x1 = x2 = (low + high) / 2
    if low > high:
        x1 = ROOMS[room][1]
        x2 = spans[1][0] if x1 < spans[1][0] else spans[1][1]
    y1, y2 = top_of(room) + BOX_HEIGHT, top_of(target) - 7
    middle = (y1 + y2) / 2
    return (f'<path d="M{x1:g} {y1:g}C{x1:g} {middle:g} {x2:g} {middle:g} {x2:g} {y2:g}" fill="none" '
            f'stroke="#6f675c" stroke-width="1.6" marker-end="url(#head)"/>')


def draw():
    height = TOP + len(BANDS) * ROW - 20
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" role="img" '
           'font-family="Inter, Helvetica, Arial, \'Liberation Sans\', sans-serif">',
           "<title>The rooms of lightcal and which includes which</title>",
           '<defs><marker id="head" viewBox="0 0 8 8" refX="2" refY="4" markerWidth="7" '
           'markerHeight="7" orient="auto"><path d="M0 0L8 4L0 8Z" fill="#6f675c"/></marker></defs>',
           f'<rect width="{WIDTH}" height="{height}" rx="14" fill="#fbf9f4"/>']
    out += [arrow(room, target) for room, target in drawn(arrows())]
    for name, (row, centre, width, holds) in ROOMS.items():
        y = top_of(name)
        out.append(f'<rect x="{centre - width / 2:g}" y="{y}" width="{width}" height="{BOX_HEIGHT}" '
                   f'rx="9" fill="{BANDS[row][1]}" stroke="#c9c0b1"/>')
        out.append(text(centre, y + 25, name, 17, weight=650))
        out.append(text(centre, y + 45, holds, 12.5, "#4a443c"))
    for row, (words, _) in enumerate(BANDS):
        if words:
            out.append(text(18, TOP + row * ROW - 10, words, 12.5, "#8a8175", anchor="start"))
    return "\n".join(out) + "\n</svg>\n"


def main():
    if sys.argv[1:] == ["--check"]:
        if PICTURE.read_text(encoding="utf-8") != draw():
            sys.exit("lib/house.svg shows other rooms or arrows than the #includes make: run "
                     "tests/architecture/draw_house.py")
        return
    PICTURE.write_text(draw(), encoding="utf-8")


if __name__ == "__main__":
    main()
