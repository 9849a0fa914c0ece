#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`lightcal sweep --sacn` against tests/tools/sacn_fixture.py, on 127.0.0.1 alone.

    sacn_sweep.py LIGHTCAL TSHARK

Killed five times and gone on: every state is read as often as the sweep says and its light is the
fixture's, so that it had come to rest. Ctrl-C and SIGTERM send three termination packets, nothing is
ever silent for a second, and Debian's tshark reads the packets as the fixture's own parser does.
"""
import collections
import json
import pathlib
import signal
import struct
import subprocess
import sys
import tempfile
import time

TOOLS = pathlib.Path(__file__).resolve().parents[1] / "tools"
sys.path.insert(0, str(TOOLS))
import sacn_fixture  # noqa: E402

LIGHTCAL, TSHARK = sys.argv[1:3]
SESSION = """lightcal = 1
[room]
dark = true
[[light]]
name = "key"
kind = "point"
"""
MAP = """lightcal = 1
universe = 7
[[control]]
name = "dimmer"
slots = [1, 2]
range = [0, 100]
[[control]]
name = "cct_K"
slots = [3]
labels = [2800, 4000, 6200]
values = [0, 128, 255]
"""
DIMMER, CCT = [100, 30, 5], [2800, 4000, 6200]


class Fixture:
    def __init__(self, folder):
        self.log = folder / "fixture.jsonl"
        self.process = subprocess.Popen([sys.executable, "-B", TOOLS / "sacn_fixture.py", self.log],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.port, self.tty = self.process.stdout.readline().split()

    def packets(self):
        whole = self.log.read_text(encoding="utf-8").split("\n")[:-1]
        return [json.loads(line) for line in whole]

    def stop(self):
        self.process.stdin.close()
        self.process.wait(timeout=10)


def begin(fixture, session, *more, meter=True):
    words = [LIGHTCAL, "sweep", "-s", session, "--distance", "1m",
             "--over", "dimmer=" + ",".join(map(str, DIMMER)), "--over",
             "cct_K=" + ",".join(map(str, CCT)), "--sacn", f"7@127.0.0.1:{fixture.port}",
             "--map", session / "map.toml", "--json", *more]
    if meter:
        words += ["--device", "line:" + fixture.tty, "--set", "sigma=1%", "-n", "3"]
    return subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True)


def new_session(folder, name):
    session = folder / name
    session.mkdir()
    (session / "session.toml").write_text(SESSION, encoding="utf-8")
    (session / "map.toml").write_text(MAP, encoding="utf-8")
    return session


def readings(session):
    journal = session / "readings.jsonl"
    if not journal.exists():
        return []
    whole = journal.read_text(encoding="utf-8").split("\n")[:-1]
    return [json.loads(line) for line in whole]


def wait_for(holds, what, seconds=30):
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end, "waited in vain for " + what
        time.sleep(0.01)


def packets_to_the_end(fixture, before):
    """Those since then, when the fixture has written down that the stream ended: it does so in its
    own time."""
    wait_for(lambda: sum(one["terminated"] for one in fixture.packets()[before:]) >= 3, "its end")
    return fixture.packets()[before:]


def killed_five_times(folder, fixture):
    session = new_session(folder, "killed")
    for _ in range(5):
        held = len(readings(session))
        sweep = begin(fixture, session)
        wait_for(lambda: len(readings(session)) > held or sweep.poll() is not None, "readings")
        assert sweep.poll() is None, sweep.communicate()
        sweep.send_signal(signal.SIGKILL)
        sweep.communicate()
    sweep = begin(fixture, session)
    out, err = sweep.communicate(timeout=120)
    assert sweep.returncode == 0, err
    told = json.loads(out)
    assert told["left"] == 0 and told["held"] >= 5 and told["seed"] == 1, told
    assert told["sacn"]["universe"] == 7, told

    others = len(DIMMER) * len(CCT) - 1
    full = (100.0, 2800.0)
    counts = collections.Counter((one["state"]["dimmer"], one["state"]["cct_K"])
                                 for one in readings(session))
    want = {(float(d), float(c)): 1 for d in DIMMER for c in CCT}
    want[full] = 1 + -(-others // 8)
    assert counts == want, (counts, want)
    for one in readings(session):
        coarse, fine = divmod(round(one["state"]["dimmer"] / 100 * 65535), 256)
        value = {2800: 0, 4000: 128, 6200: 255}[int(one["state"]["cct_K"])]
        lux, kelvin = sacn_fixture.light([coarse, fine, value])
        assert abs(one["illuminance_lx"] / lux - 1) < 0.012, (one, lux)
        assert abs(one["cct_K"] / kelvin - 1) < 0.01, (one, kelvin)
    order = [(one["state"]["dimmer"], one["state"]["cct_K"]) for one in readings(session)]
    others_read = [state for state in order if state != full]
    assert others_read != sorted(others_read, reverse=True), "not shuffled"
    return others + want[full]


def interrupted(folder, fixture, number, name):
    """Stopped while it reads; -> the packets of this sweep."""
    session = new_session(folder, name)
    before = len(fixture.packets())
    sweep = begin(fixture, session)
    wait_for(lambda: len(readings(session)) >= 1, "readings")
    sweep.send_signal(number)
    _, err = sweep.communicate(timeout=20)
    assert sweep.returncode != 0 or "goes on" in err, (sweep.returncode, err)
    packets = packets_to_the_end(fixture, before)
    assert [one["terminated"] for one in packets[-3:]] == [True] * 3, packets[-3:]
    assert sum(one["terminated"] for one in packets) == 3
    return packets


def typed(folder, fixture):
    """A person reads: the stream stays alive as long as that takes, and ends with the input."""
    session = new_session(folder, "typed")
    before = len(fixture.packets())
    sweep = begin(fixture, session, "--typed", meter=False)
    wait_for(lambda: len(fixture.packets()) > before, "the stream")
    time.sleep(3.2)
    sweep.stdin.write("1000\n")
    sweep.stdin.flush()
    sweep.communicate(timeout=20)
    packets = packets_to_the_end(fixture, before)
    gaps = [b["at"] - a["at"] for a, b in zip(packets, packets[1:])]
    assert max(gaps) < 1.0, max(gaps)
    assert sum(gaps) > 3.0
    assert [one["terminated"] for one in packets[-3:]] == [True] * 3
    assert len(readings(session)) == 1
    return max(gaps)


def dissected(folder, packets):
    """The same packets, as UDP to port 5568 in a pcap file, by tshark."""
    path = folder / "sweep.pcap"
    with path.open("wb") as pcap:
        pcap.write(struct.pack("<IHHiIII", 0xa1b2c3d4, 2, 4, 0, 0, 65535, 101))  # raw IP
        for one in packets:
            data = bytes.fromhex(one["hex"])
            udp = struct.pack(">HHHH", 5569, 5568, 8 + len(data), 0) + data
            ip = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(udp), 0, 0, 64, 17, 0,
                             b"\x7f\0\0\1", b"\x7f\0\0\1") + udp
            pcap.write(struct.pack("<IIII", int(one["at"]), 0, len(ip), len(ip)) + ip)
    fields = ["acn.cid", "acn.dmx.source_name", "acn.dmx.priority", "acn.dmx.seq_number",
              "acn.dmx.universe", "acn.dmx.option_s", "_ws.malformed", "_ws.expert.message",
              "acn.dmx.count", "acn.dmx.data"]
    # Both are off unless asked for: ACN is found by its looks, and E1.31 in it.
    out = subprocess.run([TSHARK, "-r", path, "--enable-heuristic", "acn",
                          "-o", "acn.dmx_enable:TRUE", "-T", "fields", "-E", "separator=;",
                          *[word for field in fields for word in ("-e", field)]],
                         check=True, capture_output=True, text=True).stdout.splitlines()
    assert len(out) == len(packets)
    for line, one in zip(out, packets):
        cid, source, priority, sequence, universe, *rest = line.split(";")
        assert cid.replace("-", "") == one["cid"], line
        assert (source, int(priority), int(sequence), int(universe)) == (
            one["source"], one["priority"], one["sequence"], one["universe"]), line
        assert rest[0] in (("True", "1") if one["terminated"] else ("False", "0")), line
        assert not any(rest[1:3]) and int(rest[3]) == 513, line
        shown = rest[4].split("001-020:")[1].split()[:3]
        assert [0 if s == ".." else int(s, 16) for s in shown] == one["slots"], line


def refusals(folder, fixture):
    """What is wrong is told before anything is sent."""
    session = new_session(folder, "wrong")
    before = len(fixture.packets())

    def code(changed, *more):
        (session / "map.toml").write_text(changed, encoding="utf-8")
        sweep = begin(fixture, session, "--typed", *more, meter=False)
        out, err = sweep.communicate("", timeout=20)
        return sweep.returncode, json.loads(out)["error"]["code"], err

    assert code(MAP.replace("slots = [3]", "slots = [2]"))[:2] == (3, "bad_map")
    assert code(MAP.replace("6200]", "6000]"))[:2] == (3, "map_range")
    assert code(MAP.replace('"cct_K"', '"zoom_deg"'))[:2] == (3, "map_controls")
    assert code(MAP.replace("universe = 7", "universe = 8"))[:2] == (2, "usage")
    assert len(fixture.packets()) == before
    # A port where nobody listens: no state was set, so none is read.
    (session / "map.toml").write_text(MAP, encoding="utf-8")
    deaf = type("Deaf", (), {"port": 9, "tty": ""})
    sweep = begin(deaf, session, "--typed", meter=False)
    out, _ = sweep.communicate("1000\n", timeout=20)
    assert sweep.returncode == 1 and json.loads(out)["error"]["code"] == "unheard", out
    assert not readings(session)


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        fixture = Fixture(folder)
        try:
            refusals(folder, fixture)
            count = killed_five_times(folder, fixture)
            packets = interrupted(folder, fixture, signal.SIGINT, "interrupt")
            packets += interrupted(folder, fixture, signal.SIGTERM, "terminate")
            gap = typed(folder, fixture)
            everything = fixture.packets()
            refused = [one for one in everything if "refused" in one]
            assert not refused, refused[:3]
            dissected(folder, packets)
        finally:
            fixture.stop()
    print(f"{count} readings over five kills, {len(everything)} packets, {len(packets)} dissected, "
          f"longest silence {gap:.2f} s")


if __name__ == "__main__":
    main()
