#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`check --render` on pictures of cards off a spot's axis, and of cards that face several ways under a
panorama, with known mistakes put in: another cone law, angles doubled, a panorama turned, mirrored,
on its head. The pictures are painted here from closed forms; nothing of lightcal's headers is used.
  render_shapes.py LIGHTCAL"""
import json
import math
import os
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'tools'))
import usdlux  # noqa: E402

LIGHTCAL = os.path.abspath(sys.argv[1])
INNER, OUTER, CANDELA, D = 15.0, 25.0, 1000.0, 2.0
WEIGHTS = np.array([0.212639, 0.715169, 0.072192])
HEIGHT = 160


def smooth(t):
    return t * t * (3 - 2 * t)


def cone(inner, outer, law):
    """I/I(0) by the angle in degrees."""
    def at(angle):
        cosine, ci, co = (math.cos(math.radians(v)) for v in (angle, inner, outer))
        t = min(1.0, max(0.0, (cosine - co) / (ci - co)))
        s = min(1.0, max(0.0, (outer - angle) / (outer - inner)))
        u = (1 - cosine) / (1 - co)
        return {'squared': t * t, 'smooth': smooth(t), 'cycles': smooth(t) * cosine,
                'usd': smooth(s), 'mitsuba': s, 'godot': max(0.0, 1 - u)}[law]
    return at


# what is put in -> (I/I(0), the cause that must come first, words of its message)
SPOTS = {
    'nothing': (cone(INNER, OUTER, 'squared'), 'none', ''),
    'three.js': (cone(INNER, OUTER, 'smooth'), 'other_cone_law', 'three.js'),
    'UsdLux': (cone(INNER, OUTER, 'usd'), 'other_cone_law', 'UsdLux'),
    'Mitsuba': (cone(INNER, OUTER, 'mitsuba'), 'other_cone_law', 'Mitsuba'),
    'Godot': (cone(INNER, OUTER, 'godot'), 'other_cone_law', 'Godot'),
    'doubled': (cone(2 * INNER, 2 * OUTER, 'squared'), 'full_cone_for_half', ''),
    'no inner cone': (cone(0, OUTER, 'squared'), 'inner_cone_missing', ''),
    'turned aside by 4 degrees': (cone(INNER, OUTER, 'squared'), 'other_beam', ''),
}

# cd/m2 and colour of each side.
SIDES = [((1, 0, 0), 1.0, (1.0, 0.3, 0.2)), ((-1, 0, 0), 0.5, (0.2, 1.0, 0.3)), ((0, 1, 0), 0.2, (0.3, 0.4, 1.0)),
         ((0, -1, 0), 0.1, (1.0, 1.0, 0.2)), ((0, 0, 1), 0.8, (0.6, 0.8, 1.0)), ((0, 0, -1), 0.05, (0.9, 0.6, 0.4))]


def sky(d):
    """[..., 3] directions -> linear Rec. 709 in cd/m2."""
    weights = np.stack([np.maximum(0, d @ np.array(way, float)) ** 4 for way, _, _ in SIDES], -1)
    colors = np.array([np.array(c) * v for _, v, c in SIDES])
    return 3000 * (weights / weights.sum(-1, keepdims=True)) @ colors


def around(width):
    height = width // 2
    zenith = np.pi * (np.arange(height) + 0.5) / height
    azimuth = 2 * np.pi * ((np.arange(width) + 0.5) / width - 0.5)
    z, a = np.meshgrid(zenith, azimuth, indexing='ij')
    return np.stack([np.sin(z) * np.sin(a), np.sin(z) * np.cos(a), np.cos(z)], -1), (
        np.sin(z) * (np.pi / height) * (2 * np.pi / width))


DIRECTIONS, OMEGA = around(256)


def turn(degrees):
    """What stood in front stands, at 90, to the right."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.array([[c, s, 0], [-s, c, 0], [0, 0, 1.0]])


MIRROR, HEAD, ROWS = np.diag([-1.0, 1, 1]), np.diag([-1.0, 1, -1]), np.diag([1.0, 1, -1])
BACK = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0.0]])
# what is put in -> (where a direction of the picture comes to stand, a factor, cause, degrees)
PANORAMAS = {
    'nothing': (np.eye(3), 1.0, 'none', None),
    'turned by 90': (turn(90), 1.0, 'panorama_turned', 90),
    'turned by 217': (turn(217), 1.0, 'panorama_turned', 217),
    'mirrored': (MIRROR, 1.0, 'panorama_mirrored', 0),
    'mirrored and turned by 180': (turn(180) @ MIRROR, 1.0, 'panorama_mirrored', 180),
    'on its head': (HEAD, 1.0, 'panorama_upside_down', 0),
    'rows from below': (ROWS, 1.0, 'panorama_flipped', 0),
    'on its back': (BACK, 1.0, 'panorama_on_its_back', 0),
    'pi too bright': (np.eye(3), math.pi, 'times_pi', None),
    'turned and 1.37 too bright': (turn(90), 1.37, 'panorama_turned', 90),
}


def card_light(matrix, normal):
    """[r, g, b] in lux on a white card under the sky through that matrix."""
    cosine = np.maximum(0, DIRECTIONS @ matrix.T @ normal)
    return np.einsum('yx,yx,yxc->c', cosine, OMEGA, sky(DIRECTIONS))


def paint(path, preset, light):
    """The rig's two cards through its camera; light(place, normal) -> rgb in lux."""
    rig, scale = preset['rig'], preset['exposure']['exposure']
    camera = rig['camera']
    eye, up = np.array(camera['position_m']), np.array(camera['up'])
    ahead = np.array(camera['target_m']) - eye
    ahead /= np.linalg.norm(ahead)
    right = np.cross(ahead, up)
    width = int(HEIGHT * camera['aspect_ratio'])
    focal = HEIGHT / 2 / math.tan(math.radians(camera['vertical_fov_deg']) / 2)
    x = (np.arange(width) + 0.5 - width / 2) / focal
    y = (HEIGHT / 2 - np.arange(HEIGHT) - 0.5) / focal
    rays = ahead + x[None, :, None] * right + y[:, None, None] * up
    normal, row = np.array(rig['normal']), np.array(rig['row'])
    column = np.cross(normal, row)
    picture = np.zeros((HEIGHT, width, 3))
    for card in rig['cards']:
        centre = np.array(card['centre_m'])
        distance = ((centre - eye) @ normal) / (rays @ normal)
        places = eye + distance[..., None] * rays
        inside = ((np.abs((places - centre) @ row) < rig['side_m'] / 2) &
                  (np.abs((places - centre) @ column) < rig['side_m'] / 2) & (distance > 0))
        for at in np.argwhere(inside):
            picture[tuple(at)] = np.array(light(places[tuple(at)], normal)) * card['reflectance'] / math.pi * scale
    usdlux.write_exr(path, picture)
    return picture


D65 = [0.3127, 0.3290]
FROM_XYZ = np.array([[3.2409699, -1.5373832, -0.4986108], [-0.9692436, 1.8759675, 0.0415551],
                     [0.0556301, -0.2039770, 1.0569715]])


def rgb_of(xy):
    """Linear Rec. 709 of luminance 1."""
    return FROM_XYZ @ np.array([xy[0] / xy[1], 1.0, (1 - xy[0] - xy[1]) / xy[1]])


def xyz_of(xy):
    return np.array([xy[0] / xy[1], 1.0, (1 - xy[0] - xy[1]) / xy[1]])


def matrix_of(primaries, white):
    """XYZ of linear RGB (SMPTE RP 177)."""
    columns = np.array([xyz_of(xy) for xy in primaries]).T
    return columns * np.linalg.solve(columns, xyz_of(white))


def bradford(seen, shown):
    """Of XYZ, from one white to another (ICC.1 annex E)."""
    cones = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])
    return np.linalg.inv(cones) @ np.diag(cones @ xyz_of(shown) / (cones @ xyz_of(seen))) @ cones


def uv_of(xy):
    below = -2 * xy[0] + 12 * xy[1] + 3
    return 4 * xy[0] / below, 9 * xy[1] / below


def write_png(path, linear):
    """8 bits, sRGB encoded."""
    v = np.clip(linear, 0, 1)
    codes = np.round(255 * np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** (1 / 2.4) - 0.055)).astype(np.uint8)

    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    rows = b''.join(b'\0' + row.tobytes() for row in codes)
    with open(path, 'wb') as f:
        f.write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', codes.shape[1], codes.shape[0], 8, 2, 0, 0, 0))
                + chunk(b'IDAT', zlib.compress(rows)) + chunk(b'IEND', b''))


def load(path):
    with open(path) as f:
        return json.load(f)


def run(*words):
    done = subprocess.run([LIGHTCAL, *words], capture_output=True, text=True)
    assert done.returncode == 0, (words, done.stdout, done.stderr)
    return done.stdout


class Shapes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.work = cls.temporary.name

    def export(self, name, source, *words):
        out = os.path.join(self.work, name)
        run('export', source, '--to', 'json', '-o', out, *words)
        stem = os.path.splitext(os.path.basename(source))[0]
        rigs = sorted(f for f in os.listdir(out) if f.startswith(stem + '.rig') and f.endswith('preset.json'))
        return [os.path.join(out, f) for f in rigs]

    def spot(self):
        path = os.path.join(self.work, 'spot.json')
        with open(path, 'w') as f:
            json.dump({'schema': 'lightcal.light/1', 'lights': [
                {'name': 'spot', 'kind': 'spot', 'position_m': [1, 2, 3], 'aim': [0.48, 0.36, -0.8],
                 'effects': [], 'color': {'xy': [0.3127, 0.3290]}, 'intensity_cd': {'value': CANDELA, 'u95': 10},
                 'cone': {'inner_deg': INNER, 'outer_deg': OUTER},
                 'fit': {'readings': 1, 'used': 1, 'rejected': [], 'learned': [], 'prior': []}}]}, f)
        return path

    def check(self, pictures, *more):
        words = [w for picture, rig in pictures for w in ('--render', picture, '--rig', rig)]
        done = subprocess.run([LIGHTCAL, 'check', *words, *more, '--json'], capture_output=True, text=True)
        answer = json.loads(done.stdout)
        # 1 where it says that the picture is off, beside the whole answer.
        self.assertEqual(done.returncode, 1 if 'error' in answer else 0, done.stdout + done.stderr)
        return answer

    def painted(self, name, rigs, light):
        pictures = []
        for rig in rigs:
            preset = load(rig)
            path = os.path.join(self.work, f'{name}_{len(pictures)}.exr')
            paint(path, preset, light)
            pictures.append((path, rig))
        return pictures

    def test_spots(self):
        rigs = self.export('spots', self.spot(), '--rig', '--rig-at', '18', '--rig-at', '21.5/90')
        self.assertEqual(len(rigs), 3)
        for name, (shape, cause, words) in SPOTS.items():
            aim, lamp = np.array([0.48, 0.36, -0.8]), np.array([1.0, 2, 3])
            if name.startswith('turned'):  # towards the cards at 18 degrees
                aside = np.cross(aim, [0, 0, 1]) / np.linalg.norm(np.cross(aim, [0, 0, 1]))
                aim = aim * math.cos(math.radians(4)) + aside * math.sin(math.radians(4))

            def light(place, normal):
                to = place - lamp
                d = np.linalg.norm(to)
                angle = math.degrees(math.acos(min(1.0, to @ aim / d)))
                return [CANDELA * shape(angle) * -(to @ normal) / d ** 3] * 3

            pictures = self.painted('spot', rigs, light)
            with self.subTest(put_in=name):
                answer = self.check(pictures)
                self.assertEqual(answer['cause']['code'], cause, answer['cause'])
                self.assertIn(words, answer['cause']['message'])
                for picture, (_, rig) in zip(answer['pictures'], pictures):
                    angle = load(rig)['rig'].get('off_axis_deg', 0.0)
                    want = CANDELA * shape(angle) / D ** 2 if angle else None
                    if want and not name.startswith('turned'):  # at the distance the rig says
                        want *= (D / load(rig)['rig']['separation_m']) ** 2
                        self.assertLess(abs(picture['illuminance_lx'] / want - 1), 0.01, (name, angle))
            if name == 'three.js':  # a single picture off the axis names it, too
                alone = self.check(pictures[1:2])
                codes = [alone['cause']] + alone['alternatives']
                self.assertTrue(any(c['code'] == cause and words in c['message'] for c in codes), alone)

    def test_a_shared_factor_is_no_cone_law(self):
        rigs = self.export('factor', self.spot(), '--rig', '--rig-at', '18')
        shape, lamp, aim = cone(INNER, OUTER, 'squared'), np.array([1.0, 2, 3]), np.array([0.48, 0.36, -0.8])

        def light(place, normal):
            to = place - lamp
            d = np.linalg.norm(to)
            return [math.pi * CANDELA * shape(math.degrees(math.acos(min(1.0, to @ aim / d)))) * -(to @ normal) / d ** 3] * 3

        self.assertEqual(self.check(self.painted('factor', rigs, light))['cause']['code'], 'times_pi')

    def test_rigs_of_several_lamps(self):
        # name -> (where, cd); by the inverse square the key gives nearly all light a metre below itself.
        lamps = {'key': ([0.0, 0, 3], 900.0), 'fill': ([4.0, 1, 2.5], 300.0), 'rim': ([-3.0, 5, 2], 60.0)}
        path = os.path.join(self.work, 'set.json')
        with open(path, 'w') as f:
            json.dump({'schema': 'lightcal.light/1', 'lights': [
                {'name': name, 'kind': 'point', 'position_m': where, 'effects': [],
                 'color': {'xy': [0.3127, 0.3290]}, 'intensity_cd': {'value': candela, 'u95': 1},
                 'fit': {'readings': 1, 'used': 1, 'rejected': [], 'learned': [], 'prior': []}}
                for name, (where, candela) in lamps.items()]}, f)
        rigs = self.export('set', path, '--rig', '--rig-at', 'fill', '--rig-at', 'rim:0')
        self.assertEqual([os.path.basename(r) for r in rigs],
                         ['set.rig.preset.json', 'set.rig_fill.preset.json', 'set.rig_rim.preset.json'])
        preset = load(rigs[0])
        for card in preset['rig']['cards']:  # what each lamp gives there, in their order
            for lux, (where, candela) in zip(card['lights_lx'], lamps.values()):
                to = np.array(card['centre_m']) - where
                cosine = max(0.0, -(to @ np.array(preset['rig']['normal'])) / np.linalg.norm(to))
                self.assertAlmostEqual(lux, candela * cosine / (to @ to), delta=1e-6 * candela)

        def judged(factors, chosen):
            def light(place, normal):
                sum_lx = 0.0
                for name, (where, candela) in lamps.items():
                    to = place - np.array(where)
                    d = np.linalg.norm(to)
                    sum_lx += factors.get(name, 1.0) * candela * max(0.0, -(to @ normal)) / d ** 3
                return [sum_lx] * 3
            return self.check(self.painted('set', chosen, light))

        alone = judged({'rim': 0.0}, rigs[:1])  # cards before the key cannot see the rim
        self.assertEqual((alone['cause']['code'], alone['not_seen']), ('none', ['fill', 'rim']))
        self.assertIn('--rig-at fill', alone['cause']['message'])
        two = judged({'rim': 0.0}, rigs[:2])
        self.assertEqual((two['cause']['code'], two['not_seen']), ('none', ['rim']))
        for factors, code, words in (
                ({}, 'none', 'key, fill, rim'), ({'rim': math.pi}, 'times_pi', 'rim gives 3.14 times'),
                ({'fill': 0.6}, 'other_intensity', 'fill gives 0.600 times'),
                ({name: math.pi for name in lamps}, 'times_pi', 'pi too much'),
                ({'key': 1.2, 'rim': 4.0}, 'diameter_for_radius', '; key gives 1.20 times what was measured: no known')):
            with self.subTest(factors=factors):
                answer = judged(factors, rigs)
                self.assertEqual(answer['cause']['code'], code, answer['cause'])
                self.assertIn(words, answer['cause']['message'])
                self.assertNotIn('not_seen', answer)
                for lamp in answer['lamps']:
                    self.assertAlmostEqual(lamp['factor'], factors.get(lamp['name'], 1.0), delta=0.02)

    def lamps(self, name, lamps, *options):
        """name -> (where, cd, xy); the rigs before each."""
        path = os.path.join(self.work, name + '.json')
        with open(path, 'w') as f:
            json.dump({'schema': 'lightcal.light/1', 'lights': [
                {'name': lamp, 'kind': 'point', 'position_m': where, 'effects': [], 'color': {'xy': xy},
                 'intensity_cd': {'value': candela, 'u95': 1},
                 'fit': {'readings': 1, 'used': 1, 'rejected': [], 'learned': [], 'prior': []}}
                for lamp, (where, candela, xy) in lamps.items()]}, f)
        return self.export(name, path, '--rig', *options, *[w for lamp in list(lamps)[1:] for w in ('--rig-at', lamp)])

    @staticmethod
    def shining(lamps, colors=(), factors=()):
        """Inverse squares, in their colours or others of the same luminance."""
        colors, factors = dict(colors), dict(factors)

        def light(place, normal):
            rgb = np.zeros(3)
            for name, (where, candela, xy) in lamps.items():
                to = place - np.array(where)
                lux = factors.get(name, 1.0) * candela * max(0.0, -(to @ normal)) / np.linalg.norm(to) ** 3
                tint = colors.get(name, rgb_of(xy))
                rgb += lux * tint / (tint @ WEIGHTS)
            return rgb
        return light

    def test_a_picture_that_is_off_fails(self):
        """Beyond --max-error, 5 % where nobody says otherwise: exit 1, as of a preset."""
        lamps = {'lamp': ([0.0, 0, 2], 1000.0, D65)}
        rigs = self.lamps('alone', lamps)
        for factor, more, off in ((1.0, (), False), (1.04, (), False), (1.07, (), True), (0.93, (), True),
                                  (1.07, ('--max-error', '10%'), False), (1.12, ('--max-error', '10%'), True),
                                  (1 / 683, (), True), (math.pi, (), True), (1.03, ('--max-error', '1%'), True)):
            with self.subTest(factor=factor, more=more):
                pictures = self.painted('off', rigs, self.shining(lamps, factors={'lamp': factor}))
                answer = self.check(pictures, *more)
                self.assertEqual(answer.get('error', {}).get('code'), 'render_off' if off else None, answer)
                self.assertAlmostEqual(answer['stops_off'], math.log2(factor), delta=0.01)
        # Of several pictures each.
        two = {'key': ([0.0, 0, 3], 900.0, D65), 'fill': ([4.0, 1, 2.5], 300.0, D65)}
        rigs = self.lamps('two', two)
        self.assertNotIn('error', self.check(self.painted('two', rigs, self.shining(two))))
        answer = self.check(self.painted('two', rigs, self.shining(two, factors={'fill': 0.8})))
        self.assertEqual(answer['error']['code'], 'render_off')
        self.assertIn('fill', answer['error']['message'])

    def test_the_codes_of_a_picture_leave_that_much_open(self):
        """A dark picture of 8 bits: half a code of its white card is 1.6 %, so 6 % is within 5 %."""
        lamps = {'lamp': ([0.0, 0, 2], 1000.0, D65)}
        rigs = self.lamps('dark', lamps)
        preset = load(rigs[0])
        preset['exposure']['exposure'] *= 0.018  # code 39 on the white card, 9 on the grey
        dark = os.path.join(self.work, 'dark.rig.preset.json')
        with open(dark, 'w') as f:
            json.dump(preset, f)
        for factor, off in ((1.055, False), (1.15, True)):
            exr, png = os.path.join(self.work, 'dark.exr'), os.path.join(self.work, 'dark.png')
            picture = paint(exr, preset, self.shining(lamps, factors={'lamp': factor}))
            write_png(png, picture)
            answer = self.check([(png, dark)])
            self.assertEqual('error' in answer, off, answer)

    def test_the_colour_of_the_cards(self):
        """What stands in for a lamp's colour, at its very luminance."""
        warm, cold = [0.4254, 0.4011], [0.3127, 0.3290]  # 3200 K
        white, blue = np.ones(3), np.array([0.6, 0.8, 1.0])
        lamps = {'lamp': ([0.0, 0, 2], 1000.0, warm)}
        rigs = self.lamps('warm', lamps)
        right = self.check(self.painted('warm', rigs, self.shining(lamps)))
        self.assertNotIn('error', right)
        self.assertLess(right['color']['apart_uv'], 5e-4)
        answer = self.check(self.painted('warm', rigs, self.shining(lamps, {'lamp': white})))
        self.assertEqual((answer['cause']['code'], answer['error']['code']), ('color_missing', 'color_off'))
        self.assertAlmostEqual(answer['color']['apart_uv'], math.dist(uv_of(warm), uv_of(D65)), delta=5e-4)
        self.assertNotIn('divided', answer['cause']['message'])
        # 3200 K as 2950 K is .0109 in u'v': no component is further off than .03 of the largest... or nearly.
        near = rgb_of([0.4412, 0.4063])
        answer = self.check(self.painted('warm', rigs, self.shining(lamps, {'lamp': near})))
        self.assertEqual((answer['cause']['code'], answer['error']['code']), ('other_color', 'color_off'), answer)
        # Among several, each before its own cards.
        three = {'key': ([0.0, 0, 3], 900.0, warm), 'fill': ([4.0, 1, 2.5], 300.0, cold),
                 'rim': ([-3.0, 5, 2], 60.0, warm)}
        rigs = self.lamps('three', three)
        self.assertNotIn('error', self.check(self.painted('three', rigs, self.shining(three))))
        for changed, code in ({'key': white}, 'color_missing'), ({'rim': white}, 'color_missing'), (
                {'fill': blue}, 'other_color'):
            with self.subTest(changed=list(changed)):
                answer = self.check(self.painted('three', rigs, self.shining(three, changed)))
                self.assertEqual((answer['cause']['code'], answer['error']['code']), (code, 'color_off'), answer)
                self.assertIn(list(changed)[0], answer['cause']['message'])
                off = [p['color']['off'] for p in answer['pictures']]
                self.assertTrue(off[list(three).index(list(changed)[0])], answer)
        one = self.check(self.painted('three', rigs[:1], self.shining(three, {'key': white})))
        self.assertEqual((one['cause']['code'], one['error']['code']), ('color_missing', 'color_off'), one)

    def test_pictures_of_another_space_and_another_white(self):
        """What a pipeline shows is told from what the lamp is by what its export says."""
        warm = [0.4254, 0.4011]
        lamps = {'lamp': ([0.0, 0, 2], 1000.0, warm)}
        rec709 = matrix_of([[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]], D65)
        ap1, aces = [[0.713, 0.293], [0.165, 0.830], [0.128, 0.044]], [0.32168, 0.33767]
        for options, shows in ((('--space', 'acescg'), np.linalg.inv(matrix_of(ap1, aces)) @ bradford(D65, aces) @ rec709),
                               (('--white', '0.4254,0.4011'), np.linalg.inv(rec709) @ bradford(warm, D65) @ rec709)):
            with self.subTest(options=options):
                rigs = self.lamps('space' + options[0], lamps, *options)
                shining = self.shining(lamps)
                answer = self.check(self.painted('space', rigs, lambda place, normal: shows @ shining(place, normal)))
                self.assertNotIn('error', answer)
                self.assertAlmostEqual(answer['stops_off'], 0.0, delta=0.005)
                white = self.shining(lamps, {'lamp': np.ones(3)})
                answer = self.check(self.painted('space', rigs, lambda place, normal: shows @ white(place, normal)))
                self.assertEqual(answer['error']['code'], 'color_off', answer)

    def test_causes_that_one_picture_cannot_tell_apart(self):
        """Twice the light 2 m from a lamp: 1/d, or a lamp twice as strong."""
        folder = os.path.join(self.work, 'far')
        os.mkdir(folder)
        with open(os.path.join(folder, 'session.toml'), 'w') as f:
            f.write('lightcal = 1\n[room]\ndark = true\n[[light]]\nname = "lamp"\nkind = "point"\n'
                    'position_m = [0, 0, 2]\n[[reading]]\nlight = "lamp"\ndistance_m = 2\nilluminance_lx = 250\n')
        run('fit', folder, '-o', os.path.join(self.work, 'far.json'))
        rigs = self.export('far_rigs', os.path.join(self.work, 'far.json'), '--rig')
        d = load(rigs[0])['rig']['separation_m']
        self.assertAlmostEqual(d, 2, delta=0.02)
        lamps = {'lamp': ([0.0, 0, 2], load(rigs[0])['rig']['cards'][0]['illuminance_lx'] * d * d, D65)}
        answer = self.check(self.painted('twice', rigs, self.shining(lamps, factors={'lamp': d})))
        codes = [answer['cause']['code']] + [c['code'] for c in answer['alternatives']]
        self.assertEqual(codes, ['falloff_1_over_d', 'other_intensity'])
        self.assertIn('or other_intensity: ', answer['error']['message'])
        other = answer['alternatives'][0]
        self.assertIn('another distance', other['message'])
        # What neither place nor stops explain stands alone.
        answer = self.check(self.painted('twice', rigs, self.shining(lamps, factors={'lamp': 683.0})))
        self.assertNotIn('other_intensity', [c['code'] for c in answer['alternatives']])

    def test_refusals(self):
        spot = self.spot()
        for words, code, exit_code in ((['--rig-at', '30'], 'rig_place', 3), (['--rig-at', '0'], 'usage', 2),
                                       (['--rig-at', '20/x'], 'usage', 2), (['--rig-at', 'spto'], 'unknown_light', 3),
                                       (['--rig-at', 'spot:x'], 'usage', 2)):
            out = os.path.join(self.work, 'refused')
            done = subprocess.run([LIGHTCAL, 'export', spot, '--to', 'json', '-o', out, '--json', *words],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, exit_code, done.stdout)
            self.assertEqual(json.loads(done.stdout)['error']['code'], code)
            self.assertFalse(os.path.exists(out))

    def test_panoramas(self):
        picture = os.path.join(self.work, 'place.exr')
        usdlux.write_exr(picture, sky(around(256)[0]))
        up = card_light(np.eye(3), np.array([0, 0, 1.0])) @ WEIGHTS
        place = os.path.join(self.work, 'place')
        run('dome', picture, '--lux', repr(float(up)), '-o', place)
        rigs = self.export('panorama', os.path.join(place, 'light.json'), '--rig', '--rig-at', '90', '--rig-at',
                           '90/90', '--rig-at', '90/180')
        self.assertEqual(len(rigs), 4)
        for name, (matrix, factor, cause, degrees) in PANORAMAS.items():
            known = {}

            def light(_, normal):
                key = tuple(np.round(normal, 9))
                if key not in known:
                    known[key] = factor * card_light(matrix, normal)
                return known[key]

            with self.subTest(put_in=name):
                answer = self.check(self.painted('sky', rigs, light))
                self.assertEqual(answer['cause']['code'], cause, answer)
                if degrees is not None:
                    off = (answer['cause']['turn_deg'] - degrees + 180) % 360 - 180
                    self.assertLessEqual(abs(off), 2, answer['cause'])


unittest.main(argv=sys.argv[:1])
