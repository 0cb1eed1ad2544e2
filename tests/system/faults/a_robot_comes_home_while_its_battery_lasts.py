"""A robot whose battery has little left while it is out exploring: the exploration ends by itself, the script drives it home, and the drive
tells what was left unseen. Its board is another program's."""

import json
import math
import pathlib
import subprocess
import tempfile

import harness
from served_building import ServedBuilding

SCRIPT = """
robot = pick { id 'robot1'; timeout 60.seconds }
execute robot: drive { explore(); returnToStart() }
"""

with tempfile.TemporaryDirectory() as folder, ServedBuilding(harness.ROOT / "examples/buildings/flat.toml") as building:
    script, report = pathlib.Path(folder, "floor.dolphin"), pathlib.Path(folder, "report.json")
    script.write_text(SCRIPT)
    start = dict(building.truth)

    def away_m(truth: dict) -> float:
        return math.dist((truth["x_m"], truth["y_m"]), (start["x_m"], start["y_m"]))

    run = subprocess.Popen([harness.LAPWING, "run", script, "--robot", f"tcpout://127.0.0.1:{building.port}", "--report", report, "--timeout", "300"],
                           stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        building.comes(lambda truth: away_m(truth) > 2.0, 120, "the robot is on its way")
        building.does("fault", "battery-low=0.18")
        out, err = run.communicate(timeout=200)
    finally:
        run.kill()
    assert run.returncode == 0, (run.returncode, out, err)
    robot = json.loads(report.read_text())["vehicles"][0]["robot"]
    told = robot["drives"][-1]
    assert told["outcome"] == "done", told
    assert told["remark"].startswith("explore: its battery takes it home and little farther: "), told
    assert told["remark"].endswith(" left unseen"), told
    assert away_m(building.truth) < 0.6, (start, building.truth)
    assert building.truth["collisions"] == 0, building.truth
    print(f"home after {building.truth['time_s']:.0f} s; {told['remark']}")
