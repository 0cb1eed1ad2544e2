"""How long it takes from the start of `lapwing onboard` to the first occupancy map, on the bus and at an operator's, and how many bytes the map costs an operator who gets it whole in
each heartbeat and one who follows its changes: the small car park of the examples, whole programs in real time.

    python3 bench/survey/first_map.py [PROGRAM]       # LAPWING_BENCH_STARTS=10
"""

import os
import pathlib
import statistics
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
STARTS = int(os.environ.get("LAPWING_BENCH_STARTS", "10"))
SURVEYED_S = 30
os.environ.setdefault("LAPWING", sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build/release/bin/lapwing"))
sys.path.insert(0, str(ROOT / "tests/support"))

import drone  # noqa: E402
import survey  # noqa: E402
from ros_drone import RosDrone  # noqa: E402
from ros_robot import OccupancyGrid  # noqa: E402

PATIENCE_S = 60


class Counting(drone.Operator):
    """Also counts bytes, by the type of what says them."""

    def __init__(self, *arguments, **keywords):
        self.bytes: dict[str, int] = {}
        super().__init__(*arguments, **keywords)

    def _take(self, text: str) -> None:
        kind = text.split('"', 4)[3]
        self.bytes[kind] = self.bytes.get(kind, 0) + len(text)
        super()._take(text)


def is_here(reader) -> bool:
    return any(isinstance(one, OccupancyGrid) for one in reader.take(10))


def first_maps(flight: drone.Drone, ros: RosDrone, start: bool) -> tuple[float, float, float]:
    """Seconds from the start to the first map on the bus, to the first heartbeat and to the first one with a map."""
    reader = ros.reader("/occupancy_map", OccupancyGrid)
    began = time.monotonic()
    if start:
        flight.start()
    operator = drone.Operator(flight.port, name="watch")
    on_bus = beat = with_map = None
    while not (on_bus and beat and with_map):
        now = time.monotonic() - began
        assert now < PATIENCE_S, (on_bus, beat, with_map)
        on_bus = on_bus or (now if is_here(reader) else None)
        beat = beat or (now if operator.heartbeats else None)
        with_map = with_map or (now if operator.last.get("Occupancy Map") else None)
        time.sleep(0.002)
    operator.cut()
    return on_bus, beat, with_map


def stop(flight: drone.Drone) -> None:
    flight.onboard.terminate()
    assert flight.onboard.wait(timeout=30) == 0


def starts(flight: drone.Drone, ros: RosDrone) -> None:
    """The flight controller knows its home already, as it does when the companion computer is switched on later or again."""
    rows = []
    for _ in range(STARTS):
        stop(flight)
        rows.append(first_maps(flight, ros, start=True))
    print("| from the start of `lapwing onboard` to | median | most |\n|---|---|---|")
    for name, values in zip(("the first map on the bus", "the first heartbeat", "the first heartbeat with a map"), zip(*rows)):
        print(f"| {name} | {statistics.median(values):.2f} s | {max(values):.2f} s |", flush=True)


def costs(flight: drone.Drone) -> None:
    seed, follower = Counting(flight.port, name="seed"), Counting(flight.port, name="follower")
    follower.follow_map()
    drone.take_off(seed)
    before = dict(seed.bytes), dict(follower.bytes)
    began = time.monotonic()
    seed.command("Autonomous Explore")
    seed.wait(lambda o: o.last["Occupancy Map"] and any(cell >= 0 for cell in o.last["Occupancy Map"]["Cells"]), "something is known", PATIENCE_S)
    known_s = time.monotonic() - began
    time.sleep(max(0.0, SURVEYED_S - known_s))
    took_s = time.monotonic() - began
    cells = len(seed.last["Occupancy Map"]["Cells"])
    follower.wait(lambda o: o.map and o.map["Cells"] == seed.last["Occupancy Map"]["Cells"], "both have one map", 10)

    def rate(operator: Counting, was: dict[str, int], *kinds: str) -> float:
        return sum(operator.bytes.get(kind, 0) - was.get(kind, 0) for kind in kinds) / took_s / 1000

    print(f"first cell known {known_s:.1f} s after exploring began; map of {cells} cells; kB a second while it is surveyed: "
          f"whole {rate(seed, before[0], 'Heartbeat'):.1f}, by its changes {rate(follower, before[1], 'Heartbeat', 'Map', 'Map Changes'):.1f} "
          f"(heartbeats without it {rate(follower, before[1], 'Heartbeat'):.1f})")
    seed.command("Land")
    seed.wait(lambda o: not o.last["Armed"], "landed and disarmed", 120)
    seed.cut()
    follower.cut()


def main() -> None:
    print(f"load {os.getloadavg()[0]:.1f}")
    flight = drone.Drone(processes=survey.tables())
    ros = RosDrone(flight.domain)
    with flight:
        cold = first_maps(flight, ros, start=False)
        print(f"with a flight controller that is switched on at the same time: {cold[0]:.1f} s on the bus, {cold[2]:.1f} s at an operator's")
        starts(flight, ros)
        costs(flight)
    print(f"load {os.getloadavg()[0]:.1f}")


main()
