"""A robot on ROS 2, whose messages come from another middleware than ours, explores its floor and comes home by a script, in the frames
that it tells: its laser hangs upside down. While it stands nobody talks to it, and when the script ends it stands."""

import json
import math
import pathlib
import subprocess
import tempfile

import harness
from ros_robot import RosRobot, room

SCRIPT = """
robot = pick { id 'robot1'; timeout 60.seconds }
execute robot: drive { explore(); returnToStart() }
"""
# Two rooms with a door of a metre between them.
WALLS = [*room((-1.5, -1.0), (4.5, -1.0), (4.5, 2.0), (-1.5, 2.0)), ((2.0, -1.0), (2.0, 0.2)), ((2.0, 1.2), (2.0, 2.0))]

domain = harness.own_domain()
with tempfile.TemporaryDirectory() as folder, RosRobot(domain, "/floor/r1", WALLS) as robot:
    script, report = pathlib.Path(folder, "floor.dolphin"), pathlib.Path(folder, "report.json")
    script.write_text(SCRIPT)
    done = subprocess.run([harness.LAPWING, "run", script, "--robot", f"ros2://{domain}/floor/r1", "--report", report], capture_output=True, text=True,
                          timeout=240, check=False)
    assert done.returncode == 0, (done.returncode, done.stdout, done.stderr)
    told = next(v for v in json.loads(report.read_text())["vehicles"] if v["id"] == "robot1")
    assert told["robot"]["coverage"] > 0.95, told
    # 18 m^2, without what the walls' own cells take.
    assert 15 < told["robot"]["free_m2"] < 19, told
    assert abs(told["track_m"] - robot.driven_m) < 0.1 * robot.driven_m + 0.2, (told["track_m"], robot.driven_m)
    assert math.hypot(robot.x, robot.y) < 0.3, (robot.x, robot.y)
    assert robot.touches == 0, robot.touches
    assert robot.heard[-1][1:] == (0.0, 0.0), robot.heard[-5:]

for wrong, why in (("ros2://200/r1", "no domain"), ("ros2://0/a b", "no topic")):
    refused = subprocess.run([harness.LAPWING, "run", "-", "--robot", wrong], input=SCRIPT, capture_output=True, text=True, timeout=30, check=False)
    assert refused.returncode == 2 and why in refused.stderr, (wrong, refused.returncode, refused.stderr)
print(f"the robot on ROS 2 explored {told['robot']['free_m2']} m^2 and came home after {robot.driven_m:.1f} m")
