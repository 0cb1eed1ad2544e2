"""A mission is done when it was flown: not when somebody else changed it, skipped its items or when it got stuck; and a vehicle that
nobody else has taken over is then put to rest."""

import pathlib
import subprocess
import tempfile
import time

import copter
import flight
import harness
from foreign import Foreign
from mavlink_peer import mavlink

# 800 m out and back, in legs of a hundred metres.
SURVEY = """
v = pick { type 'UAV'; timeout 20.seconds }
execute v: mission {
  name 'Long'
  home location(41.1780, -8.5980, 90)
  takeOff location(41.1780, -8.5980, 110)
  move 100, 0, 0
  move 100, 0, 0
  move 100, 0, 0
  move 100, 0, 0
  move 0, 100, 0
  move(-100, 0, 0)
  move(-100, 0, 0)
  move(-100, 0, 0)
  returnHomeAndLand()
}
message 'said to be done'
"""
SPEEDUP = 5


def flown_with(foreign, acts, at_item):
    """The run of the survey on a simulated copter, in which the other station acts when the vehicle is at that item."""
    with tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(folder, "long.dolphin")
        script.write_text(SURVEY)
        run = subprocess.Popen([harness.LAPWING, "run", str(script), "--sim", "copter:1", "--speedup", str(SPEEDUP), "--forward",
                                f"udpout://127.0.0.1:{foreign.port}"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        try:
            foreign.hears(lambda m: m.get_type() == "MISSION_CURRENT" and m.seq == at_item, 60, f"item {at_item}")
            foreign.heard.clear()
            acts()
            foreign.heard.clear()
            said = run.communicate(timeout=100)[0]
            while foreign.listen(0.0):
                pass
        finally:
            if run.poll() is None:
                run.kill()
                run.wait()
    modes = [m.custom_mode for m in foreign.heard if m.get_type() == "HEARTBEAT" and m.get_srcSystem() == 1]
    return run.returncode, said, modes


def another_station_uploads():
    foreign = Foreign()
    waypoint = mavlink.MAV_CMD_NAV_WAYPOINT
    code, said, modes = flown_with(foreign, lambda: foreign.upload([foreign.point(0, waypoint, 41.178, -8.598, 90),
                                                                    foreign.point(1, waypoint, 41.1785, -8.598, 120)]), 4)
    assert code == 1 and "another station changed its mission in flight" in said, (code, said)
    assert "said to be done" not in said, said
    assert modes[-1] == copter.BRAKE, modes
    foreign.close()


def another_station_skips():
    foreign = Foreign()
    code, said, modes = flown_with(foreign, lambda: foreign.skip_to(10), 3)
    assert code == 1 and "without passing items 3 to 9 (7 of 9 places)" in said and "has chosen the item" in said, (code, said)
    foreign.close()


def a_copter(happens_to, code, *words, speedup=SPEEDUP):
    """The first flight of a copter of ours, to which something happens at its third item."""
    field = flight.Field(speedup=speedup, leg_time=2.0)
    vehicle = field.add()
    begun = []

    def happens(now):
        if vehicle.current >= 3 and vehicle.mode == copter.AUTO and not begun:
            begun.append(now)
            happens_to(vehicle)

    ended = field.fly(flight.MISSION + "v = pick { type 'UAV'; timeout 20.seconds }\nexecute v: there\n", happens=happens)
    ended.expect(code, *words)
    return field, vehicle


def it_stands_on_the_ground():
    def stands(vehicle):
        vehicle.faults.stuck, vehicle.alt = True, copter.HOME[2]

    field, vehicle = a_copter(stands, 1, "it stands on the ground with its motors running at item 3 of 6")
    field.stay(3)
    assert not vehicle.armed and vehicle.mode == copter.BRAKE


def it_makes_no_progress():
    def hangs(vehicle):
        vehicle.faults.stuck = True

    _, vehicle = a_copter(hangs, 1, "no progress at item 3 of 6 for", speedup=20)
    assert vehicle.mode == copter.BRAKE and vehicle.armed


def its_position_jumps():
    def jumps(vehicle):
        vehicle.faults.false_place = (42.178, -8.598)

    _, vehicle = a_copter(jumps, 1, "its position jumped by 111", "and stays there: where it is, is not known")
    assert vehicle.mode == copter.BRAKE


def it_is_busy_for_a_while():
    field = flight.Field()
    vehicle = field.add()
    vehicle.faults.busy = 2
    ended = field.fly(flight.MISSION + "v = pick { type 'UAV'; timeout 20.seconds }\nexecute v: there\n")
    ended.expect(0)


for case in (another_station_uploads, another_station_skips, it_stands_on_the_ground, it_makes_no_progress, its_position_jumps,
             it_is_busy_for_a_while):
    begun = time.monotonic()
    case()
    print(f"{case.__name__}: {time.monotonic() - begun:.1f} s")
