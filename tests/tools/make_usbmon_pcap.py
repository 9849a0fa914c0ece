#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A lightcal tape as a usbmon capture that umockdev-run --pcap plays to the real libusb.

    make_usbmon_pcap.py IN.tape OUT.pcap

Link type 220 (USB_LINUX_MMAPPED): each transfer is a submission and a completion, a 64-byte header
and the data (Linux Documentation/usb/usbmon.rst). The device is bus 1, address 2, with bulk OUT
0x02 and bulk IN 0x81; each IN transfer asks for 4160 bytes, as transport/usb.h promises.
"""
import json
import pathlib
import struct
import sys

BULK, OUT, IN = 3, 0x02, 0x81
IN_BUFFER_BYTES = 4160
IN_PROGRESS = -115  # -EINPROGRESS


def bytes_of(line, key):
    return bytes.fromhex(line.get(key + "_hex", "")) or line.get(key, "").encode("ascii")


def event(number, kind, endpoint, length, data, data_flag):
    status = IN_PROGRESS if kind == "S" else 0
    header = struct.pack(
        "<QBBBBHBBqiiII8siiII", number, ord(kind), BULK, endpoint, 2, 1, ord("-"), data_flag,
        0, number, status, length, len(data), bytes(8), 0, 0, 0, 0)
    return struct.pack("<IIII", 0, 0, len(header) + len(data), len(header) + len(data)) + header + data


def transfer(number, line):
    if line["op"] == "write":
        data = bytes_of(line, "sent")
        return (event(number, "S", OUT, len(data), data, 0)
                + event(number, "C", OUT, len(data), b"", ord(">")))
    data = bytes_of(line, "got")
    return (event(number, "S", IN, IN_BUFFER_BYTES, b"", ord("<"))
            + event(number, "C", IN, len(data), data, 0))


def main():
    lines = pathlib.Path(sys.argv[1]).read_text(encoding="ascii").splitlines()
    exchanges = [json.loads(line) for line in lines[1:]]
    capture = struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 220)
    for number, line in enumerate(exchanges, start=1):
        capture += transfer(number, line)
    pathlib.Path(sys.argv[2]).write_bytes(capture)


if __name__ == "__main__":
    main()
