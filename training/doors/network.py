"""The network that finds doors, what it learns from, and what its answer means.

Each of 20 x 20 places of the square answers whether it lies in the middle of a door, where that door's edges are, and how well it knows them. Whether it
lies anywhere in a door or on a cupboard it learns as well, only to learn more from few pictures: those answers are not exported.
"""

from __future__ import annotations

import torch
from torch import nn
from torch.nn import functional

from pictures import CUPBOARD, DOOR, INPUT

STEP = 8  # pixels from place to place
PLACES = INPUT // STEP


def convolution(inputs: int, outputs: int, size: int = 3, step: int = 1) -> nn.Sequential:
    return nn.Sequential(nn.Conv2d(inputs, outputs, size, step, size // 2, bias=False), nn.BatchNorm2d(outputs), nn.ReLU(True))


class Block(nn.Module):
    def __init__(self, channels: int):
        super().__init__()
        self.first = convolution(channels, channels)
        self.second = nn.Sequential(nn.Conv2d(channels, channels, 3, 1, 1, bias=False), nn.BatchNorm2d(channels))

    def forward(self, x):
        return torch.relu(x + self.second(self.first(x)))


class Doors(nn.Module):
    def __init__(self):
        super().__init__()
        self.at4 = nn.Sequential(convolution(3, 16, 5, 2), convolution(16, 24, 3, 2))
        self.at8 = nn.Sequential(convolution(24, 48, 3, 2), Block(48))
        self.at16 = nn.Sequential(convolution(48, 80, 3, 2), Block(80))
        self.at32 = nn.Sequential(convolution(80, 96, 3, 2), Block(96), Block(96))
        self.down16 = convolution(96, 64, 1)
        self.side16 = convolution(80, 64, 1)
        self.mix16 = convolution(64, 64)
        self.side8 = convolution(48, 64, 1)
        self.mix8 = nn.Sequential(convolution(64, 64), nn.Dropout2d(0.05))
        self.middle = nn.Conv2d(64, 1, 1)
        self.edges = nn.Conv2d(64, 4, 1)
        self.surely = nn.Conv2d(64, 1, 1)
        self.areas = nn.Conv2d(64, 2, 1)
        nn.init.constant_(self.middle.bias, -4.0)
        nn.init.constant_(self.edges.bias, 1.8)

    def forward(self, x):
        at8 = self.at8(self.at4(x))
        at16 = self.at16(at8)
        at32 = self.at32(at16)
        up16 = self.mix16(functional.interpolate(self.down16(at32), scale_factor=2.0, mode="nearest") + self.side16(at16))
        up8 = self.mix8(functional.interpolate(up16, scale_factor=2.0, mode="nearest") + self.side8(at8))
        return self.middle(up8), self.edges(up8), self.surely(up8), self.areas(up8)


def places() -> torch.Tensor:
    """x and y of each, in pixels: 2, PLACES, PLACES."""
    at = torch.arange(PLACES) * STEP + STEP / 2
    return torch.stack([at[None].expand(PLACES, PLACES), at[:, None].expand(PLACES, PLACES)])


def boxes_of(edges: torch.Tensor) -> torch.Tensor:
    """Distances to the left, top, right and bottom as logarithms of steps, as left, top, right, bottom in pixels."""
    x, y = places()
    far = torch.exp(edges.clamp(-3.0, 3.8)) * STEP
    return torch.stack([x - far[:, 0], y - far[:, 1], x + far[:, 2], y + far[:, 3]], 1)


def overlap(a: torch.Tensor, b: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
    """Intersection over union of boxes along the last axis, and the generalised one, which also tells how far apart they are."""
    area = lambda left, top, right, bottom: (right - left).clamp(min=0) * (bottom - top).clamp(min=0)
    common = area(torch.maximum(a[..., 0], b[..., 0]), torch.maximum(a[..., 1], b[..., 1]), torch.minimum(a[..., 2], b[..., 2]), torch.minimum(a[..., 3], b[..., 3]))
    both = area(*a.unbind(-1)) + area(*b.unbind(-1)) - common
    hull = area(torch.minimum(a[..., 0], b[..., 0]), torch.minimum(a[..., 1], b[..., 1]), torch.maximum(a[..., 2], b[..., 2]), torch.maximum(a[..., 3], b[..., 3]))
    ratio = common / both.clamp(min=1e-6)
    return ratio, ratio - (hull - both) / hull.clamp(min=1e-6)


def loss_of(answer, boxes: torch.Tensor) -> torch.Tensor:
    middle, edges, surely, areas = answer
    x, y = (axis[None, None] for axis in places())
    left, top, right, bottom = (boxes[..., k, None, None] for k in range(4))
    kind = boxes[..., 4, None, None]
    inside = (x > left) & (x < right) & (y > top) & (y < bottom)
    half_w, half_h = ((right - left) * 0.22).clamp(min=STEP * 0.55), ((bottom - top) * 0.22).clamp(min=STEP * 0.55)
    central = ((x - (left + right) / 2).abs() < half_w) & ((y - (top + bottom) / 2).abs() < half_h) & (kind == DOOR)
    # Where two doors claim a place the smaller one has it.
    size = torch.where(central, (right - left) * (bottom - top), torch.tensor(1e9))
    smallest = size.min(1)
    mine = smallest.values < 1e9
    wanted = torch.gather(boxes[..., :4], 1, smallest.indices.flatten(1)[..., None].expand(-1, -1, 4))
    unknown = (inside & (kind == 2)).any(1) & ~mine
    # Near the middle of a door but not in it: no mistake.
    around = ((x - (left + right) / 2).abs() < half_w * 1.6) & ((y - (top + bottom) / 2).abs() < half_h * 1.6) & (kind == DOOR)
    unknown = unknown | (around.any(1) & ~mine)
    count = mine.sum().clamp(min=1)
    truth = mine.float()
    chance = torch.sigmoid(middle[:, 0])
    wrong = torch.where(mine, 1 - chance, chance)
    focal = functional.binary_cross_entropy_with_logits(middle[:, 0], truth, reduction="none") * wrong**2 * torch.where(mine, 0.6, 0.4)
    focal = (focal * ~unknown).sum() / count
    found = boxes_of(edges).flatten(2).transpose(1, 2)
    ratio, general = overlap(found, wanted)
    flat = mine.flatten(1)
    place = ((1 - general) * flat).sum() / count
    sure = (functional.binary_cross_entropy_with_logits(surely.flatten(1), ratio.detach(), reduction="none") * flat).sum() / count
    covered = torch.stack([(inside & (kind == DOOR)).any(1), (inside & (kind == CUPBOARD)).any(1)], 1).float()
    area = functional.binary_cross_entropy_with_logits(areas, covered, reduction="none")
    area = (area * ~unknown[:, None] if unknown.any() else area).mean()
    return 2 * focal + place + 0.3 * sure + 1.5 * area


def found_in(answer, slope: float = 1.0, offset: float = 0.0, most: int = 60) -> list[tuple[torch.Tensor, torch.Tensor]]:
    """For each picture the boxes in pixels of the square, and how sure of each: the logit of a chance, if slope and offset make one of the network's words."""
    middle, edges, surely, _ = answer
    sure = (functional.logsigmoid(middle) + functional.logsigmoid(surely)).flatten(1) * slope + offset
    boxes = boxes_of(edges).flatten(2).transpose(1, 2)
    return [once(boxes[k], sure[k], most) for k in range(len(sure))]


def once(boxes: torch.Tensor, sure: torch.Tensor, most: int) -> tuple[torch.Tensor, torch.Tensor]:
    """Each door once: neighbours that mean the same vote on its edges."""
    best = sure.argsort(descending=True)[:most]
    boxes, sure = boxes[best], sure[best]
    keep_boxes, keep_sure, open_ = [], [], torch.ones(len(boxes), dtype=torch.bool)
    for k in range(len(boxes)):
        if not open_[k]:
            continue
        same = overlap(boxes[k][None], boxes)[0]
        weight = torch.sigmoid(sure) * (same > 0.6)
        keep_boxes.append((boxes * weight[:, None]).sum(0) / weight.sum())
        keep_sure.append(sure[k])
        open_ &= same < 0.45
        open_[k] = False
    return torch.stack(keep_boxes), torch.stack(keep_sure)


class Exported(nn.Module):
    """As the program reads it: 5, PLACES, PLACES: the logit of the chance, left, top, right and bottom in steps from the place."""

    def __init__(self, net: Doors, slope: float, offset: float):
        super().__init__()
        self.net, self.slope, self.offset = net, slope, offset

    def forward(self, x):
        middle, edges, surely, _ = self.net(x)
        sure = torch.log(torch.sigmoid(middle) * torch.sigmoid(surely) + 1e-7) * self.slope + self.offset
        return torch.cat([sure, torch.exp(edges)], 1)
