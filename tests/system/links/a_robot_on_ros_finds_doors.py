"""A robot on ROS 2 whose camera's pictures come over a topic of another middleware than ours: what stands in them is found and laid on its map. Its camera
shows the same sign wherever it is, as a simulated building has one."""

import json
import pathlib
import subprocess
import sys
import tempfile

import harness
from ros_robot import RosRobot, room

SCRIPT = """
robot = pick { id 'robot1'; type 'UGV'; payload 'Camera'; timeout 60.seconds }
execute robot: drive { explore() } / { foundDoors(robot) >= 1 }
message "${foundDoors(robot)}"
"""
# Two rooms with a door of a metre between them.
WALLS = [*room((-1.5, -1.0), (4.5, -1.0), (4.5, 2.0), (-1.5, 2.0)), ((2.0, -1.0), (2.0, 0.2)), ((2.0, 1.2), (2.0, 2.0))]
BEFORE_THE_SIGN = ("3.3", "4.7", "90")

here = pathlib.Path(harness.LAPWING).parent
if not (here / "lapwing-vision").exists():
    print("skipped: lapwing-vision was not built (setup/packages-vision.txt)")
    sys.exit(harness.SKIPPED)


def as_jpeg(ppm: bytes) -> bytes:
    """By the one that looks: what it keeps of a photograph."""
    _, size, _, pixels = ppm.split(b"\n", 3)
    width, height = map(int, size.split())
    request = json.dumps({"look": "photograph", "width": width, "height": height, "bytes": len(pixels)}).encode() + b"\n" + pixels
    answer = subprocess.run([here / "lapwing-vision", "look"], input=request, capture_output=True, timeout=60, check=True).stdout
    head, body = answer.split(b"\n", 1)
    return body[:json.loads(head)["jpeg_bytes"]]


domain = harness.own_domain()
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    seen, script, report, cameras = folder / "seen.ppm", folder / "doors.dolphin", folder / "report.json", folder / "cameras.toml"
    subprocess.run([here / "building_hand", "picture", str(harness.ROOT / "examples/buildings/wing.toml"), *BEFORE_THE_SIGN, str(seen)], check=True,
                   stdout=subprocess.DEVNULL)
    script.write_text(SCRIPT)
    cameras.write_text('[[camera]]\ntopic = "/floor/r1/image_raw/compressed"\nat = [0.1, 0, 0.9]\n')
    with RosRobot(domain, "/floor/r1", WALLS, as_jpeg(seen.read_bytes())) as robot:
        _, err = harness.expect_exit(0, "run", str(script), "--robot", f"ros2://{domain}/floor/r1", "--robot-cameras", str(cameras), "--report", str(report),
                                     seconds=240)
    told = json.loads(report.read_text())["vehicles"][0]["robot"]
    assert told["doors"] >= 1 and any(sign.startswith("221") for sign in told["signs"]), (told, err)
    assert robot.touches == 0, robot.touches
print(f"found {told['signs']}")
