# SPDX-License-Identifier: Apache-2.0
"""PNG pictures and the rig's cards in them, for the gates alone: shares nothing with lightcal."""
import math
import struct
import zlib


def read_png(path):
    """(width, height, rows of bytes, channels); 8 bit, not interlaced."""
    data = open(path, 'rb').read()
    at, packed = 8, b''
    while at < len(data):
        length, kind = struct.unpack('>I4s', data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b'IHDR':
            width, height, depth, color = struct.unpack('>IIBB', body[:10])
        if kind == b'IDAT':
            packed += body
        at += 12 + length
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[color]
    assert depth == 8
    raw, step = zlib.decompress(packed), width * channels
    rows, above = [], bytearray(step)
    for y in range(height):
        method, line = raw[y * (step + 1)], bytearray(raw[y * (step + 1) + 1:(y + 1) * (step + 1)])
        if method == 2:
            line = bytearray((a + b) & 255 for a, b in zip(line, above))
        elif method:
            for i in range(step):
                left = line[i - channels] if i >= channels else 0
                corner = above[i - channels] if i >= channels else 0
                if method == 1:
                    guess = left
                elif method == 3:
                    guess = (left + above[i]) // 2
                else:
                    p = left + above[i] - corner
                    da, db, dc = abs(p - left), abs(p - above[i]), abs(p - corner)
                    guess = left if da <= db and da <= dc else above[i] if db <= dc else corner
                line[i] = (line[i] + guess) & 255
        rows.append(line)
        above = line
    return width, height, rows, channels


def decode(code):
    v = code / 255
    return v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4


def card_luminance(path, rig, which):
    """Linear luminance (Rec. 709) of the middle of a card, 8 bit sRGB."""
    width, height, rows, channels = read_png(path)
    camera = rig['camera']
    sub = lambda a, b: [x - y for x, y in zip(a, b)]
    dot = lambda a, b: sum(x * y for x, y in zip(a, b))
    ahead = sub(camera['target_m'], camera['position_m'])
    ahead = [x / math.sqrt(dot(ahead, ahead)) for x in ahead]
    up = camera['up']
    right = [ahead[1] * up[2] - ahead[2] * up[1], ahead[2] * up[0] - ahead[0] * up[2],
             ahead[0] * up[1] - ahead[1] * up[0]]
    to = sub(rig['cards'][which]['centre_m'], camera['position_m'])
    f = height / 2 / math.tan(math.radians(camera['vertical_fov_deg']) / 2)
    x = width / 2 + f * dot(to, right) / dot(to, ahead)
    y = height / 2 - f * dot(to, up) / dot(to, ahead)
    half = max(2, int(0.1 * f * rig['side_m'] / dot(to, ahead)))
    total, n = [0.0, 0.0, 0.0], 0
    for row in range(int(y) - half, int(y) + half):
        for column in range(int(x) - half, int(x) + half):
            n += 1
            for c in range(3):
                total[c] += decode(rows[row][column * channels + c])
    return sum(w * t / n for w, t in zip((0.212639, 0.715169, 0.072192), total))
