"""A hundred vehicles, some of which fall silent, restart and come back, on links that lose packets; viewers that come and go; a
script that runs over and over. In the end everybody is there, nothing is stuck and the station's memory is what it was.

usage: a_fleet_survives_a_long_day.py [SECONDS]; 60 in CI, 1800 by `./lapwing soak`. It stops by itself."""

import contextlib
import itertools
import random
import signal
import statistics
import subprocess
import sys
import time

import ground
import harness

SECONDS = float(sys.argv[1]) if len(sys.argv) > 1 else 60.0
GROUPS = 5
EACH = 20
SEED = 20261121
# Growth of the resident memory between the second and the last quarter of the time. Histories (log, texts, tracks of the flights)
# are bounded; what is left is the allocator's rounding.
MAY_GROW_MB = 4.0
# Takes two vehicles up and down again; among the steady ones that are five times as fast it takes ten seconds of ours.
SCRIPT = """
pair = pick { count 2; type 'UAV'; timeout 10.seconds }
hop = mission {
  name 'Hop'
  home location(41.1780, -8.5980, 90)
  takeOff location(41.1780, -8.5980, 95)
  move 10, 0
  returnHomeAndLand()
}
execute pair: hop
"""


class Group:
    """Twenty vehicles in one process. Interrupting it is their power going off, stopping it their link going dead."""

    def __init__(self, number: int, port: int):
        self.number, self.port, self.process, self.is_held = number, port, None, False
        self.start()

    def start(self):
        # The first group is steady and flies five times as fast; one group's radio is bad.
        speed = ["--speedup", "5"] if self.number == 0 else []
        bad = ["--loss", "0.2", "--duplicate", "0.1", "--delay", "0.1"] if self.number == 1 else []
        kinds = f"copter:{EACH - 5},px4:5" if self.number == 2 else f"copter:{EACH}"
        self.process = subprocess.Popen(
            [harness.LAPWING, "sim", "--vehicles", kinds, "--first-id", str(1 + self.number * EACH), "--out",
             f"udpout://127.0.0.1:{self.port}", *speed, *bad], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def flap(self):
        self.process.send_signal(signal.SIGCONT if self.is_held else signal.SIGSTOP)
        self.is_held = not self.is_held

    def restart(self):
        self.stop()
        self.start()

    def stop(self):
        if self.is_held:
            self.flap()
        self.process.terminate()
        self.process.wait(timeout=10)


class Day:
    def __init__(self, station: ground.Station, groups: list[Group]):
        self.station, self.groups = station, groups
        self.chance = random.Random(SEED)
        self.viewers: list[ground.Viewer] = []
        self.memory: list[tuple[float, float]] = []
        self.scripts = {"done": 0, "failed": 0}
        self.is_running = False
        self.flaps = self.restarts = self.looks = 0

    def trouble(self):
        """One of the groups other than the steady one has something happen to it."""
        group = self.chance.choice(self.groups[1:])
        if group.is_held or self.chance.random() < 0.6:
            group.flap()
            self.flaps += 1
        else:
            group.restart()
            self.restarts += 1

    def look(self):
        """A viewer comes, and one that was there goes; a slow one reads nothing for as long as it is there."""
        viewer = self.station.viewer()
        assert viewer.message()["type"] == "hello"
        self.viewers.append(viewer)
        self.looks += 1
        if len(self.viewers) > 4:
            self.viewers.pop(self.chance.randrange(len(self.viewers))).close()

    def script(self):
        """Starts the script when the one before has ended."""
        state = self.station.get("/api/v1/script")["state"]
        if state in ("running", "stopping"):
            return
        if self.is_running:
            self.scripts[state] += 1
        status, answer = self.station.post("/api/v1/script", {"name": "hop", "source": SCRIPT})
        assert status == 202, answer
        self.is_running = True

    def note(self, passed: float):
        self.memory.append((passed, ground.resident_mb(self.station.process.pid)))

    def live(self, seconds: float):
        begun = time.monotonic()
        wait = max(0.5, seconds / 600)
        events = itertools.cycle((self.trouble, self.look, self.script, self.look))
        while (passed := time.monotonic() - begun) < seconds:
            next(events)()
            self.note(passed)
            time.sleep(wait)  # the pace of the day

    def end(self):
        """The trouble is over: what has to come back comes back."""
        for viewer in self.viewers:
            viewer.close()
        for group in self.groups:
            if group.is_held:
                group.flap()
        with contextlib.suppress(AssertionError):
            harness.wait_until(self.all_are_there, 40, "")
        assert not self.missing(), f"not connected again: {self.missing()}"
        self.station.post("/api/v1/stop")
        harness.wait_until(lambda: self.station.get("/api/v1/script")["state"] not in ("running", "stopping"), 60,
                           "the script did not end")
        harness.wait_until(lambda: self.station.get("/api/v1/status")["viewers"] == 0, 10, "viewers that left are still counted")

    def missing(self) -> list[int]:
        known = self.station.vehicles()
        wanted = range(1, 1 + GROUPS * EACH)
        return [number for number in wanted if known.get(number, {}).get("connection") != "ok"]

    def all_are_there(self) -> bool:
        time.sleep(0.2)
        return not self.missing()

    def growth_mb(self) -> float:
        """Between the second and the last quarter, in the middle of each: a peak is no leak."""
        quarter = len(self.memory) // 4
        middle = lambda rows: statistics.median(megabytes for _, megabytes in rows)
        return middle(self.memory[-quarter:]) - middle(self.memory[quarter:2 * quarter])


def main():
    with ground.station() as station, contextlib.ExitStack() as stack:
        groups = [Group(number, station.link_ports[0]) for number in range(GROUPS)]
        for group in groups:
            stack.callback(group.stop)
        day = Day(station, groups)
        harness.wait_until(day.all_are_there, 60, "the fleet did not assemble")
        files = ground.open_files(station.process.pid)
        day.live(SECONDS)
        day.end()
        left_open = ground.open_files(station.process.pid) - files
        print(f"{SECONDS:.0f} s with {GROUPS * EACH} vehicles: {day.flaps} flaps, {day.restarts} restarts of {EACH} vehicles, "
              f"{day.looks} viewers, scripts {day.scripts}; memory {day.memory[-1][1]:.1f} MB, {day.growth_mb():+.1f} MB since the "
              f"second quarter; {left_open:+d} open files")
        assert day.scripts["done"] > 0, "no script came to its end"
        assert day.growth_mb() < MAY_GROW_MB, "the station's memory grows"
        assert left_open <= 2, "the station keeps files or sockets open"


main()
