"""Buildings that nobody drew by hand: rooms round a ring of corridors, along an L, on three sides of a hall with pillars, round a
lobby across which a scanner of 10 m does not see, along both sides of a corridor of 80 m; their sizes, doors, signs, furniture and people by a seed.

    python3 bench/drawn_buildings.py DIR SEED...                # writes DIR/SEED.toml: a ring, an L or a hall by turns
    python3 bench/drawn_buildings.py DIR lobby SEED...          # writes DIR/lobby-SEED.toml: all of one kind
    build/bench/bin/bench_robot_doors DIR/SEED.toml 1           # has a robot map it
"""

import pathlib
import random
import sys

FURNITURE = [(1.4, 0.7, 0.74), (0.9, 0.4, 1.9), (1.8, 0.9, 0.74), (0.5, 0.5, 0.9)]
ROOM_FOR_A_DOOR_M = 1.1  # on either side of its middle


class Building:
    def __init__(self, name: str, dice: random.Random):
        self.dice = dice
        self.lines = [f'name = "{name}"', "wall_thickness_m = 0.12"]
        self.numbers = dice.choice(["3{:02}", "B1{:02}", "2.{:03}", "16-1{:02}"])
        self.doors = 0

    def part(self, kind: str, **values) -> None:
        self.lines.append(f"[[{kind}]]")
        for key, value in values.items():
            text = "true" if value is True else f'"{value}"' if isinstance(value, str) else value
            self.lines.append(f"{key} = {text}")

    def wall(self, *places: tuple[float, float], **values) -> None:
        self.part("wall", line=[[round(v, 3) for v in place] for place in places], **values)

    def outside(self, *places: tuple[float, float]) -> None:
        self.wall(*places, closed=True, thickness_m=0.3)

    def door(self, x: float, y: float, into: str, is_shut: bool | None = None) -> None:
        """With its middle there; the room that it opens to lies `into` N, S, E or W."""
        half = self.dice.choice([0.85, 0.95, 1.0, 1.1]) / 2
        hinge, latch = {"N": ((x - half, y), (x + half, y)), "S": ((x + half, y), (x - half, y)),
                        "E": ((x, y + half), (x, y - half)), "W": ((x, y - half), (x, y + half))}[into]
        self.doors += 1
        number = self.numbers.format(self.doors)
        second = self.dice.choice([None, None, "Office", "Meeting", "Lab", "Dr. Green"])
        if is_shut is None:
            is_shut = self.dice.random() < 0.2
        values = {"id": number, "hinge": [round(v, 3) for v in hinge], "latch": [round(v, 3) for v in latch],
                  "sign": number + (f"\\n{second}" if second else ""),
                  "angle_deg": 0 if is_shut else self.dice.choice([90, 90, 70])}
        if not is_shut and self.dice.random() < 0.1:
            values |= {"open_s": 80, "closed_s": 40}
        colour = self.dice.choice([None, None, "#7a5230", "#305080", "#c0c0b8", "#8a2020"])
        self.part("door", **values, **({"colour": colour} if colour else {}))

    def furnish(self, left: float, low: float, right: float, high: float) -> None:
        length, width, tall = self.dice.choice(FURNITURE)
        apart = 0.8 + length / 2
        if right - left < 2 * apart or high - low < 2 * apart:
            return
        self.part("furniture", at=[round(self.dice.uniform(left + apart, right - apart), 2), round(self.dice.uniform(low + apart, high - apart), 2)],
                  turned_deg=self.dice.choice([0, 20, 90]), size=[length, width, tall], material=self.dice.choice(["wood", "wood", "dark", "cloth"]))

    def cuts(self, low: float, high: float, least: float, most: float) -> list[tuple[float, float]]:
        """Rooms beside each other from `low` to `high`, each as wide as that."""
        ends = [low]
        while high - ends[-1] > most:
            left = high - ends[-1]
            ends.append(ends[-1] + self.dice.uniform(least, min(most, left - least)) if left > 2 * least else high)
        if ends[-1] < high:
            ends.append(high)
        return list(zip(ends, ends[1:]))

    def rooms_above(self, y: float, far_y: float, ends: tuple[float, float], sizes: tuple[float, float], into: str, doors_from: float, doors_to: float) -> None:
        """Rooms between a wall at `y`, in which their doors are, and one at `far_y`."""
        for left, right in self.cuts(*ends, *sizes):
            if left > ends[0]:
                self.wall((left, y), (left, far_y))
            first, last = max(left, doors_from) + ROOM_FOR_A_DOOR_M, min(right, doors_to) - ROOM_FOR_A_DOOR_M
            if first < last:
                self.door(self.dice.uniform(first, last), y, into)
            self.furnish(left, min(y, far_y), right, max(y, far_y))

    def rooms_beside(self, x: float, far_x: float, ends: tuple[float, float], sizes: tuple[float, float], into: str) -> None:
        for low, high in self.cuts(*ends, *sizes):
            if low > ends[0]:
                self.wall((x, low), (far_x, low))
            self.door(x, self.dice.uniform(low + ROOM_FOR_A_DOOR_M, high - ROOM_FOR_A_DOOR_M), into)
            self.furnish(min(x, far_x), low, max(x, far_x), high)


def ring(dice: random.Random) -> Building:
    building = Building("Ring", dice)
    wide, high, deep, corridor = 30.0, 22.0, 6.0, dice.uniform(1.8, 2.6)
    building.outside((0, 0), (wide, 0), (wide, high), (0, high))
    building.wall((deep, deep), (wide - deep, deep), (wide - deep, high - deep), (deep, high - deep), closed=True)
    left, low, right, top = deep + corridor, deep + corridor, wide - deep - corridor, high - deep - corridor
    middle = (left + right) / 2
    building.wall((left, low), (right, low), (right, top), (left, top), closed=True)
    building.wall((middle, low), (middle, top))
    building.door((left + middle) / 2, low, "N")
    building.door((middle + right) / 2, top, "S")
    building.rooms_above(deep, 0, (0, wide), (4.5, 8), "S", deep, wide - deep)
    building.rooms_above(high - deep, high, (0, wide), (4.5, 8), "N", deep, wide - deep)
    for x, far_x, into in ((deep, 0.0, "W"), (wide - deep, wide, "E")):
        building.wall((x, deep), (far_x, deep))
        building.wall((x, high - deep), (far_x, high - deep))
        building.rooms_beside(x, far_x, (deep, high - deep), (high, high), into)
    building.part("person", at=[deep + 1, high / 2], walks=True, speed_m_s=0.8)
    building.part("start", at=[round(deep + corridor / 2, 2), round(deep + corridor / 2, 2)], facing_deg=0)
    return building


def ell(dice: random.Random) -> Building:
    building = Building("L", dice)
    corridor, deep, high, wide = dice.uniform(1.7, 2.4), 5.5, 24.0, 26.0
    low, top = high - deep - corridor, high - deep  # of the arm to the right
    inner = 2 * deep + corridor
    building.outside((0, 0), (inner, 0), (inner, low - deep), (wide, low - deep), (wide, high), (0, high))
    building.wall((deep, 0), (deep, top), (wide, top))
    building.wall((deep + corridor, 0), (deep + corridor, low), (wide, low))
    building.wall((0, top), (deep, top))
    building.wall((deep + corridor, low - deep), (inner, low - deep))
    building.rooms_beside(deep, 0, (0, top), (3.8, 7), "W")
    building.rooms_beside(deep + corridor, inner, (0, low - deep), (3.8, 7), "E")
    building.rooms_above(low, low - deep, (deep + corridor, wide), (3.8, 7), "S", 0, wide)
    building.rooms_above(top, high, (0, wide), (4.5, 8), "N", deep, wide)
    building.part("person", at=[round(deep + corridor / 2, 2), 8], walks=True, speed_m_s=0.8)
    building.part("start", at=[round(deep + corridor / 2, 2), 1.2], facing_deg=90)
    return building


def hall(dice: random.Random) -> Building:
    building = Building("Hall", dice)
    deep, wide, high = 5.0, 14.0, 12.0
    left, right, top = deep, deep + wide, high + deep
    building.outside((0, 0), (right + deep, 0), (right + deep, top), (0, top))
    building.wall((left, 0), (left, high), (right, high), (right, 0))
    for x in (left + 4, right - 4):
        for y in (4, 8):
            building.part("furniture", at=[x, y], size=[0.6, 0.6, 2.6], material="plaster")
    building.rooms_beside(left, 0, (0, high), (3.6, 7), "W")
    building.rooms_beside(right, right + deep, (0, high), (3.6, 7), "E")
    # The rooms in the upper corners are behind others, whose doors are open.
    building.wall((0, high), (left, high))
    building.wall((right, high), (right + deep, high))
    building.wall((left, high), (left, top))
    building.wall((right, high), (right, top))
    rooms = building.cuts(left, right, 3.8, 7)
    for begin, end in rooms:
        if begin > left:
            building.wall((begin, high), (begin, top))
        is_first_or_last = begin == left or end == right
        building.door(dice.uniform(begin + ROOM_FOR_A_DOOR_M, end - ROOM_FOR_A_DOOR_M), high, "N", is_shut=False if is_first_or_last else None)
    building.door(left, high + deep / 2, "W")
    building.door(right, high + deep / 2, "E")
    building.part("person", at=[left + 3, 6], walks=True, speed_m_s=0.8)
    building.part("person", at=[right - 2, 9])
    building.part("start", at=[left + wide / 2, 1.5], facing_deg=90)
    return building


def lobby(dice: random.Random) -> Building:
    building = Building("Lobby", dice)
    deep, wide, high = 4.5, 24.0, 18.0
    right, top = deep + wide, deep + high
    building.outside((0, 0), (right + deep, 0), (right + deep, top + deep), (0, top + deep))
    building.wall((deep, deep), (right, deep), (right, top), (deep, top), closed=True)
    for x, far_x, into in ((deep, 0, "W"), (right, right + deep, "E")):
        building.wall((x, deep), (far_x, deep))
        building.wall((x, top), (far_x, top))
        building.rooms_beside(x, far_x, (deep, top), (5, 9), into)
    building.rooms_above(deep, 0, (0, right + deep), (5, 9), "S", deep, right)
    building.rooms_above(top, top + deep, (0, right + deep), (5, 9), "N", deep, right)
    building.part("start", at=[deep + wide / 2, deep + high / 2], facing_deg=90)
    return building


def corridor(dice: random.Random) -> Building:
    building = Building("Corridor", dice)
    deep, long, wide = 5.0, 80.0, dice.uniform(1.8, 2.6)
    low, top = deep, deep + wide
    building.outside((0, 0), (long, 0), (long, top + deep), (0, top + deep))
    building.wall((0, low), (long, low))
    building.wall((0, top), (long, top))
    building.rooms_above(low, 0, (0, long), (5, 10), "S", 0, long)
    building.rooms_above(top, top + deep, (0, long), (5, 10), "N", 0, long)
    building.part("person", at=[long / 2, round(low + wide / 2, 2)], walks=True, speed_m_s=0.8)
    building.part("start", at=[1.5, round(low + wide / 2, 2)], facing_deg=0)
    return building


KINDS = {"ring": ring, "ell": ell, "hall": hall, "lobby": lobby, "corridor": corridor}


def main() -> None:
    words = sys.argv[2:]
    kind = words.pop(0) if words and words[0] in KINDS else None
    if not words:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for seed in map(int, words):
        drawn = KINDS[kind] if kind else (ring, ell, hall)[seed % 3]
        name = f"{kind}-{seed}" if kind else seed
        (folder / f"{name}.toml").write_text("\n".join(drawn(random.Random(seed)).lines) + "\n")


main()
