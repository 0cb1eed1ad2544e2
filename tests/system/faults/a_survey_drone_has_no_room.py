"""The disk of a survey drone is full while it surveys: what cannot be kept is told, once, the flight goes on, and is kept when there is room again. Meanwhile the process that
sees is stopped, and then given no memory: it is replaced, and nobody else misses a step. On a small tmpfs, which needs the right to mount."""

import os
import pathlib
import resource
import signal
import subprocess
import sys
import time

import harness
import survey
from drone import Drone, Operator, take_off
from ros_drone import RosDrone
from drone_faults.vision_health import Vision

KIBIBYTE = 1024


class SmallDisk:
    def __init__(self, folder: pathlib.Path):
        self.folder = folder
        folder.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={256 * KIBIBYTE}", "tmpfs", folder], capture_output=True, text=True, check=False)
        if mounted.returncode != 0:
            print(f"skipped: no small disk can be mounted here ({mounted.stderr.strip()})")
            sys.exit(harness.SKIPPED)

    def __enter__(self):
        with (self.folder / "ballast").open("wb", buffering=0) as ballast:
            try:
                while True:
                    ballast.write(b"x" * 4096)
            except OSError:
                return self

    def __exit__(self, *_):
        subprocess.run(["umount", "--lazy", self.folder], check=True)

    def make_room(self) -> None:
        (self.folder / "ballast").unlink()


def replaced(before: int) -> int:
    """The pid of the successor of who saw."""
    return harness.wait_until(lambda: (pid := drone.pid("perceive")) and pid != before and pid or time.sleep(0.05), 20, "perceive runs again")


drone = Drone(processes=survey.tables())
with SmallDisk(drone.folder / "state") as settings, SmallDisk(drone.folder / "found") as found, drone:
    vision = Vision(RosDrone(drone.domain))
    operator = Operator(drone.port)
    operator.wait(lambda o: o.last, "the first heartbeat", 40)
    operator.command("Configure", Min=7, Des=8, Max=14)
    operator.wait_for_error("the heights are not kept over boots")
    take_off(operator)
    assert abs(operator.last["Relative Altitude"] - 8) < 1, "they hold all the same"
    bridge, decide = drone.pid("bridge"), drone.pid("decide")
    operator.command("Autonomous Explore")
    operator.wait_for_state("AutonomousExplore", 5)
    began = len(operator.heartbeats)
    drone.wait_for_log("the slots are not written", 30)
    drone.wait_for_log("the map is not written", 30)

    perceive = drone.pid("perceive")
    os.kill(perceive, signal.SIGSTOP)
    drone.wait_for_log("perceive stopped by signal 19")
    perceive = replaced(perceive)
    vision.wait(lambda _: vision.count("pictures_looked_at") > 4, "it sees again", 40)

    # As a leak beside it has it: what it has it keeps, and nothing is added. It sees on with that, or is replaced.
    resource.prlimit(perceive, resource.RLIMIT_AS, (64 * KIBIBYTE * KIBIBYTE, resource.RLIM_INFINITY))
    seen = vision.count("pictures_looked_at")
    vision.wait(lambda _: drone.pid("perceive") not in (None, perceive) or vision.count("pictures_looked_at") > seen + 20, "it sees on without more memory", 40)
    print("without memory:", "it sees on" if drone.pid("perceive") == perceive else drone.health()["perceive"]["last_end"])

    settings.make_room()
    found.make_room()
    harness.wait_until(lambda: (drone.folder / "found/slots.geojson").exists() or time.sleep(0.1), 40, "with room again the slots are written")
    harness.wait_until(lambda: (drone.folder / "found/survey.jsonl").exists() or time.sleep(0.1), 40, "and the map")
    assert all(one["State"] == "AutonomousExplore" and one["Ardupilot State"] == "GUIDED" for one in operator.heartbeats[began:]), "it has flown on"
    assert (drone.pid("bridge"), drone.pid("decide")) == (bridge, decide), drone.health()
    operator.command("Land")
    operator.wait(lambda o: o.last["State"] == "Idle" and not o.last["Armed"], "it has landed", 60)
    operator.command("Configure", Min=7, Des=9, Max=14)
    harness.wait_until(lambda: (drone.folder / "state/hover-heights.toml").exists() or time.sleep(0.05), 10, "the heights are kept again")
    operator.cut()
