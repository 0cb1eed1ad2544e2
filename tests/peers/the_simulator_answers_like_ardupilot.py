"""One table of what ArduPilot answers, asked of `lapwing sim` and, where there is one, of a real ArduPilot in the loop.

    the_simulator_answers_like_ardupilot.py                           the simulator
    LAPWING_SITL=~/ardupilot the_simulator_answers_like_ardupilot.py  the ArduPilots built in that folder, started by the test
    the_simulator_answers_like_ardupilot.py --against copter=udpin:127.0.0.1:14550 --against rover=udpin:127.0.0.1:14560

A named one is any that sends MAVLink there, freshly started; each case leaves it disarmed. Each row names the vehicle, what
is sent and what was answered, by ArduPilot 4.6.0-dev (fbb7858) in the loop unless the row says otherwise. `--only TEXT`
asks the rows whose name holds TEXT. The rows are in tests/support/ardupilot.
"""

import argparse
import concurrent.futures

import harness
from ardupilot import copter_rows, in_the_loop, plane_rows, rover_rows, shared_rows
from ardupilot.vehicle import Vehicle

TABLE = {"copter": copter_rows.ROWS, "rover": rover_rows.ROWS, "plane": plane_rows.ROWS}


def plain(value):
    """What is compared: a set stays one, a tuple of numbers and texts too; texts that any row may hear are left out."""
    if isinstance(value, dict):
        return {text: severity for text, severity in value.items() if not text.startswith(("PreArm", "EKF", "GPS", "AHRS"))}
    return tuple(plain(part) for part in value) if isinstance(value, tuple) else value


def ask_all(family: str, link: str, only: str):
    """(how many rows were asked, the names of those that were answered otherwise)"""
    vehicle = Vehicle(link, family)
    wrong = []
    rows = [one for one in shared_rows.ROWS + TABLE[family] if only in one.name]
    for one in rows:
        vehicle.rest()
        try:
            answer = plain(one.ask(vehicle))
            differs = answer != one.answer
        except AssertionError as error:
            answer, differs = error, True
        print(f"{'WRONG' if differs else 'like ' + one.seen}: {family}: {one.name}"
              + (f"\n    answered {answer}\n    expected {one.answer}" if differs else ""), flush=True)
        if differs:
            wrong.append(one.name)
    vehicle.rest()
    vehicle.link.close()
    return len(rows), wrong


def against_the_simulator(family, only):
    port = harness.free_udp_port()
    with harness.lapwing("sim", "--vehicles", family, "--out", f"udpout://127.0.0.1:{port}", "--speedup", "5"):
        return ask_all(family, f"udpin:127.0.0.1:{port}", only)


def against_ardupilot(family, only):
    port = harness.free_udp_port()
    with in_the_loop.started(family, port):
        return ask_all(family, f"udpin:127.0.0.1:{port}", only)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--against", action="append", metavar="FAMILY=LINK", help="an ArduPilot: copter=udpin:127.0.0.1:14550")
    parser.add_argument("--only", default="", metavar="TEXT")
    options = parser.parse_args()
    if options.against:
        results = [ask_all(*named.split("=", 1), options.only) for named in options.against]
    elif in_the_loop.source():
        results = [against_ardupilot(family, options.only) for family in TABLE if family in in_the_loop.families()]
    else:
        print("no ArduPilot named (--against, LAPWING_SITL): the simulator alone")
        with concurrent.futures.ThreadPoolExecutor(len(TABLE)) as families:
            results = list(families.map(lambda family: against_the_simulator(family, options.only), TABLE))
    wrong = [name for _, names in results for name in names]
    assert not wrong, f"{len(wrong)} answers differ: {wrong}"
    print(f"{sum(count for count, _ in results)} answers as ArduPilot's")


main()
