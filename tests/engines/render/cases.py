# SPDX-License-Identifier: Apache-2.0
"""The lamps of the render gates: what a meter read of each, and where."""
import math

COLORS = {'2700K': (2700, 0.0), '6500K': (6500, 0.0), 'green': (5000, 0.02)}
D = 2.0
RECT = (0.6, 0.3)


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def along(p, v, s):
    return [a + b * s for a, b in zip(p, v)]


POSITION = [1.0, 2.0, 3.0]
AIM = unit([0.48, 0.36, -0.8])
# As lightcal sees a lamp known by its aim: C0 to the right from behind, C90 up.
C0 = unit(cross(AIM, [0, 0, 1]))
C90 = cross(C0, AIM)

# An asymmetric lamp: four C planes, every 5 degrees to 90.
C_DEG = [0.0, 90.0, 180.0, 270.0, 360.0]
GAMMA_DEG = [5.0 * i for i in range(19)]


def asymmetric(c, gamma):
    """Relative to the axis; kinder to one side, and wider across it."""
    t = math.cos(math.radians(gamma)) if gamma < 90 else 0.0
    power = 2.0 + 1.5 * math.cos(math.radians(c)) + 0.8 * math.sin(math.radians(c))
    return t ** power


def table_at(c, gamma):
    """The table's straight-line interpolant."""
    i = min(int(gamma / 5.0), 17)
    f = gamma / 5.0 - i
    j = min(int(c / 90.0), 3)
    g = c / 90.0 - j
    at = lambda cj, gi: round(1000.0 * asymmetric(C_DEG[cj], GAMMA_DEG[gi]), 4)
    low = at(j, i) * (1 - f) + at(j, i + 1) * f
    high = at(j + 1, i) * (1 - f) + at(j + 1, i + 1) * f
    return low * (1 - g) + high * g


def ies_text(axial=False):
    lines = ['IESNA:LM-63-2002', '[TEST] made', '[TESTLAB] lightcal', '[ISSUEDATE] 2026-01-01',
             '[MANUFAC] lightcal', 'TILT=NONE',
             f'1 -1 1 19 {1 if axial else 5} 1 2 0 0 0', '1 1 10',
             ' '.join(f'{g:g}' for g in GAMMA_DEG), ' '.join(f'{c:g}' for c in (C_DEG[:1] if axial else C_DEG))]
    for c in (C_DEG[:1] if axial else C_DEG):
        values = [round(1000.0 * (math.cos(math.radians(g)) ** 4 if axial else asymmetric(c, g)), 4)
                  if g < 90 else 0 for g in GAMMA_DEG]
        lines.append(' '.join(f'{v:g}' if v else '0' for v in values))
    return '\r\n'.join(lines) + '\r\n'


KINDS = {
    'point': ('kind = "point"\nfixture = "bulb"', 250.0),
    'spot': ('kind = "spot"\nfixture = "bulb"\ninner_deg = 15\nouter_deg = 25', 1250.0),
    'sun': ('kind = "directional"', 1000.0),
    'rect': ('kind = "rect"\nsize_m = [0.6, 0.3]', 200.0),
    'ies': ('kind = "photometric"\ndistribution = "lamp.ies"', 250.0),
    'axial': ('kind = "photometric"\ndistribution = "lamp.ies"', 250.0),
    'dome': ('kind = "dome"', 1000.0),
}


def session_toml(kind, color):
    """No walls: only the lamp is rendered."""
    keys, lux = KINDS[kind]
    cct, duv = COLORS[color]
    aim = '' if kind == 'dome' else f'aim = {AIM}\nposition_m = {POSITION}\n'
    return (f'lightcal = 1\nname = "{kind} {color}"\n[room]\ndark = true\n'
            f'[[light]]\nname = "lamp"\n{keys}\n{aim}'
            f'[[reading]]\nlight = "lamp"\ndistance_m = {D}\nilluminance_lx = {lux}\n'
            f'cct_K = {cct}\nduv = {duv}\n')


def rect_at(normal_towards, steps=120):
    """Lux over that on the axis, at D towards there and facing back: the integral over the lamp's face of
    even luminance, written out. In the lamp's own axes: C0, C90, aim."""
    width, height = RECT
    total = 0.0
    place = [D * x for x in normal_towards]
    for i in range(steps):
        x = width * ((i + 0.5) / steps - 0.5)
        for j in range(steps):
            y = height * ((j + 0.5) / steps - 0.5)
            to = [place[0] - x, place[1] - y, place[2]]
            d2 = sum(v * v for v in to)
            total += to[2] * sum(a * b for a, b in zip(to, normal_towards)) / (d2 * d2)
    return total


def probes(kind):
    """[{point, normal, lux}]: first the reading itself; of measured lamps five angles all the way round, of
    flat ones two angles more, each along and across it."""
    lux = KINDS[kind][1]
    if kind == 'dome':
        return [{'point': [0, 0, -1.0], 'normal': [0, 0, 1.0], 'lux': lux}]
    out = [{'point': along(POSITION, AIM, D), 'normal': [-x for x in AIM], 'lux': lux}]
    if kind == 'ies':
        for gamma in (10, 20, 35, 50, 60):
            for c in (0, 90, 180, 270):
                out.append(off_axis(c, gamma, lux * table_at(c, gamma) / 1000.0))
    if kind == 'rect':
        axial = rect_at((0.0, 0.0, 1.0))
        for gamma, c in ((30, 0), (30, 90), (60, 180), (60, 270)):
            g, a = math.radians(gamma), math.radians(c)
            towards = (math.sin(g) * math.cos(a), math.sin(g) * math.sin(a), math.cos(g))
            out.append(off_axis(c, gamma, lux * rect_at(towards) / axial))
    if kind == 'axial':
        for n, gamma in enumerate((10, 20, 30, 45, 60)):
            i = gamma // 5
            out.append(off_axis(30.0 + 72.0 * n, gamma, lux * round(1000 * math.cos(math.radians(5 * i)) ** 4, 4) / 1000.0))
    return out


def off_axis(c, gamma, lux):
    g, a = math.radians(gamma), math.radians(c)
    towards = [math.sin(g) * (math.cos(a) * x + math.sin(a) * y) + math.cos(g) * z
               for x, y, z in zip(C0, C90, AIM)]
    return {'point': along(POSITION, towards, D), 'normal': [-x for x in towards], 'lux': lux,
            'angle': f'C{c:g} g{gamma:g}'}
