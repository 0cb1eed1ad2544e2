"""How well logs of one building become one map, and whether logs of two buildings stay apart.

usage: merge.py [FOLDER]... [--others FOLDER] [--parts N[,N]] [--apart]; FOLDER holds logs with relations (default LAPWING_SLAM_LOGS). Each log is cut into N drives
that follow each other, and these are merged: the relations are measured over all of them. --others: logs that another SLAM has corrected (other_buildings.py), whose
poses stand in for the truth, with odometry that drifts: how far places that two parts share are off. --apart: every log's first half with every other's, none of which may be merged.
"""

import argparse
import itertools
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

import carmen_logs as logs
import other_buildings
from variants import LAPWING, trajectory


def merge(paths, out: pathlib.Path, *more) -> str:
    """What was said against it; nothing: they are one."""
    command = [LAPWING, "map", *paths, "--out", out, "--threads", "1", *more]
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode not in (0, 2):
        raise SystemExit(done.stderr)
    return "" if done.returncode == 0 else done.stderr.strip().splitlines()[-2].partition(": ")[2]


def written(log, folder: pathlib.Path) -> tuple[pathlib.Path, pathlib.Path]:
    folder.mkdir(parents=True)
    return logs.write(log, folder)


def say_joined(report: dict) -> str:
    return f"joined by {', '.join(str(one['closures']) for one in report['logs'][1:])} closures, {report['cpu_s']:.1f} s"


def measure_relations(log, count: int, folder: pathlib.Path):
    _, relations = written(log, folder / "whole")
    paths = [written(logs.part(log, i, count), folder / str(i))[0] for i in range(count)]
    against = merge(paths, folder / "map", "--relations", relations)
    if against:
        return print(f"{log.name:18} {count} parts: {against}", flush=True)
    report = json.loads((folder / "map/report.json").read_text())
    shift = report["relations"]["component"]["translation_m"]
    print(f"{log.name:18} {count} parts: {shift['mean']:.4f} m (most {shift['max']:.3f}), {say_joined(report)}", flush=True)


def measure_other(path: pathlib.Path, count: int, folder: pathlib.Path):
    log, wheels = other_buildings.read(path)
    truth = [scan.odometry for scan in log.scans]
    steps = [logs.between(a, b) for a, b in zip(truth, truth[1:])]
    log = other_buildings.with_odometry(log, other_buildings.told_by("drift", steps, wheels, 1))
    paths = [written(logs.part(log, i, count), folder / str(i))[0] for i in range(count)]
    against = merge(paths, folder / "map")
    if against:
        return print(f"{log.name:18} {count} parts: {against}", flush=True)
    poses, ends = [], []
    for i in range(count):
        poses += [pose for _, pose in trajectory(folder / f"map/trajectory-{i + 1}.tum")]
        ends.append(len(poses))
    number = lambda scan: sum(scan >= end for end in ends)  # noqa: E731
    errors = []
    for i, j in other_buildings.revisits(truth, most=10_000):
        if number(i) != number(j):
            told, true = logs.between(poses[j], poses[i]), logs.between(truth[j], truth[i])
            errors.append(math.dist(told[:2], true[:2]))
    errors.sort()
    report = json.loads((folder / "map/report.json").read_text())
    middle, most = (errors[len(errors) // 2], errors[-1]) if errors else (math.nan, math.nan)
    print(f"{log.name:18} {count} parts: {len(errors)} places of two parts, mean {statistics.fmean(errors or [math.nan]):.3f} m (median {middle:.3f}, most {most:.2f}), "
          f"{say_joined(report)}", flush=True)


def measure_apart(every: list, folder: pathlib.Path):
    paths = [written(logs.part(log, 0, 2), folder / str(i))[0] for i, log in enumerate(every)]
    merged = 0
    for (a, first), (b, second) in itertools.combinations(zip(every, paths), 2):
        if not merge([first, second], folder / "map"):
            merged += 1
            print(f"{a.name} and {b.name} were merged", flush=True)
    print(f"{merged} of {len(every) * (len(every) - 1) // 2} pairs of buildings were merged", flush=True)


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("folder", nargs="*")
    words.add_argument("--others", type=pathlib.Path)
    words.add_argument("--parts", default="2,3")
    words.add_argument("--apart", action="store_true")
    asked = words.parse_args()
    counts = [int(word) for word in asked.parts.split(",")]
    known = [logs.read(folder) for folder in logs.folders(asked.folder)]
    others = sorted(asked.others.glob("*.log")) if asked.others else []
    with tempfile.TemporaryDirectory() as name:
        for number, (log, count) in enumerate(itertools.product(known, counts)):
            measure_relations(log, count, pathlib.Path(name) / f"known-{number}")
        for number, (path, count) in enumerate(itertools.product(others, counts)):
            measure_other(path, count, pathlib.Path(name) / f"other-{number}")
        if asked.apart:
            measure_apart([*known, *(other_buildings.read(path)[0] for path in others)], pathlib.Path(name) / "apart")


if __name__ == "__main__":
    sys.exit(main())
