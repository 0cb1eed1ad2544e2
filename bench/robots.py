"""Robots in simulated buildings: how many come home, in what time, over how many metres, and how much of the floor they saw; a row a seed."""

import concurrent.futures
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILDINGS = os.environ.get("LAPWING_BENCH_BUILDINGS", "flat,office").split(",")
SEEDS = os.environ.get("LAPWING_BENCH_SEEDS", "1-20")
AT_ONCE = int(os.environ.get("LAPWING_BENCH_AT_ONCE", "2"))
SCRIPT = """robot = pick { id 'robot1'; timeout 60.seconds }
execute robot: drive { name 'Floor'; explore(); returnToStart() }
"""


def seeds() -> list:
    """Of "1-20,35"."""
    found = []
    for part in SEEDS.split(","):
        first, _, last = part.partition("-")
        found += range(int(first), int(last or first) + 1)
    return found


def row(program: pathlib.Path, building: str, seed: int) -> dict:
    with tempfile.TemporaryDirectory() as folder:
        script, report = pathlib.Path(folder, "floor.dolphin"), pathlib.Path(folder, "report.json")
        script.write_text(SCRIPT)
        began = time.monotonic()
        subprocess.run([program, "run", script, "--robot", f"sim:{ROOT}/examples/buildings/{building}.toml", "--seed", str(seed), "--report", report],
                       check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        told = json.loads(report.read_text())
    vehicle = told["vehicles"][0]
    robot = vehicle["robot"]
    drive = robot["drives"][-1]
    return {"building": building, "seed": seed, "outcome": drive["outcome"], "said": drive["error"] or drive.get("remark", ""), "travel_m": vehicle["track_m"],
            "coverage": robot["coverage"], "free_m2": robot["free_m2"], "collisions": robot["collisions"], "wall_s": time.monotonic() - began}


def measure(program: pathlib.Path, say) -> list:
    say("| building | seed | outcome | travel | coverage | free | collisions | said |")
    say("|---|---|---|---|---|---|---|---|")
    rows = []
    for building in BUILDINGS:
        with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
            for found in pool.map(lambda seed, floor=building: row(program, floor, seed), seeds()):
                rows.append(found)
                say("| {building} | {seed} | {outcome} | {travel_m:.0f} m | {coverage:.3f} | {free_m2:.0f} m2 | {collisions} | {said} |".format(**found))
    for building in BUILDINGS:
        here = [found for found in rows if found["building"] == building]
        say(f"robots {building}: {sum(found['outcome'] == 'done' for found in here)} of {len(here)} home, {sum(found['collisions'] for found in here)} collisions, "
            f"coverage {min(found['coverage'] for found in here):.3f} at least, {statistics.mean(found['travel_m'] for found in here):.0f} m, {statistics.mean(found['wall_s'] for found in here):.0f} s a run")
    return rows


if __name__ == "__main__":
    measure(ROOT / "build/release/bin/lapwing", lambda text: print(text, flush=True))
