"""The flights of `only_what_makes_sense_is_flown` on real ArduPilots in the loop: what no pilot would fly is refused, or warned of,
before the vehicle arms by its own heartbeat; what people fly is not remarked on.

    LAPWING_SITL=~/ardupilot ardupilot_flies_only_what_makes_sense.py [--only TEXT]

What is refused leaves a vehicle as it was: those flights share one vehicle of each kind. The others have vehicles of their own.
"""

import argparse
import contextlib
import subprocess
import sys
import threading
import time

import cases
import harness
from ardupilot import in_the_loop
from ardupilot.witness import Witness, witnessed
from plausibility import flights
from plausibility.flights import IMPLAUSIBLE, PLAUSIBLE

SPEEDUP = 5
AT_ONCE = 2  # a vehicle takes most of a core
PADS_M = 4  # between two vehicles, as `lapwing sim` parks them
METRES_PER_DEGREE = 83_900  # of longitude, here


class Program:
    """Lapwing, run to its end: `finish` as the harness has it, and when it spoke first of plausibility."""

    def __init__(self):
        self.said_at: float | None = None

    def finish(self, *arguments: str):
        process = subprocess.Popen([harness.LAPWING, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        too_long = threading.Timer(400, process.kill)
        too_long.start()
        lines = []
        for line in process.stderr:
            lines.append(line)
            if self.said_at is None and "plausibility: " in line:
                self.said_at = time.time()
        too_long.cancel()
        return process.wait(), "", "".join(lines)


def families(vehicles: str) -> list[str]:
    """Of `copter:1,rover:1`."""
    return [family for family, count in (group.split(":") for group in vehicles.split(",")) for _ in range(int(count))]


def why_not(vehicles: str) -> str:
    """Why no vehicle in the loop can fly it; empty if they can."""
    return ", ".join(f"there is no {family} in the loop" for family in families(vehicles) if family not in in_the_loop.families())


@contextlib.contextmanager
def standing(vehicles: str, home: str):
    """(where to listen, the witness of each), once all are ready."""
    lat, lon, alt = map(float, home.split(","))
    port = harness.free_udp_port()
    with contextlib.ExitStack() as all_of_them:
        yield (("--link", f"udpin://127.0.0.1:{port}"),
               [all_of_them.enter_context(witnessed(family, port, SPEEDUP, number + 1, home=(lat, lon + number * PADS_M / METRES_PER_DEGREE, alt)))
                for number, family in enumerate(families(vehicles))])


def own_home(options) -> tuple[str, tuple[str, ...]]:
    """(where the vehicles stand, the other options)"""
    if "--home" not in options:
        return flights.HOME, options
    at = options.index("--home")
    return options[at + 1], options[:at] + options[at + 2:]


def fly(link, script: str, options) -> tuple[flights.Flight, Program]:
    program = Program()
    return flights.fly(program.finish, script, *link, "--speedup", str(SPEEDUP), *options), program


def told(what: str, begun: float):
    print(f"{what}: {time.monotonic() - begun:.1f} s", flush=True)


def is_refused(case, link, witness: Witness):
    begun = time.monotonic()
    flight, _ = fly(link, case[2], case[5:])
    flights.refused_or_warned(case, flight)
    witness.hears(2)  # arming shows late
    assert witness.armed_at is None, f"{case[0]}: it armed\n{flight.err}"
    told(f"refused: {case[0]}", begun)


def are_refused(rows):
    """All of one kind of vehicle, on the same."""
    wrong = []
    with standing(rows[0][1], flights.HOME) as (link, (witness,)):
        for case in rows:
            try:
                is_refused(case, link, witness)
            except AssertionError as failure:
                wrong.append(str(failure))
    assert not wrong, "\n".join(wrong)


def is_warned_of(case):
    begun = time.monotonic()
    with standing(case[1], flights.HOME) as (link, witnesses):
        flight, program = fly(link, case[2], case[5:])
        flights.refused_or_warned(case, flight)
        armed = [witness.armed_at for witness in witnesses if witness.armed_at is not None]
        assert program.said_at and all(program.said_at < at for at in armed), f"{case[0]}: said only after it armed\n{flight.err}"
        told(f"warned of: {case[0]}", begun)


def is_flown(case):
    begun = time.monotonic()
    home, options = own_home(case[3:])
    with standing(case[1], home) as (link, witnesses):
        flight, _ = fly(link, case[2], options)
        flights.not_remarked(case, flight)
        assert any(witness.armed_at for witness in witnesses), f"{case[0]}: no vehicle armed\n{flight.err}"
        told(f"flown: {case[0]}", begun)


def jobs(judge, rows):
    return [(judge, row) for row in rows]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--only", default="", metavar="TEXT")
    only = parser.parse_args().only
    if not in_the_loop.source():
        print("no ArduPilot named (LAPWING_SITL); system.only_what_makes_sense_is_flown flies the same on the simulator")
        sys.exit(harness.SKIPPED)
    for what, vehicles, *_ in IMPLAUSIBLE + PLAUSIBLE:
        if why_not(vehicles):
            print(f"left out: {what}: {why_not(vehicles)}")
    implausible, plausible = ([case for case in table if not why_not(case[1]) and only in case[0]] for table in (IMPLAUSIBLE, PLAUSIBLE))
    refused = [case for case in implausible if case[4]]
    kinds = sorted({case[1] for case in refused})
    bad = cases.failures(lambda job: job[0](job[1]), jobs(are_refused, [[case for case in refused if case[1] == kind] for kind in kinds])
                         + jobs(is_warned_of, [case for case in implausible if not case[4]]) + jobs(is_flown, plausible), AT_ONCE)
    assert not bad, f"{len(bad)} of {len(implausible) + len(plausible)}:\n" + "\n".join(bad)
    print(f"{len(implausible)} implausible flights refused or warned of before arming, {len(plausible)} plausible ones flown, by ArduPilot")


main()
