"""The process that sees is killed in flight: it is back within seconds, the drone, which does not rely on it, waits where it is and surveys on with the map that there was:
the slots have their ids, and the ground that was seen is not flown over again. A camera that comes to its end is named in vision's health and tried again; so is a map that is
damaged, which is put aside; a file that makes no sense is refused before anything is started."""

import contextlib
import json
import math
import os
import pathlib
import shutil
import signal
import time

import harness
import survey
from drone import Drone, Operator, take_off
from ros_drone import DiagnosticStatus, RosDrone



def remembered_slots(folder: pathlib.Path) -> dict[str, dict]:
    """What a new process would know, by their ids."""
    with contextlib.suppress(OSError):
        features = json.loads((folder / "found/survey.jsonl").read_text().splitlines()[1])["features"]
        return {one["id"]: one["properties"] for one in features}
    return {}


with Drone(processes=survey.tables()) as drone:
    operator = Operator(drone.port)
    take_off(operator)
    operator.command("Autonomous Explore")
    operator.wait_for_state("AutonomousExplore", 5)
    operator.wait(lambda o: math.hypot(o.last["Local Position X"], o.last["Local Position Y"]) > 8, "it is on its way", 20)
    found = drone.folder / "found/slots.geojson"
    harness.wait_until(lambda: len(remembered_slots(drone.folder)) > 3 or time.sleep(0.1), 40, "slots are remembered")
    perceive = drone.pid("perceive")
    os.kill(perceive, signal.SIGKILL)
    before, coverage = remembered_slots(drone.folder), survey.found_slots(drone.folder)["survey"]["coverage"]
    found.unlink()
    told = len(operator.errors)
    drone.wait_for_log("perceive killed by signal 9 (Killed); it is started again")
    harness.wait_until(lambda: (pid := drone.pid("perceive")) and pid != perceive or time.sleep(0.05), 10, "perceive runs again")
    drone.wait_for_log("is taken up")
    harness.wait_until(lambda: found.exists() or time.sleep(0.05), 20, "the slots are written again")
    after = survey.found_slots(drone.folder)
    states = {one["id"]: one["properties"] for one in after["features"]}
    assert set(before) <= set(states), (sorted(before), sorted(states))
    # What has been looked at since may have changed; the rest is as it was, and as old.
    for name, was in before.items():
        assert states[name]["seen_at"] > was["seen_at"] or states[name]["state"] == was["state"], (name, was, states[name])
    assert after["survey"]["coverage"] > coverage - 0.05 and after["survey"]["begun"], (coverage, after["survey"])
    operator.wait(lambda o: set(before) <= {one["id"] for one in o.slots}, "the operator sees them", 10)
    operator.wait_for_error("the survey is over: nothing more to learn", 150)
    assert not any("the survey is over" in one for one in operator.errors[:told]), operator.errors
    assert all(one["State"] == "AutonomousExplore" for one in operator.heartbeats[-10:]), "it has waited in the air"
    in_all = survey.compare(survey.found_slots(drone.folder))
    print("taken up:", len(before), "slots,", f"coverage {coverage:.2f}; in all:", in_all)
    assert in_all["found"] >= 0.8 * in_all["true"] and in_all["extra"] <= 2, in_all  # from up to 20 m, with few pixels
    operator.command("Land")
    operator.wait(lambda o: o.last["State"] == "Idle" and not o.last["Armed"], "it has landed", 60)
    operator.cut()

# A folder of pictures that ends.
lots = pathlib.Path(__file__).parents[2] / "golden/lots"
drone = Drone(processes=survey.tables(camera='kind = "folder"\nfolder = "pictures"\nwidth = 480\nheight = 480'))
pictures = drone.folder / "pictures"
pictures.mkdir()
rows = ["file,time,east_m,north_m,up_m,yaw_deg,tilt_deg,roll_deg"]
for number in range(3):
    shutil.copy(lots / "00.jpg", pictures / f"{number}.jpg")
    rows.append(f"{number}.jpg,2026-05-0{number + 1}T12:00:00Z,0,20,20,0,0,0")
(pictures / "poses.csv").write_text("\n".join(rows) + "\n")
(drone.folder / "found").mkdir()
(drone.folder / "found/survey.jsonl").write_text('{"format":"lapwing survey","version":1}\n')
with drone:
    drone.wait_for_log("the map of before is not taken up", 40)
    assert (drone.folder / "found/survey.jsonl.unread").exists()
    ros = RosDrone(drone.domain)
    health = ros.reader("/vision_health", DiagnosticStatus)
    told = []
    harness.wait_until(lambda: told.extend(health.take(100)) or any(one.level == 2 and "pictures" in one.message for one in told) or time.sleep(0.1), 40,
                       "vision says that its camera is gone")
    print(sorted({(one.level, one.message) for one in told}))
    # It is tried again, and goes on saying so.
    harness.wait_until(lambda: sum("the camera is open" in line for line in drone.log) >= 2 or time.sleep(0.1), 30, "it is opened again")

# Mistakes in the file are shown at once, those of both programs.
bad = pathlib.Path(drone.folder) / "bad.toml"
bad.write_text('[bridge]\nlink = "nowhere"\n[camera]\nkind = "eye"\n[survey]\narea = [[95, 0], [1, 2], [3, 4]]\nsped_m_s = 3\n')
_, errors = harness.expect_exit(2, "onboard", "--config", str(bad))
for words in ("nowhere", "no such kind of camera", "95 is no latitude", "sped_m_s"):
    assert words in errors, (words, errors)
