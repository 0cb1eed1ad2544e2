"""What no pilot would command is refused, or warned of, before anything is sent; what pilots command goes through without a remark.
Over HTTP to a station with simulated copters, planes, rovers, boats, submarines and PX4, some of them with a fence of their own;
and plans that are uploaded."""

import json
import pathlib
import re
import tempfile
import time

import cases
import harness
import plans
from plans import LAND, TAKE_OFF, WAYPOINT
from station import Station

LAT, LON, GROUND = 41.1780, -8.5980, 90
HOME = f"{LAT},{LON},{GROUND}"
COPTER_FENCE = ("FENCE_ENABLE=1", "FENCE_TYPE=7", "FENCE_RADIUS=300", "FENCE_ALT_MAX=80")
PX4_FENCE = ("GF_MAX_HOR_DIST=300", "GF_MAX_VER_DIST=80")


def metres(north: float, east: float = 0) -> dict:
    """A place so far from home."""
    return {"lat_deg": LAT + north / 111_070, "lon_deg": LON + east / 83_900}


def at(lat: float, lon: float) -> dict:
    return {"lat_deg": lat, "lon_deg": lon}


def way(*places, take_off: float | None = 30, land: bool = True):
    """A mission's items; a place is (metres north, metres east, height)."""
    items = [(TAKE_OFF, LAT, LON, take_off)] if take_off is not None else []
    for north, east, height in places:
        place = metres(north, east)
        items.append((WAYPOINT, place["lat_deg"], place["lon_deg"], height))
    return items + [(LAND, LAT, LON, 0)] if land else items


SWAPPED, NO_MINUS = (WAYPOINT, -8.5981, 41.1781, 30), (WAYPOINT, 41.1785, 8.5980, 30)
# What the vehicles hold before the station comes.
HELD = {4: way((50, 0, 30), land=False),
        5: [(TAKE_OFF, LAT, LON, 30), (WAYPOINT, 38.7223, -9.1393, 30)],
        6: way((50, 0, 30), take_off=None),
        7: way((50, 0, 600)),
        8: way((50, 0, -20)),
        9: way((50, 0, 150), land=False),
        10: [(TAKE_OFF, LAT, LON, 30), SWAPPED],
        12: way((400, 0, 60), (0, 400, 60), land=False),
        14: way((800, 0, 0), (0, 800, 0), take_off=None, land=False),
        15: [(WAYPOINT, 41.1785, 8.5980, 0)],
        17: way((300, 0, 0), take_off=None, land=False),
        19: way((20, 0, -5), take_off=None, land=False),
        22: way((50, 0, 30), land=False),
        23: [(TAKE_OFF, LAT, LON, 30), NO_MINUS],
        33: way((500, 0, 30))}
PX4 = (21, 22, 23, 41)

# (what, vehicle, command, what it is given, rule)
ON_THE_GROUND = [
    ("a take-off to half a metre", 1, "take_off", {"height_m": 0.5}, "take_off_height"),
    ("a take-off above the ceiling", 1, "take_off", {"height_m": 130}, "ceiling"),
    ("a take-off with a zero too many", 1, "take_off", {"height_m": 1000}, "ceiling"),
    ("a take-off to an altitude above the sea", 1, "take_off", {"height_m": 190}, "ceiling"),
    ("a PX4's take-off to 400 m", 21, "take_off", {"height_m": 400}, "ceiling"),
    ("a plane's take-off to 500 m", 11, "take_off", {"height_m": 500}, "ceiling"),
    ("a take-off out of its fence", 31, "take_off", {"height_m": 100}, "outside_fence"),
    ("a PX4's take-off out of its fence", 41, "take_off", {"height_m": 100}, "outside_fence"),
    ("no mission in a copter", 1, "start_mission", {}, "empty_mission"),
    ("no mission in a plane", 11, "start_mission", {}, "empty_mission"),
    ("no mission in a rover", 13, "start_mission", {}, "empty_mission"),
    ("no mission in a boat", 16, "start_mission", {}, "empty_mission"),
    ("no mission in a submarine", 18, "start_mission", {}, "empty_mission"),
    ("no mission in a PX4", 21, "start_mission", {}, "empty_mission"),
    ("a rover armed to drive to another place", 15, "arm", {}, "too_far"),
    ("a mission in Lisbon", 5, "start_mission", {}, "too_far"),
    ("a mission without a take-off", 6, "start_mission", {}, "no_take_off"),
    ("a mission to 600 m", 7, "start_mission", {}, "ceiling"),
    ("a mission below the ground", 8, "start_mission", {}, "below_ground"),
    ("a mission with a place swapped", 10, "start_mission", {}, "too_far"),
    ("a rover's mission without its minus", 15, "start_mission", {}, "too_far"),
    ("a PX4's mission without its minus", 23, "start_mission", {}, "too_far"),
    ("a mission out of the vehicle's fence", 33, "start_mission", {}, "outside_fence"),
    ("a rover to swapped coordinates", 13, "go_to", at(LON, LAT), "too_far"),
    ("a rover to zero", 13, "go_to", at(0, 0), "zero_coordinates"),
    ("a rover over 6 km", 13, "go_to", metres(6000), "too_far"),
    ("a rover out of its fence", 34, "go_to", metres(400), "outside_fence"),
    ("a boat over 12 km", 16, "go_to", metres(0, 12_000), "too_far"),
    ("a boat to zero", 16, "go_to", at(0, 0), "zero_coordinates"),
    ("a submarine over 6 km", 18, "go_to", metres(-6000), "too_far"),
    ("a submarine east instead of west", 18, "go_to", at(LAT, -LON), "too_far"),
]
ON_THE_WAY = [
    ("nothing to resume in a copter", 1, "resume_mission", {}, "empty_mission"),
    ("nothing to resume in a rover", 13, "resume_mission", {}, "empty_mission"),
    ("a mode without a mission", 2, "set_mode", {"mode": "AUTO"}, "empty_mission"),
    ("another place's mission resumed", 5, "resume_mission", {}, "too_far"),
    ("another place's mission by its mode", 10, "set_mode", {"mode": "AUTO"}, "too_far"),
    ("a mission out of the vehicle's fence resumed", 33, "resume_mission", {}, "outside_fence"),
    ("a copter to swapped coordinates", 1, "go_to", at(LON, LAT), "too_far"),
    ("a copter east instead of west", 1, "go_to", at(LAT, -LON), "too_far"),
    ("a copter to zero", 1, "go_to", at(0, 0), "zero_coordinates"),
    ("a copter over 60 km", 1, "go_to", metres(60_000), "too_far"),
    ("a copter with a wrong digit", 1, "go_to", at(LAT + 0.1, LON), "too_far"),
    ("a copter into the ground", 1, "go_to", {**metres(50), "height_m": -50}, "below_ground"),
    ("a copter along the ground", 1, "go_to", {**metres(50), "height_m": 0.2}, "below_ground"),
    ("a copter above the ceiling", 1, "go_to", {**metres(50), "height_m": 200}, "ceiling"),
    ("a copter out of its fence", 31, "go_to", metres(420), "outside_fence"),
    ("a copter over its fence", 31, "go_to", {**metres(50), "height_m": 95}, "outside_fence"),
    ("a PX4 to swapped coordinates", 21, "go_to", at(LON, LAT), "too_far"),
    ("a PX4 over 6 km", 21, "go_to", metres(0, 6000), "too_far"),
    ("a PX4 into the ground", 21, "go_to", {**metres(50), "height_m": -5}, "below_ground"),
    ("a PX4 to 300 m", 21, "go_to", {**metres(50), "height_m": 300}, "ceiling"),
    ("a PX4 out of its fence", 41, "go_to", metres(0, 420), "outside_fence"),
    ("a PX4 over its fence", 41, "go_to", {**metres(50), "height_m": 95}, "outside_fence"),
    ("a plane over 25 km", 11, "go_to", metres(25_000), "too_far"),
    ("a plane to zero", 11, "go_to", at(0, 0), "zero_coordinates"),
    ("a plane to 400 m", 11, "go_to", {**metres(500), "height_m": 400}, "ceiling"),
]
# What is carried out, with a word before it.
WARNED_OF = [
    ("a take-off into the grass", 3, "take_off", {"height_m": 1.5}, "take_off_height"),
    ("a mission to 150 m", 9, "start_mission", {}, "ceiling"),
    ("a place at the fence", 31, "go_to", metres(299), "outside_fence"),
]
PLAUSIBLE_ON_THE_GROUND = [
    ("a copter up to 20 m", 1, "take_off", {"height_m": 20}),
    ("a copter up to 3 m", 2, "take_off", {"height_m": 3}),
    ("a copter up with another place's mission", 5, "take_off", {"height_m": 20}),
    ("another with one", 10, "take_off", {}),
    ("a copter up with a mission out of its fence", 33, "take_off", {"height_m": 10}),
    ("a copter up within its fence", 31, "take_off", {"height_m": 60}),
    ("another up to its ceiling", 32, "take_off", {"height_m": 77}),
    ("a PX4 up", 21, "take_off", {"height_m": 10}),
    ("a PX4 up within its fence", 41, "take_off", {"height_m": 50}),
    ("a plane up", 11, "take_off", {"height_m": 50}),
    ("a copter's mission", 4, "start_mission", {}),
    ("a plane's mission", 12, "start_mission", {}),
    ("a rover's mission", 14, "start_mission", {}),
    ("a boat's mission", 17, "start_mission", {}),
    ("a submarine's mission", 19, "start_mission", {}),
    ("a PX4's mission", 22, "start_mission", {}),
    ("a rover that is armed", 13, "arm", {}),
    ("a rover with a fence that is armed", 34, "arm", {}),
    ("a boat that is armed", 16, "arm", {}),
    ("a submarine that is armed", 18, "arm", {}),
]
PLAUSIBLE_ON_THE_WAY = [
    ("a copter across the field", 1, "go_to", metres(80)),
    ("a copter up and away", 1, "go_to", {**metres(200, 50), "height_m": 60}),
    ("a copter to the ceiling", 1, "go_to", {**metres(100), "height_m": 119}),
    ("a copter over 4.5 km", 1, "go_to", metres(3000, 3300)),
    ("a copter to who waits 7 km off", 1, "go_to", {**metres(7000), "allow": {"too_far": "a car follows"}}),
    ("a copter down", 1, "go_to", {**metres(30), "height_m": 4}),
    ("a copter low", 2, "go_to", {**metres(-30), "height_m": 2}),
    ("a copter within its fence", 31, "go_to", metres(200)),
    ("a copter high within its fence", 31, "go_to", {**metres(100), "height_m": 75}),
    ("a PX4 away", 21, "go_to", metres(0, 150)),
    ("a PX4 up", 21, "go_to", {**metres(50), "height_m": 40}),
    ("a PX4 within its fence", 41, "go_to", metres(250)),
    ("a plane over 2 km", 11, "go_to", metres(2000)),
    ("a plane over 15 km", 11, "go_to", metres(11_000, 10_000)),
    ("a plane higher", 11, "go_to", {**metres(1000), "height_m": 110}),
    ("a rover over the field", 13, "go_to", metres(90)),
    ("a rover over 2 km", 13, "go_to", metres(0, 2000)),
    ("a rover within its fence", 34, "go_to", metres(150, 150)),
    ("a boat over 3 km", 16, "go_to", metres(3000)),
    ("a submarine over 100 m", 18, "go_to", metres(100)),
    ("a mission that waits", 14, "pause_mission", {}),
    ("and goes on", 14, "resume_mission", {}),
]


class Watch:
    """What the station's log says of a vehicle's commands."""

    def __init__(self, station: Station):
        self.station = station

    def end(self) -> int:
        return max((line["seq"] for line in self.station.ask("log")[1]["lines"]), default=0)

    def said(self, vehicle: int, after: int, rule: str = "[a-z_]+") -> list[str]:
        lines = [line["text"] for line in self.station.ask(f"log?after={after}")[1]["lines"]]
        return [line for line in lines if re.search(rf"of [a-z]+ {vehicle}: .*\[{rule}\]", line)]

    def over(self, vehicle: int, after: int, action: str) -> dict | None:
        """The last such command's end: that of the one before it, which it cut short, comes first."""
        lines = [line["text"] for line in self.station.ask(f"log?after={after}")[1]["lines"]]
        ends = [told for line in lines if (told := re.fullmatch(rf"{action} of vehicle {vehicle}: (\w+)(?:: (.*))?", line))]
        return {"state": ends[-1][1], "reason": ends[-1][2] or ""} if ends else None


def state_of(station: Station, vehicle: int):
    """What a command changes first."""
    now = station.vehicle(str(vehicle))
    return now["armed"], now["mode"]


def first_outcome(station: Station, watch: Watch, vehicle: int, action: str, details: dict) -> dict:
    """When it shows anything. The station forgets what is over as soon as others have something to tell; then its log has it."""
    before = watch.end()
    number = station.give(action, str(vehicle), **details)

    def shown():
        try:
            now = station.outcome(number)
        except StopIteration:
            return watch.over(vehicle, before, action)
        return now if now["state"] not in ("waiting", "accepted") else None

    return harness.wait_until(shown, 30, f"{action} of {vehicle} shows")


def is_refused(station: Station, watch: Watch, case):
    _, vehicle, action, details, rule = case
    before = state_of(station, vehicle)
    outcome = first_outcome(station, watch, vehicle, action, details)
    assert outcome["state"] == "refused" and f"[{rule}]" in outcome["reason"], outcome
    assert state_of(station, vehicle) == before, (before, state_of(station, vehicle))


def obeys(station: Station, watch: Watch, vehicle: int, action: str, details: dict):
    """It is confirmed, or on its way to that."""
    outcome = first_outcome(station, watch, vehicle, action, details)
    assert outcome["state"] in ("under_way", "confirmed"), outcome


def is_warned_of(station: Station, watch: Watch, case):
    _, vehicle, action, details, rule = case
    before = watch.end()
    obeys(station, watch, vehicle, action, details)
    assert watch.said(vehicle, before, rule), watch.said(vehicle, before)


def goes_through(station: Station, watch: Watch, case):
    _, vehicle, action, details = case
    before = watch.end()
    obeys(station, watch, vehicle, action, details)
    said = watch.said(vehicle, before)
    allowed = [f"allowed: {reason}" for reason in details.get("allow", {}).values()]
    assert len(said) == len(allowed) and all(word in line for word, line in zip(allowed, said)), said


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

    def sim(vehicles: str, first_id: int, north: float, parameters=()):
        """Vehicles in a row of their own: nobody stands on another's pad."""
        home = ",".join(map(str, (*metres(north).values(), GROUND)))
        return harness.lapwing("sim", "--vehicles", vehicles, "--first-id", str(first_id), "--home", home, "--speedup", "5",
                               "--out", f"udpout://127.0.0.1:{link}", *(word for name in parameters for word in ("--param", name)))

    with sim("copter:10,plane:2,rover:3,boat:2,sub:2", 1, -100), sim("px4:3", 21, -50), sim("copter:3,rover:1", 31, 0, COPTER_FENCE), \
            sim("px4:1", 41, 50, PX4_FENCE):
        uploader = plans.Uploader(link)
        uploader.find(*HELD)
        for system, items in HELD.items():
            uploader.give(system, items, system in PX4)
        uploader.close()
        everybody = [*range(1, 20), 21, 22, 23, 31, 32, 33, 34, 41]
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

AWAY = {"polygons": [{"polygon": [[38.72, -9.14], [38.72, -9.13], [38.73, -9.13]], "inclusion": True, "version": 1}]}
ROUND = {"polygons": [{"polygon": [[41.17, -8.61], [41.17, -8.58], [41.19, -8.58], [41.19, -8.61]], "inclusion": True, "version": 1}]}
TOWER = {"circles": [{"circle": {"center": [metres(100)["lat_deg"], LON], "radius": 20}, "inclusion": False, "version": 1}]}

# (what, vehicles, items, fence, rule; whether it is refused)
IMPLAUSIBLE_PLANS = [
    ("a plan of Lisbon", "copter:1", [(TAKE_OFF, 38.7223, -9.1393, 30), (WAYPOINT, 38.7230, -9.1393, 30)], None, "too_far"),
    ("a plan with a place swapped", "copter:1", [(TAKE_OFF, LAT, LON, 30), SWAPPED], None, "too_far"),
    ("a plan without its minus", "px4:1", [(TAKE_OFF, LAT, LON, 30), NO_MINUS], None, "too_far"),
    ("a plan that does not take off", "copter:1", way((50, 0, 30), take_off=None), None, "no_take_off"),
    ("a plan under the ground", "copter:1", way((50, 0, -30)), None, "below_ground"),
    ("a plan to 2 km up", "plane:1", way((500, 0, 2000), land=False), None, "ceiling"),
    ("a plan of 60 km", "rover:1", way((60_000, 0, 0), take_off=None, land=False), None, "too_far"),
    ("a plan out of its fence", "copter:1", way((5000, 0, 30)), ROUND, "outside_fence"),
    ("a plan with the fence of Lisbon", "copter:1", way((50, 0, 30)), AWAY, "outside_fence"),
    ("a plan through its no-fly zone", "copter:1", way((200, 0, 30)), TOWER, "outside_fence"),
]
PLAUSIBLE_PLANS = [
    ("a plan up and down", "copter:1", way((50, 0, 30)), None),
    ("a plan round the field", "copter:1", way((50, 0, 30), (50, 50, 30), (0, 50, 40)), None),
    ("a plan within its fence", "copter:1", way((300, 0, 30)), ROUND),
    ("a plan beside its no-fly zone", "copter:1", way((0, 200, 30)), TOWER),
    ("a PX4's plan", "px4:1", way((50, 0, 30)), None),
    ("a plane's plan", "plane:1", way((2000, 0, 100), (2000, 2000, 100), land=False), None),
    ("a rover's plan", "rover:1", way((50, 0, 0), (50, 50, 0), take_off=None, land=False), None),
    ("a boat's plan", "boat:1", way((2000, 0, 0), take_off=None, land=False), None),
]


def upload(vehicles: str, items, fence, *more: str):
    with tempfile.TemporaryDirectory() as name:
        file = pathlib.Path(name, "a.plan")
        file.write_text(plans.text(items, fence))
        code, out, err = harness.finish("mission", "upload", str(file), "--json", *(more or ("--sim", vehicles, "--home", HOME)))
        return code, json.loads(out)["plans"], err


def upload_is_refused(case):
    what, vehicles, items, fence, rule = case
    code, uploaded, err = upload(vehicles, items, fence)
    assert code == 2 and not uploaded and re.search(rf"\[{rule}\]", err), (what, code, uploaded, err)


def upload_goes_through(case):
    what, vehicles, items, fence = case
    code, uploaded, err = upload(vehicles, items, fence)
    assert code == 0 and all(plan["outcome"] == "uploaded" for plan in uploaded), (what, code, uploaded, err)
    assert not re.search(r"\[[a-z_]+\]", err), (what, err)


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
        code, uploaded, err = upload("", way((420, 0, 30)), None, *link)
        assert code == 2 and not uploaded and "120 m outside copter 1's own fence: 300 m round home (FENCE_RADIUS)" in err, (code, uploaded, err)
        assert upload("", way((200, 0, 30)), ROUND, *link)[0] == 0
        code, uploaded, err = upload("", way((200, 0, 30)), TOWER, *link)
        assert code == 2 and not uploaded and "[outside_fence]" in err, (code, uploaded, err)
        out, _ = harness.expect_exit(0, "mission", "download", *link, "--json")
        held = json.loads(out)
        assert len(held["items"]) == 3 and held["fence_zones"] == 1, held
        code, _, err = upload("", way((400, 0, 30)), None, *link, "--allow", "outside_fence=the next field is ours")
        assert code == 0 and "allowed: the next field is ours" in err, (code, err)
        with tempfile.TemporaryDirectory() as name:
            script = pathlib.Path(name, "beyond.dolphin")
            script.write_text(BEYOND)
            code, _, err = harness.finish("run", str(script), *link, "--speedup", "5")
            assert code != 0 and "120 m outside copter 1's own fence: 300 m round home (FENCE_RADIUS)" in err and " flies '" not in err, (code, err)


begun = time.monotonic()
commands()
bad = cases.failures(upload_is_refused, IMPLAUSIBLE_PLANS)
bad += cases.failures(upload_goes_through, PLAUSIBLE_PLANS)
one_fenced_vehicle()
implausible = len(ON_THE_GROUND) + len(ON_THE_WAY) + len(WARNED_OF) + len(IMPLAUSIBLE_PLANS)
plausible = len(PLAUSIBLE_ON_THE_GROUND) + len(PLAUSIBLE_ON_THE_WAY) + len(PLAUSIBLE_PLANS)
assert implausible >= 40 and plausible >= 40
assert not bad, f"{len(bad)} plans:\n" + "\n".join(bad)
print(f"{implausible} implausible commands and plans refused or warned of, {plausible} plausible ones let through; "
      f"{time.monotonic() - begun:.0f} s")
