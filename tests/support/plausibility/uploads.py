"""Plans that no pilot would upload, and plans that pilots upload. Not a test itself."""

import json
import pathlib
import re
import tempfile

import harness
import plans
from plans import LAND, TAKE_OFF, WAYPOINT
from plausibility.commands import HOME, LAT, LON, NO_MINUS, SWAPPED, metres, way

AWAY = {"polygons": [{"polygon": [[38.72, -9.14], [38.72, -9.13], [38.73, -9.13]], "inclusion": True, "version": 1}]}
ROUND = {"polygons": [{"polygon": [[41.17, -8.61], [41.17, -8.58], [41.19, -8.58], [41.19, -8.61]], "inclusion": True, "version": 1}]}
TOWER = {"circles": [{"circle": {"center": [metres(100)["lat_deg"], LON], "radius": 20}, "inclusion": False, "version": 1}]}

# (what, vehicles, items, fence, rule)
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


def upload(items, fence, *where: str):
    """(exit code, plans that went up, what was logged); `where` the vehicles are."""
    with tempfile.TemporaryDirectory() as name:
        file = pathlib.Path(name, "a.plan")
        file.write_text(plans.text(items, fence))
        code, out, err = harness.finish("mission", "upload", str(file), "--json", *where)
        return code, json.loads(out)["plans"], err


def simulated(vehicles: str) -> tuple[str, ...]:
    return "--sim", vehicles, "--home", HOME


def is_refused(case, *where: str):
    what, vehicles, items, fence, rule = case
    code, uploaded, err = upload(items, fence, *(where or simulated(vehicles)))
    assert code == 2 and not uploaded and re.search(rf"\[{rule}\]", err), (what, code, uploaded, err)


def goes_through(case, *where: str):
    what, vehicles, items, fence = case
    code, uploaded, err = upload(items, fence, *(where or simulated(vehicles)))
    assert code == 0 and uploaded and all(plan["outcome"] == "uploaded" for plan in uploaded), (what, code, uploaded, err)
    assert not re.search(r"\[[a-z_]+\]", err), (what, err)
