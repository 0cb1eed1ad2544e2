"""Exploration: metres and seconds to 99 percent of a floor, by strategy and number of robots, means over the same starts."""

import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

STARTS = int(os.environ.get("LAPWING_BENCH_STARTS", "20"))
ROBOTS = [int(count) for count in os.environ.get("LAPWING_BENCH_ROBOTS", "1,2,4").split(",")]
STRATEGIES = os.environ.get("LAPWING_BENCH_STRATEGIES", "right-hand,nearest,regret,known-floor").split(",")
BASELINE = "nearest"
YARDSTICK = "known-floor"  # knows the plan; leads one robot


def floors(named) -> list:
    if named:
        return [pathlib.Path(name) for name in named]
    folder = os.environ.get("LAPWING_FLOORS")
    return sorted(pathlib.Path(folder).rglob("*.yaml")) if folder else []


def runs(program: pathlib.Path, floor: pathlib.Path, strategy: str, robots: int) -> list:
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder, "report.json")
        subprocess.run([program, "explore", "--map", floor, "--strategy", strategy, "--robots", str(robots), "--runs", str(STARTS), "--seed", "1", "--report", report],
                       check=True, stdout=subprocess.DEVNULL)
        return json.loads(report.read_text())["runs"]


def row_of(found: list) -> dict:
    """Means of the runs; a run that never saw 99 percent counts with all that it drove."""
    to_99 = [run["travel_to_99_m"] or run["travel_m"] for run in found]
    time_to_99 = [run["time_to_99_s"] or run["time_s"] for run in found]
    return {"to_99_m": statistics.mean(to_99), "to_99_s": statistics.mean(time_to_99), "travel_m": statistics.mean(run["travel_m"] for run in found),
            "reached_99": sum(run["travel_to_99_m"] is not None for run in found), "finished": sum(run["finished"] for run in found),
            "least_coverage": min(run["coverage"] for run in found), "collisions": sum(run["collisions"] for run in found),
            "wall_s": statistics.mean(run["wall_s"] for run in found), "runs": len(found)}


def table(rows: list, say):
    """The rows as a page of documentation has them: metres to 99 percent, seconds, and metres in all."""
    say("| floor | robots | " + " | ".join(f"{name}: m to 99 %, s, m in all" for name in STRATEGIES) + " | ended home |")
    say("|---" * (len(STRATEGIES) + 3) + "|")
    for floor, robots in dict.fromkeys((row["floor"], row["robots"]) for row in rows):
        here = {row["strategy"]: row for row in rows if row["floor"] == floor and row["robots"] == robots}
        cells = [f"{here[name]['to_99_m']:.0f}, {here[name]['to_99_s']:.0f}, {here[name]['travel_m']:.0f}" if name in here else "" for name in STRATEGIES]
        say(f"| {floor} | {robots} | " + " | ".join(cells) + f" | {sum(row['finished'] for row in here.values())} of {sum(row['runs'] for row in here.values())} |")


def means(rows: list, say):
    """Of the shares floor by floor, so that no large floor speaks for all."""
    for robots in ROBOTS:
        for name in STRATEGIES:
            pairs = [(row, base) for row in rows if row["strategy"] == name and row["robots"] == robots
                     for base in rows if base["strategy"] == BASELINE and base["robots"] == robots and base["floor"] == row["floor"]]
            if name == BASELINE or not pairs:
                continue
            say(f"explore mean over {len(pairs)} floors, {robots} robots: {name} beside {BASELINE} " +
                ", ".join(f"{100 * (statistics.mean(row[key] / base[key] for row, base in pairs) - 1):+.1f} % {what}"
                          for key, what in (("to_99_m", "m to 99 %"), ("to_99_s", "s to 99 %"), ("travel_m", "m in all"))))


def measure(program: pathlib.Path, say, named=()) -> list:
    chosen = floors(named)
    if not chosen:
        say("explore: no floors; name their .yaml files, or set LAPWING_FLOORS to a folder of them")
        return []
    rows = []
    for floor in chosen:
        for robots in ROBOTS:
            base = None
            name = f"{floor.parent.name}/{floor.stem}"  # many are called map.yaml
            for strategy in sorted(STRATEGIES, key=lambda name: name != BASELINE):
                if strategy == YARDSTICK and robots > 1:
                    continue
                row = {"floor": name, "robots": robots, "strategy": strategy} | row_of(runs(program, floor, strategy, robots))
                base = base or row["to_99_m"]
                rows.append(row)
                say(f"explore {name:26} {robots} x {strategy:11} {row['to_99_m']:8.0f} m {row['to_99_s']:8.0f} s to 99 % "
                    f"({100 * (row['to_99_m'] / base - 1):+4.0f} %), in all {row['travel_m']:6.0f} m, "
                    f"{row['reached_99']}/{row['runs']} saw 99 %, {row['finished']} home, {row['collisions']} collisions, {row['wall_s']:.1f} s a run")
    table(rows, say)
    means(rows, say)
    return rows


if __name__ == "__main__":
    measure(pathlib.Path(__file__).resolve().parent.parent / "build/release/bin/lapwing", lambda text: print(text, flush=True), sys.argv[1:])
