"""Labelled pictures as arrays of one size: photographs of a folder, rendered scenes of a seed; and random views of both to train with."""

from __future__ import annotations

import dataclasses
import pathlib

import numpy
import torch
from PIL import Image

import scenes

INPUT = 160  # pixels a side of what the network sees
GREY, CONTRAST = 114.0, 64.0  # what fills the square beside the picture is 0 to the network
MOST_BOXES = 24
DOOR, CUPBOARD, UNCLEAR = 0, 1, 2  # unclear: neither a door nor none


@dataclasses.dataclass
class Set:
    pixels: torch.Tensor  # pictures, RGB, side, side; in the upper left corner
    sizes: torch.Tensor  # width, height
    boxes: torch.Tensor  # pictures, MOST_BOXES, 5: left, top, right, bottom, kind (-1: none)

    def __len__(self) -> int:
        return len(self.sizes)

    def only(self, which) -> Set:
        return Set(self.pixels[which], self.sizes[which], self.boxes[which])


def packed(side: int, pictures: list[tuple[numpy.ndarray, list]]) -> Set:
    pixels = torch.full((len(pictures), 3, side, side), int(GREY), dtype=torch.uint8)
    sizes, boxes = torch.zeros(len(pictures), 2), torch.full((len(pictures), MOST_BOXES, 5), -1.0)
    for k, (picture, things) in enumerate(pictures):
        height, width = picture.shape[:2]
        pixels[k, :, :height, :width] = torch.from_numpy(picture.copy()).permute(2, 0, 1)
        sizes[k] = torch.tensor([width, height])
        for j, thing in enumerate(sorted(things, key=lambda thing: thing[4])[:MOST_BOXES]):
            boxes[k, j] = torch.tensor(thing)
    return Set(pixels, sizes, boxes)


def joined(sets: list[Set]) -> Set:
    return Set(*(torch.cat([getattr(one, field.name) for one in sets]) for field in dataclasses.fields(Set)))


def half_of(folder: pathlib.Path, half: str) -> list[pathlib.Path]:
    """Photographs by name: every second, from the first on, is to build with; the others are held out."""
    return sorted((folder / "images").iterdir())[0 if half == "built-with" else 1::2]


def photographs(folder: pathlib.Path, files: list[pathlib.Path], side: int) -> Set:
    """Labels as YOLO has them: class 0 is a door, 2 and 3 are doors of cupboards and refrigerators."""
    pictures = []
    for file in files:
        image = Image.open(file).convert("RGB")
        shrink = side / max(image.size)
        width, height = (max(1, round(n * shrink)) for n in image.size)
        things = []
        for line in (folder / "labels" / f"{file.stem}.txt").read_text().splitlines():
            kind, x, y, w, h = (float(word) for word in line.split())
            if kind in (0, 2, 3):
                things.append([(x - w / 2) * width, (y - h / 2) * height, (x + w / 2) * width, (y + h / 2) * height, DOOR if kind == 0 else CUPBOARD])
        pictures.append((numpy.asarray(image.resize((width, height), Image.Resampling.BOX)), things))
    return packed(side, pictures)


def without_doors(folder: pathlib.Path | None, side: int) -> list[numpy.ndarray]:
    """Photographs in which no door is: what walls, people, streets and tables really look like."""
    pictures = []
    for file in sorted(folder.iterdir()) if folder else []:
        image = Image.open(file).convert("RGB")
        shrink = side / max(image.size)
        pictures.append(numpy.asarray(image.resize(tuple(max(1, round(n * shrink)) for n in image.size), Image.Resampling.BOX)))
    return pictures


def rendered(seed: int, count: int, side: int, beyond: list[numpy.ndarray]) -> Set:
    rng, pictures = numpy.random.default_rng(seed), []
    for scene in scenes.rendered(rng, count, side, beyond):
        things = [[*box[:4], DOOR if box[4] else UNCLEAR] for box in scene.doors.tolist()] + [[*box[:4], CUPBOARD if box[4] else UNCLEAR] for box in scene.cupboards.tolist()]
        pictures.append((scene.pixels, things))
    return packed(side, pictures)


def uniform(count: int, low: float, high: float) -> torch.Tensor:
    return torch.rand(count) * (high - low) + low


def views(of: Set, which: torch.Tensor, at_random: bool) -> tuple[torch.Tensor, torch.Tensor]:
    """What the network is shown: the whole picture in the middle of the square, or a random view of it. Returns pixels and boxes of the square."""
    count, side = len(which), of.pixels.shape[-1]
    size, boxes = of.sizes[which], of.boxes[which].clone()
    scale = (INPUT / size.max(1).values)[:, None].repeat(1, 2)
    middle = size / 2
    flip, angle = torch.ones(count), torch.zeros(count)
    if at_random:
        grow = torch.exp(uniform(count, -0.55, 0.75))[:, None]
        stretch = torch.exp(torch.randn(count) * 0.12)[:, None]
        scale = scale * grow * torch.cat([stretch, 1 / stretch], 1)
        # Larger than the square: another part of it; smaller: elsewhere in the square.
        room = (size * scale - INPUT).abs() / 2 / scale + 0.06 * size
        middle = middle + (torch.rand(count, 2) * 2 - 1) * room
        flip = torch.where(torch.rand(count) < 0.5, -1.0, 1.0)
        angle = torch.randn(count) * 0.012  # little: a box round a turned box is larger than the door
    # From the square to the picture: turned, scaled, mirrored about the middle.
    cos, sin = torch.cos(angle), torch.sin(angle)
    a = torch.stack([torch.stack([cos * flip / scale[:, 0], -sin / scale[:, 0]], 1), torch.stack([sin * flip / scale[:, 1], cos / scale[:, 1]], 1)], 1)
    matrix = torch.cat([a * (INPUT / side), ((middle * 2 - side) / side)[:, :, None]], 2)
    grid = torch.nn.functional.affine_grid(matrix, [count, 3, INPUT, INPUT], align_corners=False)
    shown = torch.nn.functional.grid_sample((of.pixels[which].float() - GREY) / CONTRAST, grid, align_corners=False)
    there = boxes[..., 4] >= 0
    corners = boxes[..., [0, 1, 2, 1, 2, 3, 0, 3]].reshape(count, -1, 2) - middle[:, None]
    corners = (torch.linalg.inv(a) @ corners.transpose(1, 2)).transpose(1, 2).reshape(count, MOST_BOXES, 4, 2) + INPUT / 2
    whole = torch.cat([corners.min(2).values, corners.max(2).values], 2)
    seen = whole.clamp(0, INPUT)
    # What the picture's own edge cuts off is not in the square either.
    area = lambda b: (b[..., 2] - b[..., 0]).clamp(min=0) * (b[..., 3] - b[..., 1]).clamp(min=0)
    part = area(seen) / area(whole).clamp(min=1e-6)
    # A sliver at the edge is neither a door nor none.
    kind = torch.where(there & (part > 0), torch.where((part < 0.3) & (boxes[..., 4] == DOOR), torch.tensor(float(UNCLEAR)), boxes[..., 4]), torch.tensor(-1.0))
    small = (seen[..., 2] - seen[..., 0] < 5) | (seen[..., 3] - seen[..., 1] < 10)
    kind = torch.where((kind == DOOR) & small, torch.tensor(float(UNCLEAR)), kind)
    return (coloured(shown) if at_random else shown), torch.cat([seen, kind[..., None]], 2)


GRAIN = torch.randn(3, 2 * INPUT, 2 * INPUT, generator=torch.Generator().manual_seed(1))


def coloured(shown: torch.Tensor) -> torch.Tensor:
    """Other light, other cameras."""
    count = len(shown)
    of_each = lambda low, high: uniform(count, low, high)[:, None, None, None]
    there = (shown != 0).any(1, keepdim=True)
    gain = torch.exp(of_each(-0.45, 0.35)) * torch.exp(torch.randn(count, 3, 1, 1) * 0.1)
    light = torch.addcmul(of_each(-0.5, 0.5) + torch.randn(count, 3, 1, 1) * 0.08, shown, gain)
    light = torch.lerp(light.mean(1, keepdim=True), light, of_each(0.1, 1.6))
    for k in torch.nonzero(torch.rand(count) < 0.25).flatten().tolist():
        light[k] = light[k, torch.randperm(3)]  # a green door is as good as a red one
    for k in torch.nonzero(torch.rand(count) < 0.45).flatten().tolist():
        light[k] = torch.lerp(light[k], torch.nn.functional.avg_pool2d(light[k:k + 1], 3, 1, 1)[0], float(uniform(1, 0.0, 1.0)))
    for k in torch.nonzero(torch.rand(count) < 0.55).flatten().tolist():
        x, y = torch.randint(INPUT, (2,)).tolist()
        light[k].add_(GRAIN[:, y:y + INPUT, x:x + INPUT], alpha=float(uniform(1, 0.0, 0.12)))
    return light.mul_(there)


def covered_by(boxes: torch.Tensor, x: int, y: int, width: int, height: int) -> torch.Tensor:
    """How much of each box lies in a rectangle, in pixels."""
    side = lambda low, high, start, end: (boxes[:, high].clamp(max=end) - boxes[:, low].clamp(min=start)).clamp(min=0)
    return side(0, 2, x, x + width) * side(1, 3, y, y + height)


def pasted(shown: torch.Tensor, boxes: torch.Tensor, share: float) -> tuple[torch.Tensor, torch.Tensor]:
    """Doors of one view put into others: the same door before many walls, the same wall with many doors."""
    out, told = shown.clone(), boxes.clone()
    for k in torch.nonzero(torch.rand(len(shown)) < share).flatten().tolist():
        source = int(torch.randint(len(shown), (1,)))
        doors = boxes[source][boxes[source, :, 4] == DOOR]
        free = torch.nonzero(told[k, :, 4] < 0).flatten()
        if source == k or not len(doors) or not len(free):
            continue
        x0, y0, x1, y1 = (int(n) for n in doors[int(torch.randint(len(doors), (1,)))][:4].round())
        width, height = x1 - x0, y1 - y0
        if width < 10 or height < 20 or width > 0.6 * INPUT:
            continue
        x, y = int(torch.randint(INPUT - width + 1, (1,))), int(torch.randint(INPUT - height + 1, (1,)))
        out[k, :, y:y + height, x:x + width] = shown[source, :, y0:y1, x0:x1]
        others = told[k]
        hidden = covered_by(others, x, y, width, height) / ((others[:, 2] - others[:, 0]) * (others[:, 3] - others[:, 1])).clamp(min=1)
        gone = torch.where(hidden > 0.8, torch.tensor(-1.0), torch.tensor(float(UNCLEAR)))
        told[k, :, 4] = torch.where((others[:, 4] >= 0) & (hidden > 0.35), gone, others[:, 4])
        told[k, free[0]] = torch.tensor([x, y, x + width, y + height, DOOR], dtype=torch.float32)
    return out, told


def hidden_in_part(shown: torch.Tensor, boxes: torch.Tensor, share: float) -> tuple[torch.Tensor, torch.Tensor]:
    """Patches of one view put before others: a door is one even where something stands before it."""
    out, told = shown.clone(), boxes.clone()
    for k in torch.nonzero(torch.rand(len(shown)) < share).flatten().tolist():
        source = int(torch.randint(len(shown), (1,)))
        width, height = (int(n) for n in torch.randint(INPUT // 10, INPUT // 2, (2,)))
        x, y, from_x, from_y = (int(torch.randint(INPUT - n + 1, (1,))) for n in (width, height, width, height))
        doors = boxes[source]
        common = covered_by(doors, from_x, from_y, width, height)
        if source == k or bool((common * (doors[:, 4] == DOOR) > 0.25 * width * height).any()):
            continue  # what hides must not be a door itself
        out[k, :, y:y + height, x:x + width] = shown[source, :, from_y:from_y + height, from_x:from_x + width]
        mine = told[k]
        part = covered_by(mine, x, y, width, height) / ((mine[:, 2] - mine[:, 0]) * (mine[:, 3] - mine[:, 1])).clamp(min=1)
        told[k, :, 4] = torch.where((mine[:, 4] == DOOR) & (part > 0.6), torch.tensor(float(UNCLEAR)), mine[:, 4])
    return out, told
