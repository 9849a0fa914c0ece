#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tapes of the small serial meters, from their published frames; no byte came from a real meter.

    make_small_meter_tapes.py FOLDER            writes FOLDER/<driver>_<what>.tape
    make_small_meter_tapes.py FOLDER --check    exit 1 when a tape there says anything else
"""
import json
import math
import pathlib
import struct
import sys

SILENCE = None


def exchange(t_ms, op, data):
    line = {"t_ms": t_ms, "op": op}
    if data is SILENCE:
        return {**line, "fault": "timeout"}
    key = "sent" if op == "write" else "got"
    if all(b < 0x7F for b in data):
        return {**line, key: data.decode("ascii")}
    return {**line, key + "_hex": data.hex()}


def tape(driver, device, note, dialogue):
    header = {"schema": "lightcal.tape/1", "driver": driver, "device": device, "note": note}
    lines = [header]
    for i, (op, data) in enumerate(dialogue):
        lines.append(exchange(i, op, data))
    return "".join(json.dumps(line, separators=(",", ":")) + "\n" for line in lines)


def reads(*pieces):
    return [("read", piece) for piece in pieces]


def writes(*pieces):
    return [("write", piece) for piece in pieces]


SYNTHETIC = "synthetic: every byte follows the documentation, none came from a real meter; "


def ut382():
    frame = bytes.fromhex(
        "303035363c3f3e35303630303030303030303832323e30303030303030300d0a00"
    )
    # Joined in mid-frame: its last 12 bytes and the one after it, then a whole frame.
    first = frame[20:] + frame[:19]
    dialogue = reads(SILENCE, first, frame[19:32])
    return tape("ut382", "ut382:UT382", SYNTHETIC + "a frame of 123.4 lx, joined in mid-frame",
                dialogue)


def gm1020():
    def command(argument):
        body = bytes([0x3C, argument, 0, 0, 0, 0, 0])
        return [bytes([b]) for b in body + bytes([sum(body) % 256])]

    frame = bytes.fromhex("332204d20100fd11")
    dialogue = reads(SILENCE) + writes(*command(1)) + reads(frame) + writes(*command(2))
    return tape("gm1020", "gm1020:GM1020", SYNTHETIC + "123.4 lx at 25.3 degrees Celsius", dialogue)


def pce174():
    reply = bytes.fromhex("aadd0026061121123456" + "0c220c22" + "81200001")
    dialogue = reads(SILENCE) + writes(bytes.fromhex("878311")) + reads(reply[:10], reply[10:])
    return tape("pce174", "pce174:PCE-174", SYNTHETIC + "123.4 lx with a low battery", dialogue)


def lutron16():
    def frame(text):
        return b"\x024" + text.encode("ascii") + b"\r"

    dialogue = reads(SILENCE, frame("2010100000253"), frame("1150100001234"))
    return tape("lutron16", "lutron16:Lutron",
                SYNTHETIC + "25.3 degrees on the lower display, 123.4 lx on the upper", dialogue)


def message(direction, kind, data=b""):
    body = bytes([0xCC, direction]) + (9 + len(data)).to_bytes(3, "little") + bytes([kind]) + data
    return body + bytes([sum(body) % 256]) + b"\r\n"


def planckian(nm, kelvin):
    metres = nm * 1e-9
    return metres**-5 / math.expm1(1.4388e-2 / (metres * kelvin))


def torch_data(samples, exponent=6, microseconds=20000, number=0x1234ABCD, extra=0x0102030405060708):
    bits = struct.pack("<f", microseconds / 1000)
    little, big = int.from_bytes(bits, "little"), int.from_bytes(bits, "big")
    common = big ^ (extra >> 16)
    first = (common ^ ((little ^ number) >> 16) ^ number ^ extra) & 0xFFFF
    second = ((common >> 16) ^ little ^ number) & 0xFFFF
    masked = [s ^ (first if i < len(samples) // 2 else second) for i, s in enumerate(samples)]
    return (bytes([0]) + struct.pack("<I", microseconds) + struct.pack(">H", exponent ^ 8848)
            + struct.pack("<IQ", number, extra) + struct.pack(f"<{len(masked)}H", *masked))


def torchbearer():
    kelvin = 2848 * 1.4388 / 1.435  # CIE illuminant A
    highest = planckian(1015, kelvin)
    samples = [round(50000 * planckian(nm, kelvin) / highest) for nm in range(340, 1051)]
    answers = [
        (message(1, 0x08, b"\x18"), message(0x81, 0x08, b"Y21B7W-0042")),
        (message(1, 0x0F), message(0x81, 0x0F, struct.pack("<HH", 340, 1050))),
        (message(1, 0x0B), message(0x81, 0x0B, b"\x01")),
        (message(1, 0x33), message(0x81, 0x33, torch_data(samples))),
        (message(1, 0x04), message(0x81, 0x04)),
    ]
    dialogue = reads(SILENCE)
    for i, (asked, answered) in enumerate(answers):
        # Identified, then measured: the line is emptied before either.
        dialogue += reads(SILENCE) if i == 1 else []
        dialogue += writes(asked) + reads(answered[:5], answered[5:])
    return tape("torchbearer", "torchbearer:Y21B7W-0042", SYNTHETIC + "CIE illuminant A", dialogue)


TAPES = {
    "ut382_123lx": ut382,
    "gm1020_123lx": gm1020,
    "pce174_123lx_battery_low": pce174,
    "lutron16_123lx": lutron16,
    "torchbearer_illuminant_a": torchbearer,
}


def main():
    folder = pathlib.Path(sys.argv[1])
    for name, make in TAPES.items():
        path = folder / f"{name}.tape"
        if sys.argv[2:] != ["--check"]:
            path.write_text(make(), encoding="ascii")
        elif path.read_text(encoding="ascii") != make():
            sys.exit(f"{path} is not what this script makes")


if __name__ == "__main__":
    main()
