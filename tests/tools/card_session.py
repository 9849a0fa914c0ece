# SPDX-License-Identifier: Apache-2.0
"""A session of one lamp in the dark whose light is read off pictures of a grey card a metre away."""


def write_card_session(folder, rect):
    """session.toml beside c/*.dng; rect: the card's left, top, width and height."""
    (folder / "session.toml").write_text(f"""lightcal = 1
[room]
dark = true
[[light]]
name = "key"
kind = "point"
[[capture]]
light = "key"
frames = "c/*.dng"
use = "card"
rect = {list(rect)}
distance_m = 1
reflectance = 0.18
""")
