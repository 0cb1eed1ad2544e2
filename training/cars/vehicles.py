"""Vehicles as a few outlines at heights, drawn as a camera overhead sees them: from a little aside, with their shadows.

A body stands on the ground, its belt is where the windows begin, its roof is smaller. Whatever lies between two outlines is their hull's side, which a
camera that is not straight above sees. Lengths are metres; x is ahead, y to the left, the vehicle's middle is the origin.
"""

from __future__ import annotations

import dataclasses
import math

import numpy
from PIL import ImageDraw

PAINTS = [(232, 233, 234), (245, 245, 243), (28, 29, 31), (45, 47, 50), (120, 123, 126), (165, 168, 171), (195, 198, 200), (150, 22, 28), (110, 15, 20), (25, 50, 110),
          (40, 75, 130), (70, 105, 140), (30, 70, 60), (90, 80, 60), (170, 150, 120), (200, 180, 60), (210, 110, 40), (80, 130, 120), (90, 30, 60)]
PAINT_SHARES = numpy.array([16, 10, 14, 10, 9, 10, 9, 5, 3, 4, 4, 3, 2, 2, 3, 1, 1, 1, 1], float)
GLASS = (34, 38, 44)


@dataclasses.dataclass
class Kind:
    name: str
    share: float
    length: tuple[float, float]
    width: tuple[float, float]
    height: tuple[float, float]
    cabin: tuple[float, float]  # where the windows begin and end at the belt, 0 the tail, 1 the nose
    roof: tuple[float, float]  # and the roof


KINDS = [
    Kind("sedan", 28, (4.3, 5.0), (1.74, 1.9), (1.4, 1.5), (0.13, 0.72), (0.27, 0.56)),
    Kind("hatchback", 18, (3.6, 4.4), (1.65, 1.82), (1.42, 1.58), (0.02, 0.75), (0.1, 0.58)),
    Kind("suv", 24, (4.3, 5.1), (1.8, 2.0), (1.6, 1.85), (0.02, 0.74), (0.07, 0.58)),
    Kind("minivan", 9, (4.5, 5.2), (1.8, 2.0), (1.7, 2.0), (0.02, 0.84), (0.05, 0.68)),
    Kind("pickup", 12, (5.2, 6.1), (1.85, 2.05), (1.75, 1.95), (0.4, 0.76), (0.44, 0.63)),
    Kind("van", 9, (5.0, 6.4), (1.95, 2.1), (2.1, 2.8), (0.8, 0.92), (0.02, 0.8)),
    Kind("truck", 4, (6.0, 7.6), (2.1, 2.4), (2.8, 3.3), (0.82, 0.98), (0.84, 0.92)),
]
BUS = Kind("bus", 0, (8.5, 18.0), (2.4, 2.6), (2.7, 3.3), (0.93, 0.99), (0.005, 0.985))
BOXES = ("van", "truck", "bus")


@dataclasses.dataclass
class Vehicle:
    kind: Kind
    x: float
    y: float
    heading: float
    length: float
    width: float
    height: float
    paint: tuple[int, int, int]
    loaded: bool
    skylight: bool
    rails: bool

    def placed(self, outline: list[tuple[float, float]], z: float) -> numpy.ndarray:
        """Points of the vehicle's own frame on the ground's, at a height."""
        c, s = math.cos(self.heading), math.sin(self.heading)
        return numpy.array([(self.x + px * c - py * s, self.y + px * s + py * c, z) for px, py in outline])

    def along(self, share: float) -> float:
        return (share - 0.5) * self.length


def parked(rng: numpy.random.Generator, x: float, y: float, heading: float, kind: Kind | None = None) -> Vehicle:
    shares = numpy.array([kind.share for kind in KINDS])
    kind = kind or KINDS[rng.choice(len(KINDS), p=shares / shares.sum())]
    paint = numpy.array(PAINTS[rng.choice(len(PAINTS), p=PAINT_SHARES / PAINT_SHARES.sum())], float)
    if kind.name in BOXES and rng.random() < 0.7:
        paint = numpy.array([235.0, 236.0, 236.0])
    paint = numpy.clip(paint + rng.normal(0, 8, 3), 8, 250)
    return Vehicle(kind, x, y, heading, rng.uniform(*kind.length), rng.uniform(*kind.width), rng.uniform(*kind.height), tuple(paint), bool(rng.random() < 0.4),
                   bool(rng.random() < 0.3), bool(rng.random() < 0.3))


def rounded(x0: float, x1: float, half: float, nose: float, tail: float) -> list[tuple[float, float]]:
    """A rectangle whose corners are cut: by `nose` ahead, by `tail` behind."""
    return [(x1, -half + nose), (x1, half - nose), (x1 - 0.8 * nose, half - 0.25 * nose), (x1 - 2.2 * nose, half), (x0 + 1.6 * tail, half), (x0 + 0.5 * tail, half - 0.3 * tail),
            (x0, half - tail), (x0, -half + tail), (x0 + 0.5 * tail, -half + 0.3 * tail), (x0 + 1.6 * tail, -half), (x1 - 2.2 * nose, -half), (x1 - 0.8 * nose, -half + 0.25 * nose)]


def body(vehicle: Vehicle) -> list[tuple[float, float]]:
    box = vehicle.kind.name in BOXES
    return rounded(-vehicle.length / 2, vehicle.length / 2, vehicle.width / 2, 0.16 if box else 0.32, 0.06 if box else 0.2)


def belt_of(vehicle: Vehicle) -> float:
    return min(0.95, 0.62 * vehicle.height) if vehicle.kind.name not in (*BOXES, "pickup") else 1.05


def roof_of(vehicle: Vehicle) -> list[tuple[float, float]]:
    tail, nose = vehicle.kind.roof
    half = 0.5 * vehicle.width * (0.92 if vehicle.kind.name in BOXES else 0.76)
    return rounded(vehicle.along(tail), vehicle.along(nose), half, 0.12, 0.1)


def tones(colour, factor: float) -> tuple[int, ...]:
    return tuple(int(c) for c in numpy.clip(numpy.asarray(colour, float) * factor, 0, 255))


def between(low: numpy.ndarray, high: numpy.ndarray, count: int = 5) -> list[numpy.ndarray]:
    return [low + (high - low) * t for t in numpy.linspace(0, 1, count)]


def silhouette(vehicle: Vehicle) -> list[numpy.ndarray]:
    """Outlines that together are what of it hides the ground and stops the sun."""
    ground, belt = vehicle.placed(body(vehicle), 0.15), vehicle.placed(body(vehicle), belt_of(vehicle))
    if vehicle.kind.name == "truck":
        half, rear = vehicle.width / 2, vehicle.along(0.78)
        load = [(-vehicle.length / 2, -half), (rear, -half), (rear, half), (-vehicle.length / 2, half)]
        return between(ground, belt) + between(vehicle.placed(load, 0.8), vehicle.placed(load, vehicle.height), 7)
    if vehicle.kind.name in ("van", "bus"):
        return between(ground, vehicle.placed(roof_of(vehicle), vehicle.height), 8) + [belt]
    cabin = vehicle.placed(rounded(vehicle.along(vehicle.kind.cabin[0]), vehicle.along(vehicle.kind.cabin[1]), 0.47 * vehicle.width, 0.2, 0.12), belt_of(vehicle))
    return between(ground, belt) + between(cabin, vehicle.placed(roof_of(vehicle), vehicle.height))


def draw(rng: numpy.random.Generator, canvas: ImageDraw.ImageDraw, vehicle: Vehicle, flat, sun_side: float) -> None:
    """`flat`: from metres on the ground and above it to the canvas."""
    put = lambda points, colour: canvas.polygon([tuple(p) for p in flat(points)], fill=colour)
    paint, kind, belt, half = vehicle.paint, vehicle.kind, belt_of(vehicle), vehicle.width / 2
    for outline in between(vehicle.placed(body(vehicle), 0.2), vehicle.placed(body(vehicle), belt)):
        put(outline, tones(paint, 0.62))
    put(vehicle.placed(body(vehicle), belt), tones(paint, rng.uniform(0.86, 0.98)))
    inner = rounded(vehicle.along(kind.cabin[1]) - 0.1, vehicle.along(0.965), 0.74 * half, 0.2, 0.05)
    put(vehicle.placed(inner, belt), tones(paint, rng.uniform(0.98, 1.1)))  # the bonnet
    for side in (-1, 1):  # mirrors and lamps
        at = vehicle.along(kind.cabin[1] - 0.05)
        put(vehicle.placed([(at, side * half), (at + 0.16, side * half), (at + 0.12, side * (half + 0.18)), (at, side * (half + 0.18))], belt), tones(paint, 0.7))
        put(vehicle.placed([(vehicle.along(0.98), side * 0.55 * half), (vehicle.along(0.99), side * 0.85 * half), (vehicle.along(0.95), side * 0.93 * half)], belt), (215, 215, 210))
        put(vehicle.placed([(vehicle.along(0.01), side * 0.6 * half), (vehicle.along(0.01), side * 0.92 * half), (vehicle.along(0.03), side * 0.95 * half)], belt), (120, 20, 20))
    if kind.name == "pickup":
        bed = [(vehicle.along(0.03), -0.78 * half), (vehicle.along(0.37), -0.78 * half), (vehicle.along(0.37), 0.78 * half), (vehicle.along(0.03), 0.78 * half)]
        put(vehicle.placed(bed, 0.7), tones(paint, 0.75) if vehicle.loaded else (45, 45, 47) if rng.random() < 0.7 else tones(paint, 0.5))
        if vehicle.loaded and rng.random() < 0.5:
            put(vehicle.placed([(vehicle.along(rng.uniform(0.05, 0.15)), -0.5 * half), (vehicle.along(rng.uniform(0.2, 0.35)), -0.5 * half), (vehicle.along(0.3), 0.6 * half)], 0.9),
                tuple(int(v) for v in rng.integers(40, 200, 3)))
    if kind.name == "truck":
        rear = vehicle.along(0.78)
        load = [(-vehicle.length / 2, -half), (rear, -half), (rear, half), (-vehicle.length / 2, half)]
        cabin = rounded(vehicle.along(0.8), vehicle.along(0.97), 0.8 * half, 0.15, 0.05)
        put(vehicle.placed(cabin, 2.0), tones(paint, 0.9))
        put(vehicle.placed([(vehicle.along(0.96), -0.75 * half), (vehicle.along(0.96), 0.75 * half), (vehicle.along(0.93), 0.7 * half), (vehicle.along(0.93), -0.7 * half)], 1.8), GLASS)
        for outline in between(vehicle.placed(load, 0.8), vehicle.placed(load, vehicle.height), 8):
            put(outline, tones(paint, 0.66))
        return put(vehicle.placed(load, vehicle.height), tones(paint, rng.uniform(0.96, 1.06)))
    cabin = vehicle.placed(rounded(vehicle.along(kind.cabin[0]), vehicle.along(kind.cabin[1]), 0.94 * half, 0.2, 0.12), belt)
    roof = vehicle.placed(roof_of(vehicle), vehicle.height)
    glass = tuple(int(v) for v in numpy.clip(numpy.array(GLASS) * rng.uniform(0.6, 1.7), 0, 255))
    if kind.name in ("van", "bus"):
        for outline in between(vehicle.placed(rounded(vehicle.along(0.01), vehicle.along(0.82), half, 0.1, 0.06), belt), roof, 8):
            put(outline, tones(paint, 0.66))
        pane = [(vehicle.along(0.81), -0.84 * half), (vehicle.along(0.81), 0.84 * half), (vehicle.along(0.9), 0.9 * half), (vehicle.along(0.9), -0.9 * half)]
        put(numpy.array([*vehicle.placed(pane[:2], vehicle.height - 0.15), *vehicle.placed(pane[2:], belt)]), glass)
    else:
        for outline in between(cabin, roof, 6):
            put(outline, glass)
        bright = tones(glass, rng.uniform(1.0, 2.4))  # the sky in the pane that faces it
        ends = (vehicle.kind.cabin[1] - 0.01, vehicle.kind.roof[1]) if math.cos(vehicle.heading - sun_side) > 0 else (vehicle.kind.cabin[0] + 0.01, vehicle.kind.roof[0])
        pane = [*vehicle.placed([(vehicle.along(ends[0]), -0.6 * half), (vehicle.along(ends[0]), 0.6 * half)], belt),
                *vehicle.placed([(vehicle.along(ends[1]), 0.55 * half), (vehicle.along(ends[1]), -0.55 * half)], vehicle.height)]
        put(numpy.array(pane), bright)
        if rng.random() < 0.8:
            for x, side in ((kind.roof[0], -1), (kind.roof[0], 1), (kind.roof[1], -1), (kind.roof[1], 1)):  # pillars
                low = vehicle.kind.cabin[0] if x == kind.roof[0] else vehicle.kind.cabin[1]
                a, b = vehicle.placed([(vehicle.along(low), side * 0.86 * half)], belt)[0], vehicle.placed([(vehicle.along(x), side * 0.7 * half)], vehicle.height)[0]
                wide = vehicle.placed([(0, 0), (0, side * 0.1)], 0)
                put(numpy.array([a, a + wide[1] - wide[0], b + wide[1] - wide[0], b]), tones(paint, 0.8))
    put(roof, tones(paint, rng.uniform(0.95, 1.08)))
    tail, nose = kind.roof
    middle = rounded(vehicle.along(tail + 0.04), vehicle.along(nose - 0.03), 0.55 * half, 0.08, 0.08)
    put(vehicle.placed(middle, vehicle.height + 0.03), tones(paint, rng.uniform(1.0, 1.12)))
    if vehicle.skylight and kind.name != "van":
        at, size = rng.uniform(tail + 0.12, nose - 0.06), rng.uniform(0.04, 0.12)
        put(vehicle.placed([(vehicle.along(at - size), -0.42 * half), (vehicle.along(at), -0.42 * half), (vehicle.along(at), 0.42 * half), (vehicle.along(at - size), 0.42 * half)],
                           vehicle.height + 0.03), glass)
    if vehicle.rails or (kind.name == "van" and rng.random() < 0.3):
        for side in (-1, 1):
            put(vehicle.placed([(vehicle.along(tail + 0.05), side * 0.6 * half), (vehicle.along(nose - 0.05), side * 0.6 * half), (vehicle.along(nose - 0.05), side * 0.66 * half),
                                (vehicle.along(tail + 0.05), side * 0.66 * half)], vehicle.height + 0.05), (50, 50, 52) if rng.random() < 0.6 else (190, 190, 190))
