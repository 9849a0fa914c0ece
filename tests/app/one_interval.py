# SPDX-License-Identifier: Apache-2.0
"""One interval is said in one way by every command: half its width over the value where its arms are alike, else its
ends. fit's own JSON against the words of fit, plan, tradeoff, run, report and exported headers."""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, run  # noqa: E402

HEAD = 'lightcal = 1\n[room]\ndark = true\n[[light]]\nname = "key"\nkind = "point"\n[[meter]]\nname = "m"\n'
MINUS = "\N{MINUS SIGN}"


def session(sigma, name):
    folder = HOME / name
    folder.mkdir()
    (folder / "session.toml").write_text(HEAD + f"sigma_relative = {sigma}\n" + "".join(
        f'[[reading]]\nlight = "key"\nmeter = "m"\ndistance_m = {d}\nilluminance_lx = {100 / d**2}\n' for d in (1, 2, 4)))
    return folder


def said(text, before):
    """What stands behind those words: ("±", 26) or (-20, 31), percent."""
    skew = re.search(before + rf"[{MINUS}]([\d.]+) … \+([\d.]+) %", text)
    even = re.search(before + r"± ([\d.]+) %", text)
    assert skew or even, f"{before} in {text}"
    return (-float(skew[1]), float(skew[2])) if skew else ("±", float(even[1]))


for sigma in (0.02, 0.1, 0.2, 0.3):
    folder = session(sigma, f"s{sigma}")
    u = answer("fit", folder)["lights"][0]["intensity_cd"]
    low, high = u["low95"] / u["value"] - 1, u["high95"] / u["value"] - 1
    even = max(-low, high) <= 1.25 * min(-low, high)
    want = ("±", 50 * (high - low)) if even else (100 * low, 100 * high)
    plan = run("plan", folder, "--minutes", "reading=2").stdout  # tradeoff prints the same ladder
    tell = {"plan": said(plan, "now "), "minutes": said(plan, r"(?:as it is +|what is left \(|: now )")}
    page = HOME / f"{sigma}.html"
    run("report", folder, "-o", page)
    tell["report"] = said(page.read_text().replace("\N{NO-BREAK SPACE}", " "), " · ")
    print(sigma, want, tell)
    for command, found in tell.items():
        assert (found[0] == "±") == even, f"{command} says {found} of {want}"
        assert all(a == b or abs(a - b) <= 0.055 * abs(b) for a, b in zip(found, want)), f"{command}: {found} of {want}"
    words = run("fit", folder).stdout
    if even:
        assert abs(said(words, " cd ")[1] - want[1]) <= 0.055 * want[1], words
    else:
        assert "±" not in re.search(r"key +point +(.*?)  ", words)[1], words
    run("run", folder, "--to", "ies,gdtf")
    head = next((folder / "out").glob("*.ies")).read_text()
    assert ("+-" in head) == even, head
