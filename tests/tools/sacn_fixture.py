#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A bicolour fixture on sACN and the lux meter before it, in a process of its own.

    sacn_fixture.py LOG.jsonl

Prints "PORT TTY": the UDP port of 127.0.0.1 that it listens at, and the pseudo-terminal on which its
meter writes "lux,kelvin" fifty times a second. Its parser is written from ANSI E1.31-2018 alone and
refuses what that does not allow; LOG gets a line a packet and one a refusal. Slots 1 and 2: dimmer,
16 bits; slot 3: colour temperature. It answers a packet after 0.1 s with a time constant of 0.12 s, is
dark 2.5 s after the last packet and at once after a terminated stream.
"""
import json
import os
import pty
import random
import select
import socket
import struct
import sys
import time
import tty

LOSS_S = 2.5  # E131_NETWORK_DATA_LOSS_TIMEOUT


def parse(data):
    """-> the packet's fields, or ValueError with what the standard forbids."""
    def want(true, why):
        if not true:
            raise ValueError(why)

    want(len(data) >= 126, "shorter than 126 octets")
    preamble, postamble = struct.unpack_from(">HH", data, 0)
    want(preamble == 0x10 and postamble == 0, "preamble or postamble size")
    want(data[4:16] == bytes.fromhex("4153432d45312e3137000000"), "ACN packet identifier")
    for name, at in [("root", 16), ("framing", 38), ("DMP", 115)]:
        flags = struct.unpack_from(">H", data, at)[0]
        want(flags >> 12 == 7 and flags & 0xfff == len(data) - at, name + " flags and length")
    want(struct.unpack_from(">I", data, 18)[0] == 4, "root vector")
    want(struct.unpack_from(">I", data, 40)[0] == 2, "framing vector")
    name = data[44:108]
    want(0 in name, "source name not null-terminated")
    priority, sync, sequence, options, universe = struct.unpack_from(">BHBBH", data, 108)
    want(priority <= 200, "priority")
    want(1 <= universe <= 63999, "universe")
    want(options & 0x1f == 0, "reserved options")
    vector, kind, first, increment, count = struct.unpack_from(">BBHHH", data, 117)
    want((vector, kind, first, increment) == (2, 0xa1, 0, 1), "DMP header")
    want(count == len(data) - 125 and 1 <= count <= 513, "property value count")
    want(data[125] == 0, "start code")
    return {"cid": data[22:38].hex(), "source": name.split(b"\0")[0].decode("utf-8"),
            "priority": priority, "sync": sync, "sequence": sequence,
            "terminated": bool(options & 0x40), "preview": bool(options & 0x80),
            "universe": universe, "slots": list(data[126:])}


def light(slots):
    """lux and kelvin of the fixture; the label is not light: it begins at 4 % and bends."""
    d = (256 * slots[0] + slots[1]) / 65535
    warm = 1 - slots[2] / 255
    mired = 1e6 / 6200 + warm * (1e6 / 2800 - 1e6 / 6200)
    return 1200 * (0.04 + 0.96 * d)**0.95 * (1 - 0.25 * (2 * warm - 1)**2), 1e6 / mired


def main():
    log = open(sys.argv[1], "a", encoding="utf-8", buffering=1)
    udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    udp.bind(("127.0.0.1", 0))
    udp.setblocking(False)
    instrument, line = pty.openpty()
    tty.setraw(line)
    os.set_blocking(instrument, False)
    print(udp.getsockname()[1], os.ttyname(line), flush=True)
    noise = random.Random(1)
    heard = {}       # by CID: time, sequence
    coming = []      # (when it takes effect, lux, kelvin)
    target = now = (0.0, 4000.0)
    last = 0.0
    tick = time.monotonic()
    while True:
        wait = max(0.0, tick + 0.02 - time.monotonic())
        ready = select.select([udp, sys.stdin], [], [], wait)[0]
        if sys.stdin in ready:
            return  # whoever started it has gone, or is done
        at = time.monotonic()
        if udp in ready:
            data = udp.recv(2048)
            entry = {"at": at, "hex": data.hex()}
            try:
                packet = parse(data)
                before = heard.get(packet["cid"])
                step = (packet["sequence"] - before[1] + 128) % 256 - 128 if before else 1
                if before and at - before[0] < LOSS_S and -20 < step <= 0:
                    raise ValueError("out of sequence")
                heard[packet["cid"]] = (at, packet["sequence"])
                if packet["terminated"]:
                    heard.pop(packet["cid"])
                    coming = [(at, 0.0, 4000.0)]
                else:
                    last = at
                    coming.append((at + 0.1, *light(packet["slots"])))
                entry.update({k: v for k, v in packet.items() if k != "slots"},
                             slots=packet["slots"][:3])
            except ValueError as error:
                entry["refused"] = str(error)
            log.write(json.dumps(entry) + "\n")
        while coming and coming[0][0] <= at:
            target = coming.pop(0)[1:]
        if at - last > LOSS_S:
            target = (0.0, 4000.0)
        if at < tick + 0.02:
            continue
        share = 1 - 2.718281828**(-(at - tick) / 0.12)
        tick = at
        now = tuple(a + share * (b - a) for a, b in zip(now, target))
        text = f"{max(0.0, now[0]) * (1 + noise.gauss(0, 0.002)):.4f},{now[1]:.1f}\n"
        try:
            os.write(instrument, text.encode())
        except BlockingIOError:
            pass  # nobody reads: the line is full


if __name__ == "__main__":
    main()
