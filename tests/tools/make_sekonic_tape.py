#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A tape of one measurement by a Sekonic C-800, around a captured reply to NR.

    make_sekonic_tape.py REPLY.nr OUT.tape            writes the tape
    make_sekonic_tape.py REPLY.nr OUT.tape --check    exit 1 when OUT.tape says anything else

Only the reply to NR was captured from a real meter; the dialogue around it follows
devices/lightcal_devices/meters/sekonic/README.md.
"""
import json
import pathlib
import sys

ACKNOWLEDGE = b"\x06\x30"
IDLE = b"ST\x40\x40\x40"
IDLE_REMOTE = b"ST\x42\x40\x40"
MEASURING = b"ST\x43\x48\x40"


def with_bytes(line, key, data):
    """As the tape codec writes bytes: text below 0x7f, else hexadecimal."""
    if all(b < 0x7F for b in data):
        line[key] = data.decode("ascii")
    else:
        line[key + "_hex"] = data.hex()
    return line


def printed(line):
    return json.dumps(line, separators=(",", ":"))


def tape(reply_name, reply):
    dialogue = [
        (b"MN", b"MN@@@C-800" + bytes(5)),
        (b"ST", IDLE),
        (b"RT1", b"RT@@@"),
        (b"RM0", b"RM@@@"),
        (b"ST", MEASURING),
        (b"ST", IDLE_REMOTE),
        (b"NR", reply),
        (b"RT0", b"RT@@@"),
    ]
    lines = [
        printed(
            {
                "schema": "lightcal.tape/1",
                "driver": "sekonic",
                "device": "sekonic:C-800",
                "note": f"made from the captured reply {reply_name}; the rest follows the protocol",
            }
        )
    ]
    elapsed_ms = 0
    for command, answer in dialogue:
        lines.append(printed(with_bytes({"t_ms": elapsed_ms, "op": "write"}, "sent", command)))
        for late_ms, data in ((1, ACKNOWLEDGE), (2, answer)):
            line = {"t_ms": elapsed_ms + late_ms, "op": "read"}
            lines.append(printed(with_bytes(line, "got", data)))
        elapsed_ms += 50
    return "\n".join(lines) + "\n"


def main():
    source, target = map(pathlib.Path, sys.argv[1:3])
    text = tape(source.name, source.read_bytes())
    if sys.argv[3:] != ["--check"]:
        target.write_text(text, encoding="ascii")
    elif target.read_text(encoding="ascii") != text:
        sys.exit(f"{target} is not what {source} makes")


if __name__ == "__main__":
    main()
