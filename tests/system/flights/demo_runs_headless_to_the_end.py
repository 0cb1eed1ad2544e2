"""`lapwing demo --headless`: two copters and a rover fly the example script over UDP and see a car park, a robot maps the office and
finds its doors, each where the program that looks is there, and the report says so."""

import json
import pathlib
import re
import tempfile

import harness

with tempfile.TemporaryDirectory() as folder:
    path = pathlib.Path(folder, "report.json")
    out, err = harness.expect_exit(0, "demo", "--headless", "--report", str(path), seconds=1200)
    report = json.loads(path.read_text())

assert report["outcome"] == "done", report
assert report["errors"] == [], report["errors"]
assert report["script"].endswith("demo.dolphin"), report["script"]
vehicles = {vehicle["id"]: vehicle for vehicle in report["vehicles"]}
assert sorted(v["type"] for v in vehicles.values()) == ["copter", "copter", "robot", "rover"], vehicles
robot = vehicles.pop("robot1")
for vehicle in vehicles.values():
    assert vehicle["track_m"] > 100, f"vehicle {vehicle['id']} moved {vehicle['track_m']} m"
    assert vehicle["missions"], f"vehicle {vehicle['id']} flew nothing"
    for mission in vehicle["missions"]:
        assert mission["outcome"] == "done", mission
        assert mission["items"] > 3 and mission["upload_s"] >= 0, mission

assert robot["missions"] == [], robot
mapped = robot["robot"]
assert [(drive["name"], drive["outcome"], drive["error"]) for drive in mapped["drives"]] == [("Office", "done", "")], mapped
assert 0 < mapped["coverage"] <= 1, mapped
assert 50 < mapped["free_m2"] < 48 * 24, mapped
assert mapped["collisions"] == 0, mapped
assert robot["track_m"] > 20, robot
office = pathlib.Path(__file__).resolve().parents[3] / "examples/buildings/office.toml"
there = set(re.findall(r'^sign = "(\d+)', office.read_text(), re.MULTILINE))
found = {sign.split()[0] for sign in mapped["signs"] if sign[0].isdigit()}
assert mapped["doors"] == len(mapped["signs"]), mapped
if pathlib.Path(harness.LAPWING).with_name("lapwing-vision").exists():
    assert len(found & there) >= 0.7 * len(there) and len(found - there) <= 1, (found, there)
else:
    assert not found, mapped


# What the copters saw, where the program is built that shows them the car park.
if pathlib.Path(harness.LAPWING).with_name("lapwing-perceive").exists():
    park, score = report["car_park"], report["car_park"]["score"]
    assert park["pictures"] > 50 and park["coverage"] > 0.95, park
    assert score["true_slots"] == 432 and score["found"] > 0.8 * 432, park
    assert score["invented"] < 0.03 * 432 and score["off_m"] < 0.6, park
    assert score["told"] > 0.9 * score["found"] and score["right"] > 0.95 * score["told"], park


def leaves(task):
    return [task] if not task["children"] else [leaf for child in task["children"] for leaf in leaves(child)]


states = {leaf["state"] for root in report["tasks"] for leaf in leaves(root)}
assert states == {"done"}, states
print(f"{mapped['coverage']:.0%} of the office, {mapped['free_m2']:.0f} m2, {len(found)} of {len(there)} doors in {robot['track_m']:.0f} m; {len(vehicles)} vehicles, {sum(v['track_m'] for v in vehicles.values()):.0f} m in all")
