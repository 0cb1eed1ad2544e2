"""What no pilot would command, and what pilots command, to vehicles with and without missions and fences. Not a test itself."""

from typing import NamedTuple

from plans import LAND, TAKE_OFF, WAYPOINT

LAT, LON, GROUND = 41.1780, -8.5980, 90
HOME = f"{LAT},{LON},{GROUND}"
COPTER_FENCE = ("FENCE_ENABLE=1", "FENCE_TYPE=7", "FENCE_RADIUS=300", "FENCE_ALT_MAX=80")
ROVER_FENCE = ("FENCE_ENABLE=1", "FENCE_TYPE=6", "FENCE_RADIUS=300")  # rovers have no heights
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


class Fleet(NamedTuple):
    """Vehicles of one row, with these parameters: nobody stands on another's pad."""

    vehicles: str
    first: int  # number of the first of them
    north_m: float
    parameters: tuple[str, ...] = ()


FLEETS = (Fleet("copter:10,plane:2,rover:3,boat:2,sub:2", 1, -100), Fleet("px4:3", 21, -50), Fleet("copter:3", 31, 0, COPTER_FENCE),
          Fleet("rover:1", 34, 25, ROVER_FENCE), Fleet("px4:1", 41, 50, PX4_FENCE))


def kinds(fleet: Fleet) -> dict[int, str]:
    """What each of them is, by its number."""
    each = [kind for kind, count in (group.split(":") for group in fleet.vehicles.split(",")) for _ in range(int(count))]
    return dict(enumerate(each, fleet.first))


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
