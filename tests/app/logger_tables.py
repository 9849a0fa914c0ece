#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tables as loggers and spreadsheets write them: what the lamp was dimmed to is its state and never left out in
silence, a timestamp is the reading's time, decimals with commas are read and named, in gels and UTF-16 too.

    logger_tables.py LIGHTCAL PHOTOMETRIC_FOLDER
"""
import json
import pathlib
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused, run  # noqa: E402

SESSION = 'lightcal = 1\n[room]\ndark = true\n[[light]]\nname = "key"\nkind = "point"\nfixture = "bulb"\n'


def imported(name, text, code=0, encoding="utf-8"):
    """What stands in the journal of a session of its own, and what was said."""
    folder = HOME / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    (folder / "session.toml").write_text(SESSION)
    table = HOME / f"{name}.csv"
    table.write_bytes(text.encode(encoding))
    done = run("import", table, "-s", folder, "--light", "key", code=code)
    journal = folder / "readings.jsonl"
    return [json.loads(line) for line in journal.read_text().splitlines()] if journal.exists() else [], done.stderr


# ---- dimmers ----
for column, cells in (("dimmer", ("100%", "50%")), ("dimmer", ("100", "50")), ("Dimmer (%)", ("100", "50")),
                      ("level_percent", ("100", "50")), ("Intensity [%]", ("100", "50")),
                      ("state.dimmer", ("100", "50%"))):
    rows, said = imported("dimmed", f"distance_m,illuminance_lx,{column}\n0.5,400,{cells[0]}\n0.5,200,{cells[1]}\n")
    assert [row["state"]["dimmer"] for row in rows] == [100, 50], (column, cells, rows)
    assert "left out" not in said, said
candela = answer("fit", HOME / "dimmed")["lights"][0]["intensity_cd"]["value"]
assert abs(candela / 100 - 1) < 0.05, candela  # of the lamp at 100, not of both states at once
_, said = imported("parts", "distance_m,illuminance_lx,dimmer\n0.5,400,1\n0.5,200,0.5\n", code=3)
assert "percent" in said, said
_, said = imported("level", "distance_m,illuminance_lx,level\n0.5,400,1\n0.5,200,7\n", code=3)
assert "state.dimmer" in said, said
rows, said = imported("modes", "distance_m,illuminance_lx,mode\n0.5,400,boost\n0.5,200,eco\n")
assert len(rows) == 2 and "state.mode" in said, said

# ---- times ----
for first, second in (("01.03.2026 12:00:05", "01.03.2026 12:02:05"), ("2026-03-01T12:00:05", "2026-03-01T12:02:05"),
                      ("2026/03/01 12:00:05", "2026/03/01 12:02:05")):
    rows, said = imported("times", f"timestamp,distance_m,illuminance_lx\n{first},0.5,400\n{second},1,100\n")
    assert [row["time"] for row in rows] == ["2026-03-01T12:00:05", "2026-03-01T12:02:05"], (first, rows)
    assert "left out" not in said, said
# A date and a time of their own, seconds since 1970, and slashes that one stamp of the column settles.
for header, first, second, times in (
        ("Date,Time", "2026/03/01,12:00:05", "2026/03/01,12:02:05", ("2026-03-01T12:00:05", "2026-03-01T12:02:05")),
        ("Datum,Uhrzeit", "01.03.2026,12:00:05", "01.03.2026,12:02:05", ("2026-03-01T12:00:05", "2026-03-01T12:02:05")),
        ("Date,Time", "3/1/2026,2:05:00 PM", "3/25/2026,12:10:00 AM", ("2026-03-01T14:05:00", "2026-03-25T00:10:00")),
        ("time", "1772366405", "1772366525", ("2026-03-01T12:00:05Z", "2026-03-01T12:02:05Z")),
        ("timestamp", "1772366405250", "1772366525000", ("2026-03-01T12:00:05.250Z", "2026-03-01T12:02:05.000Z")),
        ("timestamp", "01/03/2026 12:00", "25/03/2026 12:00", ("2026-03-01T12:00:00", "2026-03-25T12:00:00"))):
    rows, said = imported("times", f"{header},distance_m,Lux\n{first},0.5,400\n{second},1,100\n")
    assert tuple(row["time"] for row in rows) == times, (first, rows, said)
    assert "left out" not in said, said
for header, first, second in (("Date,Time", "3/1/2026,2:05:00 PM", "3/2/2026,2:05:00 PM"),
                              ("timestamp", "13/03/2026 12:00", "03/25/2026 12:00"),
                              ("Date", "2026-03-01", "2026-03-02")):
    rows, said = imported("either", f"{header},distance_m,Lux\n{first},0.5,400\n{second},1,100\n")
    assert len(rows) == 2 and not any("time" in row for row in rows) and "left out" in said, (rows, said)
# March or April? Left out, and said so.
rows, said = imported("either", "timestamp,distance_m,illuminance_lx\n03/04/2026 12:00,0.5,400\n04/04/2026 12:00,1,100\n")
assert len(rows) == 2 and "left out" in said and "time" in said, said

# ---- names: a lamp's own, and other languages' ----
rows, said = imported("lamps", "lamp,distance_m,Lux\nkey,0.5,400\nkey,1,100\n")
assert [row["light"] for row in rows] == ["key", "key"] and not said.count("warning"), (rows, said)
for header in ("Reading (lux)", "measured lx", "Reading [lx]"):
    rows, said = imported("readings", f"distance_m,{header}\n0.5,400\n1,100\n")
    assert [row["illuminance_lx"] for row in rows] == [400, 100], (header, rows, said)
for header in ("fixture", "Luminaire", "Leuchte", "Lamp name"):
    rows, said = imported("fixtures", f"{header},distance_m,Lux\nkey,0.5,400\nkey,1,100\n")
    assert [row["light"] for row in rows] == ["key", "key"] and "warning" not in said, (rows, said)
    # Two lamps' readings are never one lamp's.
    _, said = imported("fixtures", f"{header},distance_m,Lux\nkey,0.5,400\nfill,1,100\n", code=3)
    assert "fill: the session has no such light" in said, said
# One that holds what the lamp is: how to leave it out is said, and does it.
model = "fixture,distance_m,Lux\nPAR 64,0.5,400\nPAR 64,1,100\n"
_, said = imported("fixtures", model, code=3)
assert "leave it out, for instance --columns -,distance_m" in said and "are then of key" in said, said
run("import", HOME / "fixtures.csv", "-s", HOME / "fixtures", "--light", "key", "--columns", "-,distance_m,illuminance_lx")
assert len((HOME / "fixtures" / "readings.jsonl").read_text().splitlines()) == 2
_, said = imported("fixtures", "fixture,Leuchte,distance_m,Lux\nkey,a,0.5,400\nkey,b,1,100\n", code=3)
assert "fixture and Leuchte both give the same quantity" in said, said
# Beside the light's name it is what the light is.
rows, said = imported("fixtures", "light,fixture,distance_m,Lux\nkey,PAR 64,0.5,400\nkey,PAR 64,1,100\n")
assert len(rows) == 2 and "column fixture" in said, said
rows, _ = imported("lamps", "lamp,distance_m,Lux\non,0.5,400\noff,1,1\n")
assert rows[1]["lamp"] == "off", rows
_, said = imported("lamps", "lamp,distance_m,Lux\nkey,0.5,400\noff,1,1\n", code=3)
assert "on or off" in said, said
for header in ("Abstand [m];Beleuchtungsstärke [lx]", "Distance (m);Éclairement (lx)", "距離(m);照度(lx)",
               "Entfernung / m;E / lx", "distancia_m;Iluminancia (lux)"):
    rows, _ = imported("words", f"{header}\n0,5;400,5\n1;100\n")
    assert [(row["distance_m"], row["illuminance_lx"]) for row in rows] == [(0.5, 400.5), (1, 100)], (header, rows)
_, said = imported("words", "Abstand;Beleuchtungsstärke [lx]\n0,5;400,5\n", code=3)
assert "no unit" in said, said

# ---- decimals ----
_, said = imported("mixed", "distance_m;illuminance_lx\n0,5;400.5\n1,0;100.2\n", code=3)
assert "commas" in said and "400,5" in said, said
seen = []
for comma in (False, True):
    for by_row in (False, True):
        nms = range(380, 781, 20)
        part = {nm: 0.5 + nm % 7 / 50 for nm in nms}
        if by_row:
            text = ("filter,name," + ",".join(f"{nm}nm" for nm in nms) + "\nG1,one," +
                    ",".join(f"{part[nm]:.4f}" for nm in nms) + "\n")
        else:
            text = "wavelength_nm,G1 transmittance (%)\n" + "".join(f"{nm}.0,{100 * part[nm]:.2f}\n" for nm in nms)
        if comma:
            text = text.replace(",", ";").replace(".", ",")
        (HOME / "gels.csv").write_text(text)
        seen.append(answer("color", "--spectrum", "illuminant:A", "--through", "gels.csv:G1")["cct_K"])
assert max(seen) - min(seen) < 0.1, seen

# ---- a photometric file saved as UTF-16 ----
for file in sorted(pathlib.Path(sys.argv[2]).glob("*.ldt"))[:1]:
    text = file.read_bytes().decode("latin-1")
    (HOME / "plain.ldt").write_bytes(text.encode("latin-1"))
    (HOME / "wide.ldt").write_bytes(text.encode("utf-16"))
    plain, wide = (answer("photometric", f"{name}.ldt") for name in ("plain", "wide"))
    assert plain["flux_lm"] == wide["flux_lm"], (plain, wide)

# ---- a preset is no light.json ----
run("quick", "192lx@0.5m", "--to", "json", "-o", "place")
refused("bad_light", "simulate", next((HOME / "place").rglob("*preset*.json")), "--at", "0,0,1", says="light.json")
