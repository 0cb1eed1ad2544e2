"""`lapwing run --robot`: a robot with cameras maps a small building, another program looks at what these see, and what stands on the signs beside
the doors is in the report, the same in a second run. It goes to the door that a script names. Without that program it maps all the same."""

import json
import os
import pathlib
import shutil
import sys
import tempfile

import harness

FIND = """
robot = pick { id 'robot1'; timeout 60.seconds }
execute robot: drive { explore(); driveTo 'room 221'; photograph() }
message "${foundDoors(robot)} doors"
"""
TWO = """
robot = pick { id 'robot1'; timeout 60.seconds }
execute robot: drive { explore() } / { foundDoors(robot) >= 2 || coverage(robot) > 0.6 }
message "${coverage(robot)} ${position(robot)}"
"""
here = pathlib.Path(harness.LAPWING).parent
building = pathlib.Path(__file__).resolve().parents[3] / "examples/buildings/wing.toml"

if not (here / "lapwing-vision").exists():
    print("skipped: lapwing-vision was not built (setup/packages-vision.txt)")
    sys.exit(harness.SKIPPED)


def robot_of(folder: pathlib.Path, script: str) -> tuple[dict, str, str]:
    (folder / "find.dolphin").write_text(script)
    report = folder / "report.json"
    out, err = harness.expect_exit(0, "run", "--robot", f"sim:{building}", "--seed", "1", "--report", str(report), "--pictures",
                                   str(folder / "pictures"), str(folder / "find.dolphin"),
                                   seconds=400)
    return json.loads(report.read_text())["vehicles"][0]["robot"], out, err


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    robot, out, _ = robot_of(folder, FIND)
    numbers = {sign.split()[0] for sign in robot["signs"] if sign[0].isdigit()}  # of a meeting room its kind may be all that is read
    assert robot["doors"] == len(robot["signs"]), robot
    assert {"220", "221"} <= numbers <= {"220", "221", "222", "223"}, robot
    assert robot["drives"][0]["outcome"] == "done" and robot["collisions"] == 0, robot
    assert f"{robot['doors']} doors" in out, out
    photograph = pathlib.Path(robot["drives"][0]["remark"].rpartition("photograph: it is in ")[2])
    assert photograph.parent == folder / "pictures" and photograph.read_bytes().startswith(b"\xff\xd8"), robot["drives"]

    first = robot_of(folder, TWO)
    assert first[0]["doors"] == 2, first
    assert robot_of(folder, TWO)[:2] == first[:2], "two runs with one seed differ"

    # The same programs, but for the one that looks.
    (folder / "bin").mkdir()
    for program in ("lapwing", "lapwing-vehicles"):
        shutil.copy(here / program, folder / "bin" / program)
    harness.LAPWING = str(folder / "bin/lapwing")
    os.environ.setdefault("LAPWING_HOME", str(building.parents[2]))
    blind, _, err = robot_of(folder, TWO)
    assert blind["doors"] == 0 and blind["coverage"] > 0.6, blind
    assert err.count("pictures are not looked at") == 1, err
print(f"{robot['doors']} doors: {', '.join(robot['signs'])}")
