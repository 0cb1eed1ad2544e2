"""What no pilot would command is refused, or warned of, before anything is sent; what pilots command goes through without a remark.
Over HTTP to a station with simulated copters, planes, rovers, boats, submarines and PX4, some of them with a fence of their own;
and plans that are uploaded."""

import contextlib
import json
import pathlib
import tempfile
import time

import cases
import harness
import plans
from plausibility import uploads
from plausibility.commanding import Watch, first_outcome, goes_through, is_refused, is_warned_of
from plausibility.commands import (COPTER_FENCE, FLEETS, GROUND, HELD, HOME, LAT, LON, ON_THE_GROUND, ON_THE_WAY, PLAUSIBLE_ON_THE_GROUND,
                                   PLAUSIBLE_ON_THE_WAY, WARNED_OF, Fleet, kinds, metres, way)
from plausibility.uploads import IMPLAUSIBLE_PLANS, PLAUSIBLE_PLANS, ROUND, TOWER, upload
from station import Station


def in_turn(judge, table):
    """Each vehicle's cases one after the other, the vehicles beside each other."""
    by_vehicle = {}
    for case in table:
        by_vehicle.setdefault(case[1], []).append(case)

    def judge_all(rows):
        for row in rows[1]:
            try:
                judge(row)
            except AssertionError as failure:
                raise AssertionError(f"{row[0]}: {failure}") from None

    return cases.failures(judge_all, [(f"vehicle {vehicle}", rows) for vehicle, rows in by_vehicle.items()], 6)


def commands():
    link, web = harness.free_udp_port(), harness.free_tcp_port()

    def sim(fleet: Fleet):
        home = ",".join(map(str, (*metres(fleet.north_m).values(), GROUND)))
        return harness.lapwing("sim", "--vehicles", fleet.vehicles, "--first-id", str(fleet.first), "--home", home, "--speedup", "5",
                               "--out", f"udpout://127.0.0.1:{link}", *(word for name in fleet.parameters for word in ("--param", name)))

    everybody = {number: kind for fleet in FLEETS for number, kind in kinds(fleet).items()}
    with contextlib.ExitStack() as running:
        for fleet in FLEETS:
            running.enter_context(sim(fleet))
        uploader = plans.Uploader(link)
        uploader.find(*HELD)
        for system, items in HELD.items():
            uploader.give(system, items, everybody[system] == "px4")
        uploader.close()
        with harness.lapwing("station", "--link", f"udpin://127.0.0.1:{link}", "--port", str(web)):
            station = Station(web)
            harness.wait_until(station.up, 20, "the station answers")
            station.is_ready(*map(str, everybody))
            watch = Watch(station)
            station.command("set_mode", "15", mode="AUTO")  # it would set off as soon as it is armed
            bad = in_turn(lambda case: is_refused(station, watch, case), ON_THE_GROUND)
            bad += in_turn(lambda case: goes_through(station, watch, case), PLAUSIBLE_ON_THE_GROUND)
            # A PX4 changes its mode by itself when it is up.
            harness.wait_until(lambda: all(station.vehicle(v)["mode"] == "AUTO.LOITER" for v in ("21", "41")), 40, "the PX4s are up")
            bad += in_turn(lambda case: is_refused(station, watch, case), ON_THE_WAY)
            bad += in_turn(lambda case: goes_through(station, watch, case), PLAUSIBLE_ON_THE_WAY)
            bad += in_turn(lambda case: is_warned_of(station, watch, case), WARNED_OF)
            assert not bad, f"{len(bad)} commands:\n" + "\n".join(bad)
            a_fence_is_followed(station, watch)


def a_fence_is_followed(station: Station, watch: Watch):
    """What is remembered of a vehicle's fence is what it is now."""
    far = ("", 31, "go_to", metres(420), "outside_fence")
    is_refused(station, watch, far)
    station.set_parameter("31", "FENCE_RADIUS", 500)
    # The vehicle itself, which refuses such places too, looks at what was set with its next turn.
    outcome = harness.wait_until(lambda: (now := first_outcome(station, watch, *far[1:4]))["state"] != "refused" or "[outside_fence]" in now["reason"] and now,
                                 20, "the vehicle goes there")
    assert outcome is True, outcome


# ---- uploads

BEYOND = f"""m = mission {{
  home location({LAT}, {LON}, {GROUND})
  takeOff location({LAT}, {LON}, {GROUND + 30})
  move 420, 0
  returnHomeAndLand()
}}
v = pick {{ timeout 30.seconds }}
execute v: m
"""


def one_fenced_vehicle():
    """It lives on: what is refused leaves it as it was, whatever refuses, the fence of its parameters or the one that it holds."""
    port = harness.free_udp_port()
    link = ("--link", f"udpin://127.0.0.1:{port}")
    with harness.lapwing("sim", "--vehicles", "copter:1", "--home", HOME, "--out", f"udpout://127.0.0.1:{port}", "--speedup", "5",
                         *(word for name in COPTER_FENCE for word in ("--param", name))):
        code, uploaded, err = upload(way((420, 0, 30)), None, *link)
        assert code == 2 and not uploaded and "120 m outside copter 1's own fence: 300 m round home (FENCE_RADIUS)" in err, (code, uploaded, err)
        assert upload(way((200, 0, 30)), ROUND, *link)[0] == 0
        code, uploaded, err = upload(way((200, 0, 30)), TOWER, *link)
        assert code == 2 and not uploaded and "[outside_fence]" in err, (code, uploaded, err)
        out, _ = harness.expect_exit(0, "mission", "download", *link, "--json")
        held = json.loads(out)
        assert len(held["items"]) == 3 and held["fence_zones"] == 1, held
        code, _, err = upload(way((400, 0, 30)), None, *link, "--allow", "outside_fence=the next field is ours")
        assert code == 0 and "allowed: the next field is ours" in err, (code, err)
        with tempfile.TemporaryDirectory() as name:
            script = pathlib.Path(name, "beyond.dolphin")
            script.write_text(BEYOND)
            code, _, err = harness.finish("run", str(script), *link, "--speedup", "5")
            assert code != 0 and "120 m outside copter 1's own fence: 300 m round home (FENCE_RADIUS)" in err and " flies '" not in err, (code, err)


begun = time.monotonic()
commands()
bad = cases.failures(uploads.is_refused, IMPLAUSIBLE_PLANS)
bad += cases.failures(uploads.goes_through, PLAUSIBLE_PLANS)
one_fenced_vehicle()
implausible = len(ON_THE_GROUND) + len(ON_THE_WAY) + len(WARNED_OF) + len(IMPLAUSIBLE_PLANS)
plausible = len(PLAUSIBLE_ON_THE_GROUND) + len(PLAUSIBLE_ON_THE_WAY) + len(PLAUSIBLE_PLANS)
assert implausible >= 40 and plausible >= 40
assert not bad, f"{len(bad)} plans:\n" + "\n".join(bad)
print(f"{implausible} implausible commands and plans refused or warned of, {plausible} plausible ones let through; "
      f"{time.monotonic() - begun:.0f} s")
