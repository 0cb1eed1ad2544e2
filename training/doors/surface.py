"""A flat picture that knows its size in metres and what lies on it, and the colours and grain that it is painted with."""

from __future__ import annotations

import dataclasses

import numpy

PIXELS_A_METRE = 72

WOODS = [(96, 62, 36), (130, 86, 48), (158, 112, 66), (184, 142, 94), (72, 44, 28), (110, 52, 30), (146, 98, 70), (206, 172, 126)]
PAINTS = [(238, 236, 230), (226, 222, 210), (246, 246, 246), (200, 204, 206), (40, 66, 104), (30, 84, 60), (132, 30, 30), (58, 58, 62), (24, 24, 28), (90, 120, 150),
          (170, 60, 44), (210, 180, 60), (120, 140, 120), (70, 110, 120), (160, 160, 150), (104, 88, 120), (44, 120, 130), (222, 210, 180)]
WALLS = [(232, 228, 220), (216, 206, 188), (240, 240, 238), (200, 196, 190), (222, 200, 160), (180, 190, 196), (206, 216, 200), (176, 150, 128), (150, 156, 160), (228, 214, 206),
         (190, 120, 90), (120, 110, 104), (246, 236, 210), (160, 180, 204)]


@dataclasses.dataclass
class Thing:
    """A rectangle of a surface, in metres from its lower left corner."""
    kind: str  # "door" or "cupboard"
    left: float
    bottom: float
    width: float
    height: float


class Surface:
    def __init__(self, rng: numpy.random.Generator, width: float, height: float, scale: float = PIXELS_A_METRE):
        self.rng, self.width, self.height, self.scale = rng, width, height, scale
        self.pixels = numpy.empty((max(8, round(height * scale)), max(8, round(width * scale)), 3), numpy.float32)
        self.things: list[Thing] = []

    def part(self, left: float, bottom: float, width: float, height: float) -> numpy.ndarray:
        rows, columns = self.pixels.shape[:2]
        at = lambda metres, most: int(min(max(round(metres * self.scale), 0), most))
        return self.pixels[at(self.height - bottom - height, rows):at(self.height - bottom, rows), at(left, columns):at(left + width, columns)]

    def fill(self, left: float, bottom: float, width: float, height: float, colour) -> None:
        self.part(left, bottom, width, height)[...] = colour

    def rim(self, left: float, bottom: float, width: float, height: float, thick: float, colour) -> None:
        """A frame inside the rectangle."""
        self.fill(left, bottom, thick, height, colour)
        self.fill(left + width - thick, bottom, thick, height, colour)
        self.fill(left, bottom, width, thick, colour)
        self.fill(left, bottom + height - thick, width, thick, colour)

    def relief(self, left: float, bottom: float, width: float, height: float, depth: float, colour) -> None:
        """A field that is sunk in or stands out: lit from above and the left, or the other way round."""
        line = 1.3 / self.scale
        light, dark = numpy.asarray(colour) * (1 + depth), numpy.asarray(colour) * (1 - depth)
        self.fill(left, bottom, line, height, dark)
        self.fill(left, bottom + height - line, width, line, dark)
        self.fill(left + width - line, bottom, line, height, light)
        self.fill(left, bottom, width, line, light)

    def shade(self, left: float, bottom: float, width: float, height: float, factor: float) -> None:
        self.part(left, bottom, width, height)[...] *= factor


def pick(rng, colours, spread: float = 14.0) -> numpy.ndarray:
    return numpy.clip(numpy.asarray(colours[rng.integers(len(colours))]) + rng.normal(0, spread, 3) + rng.normal(0, spread), 4, 252).astype(numpy.float32)


def grain(rng, part: numpy.ndarray, strength: float, along: str = "y") -> None:
    """Wood: streaks along one direction."""
    rows, columns = part.shape[:2]
    if rows < 2 or columns < 2:
        return
    if along == "y":
        streaks = numpy.repeat(numpy.cumsum(rng.normal(0, 1, (rows // 24 + 2, columns)), 0), 24, 0)[:rows]
    else:
        streaks = numpy.repeat(numpy.cumsum(rng.normal(0, 1, (rows, columns // 24 + 2)), 1), 24, 1)[:, :columns]
    part *= (1 + strength * numpy.tanh(streaks / 2))[..., None].astype(numpy.float32)


def blotches(rng, part: numpy.ndarray, strength: float, cells: int = 6) -> None:
    """Light and wear: smooth in two directions."""
    rows, columns = part.shape[:2]
    if rows < 2 or columns < 2:
        return
    coarse = rng.normal(0, strength, (cells, cells))
    y, x = numpy.linspace(0, cells - 1.001, rows), numpy.linspace(0, cells - 1.001, columns)
    top, left = y.astype(int), x.astype(int)
    fy, fx = (y - top)[:, None], (x - left)[None]
    smooth = (coarse[top][:, left] * (1 - fx) + coarse[top][:, left + 1] * fx) * (1 - fy) + (coarse[top + 1][:, left] * (1 - fx) + coarse[top + 1][:, left + 1] * fx) * fy
    part *= (1 + smooth)[..., None].astype(numpy.float32)
