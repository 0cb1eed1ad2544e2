"""A robot whose carrier is ArduPilot's Rover in the loop: skid-steered, without satellites, by its wheel encoders alone. It maps two
rooms that a companion computer makes up, comes back, is killed, taken by its pilot and cut off. Without an ArduPilot (LAPWING_SITL) it
says so, and does the same with `lapwing sim`.

    LAPWING_SITL=~/ardupilot a_mavlink_rover_carries_a_robot.py [--only TEXT]
"""

import argparse
import contextlib
import json
import math
import pathlib
import signal
import tempfile
import time

import harness
from ardupilot import in_the_loop
from mavlink_rover import GUIDED, HOLD, MANUAL, TWO_ROOMS_M2, companion
from station import Station

LAT, LON, ALT = in_the_loop.HOME
IS_REAL = bool(in_the_loop.source()) and "skid" in in_the_loop.families()
INDOORS = ("GPS1_TYPE=0", "WENC_TYPE=10", "WENC2_TYPE=10", "WENC_POS_Y=-0.15", "WENC2_POS_Y=0.15", "EK3_SRC1_POSXY=0", "EK3_SRC1_VELXY=7",
           "EK3_SRC1_POSZ=1", "EK3_SRC1_VELZ=0", "EK3_SRC1_YAW=1")
OFFICE = "robot = pick { id 'robot1'; timeout 120.seconds }\nexecute robot: drive { name 'Rooms'; explore(); returnToStart() }\n"


@contextlib.contextmanager
def rover():
    """(companion computer, `--robot` of the rover behind it)"""
    autopilot = harness.free_udp_port()
    with contextlib.ExitStack() as stack:
        # First, since an ArduPilot in the loop gives a port up where nobody listens.
        board, port = stack.enter_context(companion(autopilot))
        if IS_REAL:
            stack.enter_context(in_the_loop.started("skid", autopilot, 1, parameters=INDOORS))
        else:
            stack.enter_context(harness.lapwing("sim", "--vehicles", "rover:1", "--home", f"{LAT},{LON},{ALT}",
                                                "--out", f"udpout://127.0.0.1:{autopilot}"))
        yield board, f"mavlink:1:udpin://127.0.0.1:{port}"


@contextlib.contextmanager
def exploring():
    """(companion computer, station, its process) of a rover that is under way."""
    web = harness.free_tcp_port()
    station = Station(web)
    with rover() as (board, spec), tempfile.TemporaryDirectory() as folder, contextlib.ExitStack() as stack:
        config = pathlib.Path(folder, "station.toml")
        config.write_text(f'robots = ["{spec}"]\n[store]\nplace = "store"\n[map]\nhome = "{LAT},{LON},{ALT}"\n')
        process = stack.enter_context(harness.lapwing("station", "--config", str(config), "--port", str(web),
                                                      "--link", f"udpin://127.0.0.1:{harness.free_udp_port()}"))
        harness.wait_until(station.up, 20, "the station answers")
        harness.wait_until(lambda: station.vehicle("robot1").get("connection") == "ok", 60, "the robot is heard")
        assert station.ask("script", {"name": "rooms.dolphin", "source": OFFICE})[0] == 202
        drives(board, 90)
        yield board, station, process


def drives(board, seconds=30):
    harness.wait_until(lambda: time.sleep(0.02) or board.speed and board.speed > 0.1, seconds, f"it drives; it says {board.texts[-5:]}")


def stands(board, seconds=10):
    harness.wait_until(lambda: time.sleep(0.01) or board.speed < 0.05 and abs(board.turn_rate) < 0.05, seconds, "it stands")


def it_maps_two_rooms_and_comes_back():
    with rover() as (board, spec), tempfile.TemporaryDirectory() as folder:
        script, report = pathlib.Path(folder, "rooms.dolphin"), pathlib.Path(folder, "report.json")
        script.write_text(OFFICE)
        out, err = harness.expect_exit(0, "run", str(script), "--robot", spec, "--report", str(report), seconds=500)
        robot = json.loads(report.read_text())["vehicles"][0]["robot"]
        x, y, _ = board.place()
        spun = max(abs(rate) for _, speed, rate in board.moments if speed < 0.05)
        nearest = board.nearest_m
        fastest = max(speed for _, speed, _ in board.moments)
        print(f"    {robot['free_m2']:.1f} of {TWO_ROOMS_M2} m2 seen (coverage {robot['coverage']:.2f}), back to {math.hypot(x, y):.2f} m, "
              f"{fastest:.2f} m/s at most, {spun:.2f} rad/s on the spot, {nearest:.2f} m from walls at least")
        assert robot["drives"][0]["outcome"] == "done" and abs(robot["free_m2"] - TWO_ROOMS_M2) < 0.1 * TWO_ROOMS_M2, robot
        assert nearest > 0.18, "it touched a wall"
        assert math.hypot(x, y) < 0.6, (x, y)
        assert spun > 0.3 and 0.2 < fastest < 0.45, (spun, fastest)
        harness.wait_until(lambda: time.sleep(0.05) or (board.mode == HOLD and not board.is_armed), 5, "it is left held and disarmed")


def an_emergency_stop_kills_it_for_good():
    with exploring() as (board, station, _):
        harness.wait_until(lambda: time.sleep(0.02) or math.hypot(*board.place()[:2]) > 1.0 and board.speed > 0.2, 60, "it is on its way")
        asked = time.monotonic()
        assert station.ask("emergency-stop", {"operator": "tester"})[0] == 202
        answered = time.monotonic() - asked
        stands(board)
        stood = time.monotonic() - asked
        harness.wait_until(lambda: time.sleep(0.01) or station.stopped("robot1")["confirmed"], 10, "it is confirmed")
        print(f"    answered within {answered:.3f} s, stands within {stood:.2f} s, confirmed within {time.monotonic() - asked:.2f} s")
        assert (board.mode, board.is_armed) == (HOLD, False)
        end = time.monotonic() + 2
        while time.monotonic() < end:  # whatever else still sends
            board.steers(0.3, 0.0)
            time.sleep(0.1)
        assert board.speed < 0.05, board.speed
        assert station.ask("emergency-stop/release", {"operator": "tester"})[0] == 202
        harness.wait_until(lambda: station.command("arm", "robot1")[0]["state"] == "confirmed", 20, "an operator restarts it")
        harness.wait_until(lambda: station.vehicle("robot1").get("armed"), 5, "it shows that it may drive")
        number = station.give("go_to", "robot1", lat_deg=LAT, lon_deg=LON)  # where it began
        station.comes_to(number, "under_way")
        drives(board)
        assert board.mode == GUIDED, board.mode


def its_pilot_takes_it_and_keeps_it():
    with exploring() as (board, station, _):
        board.pilot_sets_mode(MANUAL)
        harness.wait_until(lambda: time.sleep(0.05) or station.vehicle("robot1").get("armed") is False, 10, "the robot shows that it was taken")
        time.sleep(3)
        assert board.mode == MANUAL, board.mode


def one_that_is_cut_off_stops_by_itself():
    with exploring() as (board, _, process):
        cut = time.monotonic()
        board.is_cut = True
        harness.wait_until(lambda: time.sleep(0.02) or board.speed < 0.05, 8, "the autopilot stops")
        took = time.monotonic() - cut
        # Who ends the station now waits until it is known to be lost, and no longer.
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=40)[0]
        assert "still waiting for robot 1 to be seen standing" in said, said[-2000:]
        assert "robot 1 was lost before it was seen to stand" in said, said[-2000:]
        print(f"    the autopilot stood within {took:.2f} s of the cut")
        assert took < 5.0, took


TRIES = (it_maps_two_rooms_and_comes_back, an_emergency_stop_kills_it_for_good, its_pilot_takes_it_and_keeps_it,
         one_that_is_cut_off_stops_by_itself)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--only", default="", metavar="TEXT")
    only = parser.parse_args().only
    print(f"ArduPilot of {in_the_loop.source()}" if IS_REAL else "no ArduPilot named (LAPWING_SITL): the simulator")
    wrong = []
    for each in [each for each in TRIES if only in each.__name__]:
        begun = time.monotonic()
        try:
            each()
        except AssertionError as error:
            wrong.append(each.__name__)
            print(f"WRONG: {error}")
        print(f"{each.__name__}: {time.monotonic() - begun:.1f} s", flush=True)
    assert not wrong, wrong


main()
