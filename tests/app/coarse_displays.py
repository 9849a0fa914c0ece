#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""quick of meters that show whole lux, or tens of lux: what rounding took stands in the interval.

usage: coarse_displays.py LIGHTCAL
"""
import sys

from other_light import Held, answer, room, typed


def main():
    lightcal = sys.argv[1]
    cards = {"no card": (), "a card at 2 m": (2,), "a card at each place": (0, 1, 2)}
    lamps = (("candles in whole lux", 1, (1, 3)), ("bulbs in tens of lux", 10, (20, 100)))
    for what, step, candela in lamps:
        for name, card in cards.items():
            held = Held()
            for seed in range(30):
                places, truth = room(seed, 1., day=0., candela=candela, step=step)
                words = typed(places, (), card)
                # Fewer than three different tens may be a display of whole lux.
                if step == 10 and len({x for i, p in enumerate(places)
                                       for x in (p[0], p[2] if i in card else 0) if x > 0}) < 3:
                    continue
                held.add(answer(lightcal, words), truth, words)
            held.check(f"{what}, {name}", 2, .5)
    told = answer(lightcal, ["140lx@0.5m", "40lx@1m", "10lx@2m,card=10lx"])
    assert told[1] < 32 < told[2], told


if __name__ == "__main__":
    main()
