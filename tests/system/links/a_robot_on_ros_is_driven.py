"""A robot on ROS 2, whose messages come from another middleware than ours, explores its floor and comes home by a script, in the frames
that it tells: its laser hangs upside down. It is as robots of today are: stamped commands, frames in its own namespace, a laser whose turns
differ. Its map, its place and its way are there for who looks on with ROS. While it stands nobody talks to it, and when the script ends it
stands."""

import json
import math
import pathlib
import subprocess
import tempfile

import harness
from ros_robot import Onlooker, RosRobot, room

SCRIPT = """
robot = pick { id 'robot1'; timeout 60.seconds }
execute robot: drive { explore(); returnToStart() }
"""
# Two rooms with a door of a metre between them.
WALLS = [*room((-1.5, -1.0), (4.5, -1.0), (4.5, 2.0), (-1.5, 2.0)), ((2.0, -1.0), (2.0, 0.2)), ((2.0, 1.2), (2.0, 2.0))]

domain = harness.own_domain()
with tempfile.TemporaryDirectory() as folder, RosRobot(domain, "/floor/r1", WALLS, of_today=True) as robot:
    onlooker = Onlooker(domain, "/floor/r1", "/floor/r1/tf")
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

    # Who looks on with ROS has the floor, within the walls' own cells, and the robot where it is on it.
    grid = onlooker.maps()[-1]
    assert grid.header.frame_id == "map" and abs(grid.info.resolution - 0.05) < 1e-6, grid.header
    free_m2 = sum(cell == 0 for cell in grid.data) * grid.info.resolution ** 2
    assert abs(free_m2 - told["robot"]["free_m2"]) < 0.5, (free_m2, told)
    assert {-1, 0, 100} == set(grid.data) and len(grid.data) == grid.info.width * grid.info.height, (grid.info, set(grid.data))
    corner = grid.info.origin.position
    assert abs(corner.x + 1.5) < 0.3 and abs(corner.y + 1.0) < 0.3, corner
    last = onlooker.poses()[-1].pose
    assert math.hypot(last.pose.position.x - robot.x, last.pose.position.y - robot.y) < 0.1, (last, robot.x, robot.y)
    frame = onlooker.frames()[-1]
    assert (frame.header.frame_id, frame.child_frame_id) == ("map", "odom"), frame
    assert math.hypot(frame.transform.translation.x, frame.transform.translation.y) < 0.1, "its odometry is right"
    ways = onlooker.ways()
    assert max(len(way.poses) for way in ways) > 10 and not ways[-1].poses, [len(way.poses) for way in ways[-5:]]

for wrong, why in (("ros2://200/r1", "no domain"), ("ros2://0/a b", "no topic")):
    refused = subprocess.run([harness.LAPWING, "run", "-", "--robot", wrong], input=SCRIPT, capture_output=True, text=True, timeout=30, check=False)
    assert refused.returncode == 2 and why in refused.stderr, (wrong, refused.returncode, refused.stderr)
print(f"the robot on ROS 2 explored {told['robot']['free_m2']} m^2 and came home after {robot.driven_m:.1f} m")
