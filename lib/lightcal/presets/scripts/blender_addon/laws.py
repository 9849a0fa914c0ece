# Written by lightcal: what a measured lamp is in Blender. Nothing here needs Blender itself.
# SPDX-License-Identifier: Apache-2.0
"""Watts of W = lm/683, as Blender's glTF importer has it. With I the axial intensity in cd, E an
illuminance in lx and Y the luminance of the colour whose largest component is 1:
  point, sphere, tube, spot  4 pi I/(683 Y)    sun  E/(683 Y)
  rect, disk                 pi I/(683 Y)  from 4.0 on, before it 4 I/(683 Y)
  measured distribution      177.83/(683 Y), its candela in an IES text (C0 is the node's -Y)"""
import json
import math

LUMENS_PER_WATT = 683.0
LUMENS_PER_WATT_OF_IES = 177.83
REC709 = ((3.2404542, -1.5371385, -0.4985314), (-0.9692660, 1.8760108, 0.0415560),
          (0.0556434, -0.2040259, 1.0572252))
WEIGHTS = (0.2126, 0.7152, 0.0722)


class BadLight(Exception):
    """A file that is no light.json; the message is for people."""


def read_lights(path):
    """The lamps of a light.json, as dictionaries."""
    try:
        with open(path, encoding='utf-8') as text:
            document = json.load(text)
    except OSError as fault:
        raise BadLight('cannot be read: ' + (fault.strerror or str(fault))) from fault
    except ValueError as fault:
        raise BadLight('is no JSON yet: ' + str(fault)) from fault
    if not isinstance(document, dict) or document.get('schema') != 'lightcal.light/1':
        raise BadLight('is no light.json of lightcal')
    lights = document.get('lights', [])
    if not all(isinstance(light, dict) and light.get('name') for light in lights):
        raise BadLight('has lights without names')
    return lights


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def figure(light):
    """(value, low, high, unit) of what was measured, or None. u95 is a half width."""
    for key, name in (('intensity_cd', 'cd'), ('illuminance_lx', 'lx'), ('luminance_nits', 'nits')):
        found = light.get(key)
        if found and found.get('value', 0.0) > 0.0:
            value, u95 = found['value'], found.get('u95', 0.0)
            return value, found.get('low95', value - u95), found.get('high95', value + u95), name
    return None


def locus_uv(t):
    """CIE 1960 uv of a black body of t kelvin, 1000 to 15000 K (Krystek 1985)."""
    u = (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t * t) / (
        1 + 8.42420235e-4 * t + 7.08145163e-7 * t * t)
    v = (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t * t) / (
        1 - 2.89741816e-5 * t + 1.61456053e-7 * t * t)
    return u, v


def color_of(light):
    """(linear Rec. 709 with its largest component 1, luminance of it)"""
    xy = light.get('color', {}).get('xy')
    if not xy:
        cct = light.get('color', {}).get('cct_K', {}).get('value')
        if not cct:
            return [1.0, 1.0, 1.0], 1.0
        u, v = locus_uv(float(cct))
        xy = [3 * u / (2 * u - 8 * v + 4), 2 * v / (2 * u - 8 * v + 4)]
    x, y = xy
    xyz = (x / y, 1.0, (1 - x - y) / y)
    rgb = [max(0.0, sum(m * c for m, c in zip(row, xyz))) for row in REC709]
    rgb = [c / max(rgb) for c in rgb]
    return rgb, sum(w * c for w, c in zip(WEIGHTS, rgb))


def axes_of(light):
    """(c0, c90, aim): C90 as high up as the aim lets it be, C0 along `axis` where there is one."""
    aim = unit(light.get('aim', [0.0, 0.0, -1.0]))
    axis = light.get('axis')
    if axis and 'aim' not in light:  # a tube that hangs as its axis says shines to its side
        level = axes_of({'aim': aim})
        along = unit(axis)
        if abs(sum(a * b for a, b in zip(aim, along))) > 0.99:
            aim = level[0]
    right = cross(aim, [0.0, 0.0, 1.0])
    right = unit(right) if math.sqrt(sum(x * x for x in right)) > 1e-9 else [1.0, 0.0, 0.0]
    if axis:
        dot = sum(a * b for a, b in zip(axis, aim))
        square = [a - dot * b for a, b in zip(axis, aim)]
        if math.sqrt(sum(x * x for x in square)) > 1e-9:
            right = unit(square)
    return right, cross(right, aim), aim


def position_of(light):
    """The effective source: d0 behind the place distances were measured from, along the aim."""
    at = light.get('position_m', [0.0, 0.0, 0.0])
    if 'aim' not in light or light['kind'] in ('directional', 'dome'):
        return list(at)
    offset = light.get('distance_offset_m', {}).get('value', 0.0)
    return [p - offset * a for p, a in zip(at, unit(light['aim']))]


def cone_of(inner_deg, outer_deg, disc):
    """(spot_size, spot_blend) in radians: of Cycles' smoothstep in the cosine the cone nearest to
    the measured one, ((cos - co)/(ci - co))^2, its flux within 2 %; `disc`: before Blender 4.0
    another cosine dims it."""
    inner, outer = math.radians(inner_deg), math.radians(outer_deg)
    steps = [min(math.pi / 2, outer * 1.3) * (i + 0.5) / 160 for i in range(160)]

    def ramp(angle, i, o):
        span = math.cos(i) - math.cos(o)
        return min(1.0, max(0.0, (math.cos(angle) - math.cos(o)) / max(span, 1e-9)))
    want = [ramp(a, inner, outer) ** 2 for a in steps]
    flux = sum(w * math.sin(a) for w, a in zip(want, steps))
    best = None
    for j in range(40):
        o = min(math.radians(89.9), outer * (0.80 + 0.0125 * j))
        for k in range(40):
            i = o * k / 40
            got = [t * t * (3 - 2 * t) * (math.cos(a) if disc else 1.0)
                   for t, a in ((ramp(a, i, o), a) for a in steps)]
            off = abs(sum(g * math.sin(a) for g, a in zip(got, steps)) / flux - 1)
            worst = max(abs(g - w) for g, w in zip(got, want))
            score = worst + 20 * max(0.0, off - 0.02)
            if best is None or score < best[0]:
                best = (score, i, o)
    _, i, o = best
    return 2 * o, (math.cos(i) - math.cos(o)) / (1 - math.cos(o))


def ies_text(light):
    """Its table as LM-63, turned the way Cycles counts C: 360 - C."""
    table = light['distribution']
    c, gamma, candela = table['horizontal_deg'], table['vertical_deg'], table['candela']
    n = len(gamma)
    planes = [candela[i * n:(i + 1) * n] for i in range(len(c))]
    if len(c) > 1 and c[-1] > 180.0:
        if c[-1] < 360.0:
            c, planes = list(c) + [360.0], planes + [planes[0]]
        c, planes = [360.0 - x for x in reversed(c)], planes[::-1]
    lines = ['IESNA:LM-63-2002', '[TEST] lightcal', '[TESTLAB] lightcal', '[ISSUEDATE] 2026',
             '[MANUFAC] lightcal', 'TILT=NONE',
             '1 -1 1 %d %d 1 2 0 0 0' % (n, len(c)), '1 1 0',
             ' '.join('%g' % x for x in gamma), ' '.join('%g' % x for x in c)]
    lines += [' '.join('%.6g' % x for x in plane) for plane in planes]
    return '\r\n'.join(lines) + '\r\n'


def lamp_of(light, version):
    """What to set in Blender of that version, or None where it has no such lamp (a dome, a lamp
    without a figure)."""
    kind, value = light.get('kind'), figure(light)
    color, y = color_of(light)
    if kind == 'dome' or value is None:
        return None
    c0, c90, aim = axes_of(light)
    lamp = {'type': 'POINT', 'color': color, 'axes': [c0, c90, [-a for a in aim]],
            'position': position_of(light), 'radius': 0.0}
    amount = value[0] / (LUMENS_PER_WATT * y)
    lamp['energy'] = 4 * math.pi * amount
    if kind == 'directional':
        lamp.update(type='SUN', energy=amount,
                    angle=math.radians(light.get('angular_diameter_deg', 0.0)))
    elif kind == 'sphere':
        lamp['radius'] = light.get('diameter_m', 0.0) / 2
    elif kind in ('rect', 'disk'):  # one of unknown size: 10 cm
        size = light.get('diameter_m' if kind == 'disk' else 'width_m', 0.1)
        lamp.update(type='AREA', shape='DISK' if kind == 'disk' else 'RECTANGLE', size=size,
                    size_y=light.get('height_m', size) if kind == 'rect' else size,
                    energy=(math.pi if version >= (4, 0) else 4.0) * amount)
    elif kind == 'spot' and light.get('cone'):
        size, blend = cone_of(light['cone'].get('inner_deg', 0.0), light['cone']['outer_deg'],
                              version < (4, 0))
        lamp.update(type='SPOT', spot_size=size, spot_blend=blend)
    elif kind == 'photometric' and light.get('distribution'):
        lamp.update(ies=ies_text(light), energy=LUMENS_PER_WATT_OF_IES / LUMENS_PER_WATT / y,
                    axes=[c90, [-a for a in c0], [-a for a in aim]])
    return lamp


def number_text(value):
    """Four digits, without a power of ten."""
    text = '%.4g' % value
    return '%.0f' % float(text) if 'e+' in text else text


def interval_text(light):
    """1000 cd (950 to 1050), 2700 K"""
    value = figure(light)
    if value is None:
        return 'no figure'
    text = '%s %s (%s to %s)' % (number_text(value[0]), value[3], number_text(value[1]),
                                 number_text(value[2]))
    cct = light.get('color', {}).get('cct_K', {}).get('value')
    return text + (', %.0f K' % cct if cct else '')
