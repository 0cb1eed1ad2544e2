"""Walls with doors in them and with what is easily taken for doors.

Nothing here comes from photographs: colours, grain and wear are drawn by the random numbers of one generator, so that a seed repeats a picture.
"""

from __future__ import annotations

import numpy

import textures
from fronts import adorn, arched, surround
from surface import PAINTS, WALLS, WOODS, Surface, Thing, blotches, grain, pick


def paint_wall(s: Surface, outside: bool) -> None:
    rng = s.rng
    colour = pick(rng, WALLS)
    s.pixels[...] = colour
    way = rng.choice(["plain", "brick", "tiles", "boards", "stripes", "dado", "stone"],
                     p=[0.33, 0.22, 0.07, 0.13, 0.0, 0.07, 0.18] if outside else [0.6, 0.06, 0.09, 0.06, 0.06, 0.11, 0.02])
    if way in ("brick", "tiles"):
        high, wide = (0.075, 0.24) if way == "brick" else (rng.uniform(0.1, 0.4),) * 2
        joint = colour * rng.uniform(0.6, 1.25)
        if way == "brick":
            s.pixels[...] = pick(rng, [(150, 74, 54), (176, 110, 80), (120, 60, 48), (200, 180, 150)], 10)
        line = max(1, round(0.012 * s.scale))
        for row, bottom in enumerate(numpy.arange(0, s.height, high)):
            across = s.part(0, bottom, s.width, high)
            shift = (row % 2) * wide / 2 if way == "brick" else 0
            for left in numpy.arange(-shift, s.width, wide):
                s.part(left, bottom, wide, high)[...] *= rng.uniform(0.86, 1.12)
                s.part(left, bottom, line / s.scale, high)[...] = joint
            across[-line:] = joint
    elif way in ("boards", "stripes"):
        wide = rng.uniform(0.08, 0.3)
        flat = rng.random() < 0.4 and outside
        for at in numpy.arange(0, s.height if flat else s.width, wide):
            part = s.part(0, at, s.width, wide) if flat else s.part(at, 0, wide, s.height)
            part *= rng.uniform(0.9, 1.08)
            if way == "boards":
                (part[-1:] if flat else part[:, :1])[...] *= 0.65
    elif way == "dado":
        height = rng.uniform(0.8, 1.3)
        s.fill(0, 0, s.width, height, pick(rng, WALLS + WOODS))
        s.fill(0, height, s.width, 0.04, pick(rng, PAINTS))
    elif way == "stone":
        s.pixels[...] = pick(rng, [(186, 176, 160), (150, 146, 140), (120, 112, 100), (196, 170, 130)])
        textures.stones(rng, s.pixels, s.scale)
    if not outside and rng.random() < 0.7:
        s.fill(0, 0, s.width, rng.uniform(0.06, 0.14), pick(rng, PAINTS[:4] + WOODS))
    blotches(rng, s.pixels, rng.uniform(0.01, 0.1))
    if rng.random() < (0.8 if outside else 0.3):
        textures.rough(rng, s.pixels, rng.uniform(0.02, 0.14 if outside else 0.06), rng.uniform(4, 30))
    if rng.random() < 0.12:
        textures.BEYOND.grain(rng, s.pixels, rng.uniform(0.03, 0.25))
    if outside and rng.random() < 0.06:
        textures.scribbles(rng, s.pixels, pick(rng, PAINTS, 30), int(rng.integers(4, 24)))


def glass(s: Surface, left: float, bottom: float, width: float, height: float) -> None:
    rng = s.rng
    part = s.part(left, bottom, width, height)
    if part.size == 0:
        return
    if rng.random() < 0.5:
        part[...] = pick(rng, [(30, 34, 38), (50, 60, 70), (90, 100, 104)], 10)
    else:
        part[...] = pick(rng, [(214, 226, 236), (240, 244, 248), (150, 180, 150), (190, 200, 190)], 14)
    blotches(rng, part, rng.uniform(0.05, 0.4), 4)
    if textures.BEYOND.fill(rng, part, 0.45, rng.uniform(0.2, 1.0)):
        return
    # What is mirrored or seen behind: a few edges of any direction.
    for _ in range(rng.integers(0, 4)):
        x, w = sorted(rng.uniform(0, 1, 2) * width)
        y, h = sorted(rng.uniform(0, 1, 2) * height)
        s.shade(left + x, bottom + y, w - x, h - y, rng.uniform(0.7, 1.3))


def panes(s: Surface, left: float, bottom: float, width: float, height: float, bars, colour) -> None:
    glass(s, left, bottom, width, height)
    across, down = bars
    for k in range(1, across):
        s.fill(left + width * k / across - 0.012, bottom, 0.024, height, colour)
    for k in range(1, down):
        s.fill(left, bottom + height * k / down - 0.012, width, 0.024, colour)


def handle(s: Surface, x: float, y: float, inwards: float) -> None:
    rng = s.rng
    metal = pick(rng, [(200, 200, 204), (120, 110, 90), (190, 160, 80), (40, 40, 42), (150, 150, 154)], 12)
    way = rng.integers(4)
    if way == 0:
        s.fill(min(x, x + 0.12 * inwards), y - 0.012, 0.12, 0.025, metal)
        s.fill(x - 0.02, y - 0.03, 0.04, 0.06, metal * 0.85)
    elif way == 1:
        s.fill(x - 0.03, y - 0.03, 0.06, 0.06, metal)
        s.fill(x - 0.03, y - 0.03, 0.06, 0.02, metal * 0.6)
    elif way == 2:
        high = rng.uniform(0.2, 0.9)
        s.fill(x - 0.015, y - high / 2, 0.03, high, metal)
    else:
        s.fill(x - 0.025, y - 0.11, 0.05, 0.22, metal * 0.9)
        s.fill(min(x, x + 0.11 * inwards), y, 0.11, 0.025, metal)


def paint_leaf(s: Surface, left: float, bottom: float, width: float, height: float, hinge_left: bool, style: dict | None = None) -> dict:
    """One door leaf. Two leaves of one door share a style."""
    rng = s.rng
    if style is None:
        wooden = rng.random() < 0.5
        style = {"wooden": wooden, "colour": pick(rng, WOODS if wooden else PAINTS), "cut": rng.choice(["flat", "panels", "glazed", "half", "slit", "boards", "allglass", "louvre"],
                                                                                                  p=[0.26, 0.26, 0.12, 0.12, 0.08, 0.07, 0.05, 0.04]),
                 "rows": int(rng.integers(1, 5)), "columns": int(rng.integers(1, 3)), "depth": rng.uniform(0.08, 0.4), "bars": (int(rng.integers(1, 4)), int(rng.integers(1, 6))),
                 "handle": rng.uniform(0.9, 1.15), "has_handle": rng.random() < 0.9, "grain": rng.uniform(0.02, 0.16), "stile": rng.uniform(0.08, 0.16), "plate": rng.random() < 0.12,
                 "sign": rng.random() < 0.12}
    colour, cut = style["colour"], style["cut"]
    part = s.part(left, bottom, width, height)
    if part.size == 0:
        return style
    part[...] = colour
    if style["wooden"]:
        grain(rng, part, style["grain"])
    blotches(rng, part, rng.uniform(0.01, 0.08), 3)
    stile = min(style["stile"], width * 0.25)
    inner = (left + stile, width - 2 * stile)
    if cut in ("panels", "half"):
        rows, columns = style["rows"], style["columns"]
        low = 0.2
        parts = numpy.linspace(low, height - stile, rows + 1)
        wide = inner[1] / columns
        for row in range(rows):
            for column in range(columns):
                x, w = inner[0] + wide * column + 0.02, wide - 0.04
                y, h = bottom + parts[row] + 0.02, parts[row + 1] - parts[row] - 0.06
                if cut == "half" and row == rows - 1:
                    panes(s, x, y, w, h, (1, 1) if rng.random() < 0.6 else style["bars"], colour)
                else:
                    s.relief(x, y, w, h, style["depth"], colour)
                    if rng.random() < 0.5:
                        s.relief(x + 0.03, y + 0.03, w - 0.06, h - 0.06, -style["depth"], colour)
    elif cut == "glazed":
        low = rng.uniform(0.12, 0.9)
        panes(s, inner[0], bottom + low, inner[1], height - low - stile, style["bars"], colour * 0.97)
    elif cut == "allglass":
        panes(s, left + 0.04, bottom + 0.06, width - 0.08, height - 0.1, (1, 1), colour)
    elif cut == "slit":
        w = rng.uniform(0.08, 0.2)
        x = left + (width - w) * rng.choice([0.25, 0.5, 0.75])
        glass(s, x, bottom + rng.uniform(0.9, 1.2), w, rng.uniform(0.3, 0.8))
    elif cut == "boards":
        for x in numpy.arange(0.1, width, 0.12):
            s.shade(left + x, bottom, 0.016, height, 0.6)
        if rng.random() < 0.5:
            for y in (0.3, height - 0.4):
                s.fill(left + 0.04, bottom + y, width - 0.08, 0.12, colour * 0.85)
    elif cut == "louvre":
        for y in numpy.arange(0.15, height - 0.15, 0.06):
            s.shade(inner[0], bottom + y, inner[1], 0.028, 0.7)
    if style["plate"]:
        s.fill(left + 0.04, bottom + 0.04, width - 0.08, rng.uniform(0.15, 0.3), (170, 170, 172))
    if style["sign"]:
        w = rng.uniform(0.12, 0.4)
        s.fill(left + (width - w) / 2, bottom + rng.uniform(1.3, 1.7), w, rng.uniform(0.08, 0.3), pick(rng, PAINTS))
    if style["has_handle"]:
        x = left + width - 0.07 if hinge_left else left + 0.07
        handle(s, x, bottom + style["handle"] * min(1.0, height / 2), -1.0 if hinge_left else 1.0)
    adorn(s, left, bottom, width, height)
    return style


def paint_door(s: Surface, left: float, width: float, height: float, bottom: float = 0.0, opened: bool = False) -> None:
    """A door with its frame. `opened` shows what is behind; the leaf is the scene's to draw."""
    rng = s.rng
    frame = rng.choice([0.0, 0.05, 0.09, 0.14], p=[0.12, 0.3, 0.38, 0.2])
    colour = pick(rng, WOODS + PAINTS[:4] * 3 + WALLS[:3])
    before = s.part(left, bottom, width, height).copy()
    if rng.random() < 0.12:
        surround(s, left, bottom, width, height)
        before = s.part(left, bottom, width, height).copy()
    bow = not opened and rng.random() < 0.1
    if frame and not bow:
        s.fill(left - frame, bottom, width + 2 * frame, height + frame, colour)
        line = 1.5 / s.scale
        s.fill(left - frame, bottom, line, height + frame, colour * rng.uniform(0.55, 0.95))
        s.fill(left + width + frame - line, bottom, line, height + frame, colour * rng.uniform(0.55, 0.95))
        s.fill(left - frame, bottom + height + frame - line, width + 2 * frame, line, colour * rng.uniform(0.55, 1.05))
    over = 0.0
    if not bow and rng.random() < 0.14 and s.height > height + 0.5:  # a fanlight above
        over = rng.uniform(0.25, 0.45)
        s.fill(left - frame, bottom + height, width + 2 * frame, over + frame, colour)
        panes(s, left, bottom + height + 0.05, width, over - 0.05, (int(rng.integers(1, 4)), 1), colour)
    if rng.random() < 0.1:  # a side light
        panes(s, left + width + frame, bottom + 0.1, 0.35, height - 0.1, (1, int(rng.integers(1, 4))), colour)
    if opened:
        part = s.part(left, bottom, width, height)
        if part.size:
            part[...] = pick(rng, WALLS + [(30, 28, 26), (60, 56, 50), (90, 84, 76)]) * rng.uniform(0.3, 1.0)
            blotches(rng, part, 0.3, 4)
            floor = height * rng.uniform(0.05, 0.3)
            s.fill(left, bottom, width, floor, pick(rng, WOODS + WALLS) * 0.7)
            if textures.BEYOND.fill(rng, part, 0.5):
                return
            if rng.random() < 0.5:
                x = rng.uniform(0, 0.7) * width
                s.fill(left + x, bottom, rng.uniform(0.1, 0.4) * width, rng.uniform(0.3, 0.9) * height, pick(rng, PAINTS + WOODS) * 0.7)
        return
    hinge_left = bool(rng.random() < 0.5)
    if width > 1.25:
        style = paint_leaf(s, left, bottom, width / 2, height, True)
        paint_leaf(s, left + width / 2, bottom, width / 2, height, False, style)
        s.fill(left + width / 2 - 0.006, bottom, 0.012, height, style["colour"] * 0.4)
    else:
        paint_leaf(s, left, bottom, width, height, hinge_left)
    gap = 1.0 / s.scale * rng.uniform(0.6, 1.6)
    dark = rng.uniform(0.25, 0.8)
    for side in (left, left + width - gap):
        s.shade(side, bottom, gap, height, dark)
    s.shade(left, bottom + height - gap, width, gap, dark)
    if bow:
        arched(s, before, left, bottom, width, height, colour)
    # People mark leaves, each of its own, without the frame.
    leaves = 2 if width > 1.25 else 1
    s.things += [Thing("door", left + k * width / leaves, bottom, width / leaves, height) for k in range(leaves)]


def paint_cupboards(s: Surface, left: float, width: float) -> None:
    """Kitchen and office cupboards, wardrobes, refrigerators, shelves: what opens and is no door to a room."""
    rng = s.rng
    way = rng.choice(["base", "wall", "both", "wardrobe", "fridge", "shelf", "lockers"])
    colour = pick(rng, WOODS + PAINTS)

    def fronts(bottom: float, height: float, wide: float, rows: int) -> None:
        count = max(1, int(width / wide))
        for k in range(count):
            for row in range(rows):
                x, w, y, h = left + k * width / count, width / count, bottom + row * height / rows, height / rows
                s.fill(x, y, w, h, colour * rng.uniform(0.96, 1.03))
                s.rim(x, y, w, h, 0.012, colour * 0.6)
                if rng.random() < 0.5:
                    s.relief(x + 0.06, y + 0.06, w - 0.12, h - 0.12, rng.uniform(0.1, 0.3), colour)
                if rng.random() < 0.7:
                    s.fill(x + w * (0.85 if k % 2 else 0.1), y + h * rng.uniform(0.4, 0.8), 0.03, min(0.14, h / 3), (60, 60, 64) if colour.mean() > 90 else (210, 210, 210))
                s.things.append(Thing("cupboard", x, y, w, h))

    if way in ("base", "both"):
        fronts(0.1, 0.72, rng.uniform(0.35, 0.6), int(rng.integers(1, 4)))
        s.fill(left - 0.02, 0.84, width + 0.04, 0.05, pick(rng, WOODS + PAINTS))
    if way in ("wall", "both"):
        fronts(1.4, rng.uniform(0.5, 0.8), rng.uniform(0.35, 0.6), 1)
    if way == "wardrobe":
        fronts(0.05, rng.uniform(1.7, 2.3), rng.uniform(0.4, 0.6), 1 if rng.random() < 0.4 else 2)
    if way == "lockers":
        fronts(0.1, rng.uniform(1.6, 2.0), rng.uniform(0.25, 0.4), int(rng.integers(2, 5)))
    if way == "fridge":
        colour, w, h = pick(rng, [(240, 240, 242), (180, 182, 186), (40, 40, 42)], 8), 0.65, rng.uniform(1.4, 1.9)
        split = h * rng.choice([0.3, 0.65])
        for y, part in ((0.04, split), (0.04 + split, h - split)):
            s.fill(left, y, w, part, colour)
            s.rim(left, y, w, part, 0.012, colour * 0.6)
            s.fill(left + 0.04, y + part * 0.3, 0.03, part * 0.4, colour * 0.7)
            s.things.append(Thing("cupboard", left, y, w, part))
    if way == "shelf":
        h = rng.uniform(0.8, 2.1)
        s.fill(left, 0, width, h, colour * 0.5)
        for y in numpy.arange(0, h, 0.32):
            s.fill(left, y, width, 0.03, colour)
            x = left
            while x < left + width - 0.05:
                w = rng.uniform(0.02, 0.09)
                s.fill(x, y + 0.03, w, rng.uniform(0.12, 0.26), pick(rng, PAINTS + WOODS))
                x += w + (rng.uniform(0, 0.2) if rng.random() < 0.2 else 0)


def paint_window(s: Surface, left: float, width: float, bottom: float, height: float) -> None:
    rng = s.rng
    colour = pick(rng, PAINTS[:4] * 3 + WOODS + PAINTS)
    thick = rng.uniform(0.04, 0.1)
    s.fill(left - thick, bottom - thick, width + 2 * thick, height + 2 * thick, colour)
    panes(s, left, bottom, width, height, (int(rng.integers(1, 4)), int(rng.integers(1, 5))), colour)
    if rng.random() < 0.3:
        s.fill(left - 0.1, bottom - thick - 0.04, width + 0.2, 0.05, colour * 0.9)
    if rng.random() < 0.2:  # curtains or shutters
        cloth, w = pick(rng, PAINTS + WALLS), width * rng.uniform(0.15, 0.5)
        for x in (left - w * 0.5, left + width - w * 0.5):
            s.fill(x, bottom - rng.uniform(0, 0.6), w, height + 0.2, cloth)
            grain(rng, s.part(x, bottom, w, height), 0.2)


def paint_picture(s: Surface, left: float, width: float, bottom: float, height: float) -> None:
    rng = s.rng
    s.fill(left, bottom, width, height, pick(rng, PAINTS + WOODS))
    part = s.part(left + 0.04, bottom + 0.04, width - 0.08, height - 0.08)
    part[...] = pick(rng, WALLS + PAINTS)
    if textures.BEYOND.fill(rng, part, 0.6):
        return
    for _ in range(rng.integers(0, 6)):
        x, y = rng.uniform(0, 0.8) * width, rng.uniform(0, 0.8) * height
        s.fill(left + x, bottom + y, rng.uniform(0.1, 0.3) * width, rng.uniform(0.1, 0.3) * height, pick(rng, PAINTS))


def paint_panel(s: Surface, left: float, width: float) -> None:
    """Upright and none the less no door: a mirror, a curtain, a board, a heater, a shutter."""
    rng = s.rng
    way = rng.choice(["mirror", "curtain", "board", "heater", "panel"])
    if way == "mirror":
        bottom, height = rng.uniform(0.1, 1.0), rng.uniform(0.8, 1.7)
        s.fill(left, bottom, width, height, pick(rng, WOODS + PAINTS))
        glass(s, left + 0.05, bottom + 0.05, width - 0.1, height - 0.1)
    elif way == "curtain":
        height = rng.uniform(1.6, 2.4)
        bottom = rng.uniform(0.0, 0.4)
        s.fill(left, bottom, width, height, pick(rng, PAINTS + WALLS, 24))
        part = s.part(left, bottom, width, height)
        folds = numpy.cumsum(rng.normal(0, 1, part.shape[1])) * 0.5
        part *= (1 + 0.22 * numpy.sin(folds)).astype(numpy.float32)[None, :, None]
    elif way == "board":
        s.fill(left, 0.9, width, 1.1, pick(rng, WOODS + PAINTS))
        s.fill(left + 0.04, 0.94, width - 0.08, 1.02, pick(rng, [(244, 246, 246), (40, 70, 56), (180, 140, 90)]))
        for _ in range(int(rng.integers(0, 9))):
            s.fill(left + rng.uniform(0.05, 0.8) * width, rng.uniform(1.0, 1.7), rng.uniform(0.1, 0.25), rng.uniform(0.1, 0.25), pick(rng, PAINTS[:4] + PAINTS))
    elif way == "heater":
        height = rng.uniform(0.4, 0.9)
        s.fill(left, 0.12, width, height, pick(rng, PAINTS[:4]))
        for x in numpy.arange(0.0, width, 0.07):
            s.shade(left + x, 0.12, 0.02, height, 0.75)
    else:
        s.fill(left, 0.0, width, s.height, pick(rng, WALLS + WOODS + PAINTS))
        grain(rng, s.part(left, 0.0, width, s.height), rng.uniform(0.0, 0.12))


def furnish(s: Surface, outside: bool) -> list[Thing]:
    """Doors and other things from left to right. Returns the openings whose leaf stands out of the wall."""
    rng = s.rng
    opened: list[Thing] = []
    chance = numpy.array([0.36, 0.0, 0.34, 0.04, 0.06, 0.16, 0.04] if outside else [0.32, 0.15, 0.11, 0.11, 0.06, 0.15, 0.1])
    x = rng.uniform(0.0, 0.9)
    while x < s.width - 0.5:
        kind = rng.choice(["door", "cupboards", "window", "picture", "arch", "nothing", "panel"], p=chance)
        if kind == "door":
            width = rng.uniform(0.7, 1.05) if rng.random() < 0.75 else rng.uniform(1.3, 1.9)
            height = min(s.height - 0.1, rng.uniform(1.95, 2.3) + (rng.uniform(0, 0.5) if outside else 0))
            opens = not outside and width < 1.2 and rng.random() < 0.22
            bottom = rng.choice([0.0, 0.15, 0.3], p=[0.7, 0.15, 0.15]) if outside else 0.0
            if bottom:
                s.fill(x - 0.3, 0, width + 0.6, bottom, pick(rng, WALLS) * 0.85)
            if x + width < s.width - 0.05:
                paint_door(s, x, width, min(height, s.height - bottom - 0.08), bottom, opens)
                if opens:
                    opened.append(Thing("leaf", x, 0.0, width, height))
        elif kind == "cupboards":
            width = rng.uniform(0.7, 2.6)
            paint_cupboards(s, x, width)
        elif kind == "window":
            width, height = rng.uniform(0.5, 1.8), rng.uniform(0.7, 1.6)
            paint_window(s, x, width, rng.uniform(0.6, 1.1), min(height, s.height - 1.2))
        elif kind == "picture":
            width = rng.uniform(0.3, 1.2)
            paint_picture(s, x, width, rng.uniform(1.0, 1.4), rng.uniform(0.3, 0.9))
        elif kind == "panel":
            width = rng.uniform(0.4, 1.6)
            paint_panel(s, x, width)
        elif kind == "arch":
            width = rng.uniform(0.8, 1.6)
            s.fill(x, 0, width, rng.uniform(2.0, 2.4), pick(rng, WALLS + [(30, 28, 26)]) * rng.uniform(0.3, 0.95))
            blotches(rng, s.part(x, 0, width, 2.2), 0.25, 4)
        else:
            width = rng.uniform(0.3, 1.5)
        x += width + rng.uniform(0.05, 0.9)
    if rng.random() < 0.3:  # a switch, a fire extinguisher, a plate
        s.fill(rng.uniform(0, s.width), rng.uniform(0.9, 1.6), rng.uniform(0.06, 0.2), rng.uniform(0.06, 0.4), pick(rng, PAINTS))
    textures.shaded_corners(rng, s.pixels)
    return opened
