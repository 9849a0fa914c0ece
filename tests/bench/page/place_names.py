# SPDX-License-Identifier: Apache-2.0
"""Where the names of a diagram stand so that none lies on another; as lightcal/report's
label_placement, for names that may stand at any of several points."""
import collections
import itertools
import math

NEAR, STEP, RINGS, DIRECTIONS = 7.0, 10.0, 24, 16  # pixels, pixels, and counts
CROSSED_LINE, CROSSED_LEADER = 25.0, 50.0          # what they cost, in pixels of distance

Label = collections.namedtuple("Label", "text x y box must leader")


def overlap(a, b):
    """Of boxes (left, bottom, right, top)."""
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def crosses(p, q, box):
    """Whether the segment from p to q passes through the box."""
    enter, leave = 0.0, 1.0
    for axis in (0, 1):
        along, low, high = q[axis] - p[axis], box[axis] - p[axis], box[axis + 2] - p[axis]
        if along == 0:
            if low >= 0 or high <= 0:
                return False
            continue
        enter = max(enter, min(low / along, high / along))
        leave = min(leave, max(low / along, high / along))
    return enter < leave


def box_at(point, size, distance, angle):
    """The box whose edge or corner faces the point from `distance` in direction `angle`."""
    c, s = math.cos(angle), math.sin(angle)
    left = point[0] + distance * c - size[0] * (1 - max(-1, min(1, 1.5 * c))) / 2
    bottom = point[1] + distance * s - size[1] * (1 - max(-1, min(1, 1.5 * s))) / 2
    return left, bottom, left + size[0], bottom + size[1]


def is_free(box, placed, marks, area):
    inside = (box[0] >= area[0] and box[1] >= area[1] and box[2] <= area[2] and box[3] <= area[3])
    wide = (box[0] - 2, box[1] - 1, box[2] + 2, box[3] + 1)
    return inside and not any(overlap(wide, other.box) for other in placed) and not any(
        overlap(box, mark) for mark in marks)


def nearest(box, point):
    return min(max(point[0], box[0]), box[2]), min(max(point[1], box[1]), box[3])


def place(wishes, marks, lines, area):
    """wishes: (text, size, points, must), the points any of which the name may stand at. Those that
    must be shown may stand far off at the end of a line; the others stand beside or nowhere.
    Deterministic; boxes are disjoint."""
    placed = []
    for text, size, points, must in sorted(wishes, key=lambda wish: not wish[3]):
        best, least = None, math.inf
        for ring in range(RINGS if must else 1):
            if best and STEP * ring > least:
                break
            for point, k in itertools.product(points, range(DIRECTIONS)):
                box = box_at(point, size, NEAR + STEP * ring, math.tau * k / DIRECTIONS)
                if not is_free(box, placed, marks, area):
                    continue
                cost = STEP * ring + CROSSED_LINE * sum(crosses(p, q, box) for p, q in lines)
                cost += CROSSED_LEADER * sum(crosses(*other.leader, box)
                                             for other in placed if other.leader)
                if cost < least and (must or cost == 0):
                    leader = (point, nearest(box, point)) if ring > 1 else None
                    best, least = Label(text, *box[:2], box, must, leader), cost
        if best:
            placed.append(best)
    return placed
