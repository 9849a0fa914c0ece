# SPDX-License-Identifier: Apache-2.0
"""Frames whose Orientation tag has viewers turn them: a place told in pixels is taken as it is stored, a warning says
so, and says where the box lies that a person read off a viewer. The viewer here is numpy.

    turned_frames.py LIGHTCAL SAMPLE_SESSION
"""
import json
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

import numpy as np

lightcal, sample = sys.argv[1], pathlib.Path(sys.argv[2])
# What a viewer does to the stored array.
SHOWN = {1: lambda a: a, 2: lambda a: a[:, ::-1], 3: lambda a: a[::-1, ::-1], 4: lambda a: a[::-1],
         5: lambda a: a.swapaxes(0, 1), 6: lambda a: np.rot90(a, -1),
         7: lambda a: np.rot90(a, 2).swapaxes(0, 1), 8: lambda a: np.rot90(a, 1)}


def box_of(mask):
    rows, columns = np.flatnonzero(mask.any(1)), np.flatnonzero(mask.any(0))
    return [int(n) for n in (columns[0], rows[0], columns.size, rows.size)]


def turn(path, orientation):
    """Its tag 274, which the file must have."""
    file = bytearray(path.read_bytes())
    first = struct.unpack_from("<I", file, 4)[0]
    for i in range(struct.unpack_from("<H", file, first)[0]):
        entry = first + 2 + 12 * i
        if struct.unpack_from("<H", file, entry)[0] == 274:
            struct.pack_into("<H", file, entry + 8, orientation)
            path.write_bytes(file)
            return
    raise AssertionError(f"{path} has no Orientation")


def answer(*arguments):
    done = subprocess.run([lightcal, *map(str, arguments), "--json"], check=True, capture_output=True, text=True)
    told = json.loads(done.stdout)
    return told, [w["message"] for w in told["warnings"] if w["code"] == "turned_frames"]


def refusal(*arguments):
    done = subprocess.run([lightcal, *map(str, arguments), "--json"], capture_output=True, text=True)
    assert done.returncode == 3, done
    error = json.loads(done.stdout)["error"]
    assert error["code"] in ("bad_region", "card_uneven"), error
    return error["message"]


with tempfile.TemporaryDirectory() as folder:
    session = pathlib.Path(folder) / "card"
    shutil.copytree(sample, session, ignore=shutil.ignore_patterns("out"))
    toml = session / "session.toml"
    text = toml.read_text()
    frames = sorted(session.glob("captures/*.dng"))
    info = json.loads(subprocess.run([lightcal, "merge", *frames, "-o", session / "lum.exr", "--json"], check=True,
                                     capture_output=True, text=True).stdout)
    width, height = info["width"], info["height"]
    card = [int(n) for n in re.search(r"rect = \[([^]]*)\]", text)[1].split(",")]
    stored = np.zeros((height, width), bool)
    stored[card[1]:card[1] + card[3], card[0]:card[0] + card[2]] = True
    upright, none = answer("fit", session)
    assert not none, none
    for orientation, shown in SHOWN.items():
        for frame in frames:
            turn(frame, orientation)
        # The readings do not depend on how a viewer shows them.
        told, warned = answer("fit", session)
        assert told["lights"][0]["intensity_cd"] == upright["lights"][0]["intensity_cd"], orientation
        # A place that no viewer shows there, or shows where it is stored, can only be meant as stored.
        meant = np.zeros_like(shown(stored))
        meant[card[1]:card[1] + card[3], card[0]:card[0] + card[2]] = True
        doubtful = meant.sum() == stored.sum() and (meant.shape != stored.shape or (meant != shown(stored)).any())
        assert len(warned) == doubtful, (orientation, warned)
        # Somebody writes down what the viewer shows: warning or refusal names the card.
        read_off = box_of(shown(stored))
        toml.write_text(re.sub(r"rect = \[[^]]*\]", f"rect = {read_off}", text))
        if read_off != card:
            outside = read_off[0] + read_off[2] > width or read_off[1] + read_off[3] > height
            for command in ("fit", session), ("merge", *frames, "-o", session / "lum.exr", "--force", "--anchor",
                                              ",".join(map(str, read_off)) + "=100"):
                uneven = command[0] == "fit"  # beside the card
                said = refusal(*command) if outside or uneven else answer(*command)[1][0]
                print(orientation, read_off, said)
                assert said.endswith(f"{read_off} was read off a viewer: write {card}"), (orientation, said)
        toml.write_text(text)
        # Without a place there is nothing to ask about.
        assert not answer("merge", *frames, "-o", session / "lum.exr", "--force")[1]
