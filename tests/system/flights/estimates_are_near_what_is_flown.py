"""Estimates of missions are within 10 % of what the simulator flies, for each kind of vehicle and of mission."""

import json
import pathlib
import sys
import tempfile

import harness

HEAD = "base = location(41.1780, -8.5980, 90)\nm = mission {\n  name 'm'\n  home base\n"
UP = "  takeOff location(41.1780, -8.5980, 130)\n"
TAIL = "}\nv = pick { type '%s'; timeout 30.seconds }\nexecute v: m\n"

TYPES = {"copter": "UAV", "plane": "UAV", "rover": "UGV", "boat": "USV", "sub": "UUV"}

# name: (vehicle, commands)
MISSIONS = {
    "hop": ("copter", UP + "  move 60, 0\n  returnHomeAndLand()\n"),
    "far": ("copter", UP + "  move 800, 0\n  move 0, 500\n  move (-800), 100\n  returnHomeAndLand()\n"),
    "survey": ("copter", UP + "  speed 8\n  surveyArea 150, 100, 20, 'NORTH_EAST'\n  returnHomeAndLand()\n"),
    "tower": ("copter", UP + "  move 0, 30, 100\n  move 0, 0, (-80)\n  returnHomeAndLand()\n"),
    "short legs": ("copter", UP + "".join(f"  move {10 * (1 - i % 2)}, {10 * (i % 2)}\n" for i in range(12)) + "  returnHomeAndLand()\n"),
    "circles": ("copter", UP + "  move 100, 0\n  moveAndLoiterTurns 50, 0, 0, 3, 20\n  moveAndLoiterTime 0, 50, 0, 30\n  returnHomeAndLand()\n"),
    "round": ("rover", "  move 0, 60\n  move 80, 0\n  move 0, (-120)\n  move (-80), 0\n  returnHome()\n"),
    "slow round": ("rover", "  speed 2\n  move 0, 40\n  move 40, 0\n  move 0, (-40)\n  returnHome()\n"),
    "rover survey": ("rover", "  surveyArea 80, 60, 10, 'NORTH_EAST'\n  returnHome()\n"),
    "boat round": ("boat", "  move 0, 60\n  move 80, 0\n  moveAndLoiterTime 0, (-60), 0, 20\n  returnHome()\n"),
    "dive": ("sub", "  move 30, 0, (-5)\n  move 0, 40, (-3)\n  move (-30), 0, 6\n  returnHome()\n"),
    "sub survey": ("sub", "  moveFromHome 5, 5, (-4)\n  surveyArea 60, 40, 10, 'NORTH_EAST'\n  returnHomeAndLand()\n"),
    "plane square": ("plane", UP + "  move 1000, 0\n  move 0, 1000\n  move (-1000), 0\n  move 0, (-1000)\n"),
    "plane survey": ("plane", UP + "  surveyArea 1500, 800, 200, 'NORTH_EAST'\n"),
    "plane climb": ("plane", UP + "  move 1500, 0, 150\n  move 1000, 500, (-100)\n"),
    "plane landing": ("plane", UP + "  move 1000, 0\n  move 0, 600\n  move (-1600), 0\n  returnHomeAndLand()\n"),
}

wrong = []
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    for title, (kind, commands) in MISSIONS.items():
        script, report = folder / "m.dolphin", folder / "m.json"
        script.write_text(HEAD + commands + TAIL % TYPES[kind])
        out, err = harness.expect_exit(0, "plan", str(script), "--vehicles", kind, "--json", str(report))
        mission = json.loads(report.read_text())["vehicles"][0]["missions"][0]
        line = f"{title:14}"
        for what in ("s", "m"):
            estimate, actual = mission[f"estimate_{what}"], mission[f"actual_{what}"]
            error = estimate / actual - 1
            line += f"  {actual:8.1f} {what} flown {estimate:8.1f} estimated {100 * error:+6.1f} %"
            if abs(error) > 0.10:
                wrong.append(f"{title}: {what} {100 * error:+.1f} %")
        print(line)

    # After a real run, too.
    script.write_text(HEAD + MISSIONS["hop"][1] + TAIL % "UAV")
    _, err = harness.expect_exit(0, "run", str(script), "--sim", "copter:1", "--report", str(report))
    assert "flown" in err and "estimated" in err, err
    mission = json.loads(report.read_text())["vehicles"][0]["missions"][0]
    for what in ("s", "m"):
        error = mission[f"estimate_{what}"] / mission[f"actual_{what}"] - 1
        if abs(error) > 0.10:
            wrong.append(f"run: {what} {100 * error:+.1f} %")
    assert mission["outcome"] == "done" and not mission["estimate_is_endless"]
sys.exit("\n".join(wrong) if wrong else 0)
