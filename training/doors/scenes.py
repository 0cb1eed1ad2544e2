"""Rendered rooms, corridors and house fronts with doors, and where the doors are in the picture.

A scene is a few surfaces (surface.py, walls.py) in three dimensions, seen by a camera that somebody holds: not quite level, not quite straight, in bad light.
"""

from __future__ import annotations

import copy
import dataclasses
import io
import math

import numpy
from PIL import Image, ImageDraw, ImageFilter

import furniture
import walls
import textures
from surface import PAINTS, WALLS, WOODS, Surface, Thing, blotches, pick

NEAR = 0.12
DRAWN_LARGER = 1.5  # than told, against jagged edges


@dataclasses.dataclass
class Labelled:
    """A picture, and what is in it: boxes in pixels, left, top, right, bottom, of the visible part of each; then 1 where that is enough to tell what it is, or 0."""
    pixels: numpy.ndarray
    doors: numpy.ndarray
    cupboards: numpy.ndarray


class Camera:
    def __init__(self, size: tuple[int, int], eye: numpy.ndarray, field: float, yaw: float, pitch: float, roll: float):
        """`yaw` to the right of straight ahead (z), `pitch` up, in radians; `field` of view along the longer side."""
        self.size, self.eye = size, eye
        self.focal = max(size) / 2 / math.tan(field / 2)
        cy, sy, cp, sp, cr, sr = math.cos(yaw), math.sin(yaw), math.cos(pitch), math.sin(pitch), math.cos(roll), math.sin(roll)
        turn = numpy.array([[cy, 0, -sy], [0, 1, 0], [sy, 0, cy]])
        nod = numpy.array([[1, 0, 0], [0, cp, -sp], [0, sp, cp]])
        lean = numpy.array([[cr, -sr, 0], [sr, cr, 0], [0, 0, 1]])
        self.matrix = lean @ nod @ turn

    def seen(self, points) -> numpy.ndarray:
        """In the camera's frame: right, up, ahead."""
        return (numpy.asarray(points, float) - self.eye) @ self.matrix.T

    def pixels(self, points) -> numpy.ndarray:
        at = self.seen(points)
        return numpy.stack([self.size[0] / 2 + self.focal * at[:, 0] / at[:, 2], self.size[1] / 2 - self.focal * at[:, 1] / at[:, 2]], 1)


@dataclasses.dataclass
class Placed:
    """A surface in the world: its lower left corner, the direction of its width, the direction of its height (unit vectors)."""
    surface: Surface
    origin: numpy.ndarray
    along: numpy.ndarray
    up: numpy.ndarray

    def corners(self, left: float, bottom: float, width: float, height: float) -> numpy.ndarray:
        point = lambda u, v: self.origin + self.along * u + self.up * v
        return numpy.array([point(left, bottom + height), point(left + width, bottom + height), point(left + width, bottom), point(left, bottom)])

    def whole(self) -> numpy.ndarray:
        return self.corners(0, 0, self.surface.width, self.surface.height)


def homography(source: numpy.ndarray, target: numpy.ndarray) -> list[float]:
    """Eight numbers that take points of `source` to `target`."""
    rows, right = [], []
    for (x, y), (u, v) in zip(source, target, strict=True):
        rows += [[x, y, 1, 0, 0, 0, -u * x, -u * y], [0, 0, 0, x, y, 1, -v * x, -v * y]]
        right += [u, v]
    return numpy.linalg.solve(numpy.array(rows), numpy.array(right)).tolist()


def put(canvas: Image.Image, camera: Camera, placed: Placed, light: float) -> None:
    """Draws a surface whose corners all lie ahead of the camera."""
    corners = placed.whole()
    if camera.seen(corners)[:, 2].min() < NEAR * 0.9:
        return
    at = camera.pixels(corners)
    low, high = numpy.floor(at.min(0)).astype(int), numpy.ceil(at.max(0)).astype(int)
    low, high = numpy.maximum(low, 0), numpy.minimum(high, canvas.size)
    if (high - low).min() < 2:
        return
    shaded = numpy.clip(placed.surface.pixels * light, 0, 255).astype(numpy.uint8)
    height, width = shaded.shape[:2]
    try:
        back = homography(at - low, numpy.array([[1, 1], [width - 1, 1], [width - 1, height - 1], [1, height - 1]], float))
    except numpy.linalg.LinAlgError:
        return
    size = tuple(int(n) for n in high - low)
    flat = Image.fromarray(shaded).transform(size, Image.Transform.PERSPECTIVE, back, Image.Resampling.BILINEAR)
    mask = Image.new("L", size, 0)
    ImageDraw.Draw(mask).polygon([tuple(p) for p in at - low], fill=255)
    canvas.paste(flat, tuple(int(n) for n in low), mask)


def within(polygon: numpy.ndarray, size: tuple[int, int]) -> numpy.ndarray:
    """The part of a polygon that lies in the picture."""
    for axis, sign, most in ((0, 1, 0), (1, 1, 0), (0, -1, size[0]), (1, -1, size[1])):
        inside = sign * polygon[:, axis] >= sign * most
        kept = []
        for k in range(len(polygon)):
            a, b = polygon[k - 1], polygon[k]
            if inside[k - 1] != inside[k]:
                kept.append(a + (b - a) * (most - a[axis]) / (b[axis] - a[axis]))
            if inside[k]:
                kept.append(b)
        if len(kept) < 3:
            return numpy.empty((0, 2))
        polygon = numpy.array(kept)
    return polygon


def area(polygon: numpy.ndarray) -> float:
    x, y = polygon[:, 0], polygon[:, 1]
    return abs(float(x @ numpy.roll(y, 1) - y @ numpy.roll(x, 1))) / 2


WHOLE_ENOUGH, LARGE_ENOUGH = 0.15, 0.06  # parts: of the thing that is seen, of the picture that it fills


def box_of(camera: Camera, corners: numpy.ndarray) -> tuple[float, ...] | None:
    """What the picture shows of it, and whether that is enough to tell what it is; or nothing where it shows none of it."""
    if camera.seen(corners)[:, 2].min() < NEAR * 0.9:
        return None
    at = camera.pixels(corners)
    shown = within(at, camera.size)
    if not len(shown):
        return None
    part = area(shown)
    (x0, y0), (x1, y1) = shown.min(0), shown.max(0)
    if min(x1 - x0, y1 - y0) < 3:
        return None
    filled = part / (camera.size[0] * camera.size[1])
    enough = filled < 0.97 and (part > WHOLE_ENOUGH * area(at) or filled > LARGE_ENOUGH)
    return x0 / DRAWN_LARGER, y0 / DRAWN_LARGER, x1 / DRAWN_LARGER, y1 / DRAWN_LARGER, float(enough)


def ahead_of(camera: Camera, placed: Placed) -> tuple[float, float] | None:
    """From where to where along its width an upright surface lies ahead of the camera."""
    ends = [camera.seen(placed.corners(u, 0, 0, placed.surface.height))[:, 2].min() for u in (0.0, placed.surface.width)]
    if max(ends) < 2 * NEAR:
        return None
    meets = placed.surface.width * (NEAR - ends[0]) / (ends[1] - ends[0]) if min(ends) < NEAR else 0.0
    return (meets if ends[0] < NEAR else 0.0), (meets if ends[1] < NEAR else placed.surface.width)


def part_of(placed: Placed, start: float, end: float) -> Placed:
    s = copy.copy(placed.surface)
    first, last = math.ceil(start * s.scale), math.floor(end * s.scale)
    s.pixels, s.width = s.pixels[:, first:last], (last - first) / s.scale
    return Placed(s, placed.origin + placed.along * first / s.scale, placed.along, placed.up)


UP = numpy.array([0.0, 1.0, 0.0])
LEAF_THICK = 0.045


def lay(rng, pixels: numpy.ndarray, camera: Camera, height: float, colours, light: float) -> None:
    """A floor or a ceiling without end, wherever the picture looks down or up at it; walls are drawn over it."""
    s = Surface(rng, 10.0, 10.0, 20)
    s.pixels[...] = pick(rng, colours)
    if rng.random() < 0.6:
        step, line = rng.choice([0.125, 0.25, 0.5, 1.0]), rng.uniform(0.7, 1.2)
        for at in numpy.arange(0, s.width, step):
            s.shade(at, 0, 0.05, s.height, line)
        if rng.random() < 0.6:
            for at in numpy.arange(0, s.height, step):
                s.shade(0, at, s.width, 0.05, line)
    blotches(rng, s.pixels, 0.12, 5)
    if rng.random() < 0.6:
        textures.rough(rng, s.pixels, rng.uniform(0.03, 0.2), rng.uniform(6, 40))
    if rng.random() < 0.3:
        textures.BEYOND.grain(rng, s.pixels, rng.uniform(0.05, 0.4))
    width, height_px = camera.size
    x, y = numpy.meshgrid((numpy.arange(width) + 0.5 - width / 2) / camera.focal, -(numpy.arange(height_px) + 0.5 - height_px / 2) / camera.focal)
    ray = numpy.stack([x, y, numpy.ones_like(x)], 2) @ camera.matrix
    far = (height - camera.eye[1]) / numpy.where(numpy.abs(ray[..., 1]) < 1e-3, 1e-3, ray[..., 1])
    seen = (far > 0) & (numpy.abs(ray[..., 1]) > 1e-2)
    across, down = ((far * ray[..., 0] + camera.eye[0]) * s.scale).astype(int) % s.pixels.shape[1], ((far * ray[..., 2] + camera.eye[2]) * s.scale).astype(int) % s.pixels.shape[0]
    pixels[seen] = (s.pixels[down, across] * light)[seen]


def clutter(rng, canvas: Image.Image, count: int) -> None:
    """Plants, people, what stands right before the camera: spots without straight edges."""
    width, height = canvas.size
    draw = ImageDraw.Draw(canvas)
    for _ in range(count):
        if rng.random() < 0.4:
            x, foot, tall = rng.uniform(0, width), rng.uniform(0.6, 1.2) * height, rng.uniform(0.3, 0.9) * height
            shirt, skin = pick(rng, PAINTS, 25), pick(rng, [(224, 190, 160), (140, 100, 76), (90, 62, 46)])
            tone = lambda c, k=1.0: tuple(int(v) for v in numpy.clip(c * k, 0, 255))
            draw.rectangle([x - 0.11 * tall, foot - 0.5 * tall, x + 0.11 * tall, foot], fill=tone(pick(rng, PAINTS, 25)))
            draw.ellipse([x - 0.16 * tall, foot - 0.86 * tall, x + 0.16 * tall, foot - 0.4 * tall], fill=tone(shirt))
            draw.ellipse([x - 0.065 * tall, foot - tall, x + 0.065 * tall, foot - 0.82 * tall], fill=tone(skin))
            continue
        if rng.random() < 0.6:
            reach = rng.uniform(0.06, 0.3) * height
            textures.leaves(rng, draw, rng.uniform(0, width), rng.uniform(0.1, 1.05) * height, reach, int(rng.integers(40, 220)),
                            [(60, 100, 46), (90, 120, 60), (40, 70, 40), (130, 140, 80), (120, 70, 70), (90, 70, 50)], reach * rng.uniform(0.04, 0.14))
            continue
        x, y, r = rng.uniform(0, width), rng.uniform(0.4, 1.05) * height, rng.uniform(0.03, 0.14) * height
        colour = pick(rng, [(40, 90, 40), (70, 110, 50), (60, 50, 44), (120, 60, 60), (40, 40, 60), (200, 170, 140)], 20)
        for _ in range(rng.integers(3, 16)):
            a, b, q = x + rng.normal(0, r), y + rng.normal(0, r), r * rng.uniform(0.15, 0.7)
            draw.ellipse([a - q, b - q * rng.uniform(0.5, 2), a + q, b + q], fill=tuple(int(c) for c in numpy.clip(colour * rng.uniform(0.6, 1.3), 0, 255)))


def photographed(rng, canvas: Image.Image, size: tuple[int, int]) -> numpy.ndarray:
    """Light, lens, sensor and file."""
    picture = canvas.resize(size, Image.Resampling.BOX)
    if rng.random() < 0.5:
        picture = picture.filter(ImageFilter.GaussianBlur(rng.uniform(0.2, 1.3)))
    pixels = numpy.array(picture, numpy.float32)
    height, width = pixels.shape[:2]
    if rng.random() < 0.5:
        textures.rough(rng, pixels, rng.uniform(0.01, 0.06), rng.uniform(8, 40))
    y, x = numpy.mgrid[-1:1:height * 1j, -1:1:width * 1j].astype(numpy.float32)
    light = 1 + rng.uniform(-0.35, 0.35) * x + rng.uniform(-0.3, 0.3) * y
    for _ in range(rng.integers(0, 3)):  # lamps and shadows
        cx, cy, r = rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(0.2, 0.9)
        light = light + rng.uniform(-0.4, 0.7) * numpy.exp(-((x - cx) ** 2 + (y - cy) ** 2) / r**2)
    pixels = 255 * numpy.clip(pixels * light[..., None] * rng.uniform(0.92, 1.08, 3).astype(numpy.float32) / 255, 0, 1.1) ** rng.uniform(0.7, 1.5)
    pixels = pixels + rng.normal(0, rng.uniform(0, 7), pixels.shape)
    file = io.BytesIO()
    Image.fromarray(numpy.clip(pixels, 0, 255).astype(numpy.uint8)).save(file, "JPEG", quality=int(rng.integers(35, 95)))
    return numpy.asarray(Image.open(file))


@dataclasses.dataclass
class Room:
    """Walls with what is on them, open leaves, and the space between: x from `left` to `right`, z from `behind` to `ahead`."""
    outside: bool
    left: float
    right: float
    behind: float
    ahead: float
    high: float
    walls: list[Placed]
    leaves: list[Placed]
    edges: list[Placed] = dataclasses.field(default_factory=list)  # of the leaves, by number: how thick they are


def build(rng: numpy.random.Generator) -> Room:
    outside = bool(rng.random() < 0.35)
    half, ahead = rng.choice([rng.uniform(0.65, 1.2), rng.uniform(1.0, 3.2)]), rng.uniform(1.5, 6.0)
    room = Room(outside, -half, half, -rng.uniform(0.8, 2.5), ahead, rng.uniform(2.35, 3.2), [], [])
    if outside:
        room.left, room.right, room.ahead, room.high = -5.0, 5.0, 6.0, rng.uniform(2.8, 6.0)
    feet = [((room.left, 0, room.ahead), (room.right, 0, room.ahead))]
    if not outside:
        feet += [((room.left, 0, room.behind), (room.left, 0, ahead)), ((room.right, 0, ahead), (room.right, 0, room.behind)),
                 ((room.right, 0, room.behind), (room.left, 0, room.behind))]
    for start, end in (numpy.array(foot, float) for foot in feet):
        length = float(numpy.linalg.norm(end - start))
        along = (end - start) / length
        s = Surface(rng, length, room.high)
        walls.paint_wall(s, outside)
        wall = Placed(s, start, along, UP)
        for opening in walls.furnish(s, outside):
            into, angle, hinge_left = numpy.array([along[2], 0, -along[0]]), rng.uniform(0.25, 2.2), rng.random() < 0.5
            hinge = wall.origin + along * (opening.left if hinge_left else opening.left + opening.width)
            leaf = Surface(rng, opening.width, opening.height)
            walls.paint_leaf(leaf, 0, 0, leaf.width, leaf.height, True)
            way = along * math.cos(angle) * (1 if hinge_left else -1) + into * math.sin(angle)
            room.leaves.append(Placed(leaf, hinge, way, UP))
            edge = Surface(rng, LEAF_THICK, opening.height, 200)
            edge.pixels[...] = leaf.pixels.reshape(-1, 3).mean(0) * rng.uniform(0.5, 1.1)
            room.edges.append(Placed(edge, hinge + way * leaf.width, numpy.array([way[2], 0, -way[0]]), UP))
        room.walls.append(wall)
    return room


def targets(room: Room) -> list[tuple[numpy.ndarray, numpy.ndarray]]:
    """Where doors are: the middle of each at the height of its handle, and the direction that it faces."""
    found = []
    for placed, things in [(wall, wall.surface.things) for wall in room.walls] + [(leaf, [Thing("door", 0, 0, leaf.surface.width, 2.0)]) for leaf in room.leaves]:
        for thing in things:
            if thing.kind == "door":
                found.append((placed.origin + placed.along * (thing.left + thing.width / 2) + UP * (thing.bottom + 1.05), numpy.array([placed.along[2], 0, -placed.along[0]])))
    return found


def aimed(rng, room: Room, size: tuple[int, int]) -> Camera:
    """Somebody takes a picture of a door, or of something else beside it; near, far, straight or at a slant."""
    field = math.radians(rng.uniform(38, 80))
    doors = targets(room)
    if doors and rng.random() < 0.92:
        at, faces = doors[rng.integers(len(doors))]
        away = rng.choice([rng.uniform(0.3, 0.6), rng.uniform(0.5, 1.4), rng.uniform(1.2, 3.0), rng.uniform(2.5, 6.5)], p=[0.08, 0.2, 0.4, 0.32])
        slant = rng.normal(0, 0.5)
        eye = at + away * (faces * math.cos(slant) + numpy.array([faces[2], 0, -faces[0]]) * math.sin(slant))
        at = at + rng.normal(0, 0.25, 3) * away * math.tan(field / 2) * [1, 0.5, 1]
        if rng.random() < 0.25:  # something else is meant, the door is at the picture's side
            at = at + rng.choice([-1, 1]) * rng.uniform(0.5, 1.1) * away * math.tan(field / 2) * numpy.array([faces[2], 0, -faces[0]])
    else:
        eye, at = numpy.array([0, 0, 0.0]), numpy.array([rng.uniform(room.left, room.right), 1.2, room.ahead])
    margin = 0.2
    eye = numpy.array([numpy.clip(eye[0], room.left + margin, room.right - margin), rng.uniform(0.9, 1.75), numpy.clip(eye[2], room.behind + margin, room.ahead - 0.3)])
    way = at - eye
    flat = max(0.2, math.hypot(way[0], way[2]))
    return Camera(size, eye, field, math.atan2(way[0], way[2]), 0.8 * math.atan2(way[1], flat) + rng.normal(0, 0.05), rng.normal(0, 0.035))


def render(rng: numpy.random.Generator, room: Room, longest: int) -> Labelled:
    aspect = rng.choice([1.0, 4 / 3, 3 / 2, 3 / 4, 2 / 3, 16 / 9])
    told = (longest, round(longest / aspect)) if aspect >= 1 else (round(longest * aspect), longest)
    size = (round(told[0] * DRAWN_LARGER), round(told[1] * DRAWN_LARGER))
    camera = aimed(rng, room, size)
    pixels = numpy.empty((size[1], size[0], 3), numpy.float32)
    pixels[...] = pick(rng, [(200, 215, 235), (150, 180, 220), (225, 228, 232), (90, 120, 90)]) if room.outside else pick(rng, WALLS) * 0.8
    lay(rng, pixels, camera, 0.0, WALLS + WOODS + [(90, 90, 92), (120, 116, 108), (80, 110, 60)], rng.uniform(0.5, 0.95))
    if not room.outside:
        lay(rng, pixels, camera, room.high, [(240, 240, 238), (225, 222, 215), (200, 200, 200)], rng.uniform(0.6, 1.05))
    if room.outside:
        textures.BEYOND.fill(rng, pixels, 0.35)
    canvas = Image.fromarray(numpy.clip(pixels, 0, 255).astype(numpy.uint8))
    doors, cupboards = [], []
    for wall in room.walls:
        seen = ahead_of(camera, wall)
        if seen is None or seen[1] - seen[0] < 0.3:
            continue
        put(canvas, camera, part_of(wall, *seen), rng.uniform(0.65, 1.05))
        for thing in wall.surface.things:
            left, right = max(thing.left, seen[0] + 0.02), min(thing.left + thing.width, seen[1] - 0.02)
            if right - left > 0.08:
                (doors if thing.kind == "door" else cupboards).append(wall.corners(left, thing.bottom, right - left, thing.height))
    for leaf, edge in sorted(zip(room.leaves, room.edges, strict=True), key=lambda both: -camera.seen(both[0].whole())[:, 2].mean()):
        light = rng.uniform(0.55, 1.0)
        for part in sorted((leaf, edge), key=lambda placed: -camera.seen(placed.whole())[:, 2].mean()):
            put(canvas, camera, part, light if part is leaf else light * rng.uniform(0.6, 1.1))
        doors.append(leaf.whole())
    furniture.stand(rng, canvas, camera, room, int(rng.integers(1, 7)) if rng.random() < 0.6 else 0, NEAR)
    clutter(rng, canvas, int(rng.integers(1, 5)) if rng.random() < 0.45 else 0)
    for _ in range(int(rng.integers(1, 4)) if rng.random() < 0.35 else 0):
        textures.BEYOND.obstacle(rng, canvas)
    if rng.random() < (0.5 if room.outside else 0.25):
        canvas = textures.sunlit(rng, canvas)
    boxes = lambda things: numpy.array([box for box in (box_of(camera, corners) for corners in things) if box], numpy.float32).reshape(-1, 5)
    return Labelled(photographed(rng, canvas, told), boxes(doors), boxes(cupboards))


VIEWS = 4  # of each room: painting its walls takes longer than looking at them


def rendered(rng: numpy.random.Generator, count: int, longest: int, beyond: list[numpy.ndarray] | None = None) -> list[Labelled]:
    """`beyond`: pictures without doors, to be seen in glass, frames and openings."""
    textures.BEYOND = textures.Beyond(beyond or [])
    pictures: list[Labelled] = []
    while len(pictures) < count:
        room = build(rng)
        pictures += [render(rng, room, longest) for _ in range(VIEWS if targets(room) else 1)]
    return pictures[:count]
