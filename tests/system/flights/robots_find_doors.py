"""`lapwing run --robot`: a robot with cameras maps a small building, another program looks at what these see, and what stands on the signs beside
the doors is in the report, the same in a second run. It goes to the door that a script names. Without that program it maps all the same."""

import json
import os
import pathlib
import shutil
import sys
import tempfile

import harness

SCRIPT = """
robot = pick { id 'robot1'; timeout 60.seconds }
execute robot: drive { explore() } / { foundDoors(robot) >= 4 } >> drive { driveTo 'room 223'; photograph() }
message "${foundDoors(robot)} doors"
"""
here = pathlib.Path(harness.LAPWING).parent
building = pathlib.Path(__file__).resolve().parents[3] / "examples/buildings/wing.toml"

if not (here / "lapwing-vision").exists():
    print("skipped: lapwing-vision was not built (setup/packages-vision.txt)")
    sys.exit(harness.SKIPPED)


def robot_of(folder: pathlib.Path, exit_code: int) -> tuple[dict, str, str]:
    report = folder / "report.json"
    out, err = harness.expect_exit(exit_code, "run", "--robot", f"sim:{building}", "--seed", "1", "--report", str(report), str(folder / "find.dolphin"),
                                   seconds=200)
    return json.loads(report.read_text())["vehicles"][0]["robot"], out, err


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    (folder / "find.dolphin").write_text(SCRIPT)
    robot, out, err = robot_of(folder, 0)
    numbers = {sign.split()[0] for sign in robot["signs"]}
    assert robot["doors"] == len(robot["signs"]), robot
    assert {"221", "223"} <= numbers <= {"220", "221", "222", "223"}, robot
    assert robot["drives"][-1]["outcome"] == "done" and robot["collisions"] == 0, robot
    assert f"{robot['doors']} doors" in out, out
    assert robot_of(folder, 0)[0] == robot, "two runs with one seed differ"

    # The same programs, but for the one that looks.
    (folder / "bin").mkdir()
    for program in ("lapwing", "lapwing-vehicles"):
        shutil.copy(here / program, folder / "bin" / program)
    harness.LAPWING = str(folder / "bin/lapwing")
    os.environ.setdefault("LAPWING_HOME", str(building.parents[2]))
    blind, out, err = robot_of(folder, 1)
    assert blind["doors"] == 0 and "the map has no place called 'room 223'" in blind["drives"][-1]["error"], blind
    assert blind["coverage"] > 0.9, blind
    assert err.count("pictures are not looked at") == 1, err
print(f"{robot['doors']} doors: {', '.join(robot['signs'])}")
