#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sample_data/MANIFEST.sha256 names every sample file with its hash; `sha256sum -c` reads it too.

    check_manifest.py            exit 1 and a line for each file missing, changed or not listed
    check_manifest.py --write    writes the manifest anew
"""
import hashlib
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2] / "sample_data"
MANIFEST = ROOT / "MANIFEST.sha256"


def files():
    for path in sorted(ROOT.rglob("*")):
        name = path.relative_to(ROOT).as_posix()
        made_by_run = name.startswith("sessions/") and "/out/" in name
        if path.is_file() and path != MANIFEST and not made_by_run:
            yield name, hashlib.sha256(path.read_bytes()).hexdigest()


def main():
    here = dict(files())
    if sys.argv[1:] == ["--write"]:
        MANIFEST.write_text("".join(f"{h}  {n}\n" for n, h in here.items()), encoding="utf-8")
        return
    listed = {}
    for line in MANIFEST.read_text(encoding="utf-8").splitlines():
        digest, name = line.split("  ", 1)
        listed[name] = digest
    offences = [f"not listed: {n}" for n in here.keys() - listed.keys()]
    offences += [f"listed but absent: {n}" for n in listed.keys() - here.keys()]
    offences += [f"changed: {n}" for n in here.keys() & listed.keys() if here[n] != listed[n]]
    if offences:
        sys.exit("\n".join(sorted(offences)))


if __name__ == "__main__":
    main()
