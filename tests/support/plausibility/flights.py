"""What no pilot would fly, and what people fly: missions in scripts, and what is asked of Lapwing's run of each. Not a test itself."""

import pathlib
import re
import tempfile
from typing import Callable, NamedTuple

from pymavlink import mavutil

HOME = "41.1780,-8.5980,90"
FIELD = "location(41.1780, -8.5980, 90)"
ARM, SET_HOME, START = 400, 179, 300


def flight(*body: str, home: str = FIELD, take_off: str = "location(41.1780, -8.5980, 120)", land: bool = True) -> str:
    """A copter's or a plane's mission."""
    lines = [f"home {home}" if home else "", f"takeOff {take_off}" if take_off else "", *body, "returnHomeAndLand()" if land else ""]
    return "m = mission {\n  " + "\n  ".join(line for line in lines if line) + "\n}\n"


def drive(*body: str, home: str = FIELD) -> str:
    return flight(*body, home=home, take_off="", land=False)


ONE = "v = pick { count 1; timeout 30.seconds }\nexecute v: during 20.seconds run m\n"
UP_AND_DOWN = flight("move 20, 0")

# (what, vehicles, script, rule, whether it is refused, further options)
IMPLAUSIBLE = [
    ("the script of Lisbon", "copter:1", flight("move 100, 0", home="location(38.7223, -9.1393, 20)",
                                                take_off="location(38.7223, -9.1393, 50)") + ONE, "home_moved", True),
    ("home 400 m beside", "copter:1", flight(home="location(41.1816, -8.5980, 90)") + ONE, "home_moved", True),
    ("home 130 m beside", "copter:1", flight(home="location(41.1780, -8.59645, 90)") + ONE, "home_moved", True),
    ("home swapped", "copter:1", flight(home="location(-8.5980, 41.1780, 90)") + ONE, "home_moved", True),
    ("home without its minus", "copter:1", flight(home="location(41.1780, 8.5980, 90)") + ONE, "home_moved", True),
    ("home at zero", "copter:1", flight(home="location(0, 0, 90)") + ONE, "zero_coordinates", True),
    ("a place at zero", "copter:1", flight("goPos 0, 0, 120") + ONE, "zero_coordinates", True),
    ("a place swapped", "copter:1", flight("goPos (-8.5981), 41.1781, 120") + ONE, "too_far", True),
    ("a place without its minus", "copter:1", flight("goPos 41.1785, 8.5980, 120") + ONE, "too_far", True),
    ("a wrong digit", "copter:1", flight("goPos 41.2785, -8.5980, 120") + ONE, "too_far", True),
    ("a wrong degree", "copter:1", flight("goPos 42.1785, -8.5980, 120") + ONE, "too_far", True),
    ("a take-off in Lisbon, no home", "copter:1",
     "m = mission { takeOff location(38.7223, -9.1393, 120); goPos 38.7230, -9.1393, 120 }\n" + ONE, "too_far", True),
    ("home without an altitude", "copter:1", flight(home="41.1780, -8.5980") + ONE, "home_height", True),
    ("heights above the ground", "copter:1", flight("goPos 41.1785, -8.5980, 30", home="41.1780, -8.5980, 0",
                                                    take_off="location(41.1780, -8.5980, 30)") + ONE, "home_height", True),
    ("home above the ellipsoid", "copter:1", flight(home="location(41.1780, -8.5980, 145)",
                                                    take_off="location(41.1780, -8.5980, 175)") + ONE, "home_height", True),
    ("take-off to 20 m above the sea", "copter:1", flight(take_off="location(41.1780, -8.5980, 20)") + ONE, "take_off_height", True),
    ("take-off to where it stands", "copter:1", flight(take_off=FIELD) + ONE, "take_off_height", True),
    ("take-off to one metre", "copter:1", flight(take_off="location(41.1780, -8.5980, 91)") + ONE, "take_off_height", False),
    ("a place below the ground", "copter:1", flight("goPos 41.1785, -8.5980, 60") + ONE, "below_ground", True),
    ("a place without a height", "copter:1", flight("goPos 41.1785, -8.5980") + ONE, "below_ground", True),
    ("down and down", "copter:1", flight("move 50, 0, (-20)", "move 50, 0, (-20)") + ONE, "below_ground", True),
    ("along the ground", "copter:1", flight("goPos 41.1785, -8.5980, 90") + ONE, "below_ground", False),
    ("600 m up", "copter:1", flight("move 50, 0, 570") + ONE, "ceiling", True),
    ("150 m up", "copter:1", flight("move 50, 0, 120") + ONE, "ceiling", False),
    ("above a lower ceiling", "copter:1", flight("move 50, 0, 30") + ONE, "ceiling", False, "--limit", "ceiling=50"),
    ("no take-off", "copter:1", flight("move 50, 0, 30", take_off="") + ONE, "no_take_off", True),
    ("nothing to fly", "copter:1", "m = mission { home " + FIELD + " }\n" + ONE, "empty_mission", True),
    ("longer than the battery", "copter:1", flight("move 3000, 0") + ONE, "battery", False, "--limit", "endurance=120"),
    ("landing where another stands", "copter:2",
     flight(home="", take_off="location(41.1780, -8.5980, 120)", land=False).replace("\n}", "\n  landingPoint 41.1780, -8.5980, 90\n}")
     + "v = pick { id '2'; timeout 30.seconds }\nexecute v: during 20.seconds run m\n", "shared_pad", False),
    ("the other's pad", "copter:2",
     flight() + "v = pick { id '2'; timeout 30.seconds }\nexecute v: during 20.seconds run m\n", "shared_pad", False),
    ("both land on one spot", "copter:2",
     flight() + "vs = pick { count 2; timeout 30.seconds }\nexecute vs: during 20.seconds run (m | m)\n", "shared_pad", False),
    ("60 km for a plane", "plane:1", flight("move 60000, 0", land=False) + ONE, "too_far", True),
    ("a plane in Lisbon", "plane:1", flight("move 100, 0", home="location(38.7223, -9.1393, 20)",
                                            take_off="location(38.7223, -9.1393, 50)") + ONE, "home_moved", True),
    ("a plane's home without an altitude", "plane:1", flight("move 500, 0, 60", home="41.1780, -8.5980") + ONE, "home_height", True),
    ("a plane's take-off under the ground", "plane:1", flight("goPos 41.1820, -8.5980, 150",
                                                              take_off="location(41.1780, -8.5980, 60)") + ONE, "take_off_height", True),
    ("a plane that lands under the ground", "plane:1",
     flight("goPos 41.1820, -8.5980, 150", "landingPoint 41.1780, -8.5980, 20", land=False) + ONE, "below_ground", True),
    ("a plane without take-off", "plane:1", flight("goPos 41.1820, -8.5980, 150", take_off="") + ONE, "no_take_off", False),
    ("a rover in Lisbon", "rover:1", drive("move 100, 0", home="location(38.7223, -9.1393, 20)") + ONE, "home_moved", True),
    ("a rover's home 400 m beside", "rover:1", drive("move 10, 0", home="location(41.1816, -8.5980, 90)") + ONE, "home_moved", True),
    ("12 km for a rover", "rover:1", drive("move 12000, 0") + ONE, "too_far", True),
    ("a rover to zero", "rover:1", drive("goPos 0, 0") + ONE, "zero_coordinates", True),
    ("a rover's place swapped", "rover:1", drive("goPos (-8.5981), 41.1781") + ONE, "too_far", True),
    ("PX4 without take-off", "px4:1", flight("move 50, 0, 30", take_off="") + ONE, "no_take_off", False),
    ("PX4 with a take-off to 20 m above the sea", "px4:1", flight(take_off="location(41.1780, -8.5980, 20)") + ONE,
     "take_off_height", True),
    ("PX4 in Lisbon", "px4:1", flight(home="location(38.7223, -9.1393, 20)") + ONE, "home_moved", True),
    ("PX4 below the ground", "px4:1", flight("goPos 41.1785, -8.5980, 60") + ONE, "below_ground", True),
]

PLAUSIBLE = [
    ("up and down", "copter:1", UP_AND_DOWN + ONE),
    ("a survey", "copter:1", flight("surveyArea 300, 200, 40, 'NORTH_EAST'") + ONE),
    ("a survey of 2 km", "copter:1", flight("surveyArea 2000, 2000, 100, 'SOUTH_WEST'") + ONE),
    ("low", "copter:1", flight("move 50, 0, (-20)") + ONE),
    ("to the ceiling", "copter:1", flight("move 50, 0, 90") + ONE),
    ("above a ceiling that is set", "copter:1", flight("move 50, 0, 150") + ONE, "--limit", "ceiling=200"),
    ("up a hill", "copter:1", flight("move 100, 0, 20", "move 100, 0, 20", "move 100, 0, 40") + ONE),
    ("landing elsewhere", "copter:1", flight("move 200, 0", "landingPoint 41.1800, -8.5980, 90", land=False) + ONE),
    ("landing in a valley", "copter:1", flight("move 200, 0", "landingPoint 41.1800, -8.5980, 40", land=False) + ONE),
    ("landing without a height", "copter:1", flight("move 200, 0", "landingPoint 41.1800, -8.5980", land=False) + ONE),
    ("home across the field", "copter:1", flight(home="location(41.17870, -8.5980, 90)") + ONE),
    ("home's altitude from a map", "copter:1", flight(home="location(41.1780, -8.5980, 100)",
                                                      take_off="location(41.1780, -8.5980, 130)") + ONE),
    ("a beach without an altitude", "copter:1", flight("goPos 41.1785, -8.5980, 30", home="41.1780, -8.5980",
                                                       take_off="location(41.1780, -8.5980, 30)") + ONE, "--home", "41.1780,-8.5980,4"),
    ("no home", "copter:1", flight("goPos 41.1785, -8.5980, 130", home="", land=False) + ONE),
    ("back home at home's height", "copter:1", flight("move 50, 0", "returnHome()", land=False) + ONE),
    ("round a point", "copter:1", flight("loiterTurns 41.1785, -8.5980, 120, 2, 20") + ONE),
    ("staying", "copter:1", flight("loiterPos 41.1785, -8.5980, 120", land=False) + ONE),
    ("rounds", "copter:1", flight("move 50, 0", "move (-50), 0", "jumpToItem 2, (-1)", land=False) + ONE),
    ("photos", "copter:1", flight("captureUntilStop 2", "move 50, 0", "stopCapturing()") + ONE),
    ("another altitude", "copter:1", flight("altitude 140", "move 50, 0") + ONE),
    ("slowly", "copter:1", flight("speed 2", "move 20, 0") + ONE),
    ("the second half from the air", "copter:1",
     flight("move 30, 0", land=False) + "n = mission { home " + FIELD + "; move 10, 0, 30; returnHomeAndLand() }\n"
     "v = pick { timeout 30.seconds }\nexecute v: m >> n\n"),
    ("home from the air", "copter:1",
     flight("move 300, 0", land=False) + "n = mission { home " + FIELD + "; returnHomeAndLand() }\n"
     "v = pick { timeout 30.seconds }\nexecute v: (during 30.seconds run m) >> n\n"),
    ("twice up and down", "copter:1", UP_AND_DOWN + "v = pick { timeout 30.seconds }\nexecute v: m >> m\n"),
    ("two on pads of their own", "copter:2",
     "def to(pad) { mission { home pad; takeOff location(pad.lat, pad.lon, 110); returnHomeAndLand() } }\n"
     "vs = pick { count 2; timeout 30.seconds }\n"
     "execute vs: to(location(41.1780, -8.5980, 90)) | to(location(41.1780, -8.59795, 90))\n"),
    ("a copter and a rover", "copter:1,rover:1",
     UP_AND_DOWN + "n = mission { home location(41.1780, -8.59795, 90); move 20, 0; returnHome() }\n"
     "a = pick { type 'UAV' }\nb = pick { type 'UGV' }\nexecute a: m, b: n\n"),
    ("within the battery", "copter:1", flight("move 100, 0") + ONE, "--limit", "endurance=900"),
    ("far, and allowed", "copter:1", flight("move 12000, 0") + ONE, "--allow", "too_far=a tanker waits there"),
    ("a plane's round", "plane:1", flight("goPos 41.1880, -8.5980, 170", "goPos 41.1880, -8.5880, 170") + ONE),
    ("a plane over 5 km", "plane:1", flight("goPos 41.2230, -8.5980, 200", "goPos 41.2230, -8.5380, 200") + ONE),
    ("a plane 15 km out", "plane:1", flight("move 15000, 0, 50") + ONE),
    ("a plane that circles", "plane:1", flight("loiterTurns 41.1830, -8.5980, 170, 3, 80") + ONE),
    ("a plane that goes down to land", "plane:1", flight("goPos 41.1880, -8.5980, 170", "goPos 41.1830, -8.5980, 120") + ONE),
    ("a rover without altitudes", "rover:1", drive("goPos 41.1785, -8.5980", "goPos 41.1785, -8.5970", home="41.1780, -8.5980") + ONE),
    ("a rover round its field", "rover:1", drive("move 80, 0", "move 0, 80", "returnHome()") + ONE),
    ("a rover's second mission", "rover:1", drive("move 30, 0") + "n = mission { home " + FIELD + "; returnHome() }\n"
     "v = pick { timeout 30.seconds }\nexecute v: m >> n\n"),
    ("a rover without home", "rover:1", drive("goPos 41.1785, -8.5980, 90", home="") + ONE),
    ("a boat", "boat:1", drive("move 500, 0", "move 0, 500") + ONE),
    ("a submarine", "sub:1", drive("move 20, 0, (-10)", "move 20, 0, (-10)", home="location(41.1780, -8.5980, 0)") + ONE,
     "--home", "41.1780,-8.5980,0"),
    ("PX4 up and down", "px4:1", UP_AND_DOWN + ONE),
    ("PX4 over a survey", "px4:1", flight("surveyArea 200, 200, 40, 'NORTH_EAST'") + ONE),
    ("a PX4 rover", "px4-rover:1", drive("move 50, 0") + ONE),
    ("a PX4 plane", "px4-plane:1", flight("goPos 41.1880, -8.5980, 170", land=False) + ONE),
]


class Flight(NamedTuple):
    """How a run ended."""

    code: int
    err: str  # what was logged
    sent: list[int]  # MAV_CMD of every command of the ground


def commands_sent(folder: pathlib.Path) -> list[int]:
    """MAV_CMD of every command that the ground sent."""
    sent = []
    for log in folder.glob("*.tlog"):
        reader = mavutil.mavlink_connection(str(log))
        while (message := reader.recv_match(type=["COMMAND_LONG", "COMMAND_INT"])) is not None:
            if message.get_srcSystem() == 255:
                sent.append(message.command)
    return sent


def fly(run: Callable, script: str, *options: str) -> Flight:
    """`run` runs the program to its end: (exit code, standard output, standard error)."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        file = folder / "script.dolphin"
        file.write_text(script)
        code, _, err = run("run", str(file), "--record", str(folder / "log"), *options)
        return Flight(code, err, commands_sent(folder / "log"))


def refused_or_warned(case, flight: Flight):
    what, _, _, rule, is_refused, *_ = case
    code, err, sent = flight
    said = re.search(rf"plausibility: .*\[{rule}\]|failed: .*\[{rule}\]|failed: the mission has no items", err)
    assert said, f"{what}: nothing about {rule} in\n{err}"
    if is_refused:
        assert code != 0, f"{what}: exit 0\n{err}"
        assert not {ARM, SET_HOME, START} & set(sent), f"{what}: sent {sent}\n{err}"
    else:
        begun = err.find(" flies '")
        assert begun < 0 or said.start() < begun, f"{what}: said only after the start\n{err}"


def not_remarked(case, flight: Flight):
    what, _, _, *options = case
    code, err, sent = flight
    said = [line for line in err.splitlines() if "plausibility" in line or "implausible" in line]
    if "--allow" in options:
        assert len(said) == 1 and "allowed: a tanker waits there" in said[0], f"{what}: {said}"
        said = []
    assert not said, f"{what}: {said}"
    assert ARM in sent, f"{what}: never armed\n{err}"
    assert code == 0, f"{what}: exit {code}\n{err}"
