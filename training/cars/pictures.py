"""Pictures with vehicles marked, at one scale: photographs of a folder with YOLO's labels, rendered car parks of a seed; and random views of both."""

from __future__ import annotations

import dataclasses
import io
import math
import pathlib

import numpy
import torch
from PIL import Image, ImageDraw, ImageFilter

import network
import scenes

SOURCE_METRES = 0.075  # a pixel of what is kept: finer than what the network sees, for views that are larger
VIEW = 192  # pixels a side of a view to learn from
UNKNOWN = 128  # of what is covered


@dataclasses.dataclass
class Picture:
    pixels: Image.Image
    covered: Image.Image  # 255 a vehicle, 0 none, UNKNOWN
    cars: numpy.ndarray  # x, y, length, width, heading, whether size and heading are known; pixels of this picture
    blank: numpy.ndarray  # left, top, right, bottom of where nothing is known
    slots: numpy.ndarray = dataclasses.field(default_factory=lambda: numpy.zeros((0, 4, 2), numpy.float32))  # corners
    taken: numpy.ndarray = dataclasses.field(default_factory=lambda: numpy.zeros(0, bool))


def rectangle(x, y, length, width, heading, grow=1.0) -> list[tuple[float, float]]:
    c, s = math.cos(heading), math.sin(heading)
    ends = [(i * length * grow / 2, j * width * grow / 2) for i, j in ((1, 1), (1, -1), (-1, -1), (-1, 1))]
    return [(x + c * a - s * b, y + s * a + c * b) for a, b in ends]


def marked(file: pathlib.Path, labels: pathlib.Path) -> list[tuple[int, float, float, float, float]]:
    """Class, and middle and size relative to the picture."""
    lines = [line.split() for line in labels.read_text().splitlines() if line.strip()]
    return [(int(float(line[0])), *(float(word) for word in line[1:5])) for line in lines if len(line) == 5]


def photograph(file: pathlib.Path, labels: pathlib.Path, squeezed: bool, cars=(0, 3)) -> Picture | None:
    """Scaled by the length of the cars in it, which is 4.6 m; `squeezed`: pictures that were made square, which the cars' shape undoes."""
    image = Image.open(file).convert("RGB")
    things = marked(file, labels)
    w, h = image.size
    boxes = numpy.array([(x * w, y * h, a * w, b * h) for kind, x, y, a, b in things if kind in cars]).reshape(-1, 4)
    whole = (boxes[:, 0] - boxes[:, 2] / 2 > 3) & (boxes[:, 1] - boxes[:, 3] / 2 > 3) & (boxes[:, 0] + boxes[:, 2] / 2 < w - 3) & (boxes[:, 1] + boxes[:, 3] / 2 < h - 3)
    straight = boxes[whole & (boxes[:, 2:].max(1) > 1.7 * boxes[:, 2:].min(1))]
    if len(straight) < 3:
        return None
    lying = numpy.median(straight[:, 2] / straight[:, 3]) > 1
    length = float(numpy.median(straight[:, 2:].max(1)))
    scale = numpy.full(2, 4.6 / SOURCE_METRES / length)
    if squeezed:
        shape = float(numpy.median(straight[:, 2:].max(1) / straight[:, 2:].min(1)))
        scale[1 if lying else 0] *= max(1.0, shape / 2.35)
    size = tuple(max(1, round(n * s)) for n, s in zip(image.size, scale, strict=True))
    covered = Image.new("L", size, 0)
    brush, told, blank = ImageDraw.Draw(covered), [], []
    for kind, x, y, a, b in things:
        x, y, a, b = x * size[0], y * size[1], a * size[0], b * size[1]
        inside = x - a / 2 > 3 and y - b / 2 > 3 and x + a / 2 < size[0] - 3 and y + b / 2 < size[1] - 3
        brush.rectangle([x - a * 0.55, y - b * 0.55, x + a * 0.55, y + b * 0.55], fill=UNKNOWN)
        if kind not in cars:
            blank.append((x - a / 2, y - b / 2, x + a / 2, y + b / 2))
            continue
        known = max(a, b) > 1.7 * min(a, b) and inside
        told.append((x, y, max(a, b), min(a, b), 0.0 if a >= b else math.pi / 2, float(known)))
    for x, y, length, width, heading, known in told:
        if known:
            brush.polygon(rectangle(x, y, length, width, heading, 0.8), fill=255)
    return Picture(image.resize(size, Image.Resampling.LANCZOS), covered, numpy.array(told, numpy.float32).reshape(-1, 6), numpy.array(blank, numpy.float32).reshape(-1, 4))


def photographs(folder: pathlib.Path, squeezed: bool) -> list[Picture]:
    """`folder` has pictures and labels of the same names, side by side or in `images` and `labels`."""
    pictures = []
    for file in sorted(folder.rglob("*")):
        labels = file.with_suffix(".txt") if file.parent.name != "images" else file.parent.parent / "labels" / (file.stem + ".txt")
        if file.suffix.lower() in (".jpg", ".png") and labels.exists():
            pictures.append(photograph(file, labels, squeezed))
    return [picture for picture in pictures if picture]


def rendered(rng: numpy.random.Generator, count: int, side: int = 520) -> list[Picture]:
    pictures = []
    for _ in range(count):
        scene = scenes.render(rng, side, SOURCE_METRES)
        cars, blank = [], []
        for x, y, length, width, heading, seen in scene.cars:
            if seen >= 0.5:
                cars.append((x, y, length, width, heading, 1.0))
            elif -length < x < side + length and -length < y < side + length:
                blank.append((x - length / 2, y - length / 2, x + length / 2, y + length / 2))
        pictures.append(Picture(Image.fromarray(scene.pixels), Image.fromarray(scene.covered), numpy.array(cars, numpy.float32).reshape(-1, 6),
                                numpy.array(blank, numpy.float32).reshape(-1, 4), scene.slots, scene.taken))
    return pictures


def view_of(picture: Picture, rng: numpy.random.Generator) -> tuple[numpy.ndarray, numpy.ndarray]:
    """A part of it, turned, scaled, mirrored; and what the network shall answer."""
    scale = SOURCE_METRES / network.METRES * math.exp(rng.uniform(-0.25, 0.25))
    stretch = math.exp(rng.normal(0, 0.05))
    turn = rng.choice([0, 0.5, 1, 1.5]) * math.pi + (rng.uniform(-0.8, 0.8) if rng.random() < 0.55 else 0.0)
    flip = -1.0 if rng.random() < 0.5 else 1.0
    if len(picture.cars) and rng.random() < 0.75:
        middle = picture.cars[rng.integers(len(picture.cars)), :2] + rng.uniform(-90, 90, 2)
    else:
        middle = rng.uniform(0, 1, 2) * picture.pixels.size
    reach = numpy.minimum(0.4 * VIEW / scale, numpy.array(picture.pixels.size) / 2)  # little of the view lies beside the picture
    middle = numpy.clip(middle, reach, numpy.array(picture.pixels.size) - reach)
    c, s = math.cos(turn), math.sin(turn)
    forward = numpy.array([[c * flip * stretch, -s * stretch], [s * flip / stretch, c / stretch]]) * scale
    back = numpy.linalg.inv(forward)
    shift = middle - back @ numpy.array([VIEW / 2, VIEW / 2])
    terms = (back[0, 0], back[0, 1], shift[0], back[1, 0], back[1, 1], shift[1])
    fill = tuple(int(v) for v in rng.integers(20, 220, 3))
    shown = picture.pixels.transform((VIEW, VIEW), Image.Transform.AFFINE, terms, Image.Resampling.BILINEAR, fillcolor=fill)
    covered = numpy.asarray(picture.covered.transform((VIEW, VIEW), Image.Transform.AFFINE, terms, Image.Resampling.NEAREST, fillcolor=0))
    return numpy.asarray(spoilt(shown, rng)), wanted_of(picture, covered, forward, middle)


def spoilt(shown: Image.Image, rng: numpy.random.Generator) -> Image.Image:
    """Coarser cameras, lenses that blur, files that were packed tightly."""
    if rng.random() < 0.25:
        coarse = round(VIEW / rng.uniform(1.2, 2.4))
        shown = shown.resize((coarse, coarse), Image.Resampling.BOX).resize((VIEW, VIEW), Image.Resampling.BICUBIC)
    elif rng.random() < 0.2:
        shown = shown.filter(ImageFilter.GaussianBlur(rng.uniform(0.4, 1.3)))
    if rng.random() < 0.35:
        packed = io.BytesIO()
        shown.save(packed, "JPEG", quality=int(rng.integers(25, 90)))
        shown = Image.open(packed).convert("RGB")
    return shown


PLACES = VIEW // network.STEP
ROWS, COLUMNS = numpy.mgrid[0:PLACES, 0:PLACES].astype(numpy.float32)


def wanted_of(picture: Picture, covered: numpy.ndarray, forward: numpy.ndarray, middle: numpy.ndarray) -> numpy.ndarray:
    out = numpy.zeros((11, PLACES, PLACES), numpy.float32)
    out[1] = 1.0
    cells = covered.reshape(PLACES, network.STEP, PLACES, network.STEP)
    out[10] = (cells != UNKNOWN).all((1, 3))
    out[9] = (cells == 255).mean((1, 3))
    for x0, y0, x1, y1 in picture.blank:
        seen = (numpy.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)]) - middle) @ forward.T / network.STEP + PLACES / 2
        low, high = numpy.clip(seen.min(0), 0, PLACES).astype(int), numpy.clip(numpy.ceil(seen.max(0)), 0, PLACES).astype(int)
        out[1, low[1]:high[1], low[0]:high[0]] = 0
        out[10, low[1]:high[1], low[0]:high[0]] = 0
    for x, y, length, width, heading, known in picture.cars:
        px, py = ((numpy.array([x, y]) - middle) @ forward.T / network.STEP + PLACES / 2)
        if not (0 <= px < PLACES and 0 <= py < PLACES):
            continue
        column, row = int(px), int(py)
        near = numpy.exp(-((COLUMNS - column) ** 2 + (ROWS - row) ** 2) / (2 * 1.3**2))
        numpy.maximum(out[0], near, out=out[0])
        ahead, aside = forward @ [math.cos(heading), math.sin(heading)], forward @ [-math.sin(heading), math.cos(heading)]
        way = math.atan2(ahead[1], ahead[0])
        out[0, row, column], out[1, row, column] = 1.0, 1.0
        out[2:9, row, column] = (px - column, py - row, math.log(length * numpy.linalg.norm(ahead) / network.LENGTH), math.log(width * numpy.linalg.norm(aside) / network.WIDTH),
                                 math.cos(2 * way), math.sin(2 * way), known)
    return out


def uniform(count: int, low: float, high: float) -> torch.Tensor:
    return (torch.rand(count) * (high - low) + low)[:, None, None, None]


def normal(pixels: torch.Tensor) -> torch.Tensor:
    return (pixels.float() - network.GREY) / network.CONTRAST


def coloured(shown: torch.Tensor) -> torch.Tensor:
    """Other light, other cameras: exposure, tint, haze, blur, sharpening, noise, and coarse pixels."""
    count = len(shown)
    light = shown * torch.exp(uniform(count, -0.5, 0.35)) * torch.exp(torch.randn(count, 3, 1, 1) * 0.07) + uniform(count, -0.45, 0.5)
    grey = light.mean(1, keepdim=True)
    light = grey + (light - grey) * uniform(count, 0.0, 1.5)
    blurred = torch.nn.functional.avg_pool2d(light, 3, 1, 1, count_include_pad=False)
    light = light + (blurred - light) * uniform(count, -1.3, 1.0)
    coarse = torch.nn.functional.interpolate(torch.nn.functional.avg_pool2d(light, 2), scale_factor=2.0, mode="bilinear", align_corners=False)
    light = torch.where(uniform(count, 0, 1) < 0.12, coarse, light)
    light = light + torch.randn_like(light) * uniform(count, -0.1, 0.15).clamp(min=0)
    return light.clamp(-114 / 64, 141 / 64)


def batch(sources: list[tuple[list[Picture], int]], rng: numpy.random.Generator) -> tuple[torch.Tensor, torch.Tensor]:
    """`sources`: pictures, and how many views of them."""
    views = [view_of(of[rng.integers(len(of))], rng) for of, count in sources for _ in range(count)]
    pixels = torch.from_numpy(numpy.stack([view[0] for view in views])).permute(0, 3, 1, 2)
    return coloured(normal(pixels)), torch.from_numpy(numpy.stack([view[1] for view in views]))
