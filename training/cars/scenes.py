"""Car parks as a drone sees them: asphalt with its age, lines with theirs, rows of slots some of which are taken, aisles, islands, trees, and shadows.

Everything is drawn by random numbers, at FINER times the size of the picture, and labelled with what was drawn: vehicles as turned boxes round what is seen
of them, slots by their corners, and which pixels belong to a vehicle.
"""

from __future__ import annotations

import dataclasses
import math

import numpy
from PIL import Image, ImageChops, ImageDraw, ImageFilter

import surroundings
import vehicles

FINER = 2


@dataclasses.dataclass
class Labelled:
    pixels: numpy.ndarray  # RGB
    cars: numpy.ndarray  # middle x and y, length, width, heading, share that is seen: pixels and radians, x to the right and y down
    covered: numpy.ndarray  # 255 where a vehicle is seen
    slots: numpy.ndarray  # 4 corners each: the mouth's two, then the head's two
    taken: numpy.ndarray
    metres: float  # a pixel


@dataclasses.dataclass
class Slot:
    x: float
    y: float
    heading: float  # from its mouth to its head
    width: float
    depth: float
    slant: float  # of its sides against the row's normal
    taken: bool = False
    parkable: bool = True

    def corners(self) -> numpy.ndarray:
        along = numpy.array([-math.sin(self.heading - self.slant), math.cos(self.heading - self.slant)]) * self.width / math.cos(self.slant) / 2
        deep = numpy.array([math.cos(self.heading), math.sin(self.heading)]) * self.depth / 2
        middle = numpy.array([self.x, self.y])
        flat = numpy.array([middle - deep - along, middle - deep + along, middle + deep + along, middle + deep - along])
        return numpy.concatenate([flat, numpy.zeros((4, 1))], 1)


class View:
    """From metres (east, south, up) to pixels of the canvas; what stands high leans away from below the camera."""

    def __init__(self, rng: numpy.random.Generator, side: int, metres: float):
        self.scale, self.middle = FINER / metres, side * FINER / 2
        turn = rng.uniform(0, 2 * math.pi) if rng.random() < 0.6 else rng.choice([0, 0.5, 1, 1.5]) * math.pi + rng.normal(0, 0.03)
        oblique = rng.random() < 0.25
        tilt = math.radians(rng.uniform(10, 40)) if oblique else 0.0
        toward = rng.uniform(0, 2 * math.pi)
        away = numpy.array([math.cos(toward), math.sin(toward)])
        rotation = numpy.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
        self.flatten = (numpy.eye(2) - (1 - math.cos(tilt)) * numpy.outer(away, away)) @ rotation
        self.lean = away * math.sin(tilt) + rng.normal(0, 0.06, 2)
        self.spread = 1 / rng.uniform(35, 130)

    def __call__(self, points: numpy.ndarray) -> numpy.ndarray:
        ground = points[:, :2] @ self.flatten.T
        lifted = ground + points[:, 2:3] * (self.lean + ground * self.spread)
        return lifted * self.scale + self.middle


def cloud(rng: numpy.random.Generator, size: int, cells: int) -> numpy.ndarray:
    """Smooth noise of unit spread."""
    small = Image.fromarray(rng.normal(0, 1, (cells, cells)).astype(numpy.float32))
    return numpy.asarray(small.resize((size, size), Image.Resampling.BICUBIC))


def ground(rng: numpy.random.Generator, size: int) -> Image.Image:
    tone = rng.choice([rng.uniform(40, 90), rng.uniform(80, 150), rng.uniform(140, 205)], p=[0.35, 0.45, 0.2])
    tint = numpy.array([rng.normal(0, 4), 0, rng.normal(0, 6)]) + (rng.uniform(0, 22) * numpy.array([1.2, 0.6, -1.0]) if rng.random() < 0.25 else 0)
    value = numpy.full((size, size), tone, numpy.float32)
    for cells, spread in ((3, 7), (9, 5), (40, 3), (150, 3)):
        value += cloud(rng, size, cells) * rng.uniform(0.2, 1) * spread
    value += rng.normal(0, rng.uniform(1, 8), (size, size)).astype(numpy.float32)
    return Image.fromarray(numpy.clip(value[..., None] + tint, 0, 255).astype(numpy.uint8))


def rows_of(rng: numpy.random.Generator, reach: float) -> tuple[list[Slot], list[tuple]]:
    """Slots, and the lines that bound them: (points, width)."""
    pitch, depth = rng.uniform(2.35, 3.05), rng.uniform(4.6, 5.8)
    slant = rng.choice([0.0, rng.uniform(0.2, 0.75)], p=[0.75, 0.25])
    pitch /= math.cos(slant)  # a slanted slot is as wide as others
    double, hairpin, spine = rng.random() < 0.65, rng.random() < 0.12, rng.random() < 0.7
    aisle, line = rng.uniform(4.5, 8.0), rng.uniform(0.09, 0.17)
    slots, lines = [], []
    across = -reach + rng.uniform(0, 6)
    while across < reach:
        for facing in ((1, -1) if double else (rng.choice([1, -1]),)):
            begin, end = sorted(rng.uniform(-reach, reach, 2)) if rng.random() < 0.5 else (-reach, reach)
            count = int((end - begin) / pitch)
            if count < 2:
                continue
            head = across + (depth if double else (depth if facing > 0 else 0))
            shift = facing * depth * math.tan(slant)
            for k in range(count + 1):
                at = begin + k * pitch
                mouth = (at - shift, head - facing * depth)
                offsets = (-0.2, 0.2) if hairpin else (0.0,)
                for offset in offsets:
                    lines.append(([(mouth[0] + offset, mouth[1]), (at + offset, head)], line))
                if hairpin:
                    lines.append(([(mouth[0] - 0.2, mouth[1]), (mouth[0] + 0.2, mouth[1])], line))
                if k < count:
                    heading = math.atan2(facing * depth, shift)
                    middle = (at + (pitch - shift) / 2, head - facing * depth / 2)
                    slots.append(Slot(*middle, heading, pitch * math.cos(slant), depth / math.cos(slant), -slant))
            if spine:
                lines.append(([(begin, head), (begin + count * pitch, head)], line))
        across += (2 * depth if double else depth) + aisle
    return slots, lines


def worn(rng: numpy.random.Generator, size: int) -> Image.Image:
    """How much of the paint is left."""
    left = rng.uniform(0.35, 1.0) + cloud(rng, size, 60) * rng.uniform(0, 0.3) + cloud(rng, size, 8) * rng.uniform(0, 0.2)
    return Image.fromarray((255 * numpy.clip(left, 0, 1)).astype(numpy.uint8))


def paint(rng: numpy.random.Generator, canvas: Image.Image, view: View, lines, slots: list[Slot]) -> None:
    size = canvas.size[0]
    mask = Image.new("L", canvas.size, 0)
    brush = ImageDraw.Draw(mask)
    for points, width in lines:
        seen = view(numpy.array([(*p, 0.0) for p in points]))
        brush.line([tuple(p) for p in seen], fill=255, width=max(1, round(width * view.scale)))
    for slot in slots:
        if rng.random() < 0.04:  # hatched, or with a sign on the ground
            slot.parkable = False
            a, b, c, d = slot.corners()
            for t in numpy.linspace(0.05, 0.95, 9):
                seen = view(numpy.array([a + (d - a) * t, b + (c - b) * max(0.0, t - 0.15)]))
                brush.line([tuple(p) for p in seen], fill=255, width=max(1, round(0.12 * view.scale)))
        elif rng.random() < 0.05:
            x, y = view(numpy.array([(slot.x, slot.y, 0.0)]))[0]
            r = rng.uniform(0.3, 0.7) * view.scale
            brush.ellipse([x - r, y - r, x + r, y + r], outline=255, width=max(1, round(0.12 * view.scale)))
    for _ in range(rng.integers(0, 4)):  # arrows and stray lines
        at, way = rng.uniform(-20, 20, 2), rng.normal(0, 2.0, 2)
        brush.line([tuple(p) for p in view(numpy.array([(*at, 0), (*(at + way), 0)]))], fill=255, width=max(1, round(0.15 * view.scale)))
    colour = [(235, 236, 234), (225, 225, 220), (215, 175, 70), (150, 190, 225)][rng.choice(4, p=[0.55, 0.25, 0.15, 0.05])]
    canvas.paste(Image.new("RGB", canvas.size, colour), (0, 0), ImageChops.multiply(mask, worn(rng, size)))


def cracks(rng: numpy.random.Generator, canvas: Image.Image) -> None:
    brush, size = ImageDraw.Draw(canvas), canvas.size[0]
    tone = lambda low, high: (int(rng.uniform(low, high)),) * 3
    for _ in range(rng.integers(0, 6)):  # mended places
        x, y, w, h = rng.uniform(0, size), rng.uniform(0, size), rng.uniform(0.02, 0.3) * size, rng.uniform(0.02, 0.2) * size
        part = canvas.crop((int(x), int(y), int(x + w), int(y + h)))
        if part.size[0] and part.size[1]:
            canvas.paste(part.point(lambda v, k=rng.uniform(0.75, 1.2): v * k), (int(x), int(y)))
    for _ in range(rng.integers(0, 10)):
        at = rng.uniform(0, size, 2)
        points = [at := at + rng.normal(0, 0.02 * size, 2) for _ in range(rng.integers(3, 14))]
        brush.line([tuple(p) for p in points], fill=tone(15, 70), width=int(rng.integers(1, 4)))
    for _ in range(rng.integers(0, 40)):  # oil, drains, leaves
        x, y, r = *rng.uniform(0, size, 2), rng.uniform(1, 9)
        brush.ellipse([x - r, y - r * rng.uniform(0.4, 1), x + r, y + r], fill=tone(15, 90))


def islands(rng: numpy.random.Generator, canvas: Image.Image, view: View, slots: list[Slot]) -> None:
    """Grass, kerbs, roofs and walks; slots under them are none."""
    brush = ImageDraw.Draw(canvas)
    greens = [(70, 90, 45), (95, 105, 60), (150, 140, 105), (175, 165, 140), (120, 60, 50), (190, 190, 186), (160, 80, 60)]
    for _ in range(rng.integers(0, 6)):
        x, y = rng.uniform(-26, 26, 2)
        w, h = (rng.uniform(1, 4), rng.uniform(3, 25)) if rng.random() < 0.6 else rng.uniform(4, 18, 2)
        if rng.random() < 0.5:
            w, h = h, w
        outline = numpy.array([(x - w, y - h, 0), (x + w, y - h, 0), (x + w, y + h, 0), (x - w, y + h, 0)])
        colour = numpy.array(greens[rng.integers(len(greens))]) + rng.normal(0, 12, 3)
        brush.polygon([tuple(p) for p in view(outline)], fill=tuple(int(c) for c in numpy.clip(colour, 0, 255)), outline=(190, 188, 180))
        for slot in slots:
            if abs(slot.x - x) < w + 2.5 and abs(slot.y - y) < h + 2.5:
                slot.parkable = False
    size = canvas.size[0]
    grain = rng.normal(0, 6, (size, size, 1)) + 4 * cloud(rng, size, 200)[..., None]
    canvas.paste(Image.fromarray(numpy.clip(numpy.asarray(canvas, numpy.float32) + grain, 0, 255).astype(numpy.uint8)))


def clutter(rng: numpy.random.Generator, canvas: Image.Image, view: View) -> None:
    """What is no car: bins, trolleys, pallets, roof lights, people."""
    brush = ImageDraw.Draw(canvas)
    for _ in range(rng.integers(0, 14)):
        x, y = rng.uniform(-24, 24, 2)
        w, h, z = rng.uniform(0.2, 1.3), rng.uniform(0.3, 2.0), rng.uniform(0.1, 2.0)
        turn = rng.uniform(0, math.pi)
        c, s = math.cos(turn), math.sin(turn)
        corners = numpy.array([(x + c * a - s * b, y + s * a + c * b, 0) for a, b in ((-w, -h), (w, -h), (w, h), (-w, h))])
        colour = rng.integers(20, 240, 3)
        colour = colour if rng.random() < 0.4 else colour.mean() + 0.25 * (colour - colour.mean())
        for lift in numpy.linspace(0, z, 4):
            brush.polygon([tuple(p) for p in view(corners + [0, 0, lift])], fill=tuple(int(v) for v in colour * (0.6 if lift < z else 1.0)))


def crowns_of(rng: numpy.random.Generator) -> list[tuple[numpy.ndarray, float]]:
    """Middle and radius of what grows there."""
    count = rng.integers(1, 7) if rng.random() < 0.5 else 0
    return [(numpy.array([*rng.uniform(-25, 25, 2), rng.uniform(3, 7)]), rng.uniform(1.0, 4.0)) for _ in range(count)]


def trees(rng: numpy.random.Generator, canvas: Image.Image, covered: Image.Image, view: View, crowns) -> None:
    brush, mask = ImageDraw.Draw(canvas), ImageDraw.Draw(covered)
    for middle, radius in crowns:
        green = numpy.array([(60, 85, 40), (45, 65, 35), (85, 95, 55), (110, 90, 60)][rng.integers(4)], float)
        for _ in range(140):
            at = view((middle + rng.normal(0, 0.45, 3) * radius * [1, 1, 0.3])[None])[0]
            r = rng.uniform(0.06, 0.3) * radius * view.scale
            box = [at[0] - r, at[1] - r, at[0] + r, at[1] + r]
            brush.ellipse(box, fill=tuple(int(v) for v in numpy.clip(green * rng.uniform(0.55, 1.45), 0, 255)))
            mask.ellipse(box, fill=0)


def drive(rng: numpy.random.Generator, places) -> list[vehicles.Vehicle]:
    """Along a street, now and then a bus, which takes the room of what would come next."""
    there: list[vehicles.Vehicle] = []
    for x, y, heading in places:
        bus = rng.random() < 0.06
        if not any(math.hypot(car.x - x, car.y - y) < (12.5 if bus else 3.2 + car.length / 2) and abs(math.sin(math.atan2(y - car.y, x - car.x) - heading)) < 0.35 for car in there):
            there.append(vehicles.parked(rng, x, y, heading, vehicles.BUS if bus else None))
    return there


def park(rng: numpy.random.Generator, slots: list[Slot]) -> list[vehicles.Vehicle]:
    there = []
    full = rng.choice([rng.uniform(0, 0.15), rng.uniform(0.1, 0.7), rng.uniform(0.6, 1.0)], p=[0.15, 0.4, 0.45])
    for slot in slots:
        if not slot.parkable or rng.random() > full:
            continue
        heading = slot.heading + (math.pi if rng.random() < 0.4 else 0) + rng.normal(0, 0.03)
        slip = rng.normal(0, 0.3)
        there.append(vehicles.parked(rng, slot.x + slip * math.cos(slot.heading) + rng.normal(0, 0.1), slot.y + slip * math.sin(slot.heading) + rng.normal(0, 0.1), heading))
        slot.taken = True
    for _ in range(rng.integers(0, 6)):  # on their way, or where they should not be
        x, y = rng.uniform(-24, 24, 2)
        if all(math.hypot(car.x - x, car.y - y) > 5.4 for car in there):
            there.append(vehicles.parked(rng, x, y, rng.uniform(0, 2 * math.pi)))
            for slot in slots:
                if math.hypot(slot.x - x, slot.y - y) < 3.2:
                    slot.parkable = False  # neither taken nor free: not told
    return there


def box_of(car: vehicles.Vehicle, view: View) -> tuple[float, float, float, float, float]:
    """Of all that is seen of it, along its own axis."""
    seen = view(numpy.concatenate(vehicles.silhouette(car)))
    tail, nose = view(car.placed([(-1, 0), (1, 0)], 0.6))
    way = (nose - tail) / numpy.linalg.norm(nose - tail)
    along, across = seen @ way, seen @ numpy.array([-way[1], way[0]])
    a, b = (along.min() + along.max()) / 2, (across.min() + across.max()) / 2
    middle = a * way + b * numpy.array([-way[1], way[0]])
    return (*middle / FINER, (along.max() - along.min()) / FINER, (across.max() - across.min()) / FINER, math.atan2(way[1], way[0]))


def share_seen(covered: numpy.ndarray, box) -> float:
    """How much of the box shows a vehicle: little where a tree stands over it, or where the picture ends."""
    x, y, length, width, heading = box
    u, v = numpy.meshgrid(numpy.linspace(-0.42, 0.42, 9), numpy.linspace(-0.35, 0.35, 5))
    c, s = math.cos(heading), math.sin(heading)
    columns, rows = (x + c * u * length - s * v * width).astype(int), (y + s * u * length + c * v * width).astype(int)
    inside = (columns >= 0) & (rows >= 0) & (columns < covered.shape[1]) & (rows < covered.shape[0])
    return float((covered[rows * inside, columns * inside] * inside > 100).mean())


def shaded(rng: numpy.random.Generator, canvas: Image.Image, view: View, there, crowns, sun: numpy.ndarray) -> Image.Image:
    mask = Image.new("L", canvas.size, 0)
    brush = ImageDraw.Draw(mask)
    for car in there:
        for outline in vehicles.silhouette(car):
            fallen = numpy.concatenate([outline[:, :2] + outline[:, 2:3] * sun, numpy.zeros((len(outline), 1))], 1)
            brush.polygon([tuple(p) for p in view(fallen)], fill=255)
    for middle, radius in crowns:
        at = view(numpy.array([[*(middle[:2] + middle[2] * sun), 0.0]]))[0]
        r = radius * view.scale
        brush.ellipse([at[0] - r, at[1] - r, at[0] + r, at[1] + r], fill=255)
    mask = mask.filter(ImageFilter.GaussianBlur(rng.uniform(0.5, 2.5)))
    dark = rng.uniform(0.25, 0.75)
    return Image.composite(canvas.point(lambda v: v * dark), canvas, mask)


def render(rng: numpy.random.Generator, side: int, metres: float) -> Labelled:
    size = side * FINER
    view = View(rng, side, metres)
    canvas = ground(rng, size)
    is_street = rng.random() < 0.25
    places, edges = surroundings.street_of(rng) if is_street else ([], None)
    slots, lines = rows_of(rng, 0.75 * side * metres) if not is_street and rng.random() < 0.9 else ([], [])
    if rng.random() < 0.75:
        cracks(rng, canvas)
    if is_street:
        surroundings.draw_street(rng, canvas, view, edges)
    if rng.random() < (0.95 if is_street else 0.35):
        surroundings.street_paint(rng, canvas, view)
    if rng.random() < 0.9:
        paint(rng, canvas, view, lines, slots)
    islands(rng, canvas, view, slots)
    if rng.random() < 0.5:
        surroundings.beds(rng, canvas, view)
    clutter(rng, canvas, view)
    houses, posts = surroundings.houses_of(rng), surroundings.posts_of(rng)
    slots = [slot for slot in slots if not any(house.is_near(slot.x, slot.y) for house in houses)]
    there = [car for car in park(rng, slots) + drive(rng, places) if not any(house.is_near(car.x, car.y) for house in houses)]
    sunny = rng.random() < 0.75
    angle, low = rng.uniform(0, 2 * math.pi), rng.uniform(0.15, 1.6) if sunny else 0.08
    sun = low * numpy.array([math.cos(angle), math.sin(angle)])
    covered = Image.new("L", canvas.size, 0)
    crowns = crowns_of(rng)
    canvas = shaded(rng, canvas, view, there, crowns, sun)
    fallen = [outline for house in houses for outline in surroundings.shadow_of(house, sun)] if sunny else []
    dims_cars = rng.random() < 0.6  # the shadow of houses falls on vehicles, or beside them
    if not dims_cars:
        canvas = surroundings.blurred_shadow(rng, canvas, view, fallen, posts if sunny else [], sun)
    brush, mask = ImageDraw.Draw(canvas), ImageDraw.Draw(covered)
    for car in there:
        vehicles.draw(rng, brush, car, view, angle)
        for outline in vehicles.silhouette(car):
            mask.polygon([tuple(p) for p in view(outline)], fill=255)
    if dims_cars:
        canvas = surroundings.blurred_shadow(rng, canvas, view, fallen, posts if sunny else [], sun)
    surroundings.draw_posts(rng, canvas, view, posts)
    trees(rng, canvas, covered, view, crowns)
    surroundings.draw_houses(rng, canvas, covered, view, houses)
    told = [slot for slot in slots if slot.parkable or slot.taken]
    corners = numpy.array([view(slot.corners()) / FINER for slot in told], numpy.float32).reshape(-1, 4, 2)
    small = canvas.resize((side, side), Image.Resampling.BOX)
    seen = numpy.asarray(covered.resize((side, side), Image.Resampling.BOX))
    cars = [(*box, share_seen(seen, box)) for box in (box_of(car, view) for car in there if car.kind is not vehicles.BUS)]
    return Labelled(numpy.asarray(small), numpy.array(cars, numpy.float32).reshape(-1, 6), seen, corners, numpy.array([slot.taken for slot in told], bool), metres)
