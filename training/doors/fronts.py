"""What people put round doors and on them: arches, stone surrounds, letter slots, knockers, grilles, wreaths, notes, scribbles."""

from __future__ import annotations

import numpy

import textures
from surface import PAINTS, WALLS, Surface, pick

GREENS = [(40, 80, 40), (70, 90, 50), (110, 50, 40)]
METALS = [(200, 200, 204), (120, 110, 90), (190, 160, 80), (40, 40, 42), (90, 110, 90)]


def surround(s: Surface, left: float, bottom: float, width: float, height: float) -> None:
    """Pilasters and a lintel of stone or of wood, drawn before the door."""
    rng, wide, high = s.rng, s.rng.uniform(0.12, 0.4), s.rng.uniform(0.15, 0.5)
    part = s.part(left - wide, bottom, width + 2 * wide, height + high)
    if part.size == 0:
        return
    part[...] = pick(rng, WALLS + [(186, 176, 160), (150, 146, 140), (120, 112, 100)])
    if rng.random() < 0.5:
        textures.stones(rng, part, s.scale)
    else:
        textures.rough(rng, part, rng.uniform(0.02, 0.1))
        s.relief(left - wide, bottom, wide, height, 0.25, part.reshape(-1, 3).mean(0))
        s.relief(left + width, bottom, wide, height, 0.25, part.reshape(-1, 3).mean(0))
        s.relief(left - wide, bottom + height, width + 2 * wide, high, 0.3, part.reshape(-1, 3).mean(0))


def arched(s: Surface, before: numpy.ndarray, left: float, bottom: float, width: float, height: float, frame) -> None:
    """Cuts the upper corners off: what was there `before` comes back over a bow."""
    part = s.part(left, bottom, width, height)
    if part.shape != before.shape or part.size == 0:
        return
    rows, columns = part.shape[:2]
    tall = min(rows, round(columns / 2 * s.rng.uniform(0.35, 1.0)))
    y, x = numpy.mgrid[0:tall, 0:columns]
    away = ((x - columns / 2 + 0.5) / (columns / 2)) ** 2 + ((tall - y) / max(tall, 1)) ** 2
    top = part[:tall]
    top[(away > 0.86) & (away <= 1.0)] = frame
    top[away > 1.0] = before[:tall][away > 1.0]


def adorn(s: Surface, left: float, bottom: float, width: float, height: float) -> None:
    """On a leaf: a few of the things that doors carry."""
    rng = s.rng
    metal = pick(rng, METALS, 12)
    middle = left + width / 2
    part = s.part(left, bottom, width, height)
    if part.size == 0:
        return
    if rng.random() < 0.16:  # a letter slot
        w, y = rng.uniform(0.2, 0.34), bottom + rng.uniform(0.3, 1.2)
        s.fill(middle - w / 2, y, w, 0.07, metal)
        s.fill(middle - w / 2 + 0.02, y + 0.02, w - 0.04, 0.02, metal * 0.4)
    if rng.random() < 0.14:  # a knocker
        big, y = rng.uniform(0.05, 0.14), 1 - min(0.95, rng.uniform(1.2, 1.6) / height)

        def knocker(draw, columns, rows):
            cx, cy, r = columns / 2, y * rows, big * s.scale
            draw.ellipse([cx - r, cy - r * 0.6, cx + r, cy + r * 0.8], fill=textures.tone(metal, 0.8))
            draw.ellipse([cx - r * 0.8, cy, cx + r * 0.8, cy + 2 * r], outline=textures.tone(metal), width=max(1, round(r / 3)))
        textures.drawn_on(part, knocker)
    if rng.random() < 0.08:  # a wreath
        y, r = 1 - min(0.9, 1.5 / height), rng.uniform(0.15, 0.26) * s.scale

        def wreath(draw, columns, rows):
            for angle in rng.uniform(0, 2 * numpy.pi, 40):
                textures.leaves(rng, draw, columns / 2 + r * numpy.cos(angle), y * rows + r * numpy.sin(angle), r / 4, 5, GREENS, max(1.0, r / 9))
        textures.drawn_on(part, wreath)
    if rng.random() < 0.1:  # numbers and notes
        for _ in range(int(rng.integers(1, 4))):
            x, y = left + rng.uniform(0.1, 0.7) * width, bottom + rng.uniform(0.5, 0.85) * height
            s.fill(x, y, rng.uniform(0.05, 0.25), rng.uniform(0.05, 0.3), pick(rng, PAINTS[:4] + PAINTS))
    if rng.random() < 0.08:  # a grille
        dark = pick(rng, [(20, 20, 22), (60, 50, 40), (190, 190, 190)], 10)

        def grille(draw, columns, rows):
            step = max(3, rng.uniform(0.06, 0.16) * s.scale)
            for x in numpy.arange(step / 2, columns, step):
                draw.line([(x, 0), (x, rows)], fill=textures.tone(dark), width=max(1, round(step / 7)))
            for _ in range(int(rng.integers(0, 30))):
                x, y, r = rng.uniform(0, columns), rng.uniform(0, rows), rng.uniform(0.4, 1.5) * step
                draw.arc([x - r, y - r, x + r, y + r], rng.uniform(0, 180), rng.uniform(180, 360), fill=textures.tone(dark), width=max(1, round(step / 8)))
        textures.drawn_on(part, grille)
    if rng.random() < 0.06:
        textures.scribbles(rng, part, pick(rng, PAINTS, 30), int(rng.integers(1, 7)))
    if rng.random() < 0.1:
        textures.BEYOND.grain(rng, part, rng.uniform(0.03, 0.3))
    if rng.random() < 0.35:  # wear
        textures.rough(rng, part, rng.uniform(0.03, 0.22), rng.uniform(4, 20))
