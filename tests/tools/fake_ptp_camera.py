#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A PTP/IP camera on 127.0.0.1 that never existed, for the real libgphoto2.

    fake_ptp_camera.py FRAMES LOG [FAULT[=N] ...]

FRAMES holds exposure_<tenths of a millisecond>.dng, one for every shutter time it offers. The free
port it listens on is printed as "port N"; every property set, picture taken, fetched and deleted is
appended to LOG, one line each. Faults:

    busy=N         the first N captures answer Device_Busy
    refuse=CODE    setting the property of this hexadecimal code answers Access_Denied
    drop=N         the line breaks in the middle of the Nth download
    wrong=N        the Nth picture carries another exposure than was set
    torn=N         the Nth picture is only half a file
    full=N         the card is full at the Nth picture
    slow=SECONDS   every capture takes so long
    mute=N         the Nth capture is never answered
    auto           the mode dial stands at aperture priority until it is set
    bulb           the shutter stands at a time it does not offer

Source: PIMA 15740:2000 (PTP), CIPA DC-005-2005 (PTP/IP).
"""
import pathlib
import socket
import struct
import sys
import threading
import time

SHUTTERS = [10, 20, 40, 80, 166, 333, 666, 1250, 2500, 5000, 10000]  # 0.1 ms
EXPOSURE_TIME, F_NUMBER, ISO, PROGRAM, BATTERY = 0x500D, 0x5007, 0x500F, 0x500E, 0x5001
FORMATS = {2: "B", 4: "H", 6: "I"}  # PTP data types: UINT8, UINT16, UINT32
OPERATIONS = [0x1001, 0x1002, 0x1003, 0x1004, 0x1005, 0x1006, 0x1007, 0x1008, 0x1009, 0x100B,
              0x100E, 0x1014, 0x1015, 0x1016]
OK, GENERAL, NOT_SUPPORTED, STORE_FULL, DENIED, BUSY = (0x2001, 0x2002, 0x2005, 0x200C, 0x200F,
                                                        0x2019)
STORE, DNG, ANY_DNG = 0x10001, 0x3000, 0x3801


def text(value):
    if not value:
        return b"\0"
    return bytes([len(value) + 1]) + value.encode("utf-16le") + b"\0\0"


def array(kind, values):
    return struct.pack("<I", len(values)) + b"".join(struct.pack("<" + kind, v) for v in values)


class Hangup(Exception):
    pass


class Camera:
    def __init__(self, frames, log, faults):
        self.frames, self.log, self.faults = pathlib.Path(frames), log, faults
        self.lock = threading.Lock()
        self.events = None
        self.objects = {}  # handle -> (name, bytes)
        self.captures = self.pictures = self.downloads = 0
        program = 3 if "auto" in faults else 1
        shutter = 7 if "bulb" in faults else 166
        # code -> [type, writable, current, choices]
        self.properties = {
            EXPOSURE_TIME: [6, 1, shutter, SHUTTERS],
            F_NUMBER: [4, 1, 800, [400, 560, 800, 1100]],
            ISO: [4, 1, 200, [100, 200, 400]],
            PROGRAM: [4, 1, program, [1, 2, 3, 4]],
            BATTERY: [2, 0, 90, [90]],
        }

    def fault(self, name, default=0):
        return self.faults.get(name, default)

    def note(self, *words):
        with self.lock, open(self.log, "a", encoding="utf-8") as log:
            print(*words, file=log, flush=True)

    # Packets of PTP/IP: length, type, payload.
    @staticmethod
    def send(line, kind, payload):
        line.sendall(struct.pack("<II", 8 + len(payload), kind) + payload)

    @staticmethod
    def receive(line, count):
        data = b""
        while len(data) < count:
            more = line.recv(count - len(data))
            if not more:
                raise Hangup
            data += more
        return data

    def packet(self, line):
        length, kind = struct.unpack("<II", self.receive(line, 8))
        return kind, self.receive(line, length - 8)

    def device_info(self):
        return (struct.pack("<HIH", 100, 0, 100) + text("") + struct.pack("<H", 0) +
                array("H", OPERATIONS) + array("H", [0x4002, 0x400D, 0x4006]) +
                array("H", list(self.properties)) + array("H", [ANY_DNG]) +
                array("H", [ANY_DNG, DNG]) + text("lightcal") + text("FakeCam") + text("1.0") +
                text("LCCAM1"))

    def object_info(self, handle):
        name, data = self.objects[handle]
        return (struct.pack("<IHHIHIIIIIIIHII", STORE, DNG, 0, len(data), ANY_DNG, 0, 0, 0, 64, 48,
                            14, 0, 0, 0, handle) + text(name) + text("20261121T120000") +
                text("20261121T120000") + text(""))

    def property_description(self, code):
        kind, writable, current, choices = self.properties[code]
        form = "<" + FORMATS[kind]
        return (struct.pack("<HHB", code, kind, writable) + struct.pack(form, choices[0]) +
                struct.pack(form, current) + struct.pack("<BH", 2, len(choices)) +
                b"".join(struct.pack(form, v) for v in choices))

    def set_property(self, code, data):
        kind, writable, _, _ = self.properties[code]
        value = struct.unpack("<" + FORMATS[kind], data)[0]
        if not writable or self.fault("refuse") == code:
            self.note("refused", f"{code:04x}", value)
            return DENIED
        self.properties[code][2] = value
        self.note("set", f"{code:04x}", value)
        return OK

    def expose(self):
        """The answer's code, and the handle of the picture it made."""
        self.captures += 1
        if self.captures <= self.fault("busy"):
            return BUSY, None
        number = self.pictures + 1
        if self.fault("full") == number:
            return STORE_FULL, None
        if self.fault("mute") == number:
            time.sleep(3600)
        time.sleep(self.fault("slow", 0))
        self.pictures = number
        shutter = self.properties[EXPOSURE_TIME][2]
        self.note("exposed", shutter)
        if self.fault("wrong") == number:
            shutter = 10000 if shutter != 10000 else 10
        data = (self.frames / f"exposure_{shutter}.dng").read_bytes()
        if self.fault("torn") == number:
            data = data[:200]
        self.objects[number] = (f"LC_{number:04d}.DNG", data)
        return OK, number

    def announce(self, transaction, handle):
        time.sleep(0.005)
        self.send(self.events, 8, struct.pack("<HII", 0x4002, transaction, handle))
        self.send(self.events, 8, struct.pack("<HI", 0x400D, transaction))

    def download(self, line, transaction, handle):
        self.downloads += 1
        data = self.objects[handle][1]
        if self.fault("drop") == self.downloads:
            half = data[:len(data) // 2]
            self.send(line, 9, struct.pack("<IQ", transaction, len(data)))
            self.send(line, 10, struct.pack("<I", transaction) + half)
            self.note("dropped", handle)
            line.shutdown(socket.SHUT_RDWR)
            raise Hangup
        self.note("fetched", handle)
        return data

    def answer(self, line, operation, transaction, parameters, data):
        """Code, data and parameters of the answer; a picture's handle to announce."""
        if operation == 0x1001:
            return OK, self.device_info(), (), None
        if operation in (0x1002, 0x1003):  # open and close session
            return OK, None, (), None
        if operation == 0x1004:
            return OK, array("I", [STORE]), (), None
        if operation == 0x1005:
            free = 0 if self.fault("full") == self.pictures + 1 else 1 << 33
            info = struct.pack("<HHHQQI", 4, 2, 0, 1 << 34, free, 0xFFFFFFFF)
            return OK, info + text("card") + text(""), (), None
        if operation == 0x1006:
            return OK, None, (len(self.objects),), None
        if operation == 0x1007:
            return OK, array("I", list(self.objects)), (), None
        if operation == 0x1008 and parameters[0] in self.objects:
            return OK, self.object_info(parameters[0]), (), None
        if operation == 0x1009 and parameters[0] in self.objects:
            return OK, self.download(line, transaction, parameters[0]), (), None
        if operation == 0x100B and parameters[0] in self.objects:
            del self.objects[parameters[0]]
            self.note("deleted", parameters[0])
            return OK, None, (), None
        if operation == 0x100E:
            code, handle = self.expose()
            return code, None, (), handle
        if operation in (0x1014, 0x1015, 0x1016) and parameters[0] in self.properties:
            code = parameters[0]
            if operation == 0x1014:
                return OK, self.property_description(code), (), None
            if operation == 0x1016:
                return self.set_property(code, data), None, (), None
            kind, _, current, _ = self.properties[code]
            return OK, struct.pack("<" + FORMATS[kind], current), (), None
        return NOT_SUPPORTED, None, (), None

    def serve_commands(self, line):
        while True:
            kind, payload = self.packet(line)
            if kind == 13:  # ping
                self.send(line, 14, b"")
            if kind != 6:
                continue
            phase, operation, transaction = struct.unpack("<IHI", payload[:10])
            count = (len(payload) - 10) // 4
            parameters = struct.unpack(f"<{count}I", payload[10:10 + 4 * count])
            data = b""
            while phase == 2:
                kind, part = self.packet(line)
                if kind in (10, 12):
                    data += part[4:]
                if kind == 12:
                    break
            code, out, results, handle = self.answer(line, operation, transaction, parameters, data)
            if out is not None:
                self.send(line, 9, struct.pack("<IQ", transaction, len(out)))
                self.send(line, 12, struct.pack("<I", transaction) + out)
            self.send(line, 7, struct.pack("<HI", code, transaction) +
                      b"".join(struct.pack("<I", r) for r in results))
            if handle is not None:
                threading.Thread(target=self.announce, args=(transaction, handle),
                                 daemon=True).start()

    def serve(self, line):
        try:
            line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            kind, _ = self.packet(line)
            if kind == 1:
                name = "FakeCam\0".encode("utf-16le")
                self.send(line, 2, struct.pack("<I", 1) + b"\1" * 16 + name +
                          struct.pack("<I", 0x10000))
                self.serve_commands(line)
            elif kind == 3:
                self.events = line
                self.send(line, 4, b"")
                while line.recv(64):
                    pass
        except (Hangup, OSError):
            pass
        finally:
            line.close()


def main():
    faults = {}
    for word in sys.argv[3:]:
        name, _, value = word.partition("=")
        faults[name] = 1 if not value else (
            int(value, 16) if name == "refuse" else float(value) if name == "slow" else int(value))
    camera = Camera(sys.argv[1], sys.argv[2], faults)
    listener = socket.create_server(("127.0.0.1", 0))
    print("port", listener.getsockname()[1], flush=True)
    while True:
        line, _ = listener.accept()
        threading.Thread(target=camera.serve, args=(line,), daemon=True).start()


if __name__ == "__main__":
    main()
