# SPDX-License-Identifier: Apache-2.0
"""Meters' spectra as computers of decimal commas write and spreadsheets save them again: between semicolons or tabs
they read as the originals, between commas they are refused; samples from red to blue read as from blue to red. Files
are the samples' own text, rewritten here."""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused  # noqa: E402

SPECTRA = pathlib.Path(__file__).resolve().parents[2] / "sample_data/spectra"


def commas(text):
    return re.sub(r"(?<=\d)\.(?=\d)", ",", text)


def written(name, text):
    (HOME / name).write_text(text, encoding="utf-8")
    return HOME / name


def color(path):
    return answer("color", "--spectrum", path)


def same(one, other):
    assert not one.get("warnings"), one["warnings"]
    for key in ("cct_K", "duv", "illuminance_lx"):
        assert (key in one) == (key in other), key
        assert key not in one or abs(one[key] - other[key]) <= 1e-9 * abs(other[key]), (key, one[key], other[key])
    assert one.get("reported") == other.get("reported"), (one.get("reported"), other.get("reported"))


count = 0
sekonic = SPECTRA / "colour_science/sekonic_RANDOM_001_02deg_3262K.csv"
text = sekonic.read_text(encoding="utf-8-sig")
truth = color(sekonic)
for mark in ";\t":
    for decimals in (commas, str):
        same(color(written("sekonic.csv", decimals(text.replace(",", mark)))), truth)
        count += 1
told = refused("decimals_ambiguous", "color", "--spectrum", written("sekonic.csv", commas(text)))
assert "decimal commas" in told["message"] and "semicolons" in told["message"], told
uprtek = [*sorted((SPECTRA / "uprtek_cv600").glob("*.xls")), *sorted((SPECTRA / "colour_science").glob("uprtek*.xls"))]
assert len(uprtek) >= 9
for path in uprtek:
    raw = path.read_bytes()
    text = raw.decode("utf-16") if raw[:2] in (b"\xff\xfe", b"\xfe\xff") else raw.decode("latin-1")
    truth = color(path)
    truth.pop("warnings", None)
    for mark in "\t;":
        one = color(written("uprtek.xls", commas(text.replace("\t", mark))))
        one.pop("warnings", None)
        same(one, truth)
        count += 1
    one = color(written("uprtek.xls", text.replace("\t", ",")))
    one.pop("warnings", None)
    same(one, truth)
    refused("decimals_ambiguous", "color", "--spectrum", written("uprtek.xls", commas(text.replace("\t", ","))))

# From red to blue: TM-27, and a table; out of order is refused as ever.
spdx = (SPECTRA / "colour_science/Fluorescent.spdx").read_text()
samples = re.findall(r"<SpectralData .*?</SpectralData>", spdx)
falling = spdx.replace("\n".join(samples), "")
for one, other in zip(samples, reversed(samples)):
    falling = falling.replace(one, f"@{samples.index(one)}@", 1)
for k, other in enumerate(reversed(samples)):
    falling = falling.replace(f"@{k}@", other, 1)
assert falling != spdx
one, truth = color(written("falling.spdx", falling)), color(SPECTRA / "colour_science/Fluorescent.spdx")
assert abs(one["cct_K"] - truth["cct_K"]) < 1e-9, (one["cct_K"], truth["cct_K"])
mixed = spdx.replace(samples[3], "@").replace(samples[9], samples[3]).replace("@", samples[9])
assert "must increase" in refused("bad_spectrum", "color", "--spectrum", written("mixed.spdx", mixed))["message"]
print(count, "files of decimal commas")
