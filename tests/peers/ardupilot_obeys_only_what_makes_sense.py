"""The commands and plans of `only_commands_that_make_sense_are_given` to real ArduPilots in the loop: what no pilot would command is
refused before it arms by its own heartbeat, or warned of; what pilots command goes through without a remark.

    LAPWING_SITL=~/ardupilot ardupilot_obeys_only_what_makes_sense.py [--only VEHICLE]

Each vehicle of the table is one in the loop, with its mission and fence, and a station of its own.
"""

import argparse
import contextlib
import sys
import time

import cases
import harness
import plans
from ardupilot import in_the_loop
from ardupilot.witness import Witness, witnessed
from plausibility import uploads
from plausibility.commanding import Watch, goes_through, is_refused, is_warned_of
from plausibility.commands import (FLEETS, GROUND, HELD, ON_THE_GROUND, ON_THE_WAY, PLAUSIBLE_ON_THE_GROUND, PLAUSIBLE_ON_THE_WAY, WARNED_OF, Fleet,
                                   kinds, metres)
from plausibility.uploads import IMPLAUSIBLE_PLANS, PLAUSIBLE_PLANS
from station import Station

SPEEDUP = 5
AT_ONCE = 2  # a vehicle takes most of a core
VEHICLES = {number: (kind, fleet) for fleet in FLEETS for number, kind in kinds(fleet).items()}
COMMANDS = ON_THE_GROUND + ON_THE_WAY + WARNED_OF, PLAUSIBLE_ON_THE_GROUND + PLAUSIBLE_ON_THE_WAY
PLANS = IMPLAUSIBLE_PLANS, PLAUSIBLE_PLANS


def flies(kind: str) -> bool:
    """Whether such a one is in the loop."""
    return kind in in_the_loop.families()


def family(vehicles: str) -> str:
    """Of `copter:1`."""
    return vehicles.split(":")[0]


@contextlib.contextmanager
def standing(number: int, kind: str, fleet: Fleet):
    """(the station, the vehicle's witness), once it is ready, with the mission that it is to hold."""
    link, web = harness.free_udp_port(), harness.free_tcp_port()
    home = (*metres(fleet.north_m).values(), GROUND)
    with witnessed(kind, link, SPEEDUP, number, home=home, parameters=fleet.parameters) as witness:
        if number in HELD:
            uploader = plans.Uploader(link)
            uploader.find(number)
            uploader.give(number, HELD[number])
            uploader.close()
        with harness.lapwing("station", "--link", f"udpin://127.0.0.1:{link}", "--port", str(web)):
            station = Station(web)
            harness.wait_until(station.up, 20, "the station answers")
            station.is_ready(str(number))
            yield station, witness


class Judgement:
    """Of one vehicle's cases, one after the other."""

    def __init__(self, number: int, station: Station, witness: Witness):
        self.number, self.station, self.witness = number, station, witness
        self.watch = Watch(station)
        self.wrong: list[str] = []

    def judge(self, how, table, said: str):
        for case in table:
            if case[1] != self.number:
                continue
            begun = time.monotonic()
            try:
                how(self.station, self.watch, case)
                print(f"{said}: {case[0]}: {time.monotonic() - begun:.1f} s", flush=True)
            except AssertionError as failure:
                self.wrong.append(f"{case[0]}: {failure}")

    def is_warned_of_first(self, station: Station, watch: Watch, case):
        """Before it arms, if it has not."""
        before, was_armed = watch.end(), self.witness.armed_at is not None
        is_warned_of(station, watch, case)
        self.witness.hears(2)  # arming shows late
        said_at = watch.said_at(self.number, before, case[4])
        assert was_armed or self.witness.armed_at and said_at < self.witness.armed_at, f"said at {said_at}, armed at {self.witness.armed_at}"

    def all(self):
        if self.number == 15:
            self.station.command("set_mode", "15", mode="AUTO")  # it would set off as soon as it is armed
        self.judge(is_refused, ON_THE_GROUND, "refused")
        self.witness.hears(2)  # arming shows late
        if self.witness.armed_at is not None:
            self.wrong.append(f"vehicle {self.number} armed for what was refused")
        self.judge(goes_through, PLAUSIBLE_ON_THE_GROUND, "done")
        self.judge(is_refused, ON_THE_WAY, "refused")
        self.judge(goes_through, PLAUSIBLE_ON_THE_WAY, "done")
        self.judge(self.is_warned_of_first, WARNED_OF, "warned of")


def commanded(number: int):
    with standing(number, *VEHICLES[number]) as (station, witness):
        judgement = Judgement(number, station, witness)
        judgement.all()
        assert not judgement.wrong, "\n".join(judgement.wrong)


def given_plans(kind: str):
    """All plans of a kind of vehicle go to the same."""
    link = harness.free_udp_port()
    where = ("--link", f"udpin://127.0.0.1:{link}")
    wrong = []
    with witnessed(kind, link, SPEEDUP) as witness:
        for how, table in ((uploads.is_refused, IMPLAUSIBLE_PLANS), (uploads.goes_through, PLAUSIBLE_PLANS)):
            for case in table:
                try:
                    if family(case[1]) == kind:
                        how(case, *where)
                        print(f"{how.__name__.replace('_', ' ')}: {case[0]}", flush=True)
                except AssertionError as failure:
                    wrong.append(str(failure))
        witness.hears(2)
        assert witness.armed_at is None, f"the {kind} armed for a plan"
    assert not wrong, "\n".join(wrong)


def left_out() -> list[str]:
    commands = [(case[0], VEHICLES[case[1]][0]) for table in COMMANDS for case in table]
    plans_too = [(case[0], family(case[1])) for table in PLANS for case in table]
    return [f"left out: {what}: there is no {kind} in the loop" for what, kind in commands + plans_too if not flies(kind)]


def counted(commands, plan_cases) -> int:
    return sum(flies(VEHICLES[case[1]][0]) for case in commands) + sum(flies(family(case[1])) for case in plan_cases)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--only", type=int, metavar="VEHICLE")
    only = parser.parse_args().only
    if not in_the_loop.source():
        print("no ArduPilot named (LAPWING_SITL); system.only_commands_that_make_sense_are_given asks the same of the simulator")
        sys.exit(harness.SKIPPED)
    print("\n".join(left_out()))
    has_cases = {case[1] for table in COMMANDS for case in table}
    numbers = [number for number, (kind, _) in VEHICLES.items() if number in has_cases and flies(kind) and only in (None, number)]
    families = [] if only else [kind for kind in in_the_loop.families() if any(family(case[1]) == kind for table in PLANS for case in table)]
    jobs = [(commanded, number) for number in numbers] + [(given_plans, kind) for kind in families]
    bad = cases.failures(lambda job: job[0](job[1]), jobs, AT_ONCE)
    assert not bad, f"{len(bad)} vehicles:\n" + "\n".join(bad)
    if not only:
        print(f"{counted(COMMANDS[0], PLANS[0])} implausible commands and plans refused or warned of, "
              f"{counted(COMMANDS[1], PLANS[1])} plausible ones let through, by ArduPilot")


main()
