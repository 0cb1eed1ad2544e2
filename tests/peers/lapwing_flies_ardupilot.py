"""What Lapwing says of flights on a real ArduPilot in the loop, and where it leaves the vehicle: done only what was done, causes as
they were, alarms in time. Without one it says so, and flies the same on `lapwing sim`.

    LAPWING_SITL=~/ardupilot lapwing_flies_ardupilot.py [--only TEXT]

The folder is that of an ArduPilot's source in which its programs for the loop were built (`./waf copter rover plane`); each flight has
a vehicle of its own, freshly started at five times the pace of the clock.
"""

import argparse
import contextlib
import pathlib
import signal
import subprocess
import tempfile
import time

import harness
from ardupilot import in_the_loop
from ardupilot.vehicle import BRAKE, COPTER_AUTO, ROVER_AUTO
from foreign import Foreign
from mavlink_peer import Peer, mavlink
from station import Station

SPEEDUP = 5 if in_the_loop.source() else 10  # a real one cannot be much faster
LAT, LON, ALT = in_the_loop.HOME


def script(*steps, kind="UAV"):
    return (f"v = pick {{ type '{kind}'; timeout 120.seconds }}\nexecute v: mission {{\n  name 'Long'\n"
            f"  home location({LAT}, {LON}, {ALT})\n  " + "\n  ".join(steps) + "\n}\nmessage 'said to be done'\n")


UP = f"takeOff location({LAT}, {LON}, {ALT + 20})"
SURVEY = script(UP, *["move 100, 0, 0"] * 4, "move 0, 100, 0", *["move(-100, 0, 0)"] * 3, "returnHomeAndLand()")
DRIVE = script("move 30, 0", "move 0, 30", "move(-30, 0)", kind="UGV")
LANDING = script(f"takeOff location({LAT}, {LON}, {ALT + 40})", "move 500, 0, 0", "move 0, 400, 0", "move(-900, 0, 0)",
                 "returnHomeAndLand()")
CIRCUIT = script(f"takeOff location({LAT}, {LON}, {ALT + 40})", "move 500, 0, 0", "move 0, 400, 0")


@contextlib.contextmanager
def vehicle(family):
    """(the process of one, the port to which it sends)"""
    port = harness.free_udp_port()
    if in_the_loop.source():
        with in_the_loop.started(family, port, SPEEDUP) as process:
            yield process, port
    else:
        with harness.lapwing("sim", "--vehicles", f"{family}:1", "--home", f"{LAT},{LON},{ALT}", "--speedup", str(SPEEDUP),
                             "--out", f"udpout://127.0.0.1:{port}") as process:
            yield process, port


def left_at(port):
    """(mode, armed) of the vehicle when nobody commands it any more."""
    listener = Peer(port, 253, 190, listens=True)
    try:
        beat = listener.hears(lambda m: m.get_type() == "HEARTBEAT" and m.autopilot == mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA)
        return beat.custom_mode, bool(beat.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)
    finally:
        listener.close()


def flown(family, source, at_item=None, acts=lambda foreign: None):
    """(exit code, what was said, (mode, armed) afterwards) of a run in which another station acts at that item."""
    with vehicle(family) as (_, port), tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "flight.dolphin")
        path.write_text(source)
        foreign = Foreign()
        run = subprocess.Popen([harness.LAPWING, "run", str(path), "--link", f"udpin://127.0.0.1:{port}", "--speedup", str(SPEEDUP),
                                *foreign.forward], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        try:
            if at_item is not None:
                foreign.waits_for_item(at_item)
                acts(foreign)
            said = run.communicate(timeout=200)[0]
        finally:
            if run.poll() is None:
                run.kill()
                print(run.communicate()[0])
            foreign.close()
        return run.returncode, said, left_at(port)


@contextlib.contextmanager
def watched(family, *options):
    """(the vehicle's process, the station that watches it, once it is ready)"""
    web = harness.free_tcp_port()
    station = Station(web)
    with vehicle(family) as (process, port), \
            harness.lapwing("station", "--link", f"udpin://127.0.0.1:{port}", "--port", str(web), *options):
        harness.wait_until(station.up, 20, "the station answers")
        station.is_ready("1")
        # Its checks before arming do not ask for a position in the mode that it starts in; flying does.
        harness.wait_until(lambda: station.vehicle("1")["health"]["position_ok"], 90, "it knows where it is")
        yield process, station


def climbs(station, height_m):
    """The number of the take-off, once it has left the ground: who has just found his place may not arm at once."""
    def begun():
        number = station.give("take_off", "1", height_m=height_m)
        harness.wait_until(lambda: station.outcome(number)["state"] not in ("waiting", "accepted"), 20, "the take-off's begin")
        return station.outcome(number)["state"] != "refused" and number

    return harness.wait_until(begun, 60, "it takes off")


def alarms(station, kind):
    return [alarm for alarm in station.ask("alarms")[1]["alarms"] if alarm["kind"] == kind]


# ---- missions to their ends

def a_copter_flies_its_mission_and_lands():
    code, said, left = flown("copter", SURVEY)
    assert code == 0 and "said to be done" in said, (code, said)
    assert left == (COPTER_AUTO, False), left


def a_rover_drives_its_mission_and_is_not_left_armed():
    code, said, left = flown("rover", DRIVE)
    assert code == 0 and "said to be done" in said, (code, said)
    assert left[0] != ROVER_AUTO and not left[1], left


def a_plane_flies_its_mission_and_lands():
    code, said, left = flown("plane", LANDING)
    assert code == 0 and "said to be done" in said, (code, said)
    assert not left[1], left


def a_plane_flies_its_mission_and_returns():
    code, said, left = flown("plane", CIRCUIT)
    assert code == 0 and "said to be done" in said, (code, said)
    assert left == (11, True), left


# ---- others at the same vehicle

def another_station_uploads_a_mission():
    code, said, left = flown("copter", SURVEY, 4, lambda foreign: foreign.upload(
        foreign.waypoints((LAT, LON, ALT), (LAT + 0.0005, LON, ALT + 30))))
    assert code == 1 and "another station changed its mission in flight" in said and "said to be done" not in said, (code, said)
    assert left == (BRAKE, True), left


def another_station_skips_to_the_last_item():
    code, said, left = flown("copter", SURVEY, 3, lambda foreign: foreign.skip_to(10))
    assert code == 1 and "without passing items 3 to 9 (7 of 9 places)" in said and "said to be done" not in said, (code, said)


def close_the_fence(foreign):
    for name, value in (("FENCE_TYPE", 2), ("FENCE_RADIUS", 60), ("FENCE_ACTION", 1), ("FENCE_ENABLE", 1)):
        foreign.set_parameter(name, value)


def a_fence_that_is_breached_is_the_cause():
    code, said, left = flown("copter", SURVEY, 4, close_the_fence)
    assert code == 1 and "ence" in said.split("failed", 1)[-1] and "by operator" not in said, (code, said)


def a_fence_that_is_breached_is_an_alarm():
    foreign = Foreign()
    with watched("copter", *foreign.forward) as (_, station):
        station.comes_to(climbs(station, 20), "confirmed")
        here = station.vehicle("1")["position"]
        number = station.give("go_to", "1", lat_deg=here["lat_deg"] + 0.0012, lon_deg=here["lon_deg"])
        station.comes_to(number, "confirmed")
        close_the_fence(foreign)
        told = harness.wait_until(lambda: alarms(station, "fence"), 10, f"the alarm; there are {station.ask('alarms')[1]}")
        print(f"    {told[0]['text']}")
    foreign.close()


# ---- an operator

def an_emergency_stop_in_a_run_stops_it_at_once():
    with watched("copter") as (_, station):
        assert station.ask("script", {"name": "long.dolphin", "source": SURVEY})[0] == 202
        harness.wait_until(lambda: station.vehicle("1").get("relative_alt_m", 0) > 15, 90, "it flies")
        asked = time.monotonic()
        assert station.ask("emergency-stop", {"operator": "tester"})[0] == 202
        answered = time.monotonic()
        harness.wait_until(lambda: station.stopped("1")["confirmed"], 10, "it has confirmed its stop")
        took = time.monotonic() - asked
        print(f"    answered within {answered - asked:.3f} s, stopped within {took:.3f} s")
        assert station.vehicle("1")["mode"] == "BRAKE", station.vehicle("1")
        harness.wait_until(lambda: station.ask("script")[1]["state"] == "stopped", 20, "the script is halted")
        assert took < 1.0, took


def a_take_off_that_is_cut_short_is_corrected():
    with watched("copter") as (_, station):
        number = climbs(station, 60)
        harness.wait_until(lambda: station.vehicle("1").get("relative_alt_m", 0) > 4, 60, "it climbs")
        station.ask("emergency-stop", {"operator": "tester"})
        cut = station.comes_to(number, "cut_short")
        assert cut["reason"].startswith("emergency stop by tester, "), cut
        assert int(cut["reason"].split(", at ")[1].split()[0]) >= 4, cut
        harness.wait_until(lambda: station.stopped("1")["confirmed"], 10, "it has confirmed its stop")


def a_silent_vehicle_is_an_alarm_within_three_seconds():
    with watched("copter") as (process, station):
        station.comes_to(climbs(station, 10), "confirmed")
        process.send_signal(signal.SIGSTOP)
        stopped = time.monotonic()
        harness.wait_until(lambda: alarms(station, "silent"), 10, "the alarm")
        took = time.monotonic() - stopped
        print(f"    told within {took:.2f} s")
        process.send_signal(signal.SIGCONT)
        harness.wait_until(lambda: not alarms(station, "silent"), 20, "the alarm's end")
        assert took < 3.5, took


FLIGHTS = (a_copter_flies_its_mission_and_lands, a_rover_drives_its_mission_and_is_not_left_armed,
           a_plane_flies_its_mission_and_lands, a_plane_flies_its_mission_and_returns, another_station_uploads_a_mission,
           another_station_skips_to_the_last_item, a_fence_that_is_breached_is_the_cause, a_fence_that_is_breached_is_an_alarm,
           an_emergency_stop_in_a_run_stops_it_at_once, a_take_off_that_is_cut_short_is_corrected,
           a_silent_vehicle_is_an_alarm_within_three_seconds)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--only", default="", metavar="TEXT")
    only = parser.parse_args().only
    print(f"ArduPilot of {in_the_loop.source()}" if in_the_loop.source() else "no ArduPilot named (LAPWING_SITL): the simulator")
    wrong = []
    for flight in [each for each in FLIGHTS if only in each.__name__]:
        if in_the_loop.source() and "plane" in flight.__name__ and "plane" not in in_the_loop.families():
            print(f"{flight.__name__}: skipped, no plane was built")
            continue
        begun = time.monotonic()
        try:
            flight()
        except AssertionError as error:
            wrong.append(flight.__name__)
            print(f"WRONG: {error}")
        print(f"{flight.__name__}: {time.monotonic() - begun:.1f} s", flush=True)
    assert not wrong, wrong


main()
