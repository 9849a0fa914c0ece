#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every file a session is calibrated from (session.toml, spectra, photometric files, pictures, a
camera's frames) is opened once in a `run`, hashes included: the system calls say so.

    opened_once.py LIGHTCAL STRACE
"""
import collections
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SAMPLES = pathlib.Path(__file__).resolve().parents[2] / "sample_data"
OPENED = re.compile(r'open(?:at)?\([^"]*"([^"]+)".*= \d+$', re.M)

SESSION = """lightcal = 1
[[light]]
name = "key"
kind = "point"
[[light]]
name = "downlight"
kind = "photometric"
distribution = "lamp.ies"
[[light]]
name = "card_lamp"
kind = "point"
[[light]]
name = "sky"
kind = "dome"
[[reading]]
light = "key"
distance_m = 0.5
illuminance_lx = 192.0
spectrum = "lamp.xls"
[[reading]]
light = "key"
distance_m = 1.0
illuminance_lx = 52.0
spectrum = "lamp.xls"
[[reading]]
light = "downlight"
distance_m = 2.0
illuminance_lx = 60.0
[[capture]]
light = "card_lamp"
frames = "captures/*.dng"
use = "card"
reflectance = 0.18
distance_m = 0.8
[[capture]]
light = "sky"
frames = "lobby.hdr"
use = "dome"
anchor_illuminance_lx = 420
"""


def make_everything(lightcal, folder):
    (folder / "captures").mkdir(parents=True)
    (folder / "session.toml").write_text(SESSION)
    for frame in (SAMPLES / "sessions/grey_card_dng/captures").glob("*.dng"):
        shutil.copy(frame, folder / "captures")
    shutil.copy(SAMPLES / "spectra/uprtek_cv600/Osram Osconiq 3000K.xls", folder / "lamp.xls")
    shutil.copy(SAMPLES / "pictures/latlong/lobby.hdr", folder)
    subprocess.run([lightcal, "photometric", SAMPLES / "photometric/sample2.ldt", "--to", "ies",
                    "-o", folder / "lamp.ies"], check=True, capture_output=True)


def opened(lightcal, strace, session, folder):
    """How often each file of the session was opened, by name."""
    for stale in folder.glob("calls.*"):
        stale.unlink()
    log = folder / "calls"
    # A log a thread: in one file a call that another cuts in two is no line any more.
    run = subprocess.run([strace, "-ff", "-o", log, "-e", "trace=open,openat",
                          lightcal, "run", session, "-o", folder / "out"],
                         capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"{session.name}: {run.stderr}")
    counts = collections.Counter()
    calls = "".join(own.read_text(errors="replace") for own in folder.glob("calls.*"))
    for path in OPENED.findall(calls):
        if path.startswith(str(session)) and pathlib.Path(path).is_file():
            counts[str(pathlib.Path(path).relative_to(session))] += 1
    return counts


def main():
    lightcal, strace = sys.argv[1:]
    faults = []
    with tempfile.TemporaryDirectory(prefix="opened_once.") as name:
        folder = pathlib.Path(name)
        make_everything(lightcal, folder / "everything")
        for sample in ("grey_card_exr", "lit_wall"):
            shutil.copytree(SAMPLES / "sessions" / sample, folder / sample,
                            ignore=shutil.ignore_patterns("out"))
        for session in ("everything", "grey_card_exr", "lit_wall"):
            counts = opened(lightcal, strace, folder / session, folder)
            missing = [str(path.relative_to(folder / session))
                       for path in (folder / session).rglob("*")
                       if path.is_file() and str(path.relative_to(folder / session)) not in counts]
            faults += [f"{session}: {path} was not opened at all" for path in missing]
            faults += [f"{session}: {path} was opened {count} times"
                       for path, count in sorted(counts.items()) if count != 1]
    if faults:
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    main()
