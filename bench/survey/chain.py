"""Survey drones over drawn car parks, whole programs in real time: a simulated flight controller on MAVLink, `lapwing onboard` with its bus, camera,
vision, mapper and planner, and an operator in plain Python; a row a seed: slots found within half a metre, states told rightly, coverage, time.

    python3 bench/survey/chain.py [PROGRAM]       # LAPWING_BENCH_SEEDS=1-20, LAPWING_BENCH_KIND=usual
"""

import json
import math
import os
import pathlib
import random
import sys
import time
from dataclasses import dataclass

ROOT = pathlib.Path(__file__).resolve().parents[2]
SEEDS = os.environ.get("LAPWING_BENCH_SEEDS", "1-20")
KIND = os.environ.get("LAPWING_BENCH_KIND", "usual")
os.environ.setdefault("LAPWING", sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build/release/bin/lapwing"))
sys.path.insert(0, str(ROOT / "tests/support"))

import drone  # noqa: E402
import survey  # noqa: E402

AISLE_M = 6.0
MARGIN_M = 6.0


@dataclass(frozen=True)
class Kind:
    """How the slots of a car park are built: metres from and to, degrees of which one is drawn."""

    width_m: tuple[float, float] = (2.5, 2.5)
    length_m: tuple[float, float] = (5.0, 5.0)
    slants_deg: tuple[float, ...] = (0.0,)
    paint: tuple[str, ...] = ("sides",)
    columns: float = 1.0  # times as many as usual
    is_head_to_head: bool = True


KINDS = {
    "usual": Kind(),
    "wide": Kind(width_m=(2.7, 3.1), length_m=(5.0, 5.6)),
    "heads": Kind(width_m=(2.3, 2.6), length_m=(4.7, 5.2), paint=("sides", "heads")),
    "single": Kind(is_head_to_head=False),
    "slanted": Kind(width_m=(2.4, 2.7), length_m=(4.8, 5.4), slants_deg=(20, 30, 45, -30, -40)),
    "in-line": Kind(width_m=(5.8, 6.6), length_m=(2.1, 2.5), paint=("sides", "mouths"), columns=0.5, is_head_to_head=False),
}


def seeds() -> list[int]:
    """Of "1-20,35"."""
    found = []
    for part in SEEDS.split(","):
        first, _, last = part.partition("-")
        found += range(int(first), int(last or first) + 1)
    return found


def drawn(seed: int, kind: Kind) -> tuple[str, list[list[float]]]:
    """The file of a car park north of home, with one or two blocks of rows, and the corners of the ground that is to be surveyed."""
    dice = random.Random(seed)
    turn, columns, blocks = dice.uniform(-0.5, 0.5), round(kind.columns * dice.randint(8, 14)), dice.randint(1, 2)
    of_kind = random.Random(f"{seed} {kind}")
    width_m, length_m, slant_deg = of_kind.uniform(*kind.width_m), of_kind.uniform(*kind.length_m), of_kind.choice(kind.slants_deg)
    slant = math.radians(slant_deg)
    # Slanted rows shift from their mouths to their heads, where the next one's sides go on.
    shift, depth = length_m * math.sin(slant), length_m * math.cos(slant)
    block_m = (2 if kind.is_head_to_head else 1) * depth
    slots_m = columns * width_m / math.cos(slant)
    wide, deep = slots_m + 2 * abs(shift), blocks * block_m + (blocks - 1) * AISLE_M
    first = max(0.0, -2 * shift)
    ahead, left = (math.cos(turn), math.sin(turn)), (-math.sin(turn), math.cos(turn))
    # So far north that the drone stands outside of it.
    south = 16 + 0.5 * wide * abs(math.sin(turn)) + dice.uniform(0, 4)

    def at(along: float, across: float) -> list[float]:
        return [(along - wide / 2) * ahead[0] + across * left[0], south + (along - wide / 2) * ahead[1] + across * left[1]]

    def box(margin: float) -> list[list[float]]:
        return [at(-margin, -margin), at(wide + margin, -margin), at(wide + margin, deep + margin), at(-margin, deep + margin)]

    share = dice.uniform(0.3, 0.8)
    text = f"""name = "Drawn {seed}"
anchor = [{drone.HOME[0]}, {drone.HOME[1]}, 100.0]
seed = {seed}
[light]
sun_azimuth_deg = {dice.uniform(90, 270):.0f}
sun_height_deg = {dice.uniform(25, 70):.0f}
shadow = {dice.uniform(0.4, 0.7):.2f}
[ground]
pixel_m = 0.03
wear = {dice.uniform(0.1, 0.5):.2f}
[cars]
share = {share:.2f}
[[area]]
ground = "asphalt"
kerb = true
corners = {json.dumps(box(MARGIN_M + 2))}
"""
    for block in range(blocks):
        low = block * (block_m + AISLE_M)
        rows = [("A", at(first, low), turn)]
        if kind.is_head_to_head:
            rows.append(("B", at(first + slots_m + 2 * shift, low + block_m), turn + math.pi))
        for name, begin, heading in rows:
            taken = [i for i in range(1, columns + 1) if dice.random() < share]
            free = [i for i in range(1, columns + 1) if i not in taken]
            text += f"""[[row]]
name = "{name}{block}"
at = {json.dumps(begin)}
heading_deg = {math.degrees(heading):.6f}
count = {columns}
width_m = {width_m}
length_m = {length_m}
slant_deg = {slant_deg}
paint = {json.dumps(kind.paint)}
taken = {taken}
free = {free}
"""
    return text, box(MARGIN_M)


def fly(operator: drone.Operator) -> None:
    """On a busy machine a program may not be ready for the first word; the drone is on the ground then, and is asked again."""
    for attempt in range(3):
        try:
            drone.take_off(operator)
            return
        except AssertionError:
            if attempt == 2 or operator.last["Armed"]:
                raise


def row(seed: int) -> dict:
    text, corners = drawn(seed, KINDS[KIND])
    flight = drone.Drone(decide='relies_on = ["vision", "mapper", "planner"]')
    world = flight.folder / "world.toml"
    world.write_text(text)
    area = [survey.on_globe(*corner) for corner in corners]
    with flight.config.open("a") as config:
        config.write(f"""[camera]
kind = "simulated"
world = "world.toml"
width = 640
height = 480
seed = {seed}
faults = {{ noise = 3, position_m = 0.3, angle_deg = 0.5 }}
[survey]
area = {json.dumps(area)}
folder = "found"
""")
    with flight:
        operator = drone.Operator(flight.port)
        operator.wait(lambda o: o.last, "the first heartbeat", 30)
        operator.command("Configure", Min=7, Des=9, Max=14)
        fly(operator)
        began = time.monotonic()
        operator.command("Autonomous Explore")
        operator.wait_for_state("AutonomousExplore", 5)
        ending = operator.wait_for_error("the survey is over", 600)
        took_s = time.monotonic() - began
        operator.command("Land")
        operator.wait(lambda o: not o.last["Armed"], "landed and disarmed", 120)
        operator.cut()
    found = survey.found_slots(flight.folder)
    told = survey.compare(found, world)
    return {"seed": seed, "took_s": took_s, "ending": ending, "coverage": found["survey"]["coverage"], "pictures": found["survey"]["pictures"], **told}


def main() -> None:
    if KIND not in KINDS:
        sys.exit(f"LAPWING_BENCH_KIND={KIND}: there are {', '.join(KINDS)}")
    print("| seed | slots | within 0.5 m | off | told | rightly | others | coverage | took | pictures |")
    print("|---|---|---|---|---|---|---|---|---|---|", flush=True)
    rows = []
    for seed in seeds():
        try:
            rows.append(row(seed))
        except AssertionError as error:
            print(f"| {seed} | failed: {str(error)[:200]} |", flush=True)
            continue
        print("| {seed} | {true} | {found} | {off_m:.2f} m | {told} | {right} | {extra} | {coverage:.3f} | {took_s:.0f} s | {pictures} |".format(**rows[-1]), flush=True)

    def total(key: str) -> float:
        return sum(one[key] for one in rows)

    if rows:
        print(f"{len(rows)} of {len(seeds())} surveys: {total('found') / total('true'):.4f} of the slots within 0.5 m, {total('right') / total('told'):.4f} of those told told rightly, "
              f"{total('extra') / len(rows):.2f} others each, coverage {min(one['coverage'] for one in rows):.3f} at least, {total('took_s') / len(rows):.0f} s each")


main()
