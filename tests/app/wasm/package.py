#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The npm package, packed and installed from its tarball into an empty folder: every sample session
that needs no picture gives the program's files; what it cannot do it says.

    package.py LIGHTCAL WASM [--report]
"""
import argparse
import difflib
import io
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

from module_answers import difference

ROOT = pathlib.Path(__file__).resolve().parents[3]
SESSIONS = ROOT / "sample_data/sessions"
LARGEST = 3 * 1024 * 1024
WITHIN = 1e-9
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")


def as_text(name, data):
    """A file as text; of a GDTF archive all that it holds, one after another."""
    if not name.endswith(".gdtf"):
        return data.decode()
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return "".join(f"{entry}\n{archive.read(entry).decode('latin-1')}"
                       for entry in sorted(archive.namelist()))


def numbers_apart(a, b):
    """The largest relative difference of two texts that differ in numbers alone, else infinite."""
    if NUMBER.sub("#", a) != NUMBER.sub("#", b):
        return float("inf")
    pairs = zip(map(float, NUMBER.findall(a)), map(float, NUMBER.findall(b)))
    return max((abs(x - y) / max(abs(x), abs(y), 1e-6) for x, y in pairs), default=0.0)


def linked(run, home, who):
    """What becomes of symbolic links: (exit code, the last line said, the kind of file) of each."""
    place = home / f"links_{who}"
    shutil.copytree(SESSIONS / "three_real_lights", place / "real", ignore=shutil.ignore_patterns("out"))
    (place / "outs").mkdir()
    (place / "link").symlink_to("real")
    (place / "out").symlink_to("outs")
    (place / "old.json").write_text("{}")
    light, seen = place / "outs/light.json", []

    def ask(what):
        done = run("run", place / "link", "-o", place / "out", "--to", "gltf", "--force")
        said = (done.stderr.splitlines() or [""])[-1] if done.returncode else ""
        seen.append((what, done.returncode, said.replace(str(place), "")))

    ask("a session and an output folder behind links")
    light.unlink()
    light.symlink_to("../old.json")
    ask("an output that is a link")
    seen.append(("it is a file now, what it led to is as it was", light.is_symlink(),
                 (place / "old.json").read_text()))
    light.unlink()
    light.symlink_to("../real/session.toml")
    ask("an output that leads to an input")
    light.unlink()
    shutil.move(place / "real/session.toml", place / "session.toml")
    (place / "real/session.toml").symlink_to("../session.toml")
    ask("a session.toml that leads out of its folder")
    return seen


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("lightcal", type=pathlib.Path)
    parser.add_argument("wasm", type=pathlib.Path)
    parser.add_argument("--report", action="store_true", help="what differs, in full")
    options = parser.parse_args()
    program, faults = options.lightcal.resolve(), []
    with tempfile.TemporaryDirectory() as folder:
        home = pathlib.Path(folder)
        packed = subprocess.run([ROOT / "app/wasm/make_npm", options.wasm.resolve()], check=True,
                                capture_output=True, text=True,
                                env=os.environ | {"NPM_TARGET": str(home / "packed")})
        tarball = pathlib.Path(packed.stdout.splitlines()[-1])
        if tarball.stat().st_size > LARGEST:
            faults.append(f"{tarball.name} has {tarball.stat().st_size} bytes")
        clean = home / "clean"
        clean.mkdir()
        # A PATH of node alone: no lightcal to lean on.
        subprocess.run(["npm", "install", "--offline", "--no-audit", "--no-fund", tarball], cwd=clean,
                       check=True, capture_output=True, env=os.environ | {"HOME": str(home)})
        described = json.loads((clean / "node_modules/lightcal/package.json").read_text())
        if described.get("dependencies") or described.get("scripts"):
            faults.append("the package has dependencies or scripts")
        lightcal = clean / "node_modules/.bin/lightcal"

        def node(*words, **more):
            return subprocess.run([lightcal, *words], cwd=clean, capture_output=True, text=True,
                                  check=False, **more)

        same = apart = 0
        worst = (0.0, "")
        for session in sorted(SESSIONS.iterdir()):
            text = (session / "session.toml").read_text(encoding="utf-8")
            name = session.name
            outs = {}
            for who in ("program", "package"):
                place = home / who / name
                shutil.copytree(session, place, ignore=shutil.ignore_patterns("out"))
                outs[who] = place / "out"
            ours = node("run", home / "package" / name)
            if "[[capture]]" in text:
                if ours.returncode != 3 or "picture" not in ours.stderr:
                    faults.append(f"{name}: pictures end with {ours.returncode}: {ours.stderr}")
                continue
            theirs = subprocess.run([program, "run", home / "program" / name], capture_output=True,
                                    text=True, check=False)
            if ours.returncode != theirs.returncode:
                faults.append(f"{name}: ends with {ours.returncode}: {ours.stderr}")
                continue
            if ours.stdout.replace("/package/", "/program/") != theirs.stdout:
                faults.append(f"{name} prints\n" + "\n".join(difflib.unified_diff(
                    theirs.stdout.splitlines(), ours.stdout.splitlines(), "program", "package", n=0)))
            names = sorted(p.name for p in outs["program"].iterdir())
            if names != sorted(p.name for p in outs["package"].iterdir()):
                faults.append(f"{name}: other files")
                continue
            for file in names:
                wanted, got = ((outs[who] / file).read_bytes() for who in ("program", "package"))
                if wanted == got:
                    same += 1
                    continue
                apart += 1
                a, b = as_text(file, wanted), as_text(file, got)
                found = (difference(json.loads(a), json.loads(b), "") if file.endswith(".json")
                         else (numbers_apart(a, b), ""))
                worst = max(worst, (found[0], f"{name}/{file} {found[1]}"))
                if options.report:
                    print(f"{name}/{file}: {found[0]:.2g} {found[1]}")
                if found[0] > WITHIN:
                    faults.append(f"{name}/{file}: apart by {found[0]:.3g} {found[1]}")
        ours, theirs = linked(node, home, "package"), linked(
            lambda *words: subprocess.run([program, *words], capture_output=True, text=True, check=False),
            home, "program")
        faults += [f"links: {a} is not {b}" for a, b in zip(ours, theirs) if a != b]
        if [code for _, code, _ in theirs] != [0, 0, False, 3, 1]:
            faults.append(f"the program itself: {theirs}")
        wrote = node("quick", "52lx@1m,card=5lx", "--to", "unreal", "-o", "presets")
        if wrote.returncode != 0 or not list((clean / "presets").glob("*.unreal.py")):
            faults.append(f"quick --to unreal: {wrote.stderr}")
        for words, code, said in [(["color", "--cct", "3200K"], 0, ""),
                                  (["exposure", "--aperture", "2.8", "--shutter", "1/60", "--iso", "100"], 0, ""),
                                  (["photometric", ROOT / "sample_data/photometric/sample2.ldt"], 0, ""),
                                  (["merge", "a.dng", "-o", "b.exr"], 1, "Linux"),
                                  (["devices"], 1, "Linux"), (["quick", "52lx"], 2, "52lx")]:
            done = node(*words)
            if done.returncode != code or said not in done.stderr:
                faults.append(f"{words} ends with {done.returncode}: {done.stderr}")
        print(f"{tarball.stat().st_size} bytes; {same} files equal to the byte, {apart} differ, the "
              f"most by {worst[0]:.2g}: {worst[1]}")
    if faults:
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    main()
