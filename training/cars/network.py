"""The network that finds vehicles from above, what it learns from, and what its answer means.

Each place of a grid, four pixels apart, answers whether a vehicle's middle is there, where exactly, how long and wide it is, which way it lies, and whether
a vehicle is seen there at all. A pixel is ten centimetres: what is larger or smaller is no car.
"""

from __future__ import annotations

import torch
from torch import nn
from torch.nn import functional

STEP = 4  # pixels from place to place
METRES = 0.1  # a pixel
GREY, CONTRAST = 114.0, 64.0
LENGTH, WIDTH = 46.0, 19.0  # pixels of the usual car: sizes are told as logarithms beside these
MIDDLE, OFFSET, SIZE, WAY, COVERED = 0, slice(1, 3), slice(3, 5), slice(5, 7), 7


def convolution(inputs: int, outputs: int, size: int = 3, step: int = 1) -> nn.Sequential:
    return nn.Sequential(nn.Conv2d(inputs, outputs, size, step, size // 2, bias=False), nn.BatchNorm2d(outputs), nn.ReLU(True))


class Twice(nn.Module):
    """Two convolutions beside a short cut (He et al. 2016)."""

    def __init__(self, planes: int):
        super().__init__()
        self.first = convolution(planes, planes)
        self.second = nn.Sequential(nn.Conv2d(planes, planes, 3, 1, 1, bias=False), nn.BatchNorm2d(planes))

    def forward(self, x):
        return functional.relu(x + self.second(self.first(x)))


def twice_as_large(x: torch.Tensor) -> torch.Tensor:
    return functional.interpolate(x, scale_factor=2.0, mode="nearest")


class Cars(nn.Module):
    """Down to a 32nd, where a place has seen what a house looks like, and up again to a 4th, where a vehicle is told from its neighbour."""

    def __init__(self):
        super().__init__()
        self.at4 = nn.Sequential(convolution(3, 14, 3, 2), convolution(14, 28, 3, 2))
        self.at8 = nn.Sequential(convolution(28, 48, 3, 2), Twice(48))
        self.at16 = nn.Sequential(convolution(48, 80, 3, 2), Twice(80))
        self.at32 = nn.Sequential(convolution(80, 112, 3, 2), Twice(112))
        self.side32, self.side16, self.side8, self.side4 = nn.Conv2d(112, 56, 1), nn.Conv2d(80, 56, 1), nn.Conv2d(48, 40, 1), nn.Conv2d(28, 32, 1)
        self.mix16, self.mix8, self.mix4 = convolution(56, 40), convolution(40, 32), convolution(32, 40)
        self.head = nn.Conv2d(40, 8, 1)
        nn.init.normal_(self.head.weight, 0, 0.01)
        nn.init.zeros_(self.head.bias)
        nn.init.constant_(self.head.bias[:1], -4.0)

    def forward(self, x):
        at4 = self.at4(x)
        at8 = self.at8(at4)
        at16 = self.at16(at8)
        up16 = self.mix16(twice_as_large(self.side32(self.at32(at16))) + self.side16(at16))
        up8 = self.mix8(twice_as_large(up16) + self.side8(at8))
        return self.head(self.mix4(twice_as_large(up8) + self.side4(at4)))


def loss_of(answer: torch.Tensor, wanted: torch.Tensor) -> torch.Tensor:
    """`wanted`: nearness to a middle, its weight, offset, size, way, weight of size and way, covered, its weight."""
    near, near_weight, offset, size, way, sized, covered, covered_weight = wanted.split([1, 1, 2, 2, 2, 1, 1, 1], 1)
    logit = answer[:, :1]
    middle = (near > 0.999).float()
    count = middle.sum().clamp(min=1)
    hit = -functional.logsigmoid(logit) * torch.sigmoid(-logit) ** 2 * middle
    miss = -functional.logsigmoid(-logit) * torch.sigmoid(logit) ** 2 * (1 - near) ** 4 * (1 - middle)
    focal = ((hit + miss) * near_weight).sum() / count
    place = (functional.l1_loss(answer[:, OFFSET], offset, reduction="none") * middle).sum() / count
    known = middle * sized
    sizes = known.sum().clamp(min=1)
    extent = (functional.l1_loss(answer[:, SIZE], size, reduction="none") * known).sum() / sizes
    turn = (functional.mse_loss(answer[:, WAY], way, reduction="none") * known).sum() / sizes
    seen = (functional.binary_cross_entropy_with_logits(answer[:, COVERED:], covered, reduction="none") * covered_weight).mean()
    return focal + 0.4 * place + 1.5 * extent + 0.5 * turn + 2.0 * seen


def found_in(answer: torch.Tensor, least: float = -4.0) -> list[torch.Tensor]:
    """Of each picture the vehicles: x, y, length, width, heading, logit of the chance. Each once, the surest first."""
    every = []
    for said in answer:
        logit = said[MIDDLE]
        best = functional.max_pool2d(logit[None, None], 3, 1, 1)[0, 0]
        rows, columns = torch.where((logit == best) & (logit > least))
        at = said[:, rows, columns]
        way = 0.5 * torch.atan2(at[6], at[5])
        cars = torch.stack([(columns + at[1]) * STEP, (rows + at[2]) * STEP, LENGTH * at[3].exp(), WIDTH * at[4].exp(), way, at[0]], 1)
        every.append(once(cars[cars[:, 5].argsort(descending=True)]))
    return every


def once(cars: torch.Tensor) -> torch.Tensor:
    """What lies within half a car's width of a surer one is that one."""
    kept: list[torch.Tensor] = []
    for car in cars:
        if all((car[:2] - other[:2]).norm() > 0.5 * other[3] for other in kept):
            kept.append(car)
    return torch.stack(kept) if kept else cars[:0]


class Exported(nn.Module):
    """As the program reads it: the first plane is the logit of a chance, the last the chance that a vehicle is seen there."""

    def __init__(self, net: Cars, slope: float, offset: float):
        super().__init__()
        self.net, self.slope, self.offset = net, slope, offset

    def forward(self, x):
        answer = self.net(x)
        return torch.cat([answer[:, :1] * self.slope + self.offset, answer[:, 1:7], torch.sigmoid(answer[:, 7:])], 1)
