"""`--plans DIR`: scripts fly missions that were drawn elsewhere; what is wrong with a file is said where it is wanted."""

import json
import pathlib
import tempfile

import harness


def item(number: int, command: int, lat: float, lon: float, height: float, frame: int = 3) -> dict:
    return {"type": "SimpleItem", "autoContinue": True, "command": command, "doJumpId": number, "frame": frame,
            "params": [0, 0, 0, None if command == 16 else 0, lat, lon, height]}


def plan_of(*items: dict) -> str:
    return json.dumps({"fileType": "Plan", "version": 1, "groundStation": "QGroundControl",
                       "mission": {"version": 2, "items": items, "plannedHomePosition": [41.178, -8.598, 90]},
                       "geoFence": {"version": 2, "polygons": [],
                                    "circles": [{"circle": {"center": [41.178, -8.598], "radius": 500}, "inclusion": True}]}})


def expect(text: str, *words: str):
    for word in words:
        assert word in text, f"no {word!r} in\n{text}"


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    plans = folder / "plans"
    plans.mkdir()
    (plans / "north.plan").write_text(plan_of(item(1, 22, 41.178, -8.598, 20), item(2, 16, 41.179, -8.598, 25), item(3, 20, 0, 0, 0, 2)))
    (plans / "patrol.waypoints").write_text(
        "QGC WPL 110\n0\t1\t0\t16\t0\t0\t0\t0\t41.178\t-8.598\t90\t1\n1\t0\t3\t16\t0\t0\t0\t0\t41.1783\t-8.598\t0\t1\n")

    def script(text: str) -> str:
        path = folder / "script.dolphin"
        path.write_text(text)
        return str(path)

    with_plans = ("--plans", str(plans))
    harness.expect_exit(0, "check", script("v = pick {}\nexecute task('north')"), *with_plans)

    # A copter flies the plan above its own home, a rover the way points.
    report = folder / "report.json"
    both = """
air = pick { type 'UAV'; timeout 30 }
ground = pick { type 'UGV'; timeout 30 }
execute air: imcPlan['north'], ground: task('patrol')
"""
    _, err = harness.expect_exit(0, "run", script(both), "--sim", "copter:1,rover:1", "--report", str(report), *with_plans)
    expect(err, "geofence")
    missions = [mission for vehicle in json.loads(report.read_text())["vehicles"] for mission in vehicle["missions"]]
    assert {(mission["name"], mission["items"], mission["outcome"]) for mission in missions} == {
        ("north", 4, "done"), ("patrol", 2, "done")}, missions

    # A rover does not take off; no other vehicle is picked, so nothing starts.
    _, err = harness.expect_exit(1, "run", script("v = pick { type 'UGV'; timeout 30 }\nexecute v: task('north')"),
                                 "--sim", "rover:1", *with_plans)
    expect(err, "item 1, NAV_TAKEOFF: a rover with ArduPilot would skip it")

    # Unknown names, broken files, no directory.
    _, err = harness.expect_exit(1, "run", script("v = pick { timeout 30 }\nexecute task('nort')"), "--sim", "copter:1", *with_plans)
    expect(err, "there is no plan called 'nort'", "did you mean north?")
    (plans / "broken.plan").write_text(plan_of({"type": "SimpleItem", "command": "16", "frame": 3, "params": []}))
    out, _ = harness.expect_exit(2, "check", script("v = pick {}\nexecute task('north')"), *with_plans)
    expect(out, "broken.plan: mission.items[0].command: a number was expected")
    _, err = harness.expect_exit(1, "run", script("v = pick {}\nexecute task('broken')"), "--platform", "test", *with_plans)
    expect(err, "broken.plan: mission.items[0].command: a number was expected")
    _, err = harness.expect_exit(2, "run", script("message 1"), "--sim", "copter:1", "--plans", str(folder / "nowhere"))
    expect(err, "nowhere", "No such file")

    # Raw messages reach the vehicle; mistakes in them are explained.
    send = "v = pick { type 'UAV'; timeout 30 }\nsendMessage v, 'COMMAND_LONG', command: %s, param1: 1\npause 2"
    harness.expect_exit(0, "run", script(send % "'MAV_CMD_COMPONENT_ARM_DISARM'"), "--sim", "copter:1")
    _, err = harness.expect_exit(1, "run", script(send % "'MAV_CMD_COMPONENT_ARM'"), "--sim", "copter:1")
    expect(err, "MAVLink has no MAV_CMD_COMPONENT_ARM")
