"""`lapwing run --robot tcpout://... --robot-cameras F`: a robot whose board is another program's, with cameras whose pictures that program puts into
folders. Before there are any, that is said; then it finds a door, and photographs it into a file whose path it tells. What is wrong with the file of
cameras is said before anything moves."""

import json
import pathlib
import subprocess
import sys
import tempfile

import harness
from served_building import ServedBuilding

WING = harness.ROOT / "examples/buildings/wing.toml"
SCRIPT = """
robot = pick { id 'robot1'; type 'UGV'; payload 'Camera'; timeout 60.seconds }
execute robot: drive { explore() } / { foundDoors(robot) >= 1 } >> drive { photograph() }
message "${foundDoors(robot)} doors"
"""
# The first two cameras to the sides of a simulated robot (src/sim/building/robot/robot_settings.cpp).
CAMERAS = {"left": 49.85, "right": -49.85}

here = pathlib.Path(harness.LAPWING).parent
for program in ("lapwing-vision", "lapwing-perceive"):
    if not (here / program).exists():
        print(f"skipped: {program} was not built (setup/packages-vision.txt)")
        sys.exit(harness.SKIPPED)


def cameras_of(folder: pathlib.Path) -> pathlib.Path:
    file = folder / "cameras.toml"
    file.write_text("".join(f'[[camera]]\nfolder = "{name}"\nyaw_deg = {yaw}\npitch_deg = 20.05\nview_deg = 53.86\n' for name, yaw in CAMERAS.items()))
    for name in CAMERAS:
        (folder / name).mkdir()
    return file


def show(building: ServedBuilding, folder: pathlib.Path, number: int):
    """What each camera sees now, whole from the first moment on."""
    for camera, name in enumerate(CAMERAS):
        part = folder / name / "part"
        part.write_bytes(building.shoot(camera, folder / f"{name}.ppm"))
        part.rename(folder / name / f"{number % 3}.png")


with tempfile.TemporaryDirectory() as name, ServedBuilding(WING) as building:
    folder = pathlib.Path(name)
    script, report, said = folder / "doors.dolphin", folder / "report.json", folder / "said"
    script.write_text(SCRIPT)
    with said.open("w") as errors:
        run = subprocess.Popen([harness.LAPWING, "run", script, "--robot", f"tcpout://127.0.0.1:{building.port}", "--robot-cameras", cameras_of(folder),
                                "--pictures", folder / "photographs", "--report", report, "--timeout", "400"], stdout=subprocess.PIPE, stderr=errors, text=True)
        try:
            harness.wait_until(lambda: "gives no pictures: no picture lies in" in said.read_text() or run.poll() is not None, 120, "missing pictures are said")
            number = 0
            while run.poll() is None:
                show(building, folder, number)
                number += 1
        finally:
            run.kill()
    out, err = run.stdout.read(), said.read_text()
    assert run.returncode == 0, (run.returncode, out, err)
    assert "gives pictures again" in err, err
    robot = json.loads(report.read_text())["vehicles"][0]["robot"]
    assert robot["doors"] >= 1 and robot["signs"], robot
    assert building.truth["collisions"] == 0, building.truth
    told = robot["drives"][-1]
    assert told["outcome"] == "done" and told["remark"].startswith("photograph: it is in "), told
    photograph = pathlib.Path(told["remark"].removeprefix("photograph: it is in "))
    assert photograph.parent == folder / "photographs" and photograph.read_bytes().startswith(b"\xff\xd8"), told

with tempfile.TemporaryDirectory() as name:
    file = pathlib.Path(name, "cameras.toml")
    board = ("--robot", "tcpout://127.0.0.1:9")
    for text, robots, why in (('[[camera]]\nsource = "concat:a://b"\n', board, "do not come that way"), ("[[camera]]\nyaw = 90\n", board, "no setting yaw"),
                              ('[[camera]]\nrobot = "robot2"\nfolder = "a"\n', board, "no robot 'robot2'"),
                              ('[[camera]]\ntopic = "/image"\n', board, "not on ROS 2"),
                              ('[[camera]]\nfolder = "a"\n', ("--robot", f"sim:{WING}"), "has its own cameras")):
        file.write_text(text)
        code, _, err = harness.finish("run", "-", *robots, "--robot-cameras", str(file), input=SCRIPT)
        assert code == 2 and why in err, (text, code, err)
print(f"{robot['doors']} doors by {number} rounds of pictures: {', '.join(robot['signs'])}")
