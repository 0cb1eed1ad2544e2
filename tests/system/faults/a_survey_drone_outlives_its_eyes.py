"""The process that sees is killed in flight: it is back within seconds, the drone, which does not rely on it, waits where it is and surveys on. A camera that comes to its end
is named in vision's health and tried again; a file that makes no sense is refused before anything is started."""

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

with Drone(processes=survey.tables()) as drone:
    operator = Operator(drone.port)
    take_off(operator)
    operator.command("Autonomous Explore")
    operator.wait_for_state("AutonomousExplore", 5)
    operator.wait(lambda o: math.hypot(o.last["Local Position X"], o.last["Local Position Y"]) > 8, "it is on its way", 20)
    perceive = drone.pid("perceive")
    os.kill(perceive, signal.SIGKILL)
    drone.wait_for_log("perceive killed by signal 9 (Killed); it is started again")
    harness.wait_until(lambda: (pid := drone.pid("perceive")) and pid != perceive or time.sleep(0.05), 10, "perceive runs again")
    harness.wait_until(lambda: (drone.folder / "found/slots.geojson").exists() and len(survey.found_slots(drone.folder)["features"]) > 3
                       or time.sleep(0.2), 40, "it surveys on")
    assert all(one["State"] == "AutonomousExplore" for one in operator.heartbeats[-10:]), "it has waited in the air"
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
with drone:
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
