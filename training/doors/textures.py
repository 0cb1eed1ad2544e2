"""What makes a drawn surface look less drawn: grain at every scale, stone, scribbles, leaves, light that falls unevenly."""

from __future__ import annotations

import math

import numpy
from PIL import Image, ImageDraw


def fractal(rng: numpy.random.Generator, rows: int, columns: int, cells: float, octaves: int = 4, fall: float = 0.6) -> numpy.ndarray:
    """Noise about 0, of a spread of about 1: `cells` coarse patches along the longer side, then ever finer and fainter ones."""
    out, weight, total = numpy.zeros((rows, columns), numpy.float32), 1.0, 0.0
    for octave in range(octaves):
        step = max(rows, columns) / (cells * 2**octave)
        if step < 1.5:
            break
        coarse = rng.normal(0, 1, (max(2, math.ceil(rows / step) + 1), max(2, math.ceil(columns / step) + 1))).astype(numpy.float32)
        out += weight * numpy.asarray(Image.fromarray(coarse).resize((columns, rows), Image.Resampling.BICUBIC))
        total += weight**2
        weight *= fall
    return out / max(total, 1e-6) ** 0.5


def rough(rng, part: numpy.ndarray, strength: float, cells: float = 12, octaves: int = 5) -> None:
    """Lighter and darker at every scale, and a little of other colours."""
    rows, columns = part.shape[:2]
    if rows < 3 or columns < 3:
        return
    part *= (1 + strength * fractal(rng, rows, columns, cells, octaves, 0.75))[..., None]
    if rng.random() < 0.3:
        part += (rng.normal(0, 60, 3) * strength)[None, None].astype(numpy.float32) * fractal(rng, rows, columns, cells / 2, 2)[..., None]


def stones(rng, part: numpy.ndarray, scale: float) -> None:
    """Courses of blocks that differ in length and tone."""
    rows, columns = part.shape[:2]
    joint, line = part.reshape(-1, 3).mean(0) * rng.uniform(0.55, 1.2), max(1, round(0.012 * scale))
    row, height = 0, rng.uniform(0.14, 0.4)
    while row < rows:
        tall = max(4, round(height * scale * rng.uniform(0.85, 1.15)))
        column = -round(rng.uniform(0, 0.5) * scale)
        while column < columns:
            wide = max(5, round(height * scale * rng.uniform(0.8, 2.6)))
            block = part[row:row + tall, max(column, 0):max(column + wide, 0)]
            block *= rng.uniform(0.78, 1.15)
            block *= 1 + rng.normal(0, 0.03, 3).astype(numpy.float32)
            part[row:row + tall, max(column, 0):max(column + line, 0)] = joint
            column += wide
        part[row:row + line] = joint
        row += tall
    rough(rng, part, rng.uniform(0.05, 0.14), 20)


def drawn_on(part: numpy.ndarray, draw_it) -> None:
    """Lets `draw_it(draw, width, height)` draw on pixels that are numbers."""
    if part.shape[0] < 3 or part.shape[1] < 3:
        return
    image = Image.fromarray(numpy.clip(part, 0, 255).astype(numpy.uint8))
    draw_it(ImageDraw.Draw(image), image.width, image.height)
    part[...] = numpy.asarray(image)


def tone(colour, light: float = 1.0) -> tuple[int, ...]:
    return tuple(int(v) for v in numpy.clip(numpy.asarray(colour) * light, 0, 255))


def scribbles(rng, part: numpy.ndarray, colour, count: int) -> None:
    def draw_it(draw, width, height):
        for _ in range(count):
            x, y = rng.uniform(0, width), rng.uniform(0, height)
            reach = rng.uniform(0.04, 0.15) * max(width, height)
            points = [(x + dx, y + dy) for dx, dy in numpy.cumsum(rng.normal(0, reach / 2.5, (int(rng.integers(3, 9)), 2)), 0)]
            draw.line(points, fill=tone(colour, rng.uniform(0.7, 1.3)), width=int(rng.integers(1, 4)))
    drawn_on(part, draw_it)


def leaves(rng, draw: ImageDraw.ImageDraw, x: float, y: float, reach: float, count: int, colours, size: float) -> None:
    """A bush, a pot plant, ivy: many spots about a place, the light ones on top."""
    base = numpy.asarray(colours[rng.integers(len(colours))]) + rng.normal(0, 14, 3)
    light = numpy.sort(rng.uniform(0.35, 1.5, count))
    at = rng.normal(0, reach / 2, (count, 2))
    for (dx, dy), lit in zip(at, light, strict=True):
        w, h = size * rng.uniform(0.5, 1.6), size * rng.uniform(0.5, 1.6)
        draw.ellipse([x + dx - w, y + dy - h, x + dx + w, y + dy + h], fill=tone(base, lit))


def shaded_corners(rng, pixels: numpy.ndarray) -> None:
    """Less light gets to where walls meet floor, ceiling and each other."""
    rows, columns = pixels.shape[:2]
    y, x = numpy.linspace(0, 1, rows, dtype=numpy.float32)[:, None], numpy.linspace(0, 1, columns, dtype=numpy.float32)[None]
    fall = lambda at, depth, reach: 1 - depth * numpy.exp(-at / reach)
    deep = rng.uniform(0.0, 0.4, 4)
    light = fall(y, deep[0], 0.08) * fall(1 - y, deep[1], 0.06) * fall(x, deep[2], 0.05) * fall(1 - x, deep[3], 0.05)
    pixels *= light[..., None]


def sunlit(rng, canvas: Image.Image) -> Image.Image:
    """Shadows with edges, or patches of sun: a few polygons, some of them like branches."""
    width, height = canvas.size
    mask = Image.new("L", (width, height), 0)
    draw = ImageDraw.Draw(mask)
    for _ in range(int(rng.integers(1, 4))):
        if rng.random() < 0.5:
            x, lean, wide = rng.uniform(-0.3, 1.1) * width, rng.normal(0, 0.5) * height, rng.uniform(0.05, 0.6) * width
            top, bottom = sorted(rng.uniform(-0.2, 1.2, 2) * height)
            draw.polygon([(x, top), (x + wide, top), (x + wide + lean, bottom), (x + lean, bottom)], fill=int(rng.integers(120, 256)))
        else:
            leaves(rng, draw_grey(draw), rng.uniform(0, width), rng.uniform(0, height), rng.uniform(0.1, 0.4) * height, 60, [(200, 200, 200)], rng.uniform(0.01, 0.04) * height)
    light = numpy.asarray(mask.resize((width // 3 + 1, height // 3 + 1)).resize((width, height), Image.Resampling.BILINEAR), numpy.float32)[..., None] / 255
    factor = rng.uniform(0.3, 0.75) if rng.random() < 0.6 else rng.uniform(1.2, 1.8)
    return Image.fromarray(numpy.clip(numpy.asarray(canvas, numpy.float32) * (1 + (factor - 1) * light), 0, 255).astype(numpy.uint8))


class draw_grey:
    """Draws with the brightness of a colour alone."""

    def __init__(self, draw: ImageDraw.ImageDraw):
        self.draw = draw

    def ellipse(self, box, fill):
        self.draw.ellipse(box, fill=fill[0])


class Beyond:
    """Pictures without doors to be seen through glass, in mirrors, in frames on walls and behind open doors; and what stands in the way is cut out of them."""

    def __init__(self, pictures: list[numpy.ndarray]):
        self.pictures = [Image.fromarray(picture) for picture in pictures]

    def part(self, rng, rows: int, columns: int) -> numpy.ndarray | None:
        """A part of one of them of this size, or nothing where there are none."""
        if not self.pictures or rows < 3 or columns < 3:
            return None
        image = self.pictures[rng.integers(len(self.pictures))]
        share = rng.uniform(0.25, 1.0)
        wide = min(image.width, max(4, round(share * image.width)))
        high = min(image.height, max(4, round(wide * rows / columns))) if rng.random() < 0.7 else max(4, round(share * image.height))
        x, y = rng.integers(0, image.width - wide + 1), rng.integers(0, image.height - high + 1)
        if rng.random() < 0.5:
            image = image.transpose(Image.Transpose.FLIP_LEFT_RIGHT)
        return numpy.asarray(image.resize((columns, rows), Image.Resampling.BILINEAR, (x, y, x + wide, y + high)), numpy.float32)

    def fill(self, rng, part: numpy.ndarray, chance: float, clear: float = 1.0) -> bool:
        """Shows a part of one in place of what is there, `clear` to so much."""
        seen = self.part(rng, *part.shape[:2]) if rng.random() < chance else None
        if seen is not None:
            part += (seen * rng.uniform(0.5, 1.2) - part) * clear
        return seen is not None

    def grain(self, rng, part: numpy.ndarray, strength: float) -> None:
        """Its light and shade as a pattern."""
        seen = self.part(rng, *part.shape[:2])
        if seen is not None:
            grey = seen.mean(2, keepdims=True)
            part *= 1 + strength * (grey - grey.mean()) / max(float(grey.std()), 12.0)

    def obstacle(self, rng, canvas: Image.Image) -> None:
        """Something with a bowed outline right before the camera."""
        width, height = canvas.size
        columns, rows = (int(n) for n in rng.uniform(0.08, 0.5, 2) * [width, height])
        seen = self.part(rng, rows, columns)
        if seen is None:
            return
        mask = Image.new("L", (columns, rows), 0)
        angle = numpy.sort(rng.uniform(0, 2 * math.pi, int(rng.integers(5, 16))))
        far = rng.uniform(0.55, 1.0, len(angle))
        outline = [(columns / 2 * (1 + r * math.cos(a)), rows / 2 * (1 + r * math.sin(a))) for a, r in zip(angle, far, strict=True)]
        ImageDraw.Draw(mask).polygon(outline, fill=255)
        canvas.paste(Image.fromarray(seen.astype(numpy.uint8)), (int(rng.uniform(-0.2, 1.0) * width), int(rng.uniform(0.1, 1.0) * height)), mask)


BEYOND = Beyond([])  # what scenes.rendered was given
