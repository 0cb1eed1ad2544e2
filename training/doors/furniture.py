"""What stands in rooms and before houses, as blocks: tables, chairs, beds, sofas, basins, steps, railings."""

from __future__ import annotations

import math

import numpy
from PIL import Image, ImageDraw

import textures
from surface import PAINTS, WALLS, WOODS, pick

Block = tuple[float, float, float, float, float, float, numpy.ndarray]  # left, foot, near, width, height, depth in metres; colour


def boxes(rng) -> list[Block]:
    foot = rng.uniform(0, 0.5) if rng.random() < 0.3 else 0
    return [(0, foot, 0, rng.uniform(0.25, 1.6), rng.uniform(0.25, 1.2), rng.uniform(0.25, 0.9), pick(rng, WOODS + PAINTS + WALLS))]


def table(rng) -> list[Block]:
    w, h, d, thick, colour = rng.uniform(0.6, 2.0), rng.uniform(0.4, 0.78), rng.uniform(0.5, 1.0), rng.uniform(0.03, 0.07), pick(rng, WOODS + PAINTS)
    legs = [(x, 0, z, thick, h, thick, colour * 0.85) for x in (0, w - thick) for z in (0, d - thick)]
    return [*legs, (0, h, 0, w, thick, d, colour), *load(rng, w, h + thick, d)]


def load(rng, w: float, h: float, d: float) -> list[Block]:
    """What lies and stands on something."""
    place = lambda: (rng.uniform(0, 0.8) * w, h, rng.uniform(0, 0.7) * d)
    return [(*place(), rng.uniform(0.06, 0.4), rng.uniform(0.03, 0.4), rng.uniform(0.05, 0.2), pick(rng, PAINTS + WOODS)) for _ in range(int(rng.integers(0, 5)))]


def chair(rng) -> list[Block]:
    w, h, d, colour = rng.uniform(0.38, 0.5), rng.uniform(0.4, 0.48), rng.uniform(0.38, 0.5), pick(rng, WOODS + PAINTS)
    seat = pick(rng, PAINTS) if rng.random() < 0.5 else colour
    back = (0, h, d if rng.random() < 0.5 else 0, w, rng.uniform(0.35, 0.6), 0.04, seat)
    return [*((x, 0, z, 0.035, h, 0.035, colour * 0.8) for x in (0, w - 0.035) for z in (0, d - 0.035)), (0, h, 0, w, 0.05, d, seat), back]


def bed(rng) -> list[Block]:
    w, d, wood, cloth = rng.uniform(0.9, 1.8), rng.uniform(1.6, 2.1), pick(rng, WOODS + PAINTS[:4]), pick(rng, PAINTS + WALLS, 30)
    pillow, board = (0.1, 0.3, d * 0.75, w - 0.2, 0.2, d * 0.22, pick(rng, PAINTS[:4])), (0, 0, d, w, rng.uniform(0.6, 1.2), 0.05, wood)
    return [(0, 0, 0, w, 0.3, d, wood), (0, 0.3, 0, w, 0.22, d * 0.75, cloth), pillow, board]


def sofa(rng) -> list[Block]:
    w, d, cloth = rng.uniform(0.8, 2.2), rng.uniform(0.7, 0.95), pick(rng, PAINTS + WALLS, 24)
    return [(0, 0, 0, w, 0.42, d, cloth), (0, 0.42, d - 0.2, w, 0.4, 0.2, cloth * 0.95), (0, 0.42, 0, 0.18, 0.18, d, cloth), (w - 0.18, 0.42, 0, 0.18, 0.18, d, cloth)]


def worktop(rng) -> list[Block]:
    w, d, front, top = rng.uniform(0.8, 2.4), rng.uniform(0.55, 0.7), pick(rng, WOODS + PAINTS), pick(rng, WOODS + PAINTS)
    doors, wide = [], rng.uniform(0.4, 0.6)
    for x in numpy.arange(0, w - wide / 2, wide):
        doors.append((x + 0.02, 0.1, -0.01, min(wide, w - x) - 0.04, 0.68, 0.01, front * rng.uniform(0.94, 1.06)))
        doors.append((x + wide * 0.7, 0.66, -0.03, 0.1, 0.02, 0.02, pick(rng, [(60, 60, 64), (200, 200, 204)])))
    return [(0, 0, 0, w, 0.84, d, front * 0.8), *doors, (0, 0.84, -0.02, w, 0.04, d + 0.02, top), *load(rng, w, 0.88, d)]


def basin(rng) -> list[Block]:
    white = pick(rng, PAINTS[:4], 6)
    foot, bowl, hollow = (0.2, 0, 0.1, 0.2, 0.7, 0.2, white * 0.9), (0, 0.7, 0, 0.6, 0.16, 0.45, white), (0.08, 0.85, 0.06, 0.44, 0.011, 0.3, white * 0.7)
    return [foot, bowl, hollow, (0.27, 0.86, 0.36, 0.05, 0.12, 0.04, pick(rng, [(200, 200, 204)]))]


def screen(rng) -> list[Block]:
    w, h = rng.uniform(0.4, 1.2), rng.uniform(0.3, 0.7)
    return [(0, rng.uniform(0.5, 0.9), 0, w, h, 0.05, pick(rng, [(24, 24, 28)])), (0, 0, 0.05, w, 0.5, 0.4, pick(rng, WOODS + PAINTS))]


def steps(rng) -> list[Block]:
    w, stone, count = rng.uniform(1.0, 2.4), pick(rng, WALLS + [(120, 116, 110)]), int(rng.integers(1, 5))
    return [(0, 0, 0.3 * k, w, 0.17 * (k + 1), 0.3 * (count - k), stone * rng.uniform(0.9, 1.1)) for k in range(count)]


def railing(rng) -> list[Block]:
    w, h, colour = rng.uniform(1.0, 3.0), rng.uniform(0.8, 1.2), pick(rng, PAINTS + WOODS)
    bars = [(x, 0, 0, 0.03, h, 0.03, colour) for x in numpy.arange(0, w, rng.uniform(0.1, 0.3))]
    return [*bars, (0, h, 0, w, 0.05, 0.04, colour), (0, 0.15, 0, w, 0.04, 0.03, colour)]


INSIDE, OUTSIDE = [boxes, boxes, table, chair, chair, bed, sofa, worktop, worktop, basin, screen], [boxes, steps, railing, railing, table, chair]


def stand(rng, canvas: Image.Image, camera, room, count: int, near: float) -> None:
    """Puts some of it on the floor, what is far first."""
    pieces = []
    for _ in range(count):
        make = (OUTSIDE if room.outside else INSIDE)[rng.integers(len(OUTSIDE if room.outside else INSIDE))]
        blocks = make(rng)
        wide, deep = max(b[0] + b[3] for b in blocks), max(b[2] + b[5] for b in blocks)
        x, z = rng.uniform(room.left, max(room.left + 0.1, room.right - wide)), rng.uniform(room.behind, max(room.behind + 0.1, room.ahead - deep))
        if math.hypot(x + wide / 2 - camera.eye[0], z + deep / 2 - camera.eye[2]) > 0.9 + wide / 2:
            turn = rng.integers(4)
            pieces += [turned(block, turn, x, z) for block in blocks]
    draw = ImageDraw.Draw(canvas)
    light = rng.uniform(0.6, 1.0, 3)
    for x, y, z, w, h, d, colour in sorted(pieces, key=lambda b: -math.dist((b[0] + b[3] / 2, b[1] + b[4] / 2, b[2] + b[5] / 2), camera.eye)):
        at = lambda i, j, k: (x + i * w, y + j * h, z + k * d)
        faces = [([at(i, 0, 0), at(i, 1, 0), at(i, 1, 1), at(i, 0, 1)], light[0]) for i in ((0,) if camera.eye[0] < x else (1,) if camera.eye[0] > x + w else ())]
        faces += [([at(0, j, 0), at(1, j, 0), at(1, j, 1), at(0, j, 1)], 1.1 * light[1]) for j in ((0,) if camera.eye[1] < y else (1,) if camera.eye[1] > y + h else ())]
        faces += [([at(0, 0, k), at(1, 0, k), at(1, 1, k), at(0, 1, k)], light[2]) for k in ((0,) if camera.eye[2] < z else (1,) if camera.eye[2] > z + d else ())]
        for points, lit in faces:
            if camera.seen(points)[:, 2].min() > near:
                draw.polygon([tuple(q) for q in camera.pixels(points)], fill=textures.tone(colour, lit))


def turned(block: Block, turn: int, x: float, z: float) -> Block:
    """By quarters."""
    left, foot, near, w, h, d, colour = block
    if turn % 2:
        left, near, w, d = near, left, d, w
    if turn >= 2:
        left, near = -left - w, -near - d
    return x + left, foot, z + near, w, h, d, colour
