#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The page in headless chromium, opened from the disk: what a person does with it on a phone, that it
answers as the program does, that its session runs in the program, that it asks for nothing.

    page.py LIGHTCAL MODULES [--count 60] [--screenshots DIR]
"""
import argparse
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import tomllib

from module_answers import WITHIN, color, difference, exposure, quick

HERE = pathlib.Path(__file__).resolve().parent
GATE = HERE.parents[1] / "report/browser/gate.mjs"
LARGEST = 2_000_000
LIGHTS = {"a </script> lamp": "ends no script"}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("lightcal", type=pathlib.Path)
    parser.add_argument("modules")
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--screenshots", type=pathlib.Path)
    options = parser.parse_args()
    program, modules = options.lightcal.resolve(), pathlib.Path(options.modules).resolve()
    faults = []

    def lightcal(*words, **more):
        return subprocess.run([program, *words], capture_output=True, text=True, check=False, **more)

    with tempfile.TemporaryDirectory() as folder:
        home = pathlib.Path(folder)
        made = lightcal("page", "-o", "lightcal.html", cwd=home)
        assert made.returncode == 0, made.stderr
        again = lightcal("page", "-o", "lightcal.html", cwd=home)
        if again.returncode != 0:
            faults.append(f"its own page is not replaced: {again.stderr}")
        page = home / "lightcal.html"
        if page.stat().st_size > LARGEST:
            faults.append(f"the page has {page.stat().st_size} bytes, more than {LARGEST}")
        rng = random.Random(7)
        kinds = [quick, color, exposure]
        lines = [[*kinds[i % 3](rng), "--json"] for i in range(options.count)]
        command = ["node", HERE / "page.mjs", modules, page]
        if options.screenshots:
            options.screenshots.mkdir(parents=True, exist_ok=True)
            command += ["--screenshots", options.screenshots.resolve()]
        asked = "\n".join(json.dumps({"words": words}) for words in lines)
        done = subprocess.run(command, input=asked, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        seen = json.loads(done.stdout)
        if seen["requests"] or seen["errors"]:
            faults.append(f"requests {seen['requests']}, errors {seen['errors']}")
        if "x" not in seen["refused"]:
            faults.append(f"a distance of letters is answered with {seen['refused']}")
        if ".preset.json" not in seen["saved"]:
            faults.append(f"saving a preset says {seen['saved']}")
        if "1200lx" not in seen["thousands"]:
            faults.append(f"1,200 lx is answered with {seen['thousands']}")
        if "slash" not in seen["unsaved"]:
            faults.append(f"saving a lamp named a/b says {seen['unsaved']}")
        sizes = {"5m,4.4m,2.8m": [5, 4.4, 2.8], "16ft,13ft,8ft": [4.8768, 3.9624, 2.4384],
                 "5, 4, 2.6, 0.7": [5, 4, 2.6]}
        for room, size in sizes.items():
            told = tomllib.loads(seen["rooms"][room])["room"]["size_m"]
            if told != size:
                faults.append(f"a room of {room} is saved as {told}")
        if seen["otherwise"]:
            faults.append(f"the screen answers otherwise than the phone: {seen['otherwise']}")
        worst = 0.0
        for words, answer in zip(lines, seen["answers"]):
            program_says = lightcal(*words)
            if answer["code"] != program_says.returncode:
                faults.append(f"{words} ends with {answer['code']}: {answer['err']}")
                continue
            if not program_says.stdout.strip():
                continue
            found, where = difference(json.loads(program_says.stdout), json.loads(answer["out"]), "")
            worst = max(worst, found)
            if found > WITHIN:
                faults.append(f"{words}: {where}")
        # The session that the page saves is the lamp that it showed.
        (home / "hall").mkdir()
        (home / "hall/session.toml").write_text(seen["session"], encoding="utf-8")
        fitted = lightcal("fit", "hall", "--json", cwd=home)
        assert fitted.returncode == 0, fitted.stderr + seen["session"]
        candela = json.loads(fitted.stdout)["lights"][0]["intensity_cd"]["value"]
        if abs(candela / seen["candela"] - 1) > WITHIN:
            faults.append(f"the page shows {seen['candela']} cd, its session gives {candela}")
        # Lights that the page carries along, whatever their names hold.
        quick_json = lightcal("quick", "203lx@0.5m", "--json")
        light = json.loads(quick_json.stdout)
        light["lights"][0]["name"] = "a </script> lamp"
        (home / "lamp.json").write_text(json.dumps(light), encoding="utf-8")
        carried = lightcal("export", "lamp.json", "--to", "page", "-o", "out", cwd=home)
        assert carried.returncode == 0, carried.stderr
        pages = [page, *home.glob("out/*.html")]
        if len(pages) != 2:
            faults.append(f"--to page wrote {pages}")
        gate = ["node", GATE, modules, *pages]
        if options.screenshots:
            gate += ["--screenshots", options.screenshots.resolve()]
        looked = subprocess.run(gate, capture_output=True, text=True, check=False)
        if looked.returncode != 0:
            faults.append(looked.stderr)
        slowest = max(answer["ms"] for answer in seen["answers"])
        print(f"{page.stat().st_size} bytes, first answer {seen['ready_ms']} ms, {len(lines)} answers "
              f"within {worst:.2g}, the slowest {slowest:.0f} ms")
    if faults:
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    main()
