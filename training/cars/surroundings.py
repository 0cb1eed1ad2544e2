"""What lies round vehicles and is none: houses with what stands on their roofs, streets with their paint, beds, steps, buses, people and lamp posts.

Most of it is as large as a vehicle, and as bright or as dark, on purpose: a network that has seen only car parks takes a skylight or a flower bed for a car.
Lengths are metres on the ground; `view` makes pixels of them.
"""

from __future__ import annotations

import dataclasses
import math

import numpy
from PIL import Image, ImageDraw, ImageFilter

TILES = [(150, 70, 50), (175, 90, 65), (120, 60, 50), (90, 85, 82), (130, 128, 125), (190, 188, 184), (215, 214, 210), (70, 72, 76), (160, 145, 120)]
SOILS = [(60, 50, 42), (85, 72, 58), (55, 75, 40), (80, 100, 50), (40, 55, 32), (120, 110, 90), (38, 38, 40), (150, 150, 146), (205, 203, 198)]
FREE = 5.6  # no vehicle is this near to where a house stands


def turned(x: float, y: float, length: float, width: float, turn: float, z: float = 0.0) -> numpy.ndarray:
    """A rectangle's corners, at a height."""
    c, s = math.cos(turn), math.sin(turn)
    return numpy.array([(x + c * a * length - s * b * width, y + s * a * length + c * b * width, z) for a, b in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))])


def tint(rng: numpy.random.Generator, colours, spread: float = 12.0) -> numpy.ndarray:
    return numpy.clip(numpy.array(colours[rng.integers(len(colours))], float) + rng.normal(0, spread / 2, 3) + rng.normal(0, spread), 5, 250)


def toned(colour, factor: float = 1.0) -> tuple[int, ...]:
    return tuple(int(v) for v in numpy.clip(numpy.asarray(colour, float) * factor, 0, 255))


class Brush:
    """Polygons and lines that are given in metres."""

    def __init__(self, canvas: Image.Image, view):
        self.draw, self.view = ImageDraw.Draw(canvas), view

    def area(self, points: numpy.ndarray, fill, outline=None) -> None:
        self.draw.polygon([tuple(p) for p in self.view(points)], fill=fill, outline=outline)

    def stroke(self, points: numpy.ndarray, fill, width: float) -> None:
        self.draw.line([tuple(p) for p in self.view(points)], fill=fill, width=max(1, round(width * self.view.scale)))


@dataclasses.dataclass
class House:
    x: float
    y: float
    length: float
    width: float
    turn: float
    height: float

    def outline(self, z: float) -> numpy.ndarray:
        return turned(self.x, self.y, self.length, self.width, self.turn, z)

    def is_near(self, x: float, y: float) -> bool:
        c, s = math.cos(self.turn), math.sin(self.turn)
        along, across = c * (x - self.x) + s * (y - self.y), c * (y - self.y) - s * (x - self.x)
        return abs(along) < self.length / 2 + FREE / 2 and abs(across) < self.width / 2 + FREE / 2

    def inside(self, along: float, across: float, length: float, width: float, turn: float, z: float) -> numpy.ndarray:
        c, s = math.cos(self.turn), math.sin(self.turn)
        return turned(self.x + c * along - s * across, self.y + s * along + c * across, length, width, self.turn + turn, z)


def houses_of(rng: numpy.random.Generator) -> list[House]:
    count = rng.integers(1, 4) if rng.random() < 0.45 else 0
    turn = rng.uniform(0, math.pi)
    away = lambda: rng.uniform(6, 24) * rng.choice([-1, 1])
    return [House(away(), away(), rng.uniform(8, 34), rng.uniform(6, 18), turn + rng.choice([0, math.pi / 2]) + rng.normal(0, 0.03), rng.choice([rng.uniform(2.5, 4.5), rng.uniform(4, 14)]))
            for _ in range(count)]


def upon_roof(rng: numpy.random.Generator, brush: Brush, house: House, base: numpy.ndarray) -> None:
    """Skylights, dormers, boxes that blow air, panels: many of them as large as cars, often in a row."""
    for _ in range(rng.integers(1, 5)):
        length, width, high = rng.uniform(0.6, 5.5), rng.uniform(0.6, 2.6), rng.choice([0.05, rng.uniform(0.2, 2.2)])
        colour = tint(rng, [(240, 240, 240), (205, 205, 205), (150, 152, 155), (60, 62, 66), (35, 45, 70), (90, 110, 140), toned(base, 0.7), toned(base, 1.3)])
        turn = rng.choice([0.0, math.pi / 2])
        count, gap = (rng.integers(2, 12), max(length, width) * rng.uniform(1.05, 2.0)) if rng.random() < 0.5 else (1, 0.0)
        begin, across = rng.uniform(-0.45, 0.45) * house.length, rng.uniform(-0.42, 0.42) * house.width
        framed, striped = rng.random() < 0.4, rng.random() < 0.25
        for k in range(count):
            along = begin + k * gap
            if along > house.length / 2 - 0.5:
                break
            for step in numpy.linspace(0, high, 4):
                brush.area(house.inside(along, across, length, width, turn, house.height + step), toned(colour, 0.6))
            top = house.height + high
            brush.area(house.inside(along, across, length, width, turn, top), toned(colour, rng.uniform(0.95, 1.05)), toned(colour, 0.6) if rng.random() < 0.4 else None)
            if framed:
                brush.area(house.inside(along, across, 0.8 * length, 0.75 * width, turn, top), toned(colour, 0.45 if colour.mean() > 90 else 1.8))
            if striped:
                for part in numpy.linspace(-0.4, 0.4, 6):
                    brush.area(house.inside(along + (part * length if turn == 0 else 0), across + (part * length if turn else 0), 0.07 * length, width, turn, top), toned(colour, 0.7))


def draw_houses(rng: numpy.random.Generator, canvas: Image.Image, covered: Image.Image, view, houses: list[House]) -> None:
    brush, mask = Brush(canvas, view), Brush(covered, view)
    for house in houses:
        base = tint(rng, TILES)
        wall = tint(rng, [(200, 195, 185), (150, 145, 140), (110, 70, 60), (225, 222, 215)])
        for z in numpy.linspace(0, house.height, 40):  # the walls that are seen; windows are their darker storeys
            brush.area(house.outline(z), toned(wall, 0.45 if z % 3 > 1.3 and z % 3 < 2.3 else 0.75))
            mask.area(house.outline(z), 0)
        if rng.random() < 0.5:  # a ridge: one side is lit
            lit = rng.uniform(1.0, 1.3)
            for side, factor in ((-1, lit), (1, 2 - lit)):
                brush.area(house.inside(0, side * house.width / 4, house.length, house.width / 2, 0, house.height), toned(base, factor))
        else:
            brush.area(house.outline(house.height), toned(base), toned(base, rng.choice([0.6, 1.5])))
            edge = rng.uniform(0.2, 0.6)
            brush.area(house.inside(0, 0, house.length - edge, house.width - edge, 0, house.height), toned(base, rng.uniform(0.85, 1.15)))
        if rng.random() < 0.6:
            pitch = rng.uniform(0.3, 2.5)
            for across in numpy.arange(-house.width / 2, house.width / 2, pitch):
                brush.area(house.inside(0, across, house.length, 0.06, 0, house.height), toned(base, rng.uniform(0.8, 0.95)))
        upon_roof(rng, brush, house, base)


def shadow_of(house: House, sun: numpy.ndarray) -> list[numpy.ndarray]:
    return [numpy.concatenate([house.outline(0)[:, :2] + z * sun, numpy.zeros((4, 1))], 1) for z in numpy.linspace(0, house.height, 24)]


def street_paint(rng: numpy.random.Generator, canvas: Image.Image, view) -> None:
    """Crossings, dashes, arrows, letters, hatched and coloured areas, somewhere on the ground."""
    mask = Image.new("L", canvas.size, 0)
    brush, colours = Brush(mask, view), Brush(canvas, view)
    turn = rng.uniform(0, math.pi)
    way, side = numpy.array([math.cos(turn), math.sin(turn), 0]), numpy.array([-math.sin(turn), math.cos(turn), 0])
    for _ in range(rng.integers(0, 3)):
        at = numpy.array([*rng.uniform(-18, 18, 2), 0.0])
        what = rng.integers(6)
        if what == 0:  # a crossing
            pitch, wide, long = rng.uniform(0.8, 1.3), rng.uniform(0.35, 0.6), rng.uniform(2.0, 4.5)
            for k in range(rng.integers(5, 22)):
                brush.area(turned(*(at + way * k * pitch)[:2], wide, long, turn), 255)
        elif what == 1:  # lanes
            for lane in range(rng.integers(1, 5)):
                dash, gap, wide = rng.choice([rng.uniform(1, 4), 60.0]), rng.uniform(1, 6), rng.uniform(0.1, 0.3)
                for k in range(-12, 12):
                    brush.area(turned(*(at + way * k * (dash + gap) + side * lane * 3.2)[:2], dash, wide, turn), 255)
        elif what == 2:  # an arrow
            for lane in range(rng.integers(1, 4)):
                foot = at + side * lane * 3.2
                brush.stroke(numpy.array([foot, foot + way * 3.0]), 255, 0.18)
                brush.area(numpy.array([foot + way * 4.2, foot + way * 2.8 + side * 0.5, foot + way * 2.8 - side * 0.5]), 255)
        elif what == 3:  # hatched
            long, wide = rng.uniform(4, 14), rng.uniform(1.8, 5)
            for k in numpy.arange(0, long, rng.uniform(0.6, 1.3)):
                brush.stroke(numpy.array([at + way * k, at + way * (k + 0.7 * wide) + side * wide]), 255, rng.uniform(0.1, 0.25))
            brush.draw.line([tuple(p) for p in view(turned(*(at + way * long / 2 + side * wide / 2)[:2], long + wide * 0.7, wide, turn))], fill=255, width=max(1, round(0.12 * view.scale)))
        elif what == 4:  # letters and signs
            for k in range(rng.integers(1, 4)):
                foot = at + side * k * 1.3
                for _ in range(4):
                    a, b = rng.uniform(0, 1, 2), rng.uniform(0, 1, 2)
                    brush.stroke(numpy.array([foot + way * 2.4 * a[0] + side * 0.9 * a[1], foot + way * 2.4 * b[0] + side * 0.9 * b[1]]), 255, 0.16)
        else:  # a coloured way
            colours.area(turned(*at[:2], rng.uniform(3, 40), rng.uniform(1.4, 3.2), turn), toned(tint(rng, [(60, 160, 80), (40, 70, 60), (170, 70, 60), (70, 110, 170), (200, 180, 80)])))
    left = rng.uniform(0.5, 1.0)
    canvas.paste(Image.new("RGB", canvas.size, toned(tint(rng, [(238, 238, 236), (222, 222, 218), (215, 180, 80)]))), (0, 0), mask.point(lambda v: v * left))


def beds(rng: numpy.random.Generator, canvas: Image.Image, view) -> None:
    """Flat and as large as vehicles, or larger: mended asphalt, plates, beds with kerbs, gratings, steps."""
    brush = Brush(canvas, view)
    turn = rng.uniform(0, math.pi)
    for _ in range(rng.integers(0, 9)):
        x, y = rng.uniform(-22, 22, 2)
        length, width = rng.uniform(1.5, 8), rng.uniform(0.8, 3)
        way = turn + rng.choice([0, math.pi / 2]) + (rng.normal(0, 0.3) if rng.random() < 0.3 else 0)
        colour, kerb = tint(rng, SOILS, 16), rng.uniform(0.08, 0.3)
        if rng.random() < 0.5:
            brush.area(turned(x, y, length + 2 * kerb, width + 2 * kerb, way), toned(tint(rng, [(200, 198, 192), (160, 158, 150), (210, 190, 110), (90, 90, 90)])))
        brush.area(turned(x, y, length, width, way), toned(colour))
        what = rng.random()
        if what < 0.25:  # steps or a grating
            for part in numpy.arange(-0.48, 0.5, rng.uniform(0.04, 0.12)):
                c, s = math.cos(way), math.sin(way)
                brush.area(turned(x + c * part * length, y + s * part * length, rng.uniform(0.05, 0.2), width, way), toned(colour, rng.choice([0.6, 1.35])))
        elif what < 0.6:  # what grows there
            for _ in range(30):
                c, s, a, b = math.cos(way), math.sin(way), rng.uniform(-0.5, 0.5) * length, rng.uniform(-0.5, 0.5) * width
                at = view(numpy.array([[x + c * a - s * b, y + s * a + c * b, 0.3]]))[0]
                r = rng.uniform(0.08, 0.45) * view.scale
                brush.draw.ellipse([at[0] - r, at[1] - r, at[0] + r, at[1] + r], fill=toned(colour, rng.uniform(0.6, 1.5)))


def posts_of(rng: numpy.random.Generator) -> list[tuple[numpy.ndarray, float, float]]:
    """People, bollards, lamp posts: place, height and thickness."""
    people = [(rng.uniform(-22, 22, 2), rng.uniform(0.9, 1.9), rng.uniform(0.3, 0.6)) for _ in range(rng.integers(0, 10) if rng.random() < 0.5 else 0)]
    return people + [(rng.uniform(-22, 22, 2), rng.uniform(4, 10), rng.uniform(0.1, 0.25)) for _ in range(rng.integers(0, 4) if rng.random() < 0.5 else 0)]


def draw_posts(rng: numpy.random.Generator, canvas: Image.Image, view, posts) -> None:
    brush = Brush(canvas, view)
    for at, height, thick in posts:
        colour = tint(rng, [(30, 30, 35), (160, 160, 160), (220, 220, 220), (150, 40, 40), (50, 70, 130)])
        brush.stroke(numpy.array([(*at, 0.0), (*at, height)]), toned(colour, 0.8), thick)
        top = view(numpy.array([(*at, height)]))[0]
        r = 0.5 * thick * view.scale
        brush.draw.ellipse([top[0] - r, top[1] - r, top[0] + r, top[1] + r], fill=toned(colour))


def street_of(rng: numpy.random.Generator) -> tuple[list[tuple[float, float, float]], numpy.ndarray]:
    """Vehicles on their way or at the kerb (x, y, heading), and the turn and offsets of a street's two edges."""
    turn, half = rng.uniform(0, 2 * math.pi), rng.uniform(3.5, 9)
    c, s = math.cos(turn), math.sin(turn)
    places = []
    for lane in numpy.arange(-half + 1.3, half - 1, rng.uniform(2.4, 3.6)):
        often, at = rng.uniform(0.1, 0.9), -30.0
        while at < 30:
            at += rng.uniform(5.2, 6.4) if rng.random() < often else rng.uniform(7, 20)
            side = lane + rng.normal(0, 0.15)
            places.append((c * at - s * side, s * at + c * side, turn + (math.pi if lane < 0 else 0) + rng.normal(0, 0.03)))
    return places, numpy.array([turn, half])


def draw_street(rng: numpy.random.Generator, canvas: Image.Image, view, edges: numpy.ndarray) -> None:
    """The walks on either side, and their kerbs."""
    brush, (turn, half) = Brush(canvas, view), edges
    c, s = math.cos(turn), math.sin(turn)
    for side in (-1, 1):
        wide = rng.uniform(1.5, 5)
        for offset, width, colour in ((half + 14, 28.0, tint(rng, [(90, 105, 60), (150, 150, 145), (190, 188, 180), (110, 100, 85)])),
                                      (half + wide / 2, wide, tint(rng, [(170, 168, 162), (200, 198, 192), (140, 120, 110)])), (half, 0.2, tint(rng, [(210, 208, 204), (120, 120, 118)]))):
            brush.area(turned(-s * side * offset, c * side * offset, 80, width, turn), toned(colour))


def blurred_shadow(rng: numpy.random.Generator, canvas: Image.Image, view, outlines: list[numpy.ndarray], posts, sun: numpy.ndarray) -> Image.Image:
    """What houses and posts keep from the sun."""
    mask = Image.new("L", canvas.size, 0)
    brush = Brush(mask, view)
    for outline in outlines:
        brush.area(outline, 255)
    for at, height, thick in posts:
        brush.stroke(numpy.array([(*at, 0.0), (*(at + sun * height), 0.0)]), 255, thick)
    mask = mask.filter(ImageFilter.GaussianBlur(rng.uniform(0.5, 2.0)))
    dark = rng.uniform(0.25, 0.7)
    return Image.composite(canvas.point(lambda v: v * dark), canvas, mask)
