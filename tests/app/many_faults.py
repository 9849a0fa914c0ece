# SPDX-License-Identifier: Apache-2.0
"""What is wrong with a session's files is named at once: spectra, pictures of cards and of walls, distributions."""
import json
import pathlib
import subprocess
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, LIGHTCAL  # noqa: E402
from plain_png import write_png  # noqa: E402

write_png(HOME / "grey.png", np.full((48, 64, 3), 120, np.uint8))
(HOME / "empty.csv").write_text("wavelength_nm,value\n")
SPECTRUM = '[[reading]]\nlight = "key"\ndistance_m = 1\nilluminance_lx = 100\nspectrum = "%s"\n'
CARD = ('[[capture]]\nlight = "%s"\nframes = "%s"\nuse = "card"\nreflectance = 0.18\ndistance_m = 1\n'
        'exposure_s = [0.01]\nf_number = 8\niso = 100\n')
WALL = ('[[capture]]\nlight = "spot"\nframes = "no_wall.png"\nuse = "wall"\nreflectance = 0.5\n'
        'lens_glare = 0\n[capture.wall]\nsquare_m = 0.03\nboard_views = "views/*.png"\n')
LIGHTS = "".join(f'[[light]]\nname = "{name}"\nkind = "point"\n' for name in ("key", "fill", "rim"))
LIGHTS += '[[light]]\nname = "ies"\nkind = "photometric"\ndistribution = "nothing.ies"\n'
LIGHTS += '[[light]]\nname = "spot"\nkind = "photometric"\nposition_m = [0, -2, 1]\naim = [0, 1, 0]\n'
TEXT = ("lightcal = 1\n" + LIGHTS + SPECTRUM % "lost.csv" + SPECTRUM % "empty.csv" + CARD % ("fill", "lost.png") +
        CARD % ("rim", "grey.png") + '[[reading]]\nlight = "ies"\ndistance_m = 1\nilluminance_lx = 9\n' + WALL)
path = HOME / "session.toml"
path.write_text(TEXT)
done = subprocess.run([LIGHTCAL, "fit", path, "--json"], capture_output=True, text=True)
assert done.returncode in (1, 3), done
error = json.loads(done.stdout)["error"]
all_of = [error, *error.get("others", [])]
told = "\n".join(f"{one['subject']}: {one['message']}" for one in all_of)
print(done.returncode, len(all_of), "faults:\n" + told)
for name in ("lost.csv", "empty.csv", "lost.png", "grey.png", "nothing.ies", "no_wall.png"):
    assert name in told, f"{name} is not named in:\n{told}"
assert len({(one["subject"], one["message"]) for one in all_of}) == len(all_of) == 6, told
