"""Robots explore floor plans: the report's contract, repeatable runs, pictures, and what is said of plans and starts that are none."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

import harness

LAPWING = os.environ["LAPWING"]
if not (pathlib.Path(LAPWING).parent / "lapwing-map").exists():
    print("skipped: lapwing-map was not built (its libraries: setup/packages-map.txt)")
    sys.exit(harness.SKIPPED)

PLAN = [
    "##########################",
    "#       #        #       #",
    "#       #        #       #",
    "#       #        #       #",
    "###  ######  #########  ##",
    "#                        #",
    "#                        #",
    "#   ###########          #",
    "#   ###########          #",
    "#                        #",
    "#                        #",
    "##########################",
]
CELLS = 5  # a side of each letter, 0.1 m each


def explore(*words, code=0):
    done = subprocess.run([LAPWING, "explore", *map(str, words)], capture_output=True, text=True, timeout=200, check=False)
    assert done.returncode == code, f"{words}: {done.returncode}\n{done.stdout}\n{done.stderr}"
    return done


def pgm(path: pathlib.Path, wall=0, free=254):
    rows = [bytes(free if letter == " " else wall for letter in line for _ in range(CELLS)) for line in PLAN for _ in range(CELLS)]
    path.write_bytes(b"P5\n%d %d\n255\n" % (len(rows[0]), len(rows)) + b"".join(rows))


def write_yaml(path: pathlib.Path, image: str, **changes):
    keys = {"image": image, "resolution": 0.1, "origin": "[0, 0, 0]", "negate": 0, "occupied_thresh": 0.65, "free_thresh": 0.196} | changes
    path.write_text("".join(f"{key}: {value}\n" for key, value in keys.items()))
    return path


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    pgm(folder / "plan.pgm")
    plan = write_yaml(folder / "plan.yaml", "plan.pgm")

    # The contract, for each strategy.
    for strategy in ("regret", "tour", "nearest", "frontier", "right-hand", "known-floor"):
        report = folder / f"{strategy}.json"
        explore("--map", plan, "--strategy", strategy, "--start", "1.25,2,0", "--report", report, "--picture", folder / "run.svg")
        told = json.loads(report.read_text())
        assert told["strategy"] == strategy and told["robots"] == 1 and len(told["runs"]) == 1, told
        run = told["runs"][0]
        assert run["start"] == [1.25, 2.0, 0.0], run
        assert run["finished"] is True and run["reason"] == "explored" and run["coverage"] >= 0.99 and run["collisions"] == 0, run
        assert 10 < run["travel_to_99_m"] <= run["travel_m"] < 1000 and run["time_s"] > run["travel_m"] / 0.3 - 1, run
    assert (folder / "run.svg").read_text().startswith("<svg")

    # The same seed, the same run; another one, another.
    def runs(*words):
        explore("--map", plan, "--robots", 2, "--people", 2, "--report", folder / "runs.json", *words)
        found = json.loads((folder / "runs.json").read_text())["runs"]
        for run in found:
            del run["wall_s"]
        return found

    two = runs("--seed", 5, "--runs", 2, "--threads", 2)
    assert two == runs("--seed", 5, "--runs", 2, "--threads", 1), "repeats"
    assert two[1] == runs("--seed", 6)[0] and two[0] != two[1]

    # Lines come in the order of the runs, whichever ends first.
    lines = explore("--map", plan, "--runs", 6, "--threads", 3).stdout.splitlines()
    assert [line.split()[0] for line in lines] == ["1", "2", "3", "4", "5", "6"], lines

    # The same floor drawn the other way around, with a turned origin: the same way from the same place.
    pgm(folder / "negative.pgm", wall=255, free=0)
    negative = write_yaml(folder / "negative.yaml", "negative.pgm", negate=1, origin="[10, -5, 1.5707963267948966]")
    explore("--map", negative, "--start", "8,-3.75,1.5707963267948966", "--report", folder / "negative.json")
    turned = json.loads((folder / "negative.json").read_text())["runs"][0]
    plain = json.loads((folder / "nearest.json").read_text())["runs"][0]
    assert abs(turned["travel_m"] - plain["travel_m"]) < 1e-6 and turned["start"][:2] == [8.0, -3.75], (turned, plain)

    # What is wrong is said, with exit code 2.
    def refused(text, *words):
        done = explore(*words, code=2)
        assert text in done.stderr, done.stderr

    refused("cannot start at 0.20, 0.20: there is a wall", "--map", plan, "--start", "0.2,0.2")
    refused("outside of the floor plan", "--map", plan, "--start", "-50,2,0")
    refused("no strategy `left-hand`", "--map", plan, "--strategy", "left-hand")
    pgm(folder / "solid.pgm", free=0)
    refused("no free cell", "--map", write_yaml(folder / "solid.yaml", "solid.pgm"))
    refused("is no ROS map", "--map", write_yaml(folder / "no_metres.yaml", "plan.pgm", resolution="wide"))
    refused("nowhere on the floor plan has a robot room", "--map", write_yaml(folder / "doll.yaml", "plan.pgm", resolution=0.002))
    (folder / "cut.pgm").write_bytes((folder / "plan.pgm").read_bytes()[:40])
    refused("cut.pgm", "--map", write_yaml(folder / "cut.yaml", "cut.pgm"))
    explore("--map", plan, "--robots", 9, code=2)
    done = explore("--map", folder / "nothing.yaml", code=3)
    assert "nothing.yaml cannot be read" in done.stderr, done.stderr
print("robots explored")
