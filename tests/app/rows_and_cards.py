# SPDX-License-Identifier: Apache-2.0
"""`import` of a table: a row whose meter left no value is skipped, said once with how many and where; card_lx beside a
reading is a second one of the same place behind a shadow card, as if both had been written in the session by hand."""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused  # noqa: E402

SESSION = 'lightcal = 1\nname = "t"\n[[light]]\nname = "key"\nkind = "point"\n'


def session(name, readings=""):
    (HOME / name).mkdir()
    (HOME / name / "session.toml").write_text(SESSION + readings)
    return name


def imported(name, text):
    session(name)
    (HOME / "log.csv").write_text(text)
    document = answer("import", "log.csv", "-s", name, "--light", "key")
    rows = [json.loads(line) for line in (HOME / name / "readings.jsonl").read_text().splitlines()]
    return rows, [w for w in document.get("warnings", []) if w["code"] == "rows_skipped"]


rows, skipped = imported("gaps", "time,distance_m,illuminance_lx\n" + "".join(
    f"2026-01-31T23:59:0{k}Z,1,{'' if k in (3, 5, 6) else 100 + k}\n" for k in range(9)))
assert [row["illuminance_lx"] for row in rows] == [100, 101, 102, 104, 107, 108], rows
assert len(skipped) == 1 and "3 of 9 rows" in skipped[0]["message"] and "line 5" in skipped[0]["message"], skipped
(HOME / "log.csv").write_text("time,distance_m,illuminance_lx\n2026-01-31T23:59:00Z,1,\n")
refused("bad_row", "import", "log.csv", "-s", session("empty"), "--light", "key", says="neither an illuminance nor")

rows, skipped = imported("cards", "distance_m,illuminance_lx,card_lx,cct_K\n0.5,420,20,2900\n1,112,,\n2,37,12,\n")
assert not skipped and len(rows) == 5, rows
assert [(r["distance_m"], r["illuminance_lx"], r.get("shadow_card", False)) for r in rows] == [
    (.5, 420, False), (.5, 20, True), (1, 112, False), (2, 37, False), (2, 12, True)], rows
assert "cct_K" not in rows[1] and rows[0]["cct_K"] == 2900, rows
by_hand = session("by_hand", "".join(
    f'[[reading]]\nlight = "key"\ndistance_m = {d}\nilluminance_lx = {e}\n{extra}'
    for d, e, extra in ((.5, 420, "cct_K = 2900\n"), (.5, 20, "shadow_card = true\n"), (1, 112, ""), (2, 37, ""),
                        (2, 12, "shadow_card = true\n"))))
cd = [answer("fit", name)["lights"][0]["intensity_cd"] for name in ("cards", by_hand)]
assert cd[0] == cd[1], cd
for bad in ("distance_m,illuminance_lx,card_lx,lamp\n1,5,2,off\n", "distance_m,illuminance_lx,card_lx,shadow_card\n1,5,2,yes\n",
            "distance_m,illuminance_lx,card_lx\n1,5,-2\n"):
    (HOME / "log.csv").write_text(bad)
    refused("bad_row", "import", "log.csv", "-s", "empty", "--light", "key", says="card_lx")
