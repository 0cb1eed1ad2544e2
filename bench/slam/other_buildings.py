"""Maps of buildings that the mapper has not been tuned on, from logs that another SLAM has corrected: its poses stand in for the truth.

usage: other_buildings.py FOLDER... [--only BUILDING[,BUILDING]] [--odometry KIND[,KIND]] [--set NAME=NUMBER]... [--keep DIR]; FOLDER holds *.log of CARMEN
whose FLASER lines have the corrected pose, a metre or so apart. What odometry is told: as the file is (`file`), the wheels' own (`wheels`: the steps
between ODOM lines, as GMapping leaves them), or the corrected one with errors put on: `drift` (0.5 degrees a metre at random, 2 percent too long, pulling to
one side by 0.1 degrees a metre), `worse` (2 degrees, 5 percent, 0.3 degrees), `slips` (drift, and wheels that spin for two scans now and then), `none`.
"""

import argparse
import json
import math
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile

import carmen_logs as logs
from variants import LAPWING, trajectory

DEGREE = math.pi / 180


def read(path: pathlib.Path):
    """The log with the corrected poses as its odometry, and the wheels' steps from each scan to the next; a second a metre and a second a radian."""
    log = logs.Log(path.stem.removesuffix("-corrected"), [], -math.pi / 2, math.pi / 180)
    wheels, begun, last, time = [], None, None, 0.0
    for line in path.read_text(errors="replace").splitlines():
        words = line.split()
        if words[:1] == ["ODOM"]:
            last = tuple(float(word) for word in words[1:4])
            begun = begun or last
        if words[:1] != ["FLASER"]:
            continue
        count = int(words[1])
        pose = tuple(float(word) for word in words[5 + count:8 + count])
        if log.scans:
            step = logs.between(log.scans[-1].odometry, pose)
            time += 2.0 * math.hypot(*step[:2]) + 2.0 * abs(step[2]) + 0.2
            wheels.append(logs.between(begun, last) if begun is not last else step)
        log.step = math.pi / (count if count % 2 == 0 else count - 1)
        log.scans.append(logs.Scan(time, [float(word) for word in words[2:2 + count]], pose))
        begun = last = None
    return log, wheels


def drifting(steps: list, turn: float, scale: float, pull: float, slips: bool, chance: random.Random) -> list:
    told, slipping = [], 0
    for x, y, yaw in steps:
        length = math.hypot(x, y)
        if slips and slipping == 0 and chance.random() < 0.02:
            slipping = 2
        factor = 1.0 + scale
        if slipping:
            slipping -= 1
            factor = 0.3
        yaw += (pull + turn * chance.gauss(0, 1)) * DEGREE * length + 0.02 * chance.gauss(0, 1) * yaw
        told.append((x * factor, y * factor, yaw))
    return told


def told_by(kind: str, steps: list, wheels: list, seed: int) -> list:
    chance = random.Random(seed)
    return {"wheels": lambda: wheels,
            "drift": lambda: drifting(steps, 0.5, 0.02, 0.1, False, chance),
            "worse": lambda: drifting(steps, 2.0, 0.05, 0.3, False, chance),
            "slips": lambda: drifting(steps, 0.5, 0.02, 0.1, True, chance),
            "none": lambda: [(0.0, 0.0, 0.0)] * len(steps)}[kind]()


def with_odometry(log, steps: list):
    pose = (0.0, 0.0, 0.0)
    scans = []
    for scan, step in zip(log.scans, [None, *steps]):
        pose = logs.after(pose, step) if step else pose
        scans.append(logs.Scan(scan.time, scan.ranges, pose))
    return logs.Log(log.name, scans, log.start, log.step, most=log.most)


def revisits(truth: list, within_m: float = 3.0, apart_m: float = 20.0, most: int = 600) -> list:
    """Pairs of scans far apart on the way at places near each other: where a loop must have been closed."""
    path = [0.0]
    for a, b in zip(truth, truth[1:]):
        path.append(path[-1] + math.dist(a[:2], b[:2]))
    pairs = [(i, j) for i in range(len(truth)) for j in range(i) if path[i] - path[j] > apart_m and math.dist(truth[i][:2], truth[j][:2]) < within_m]
    return random.Random(7).sample(pairs, min(len(pairs), most))


def laid_upon(poses: list, truth: list) -> float:
    """Root mean square of what is left when the trajectory is laid upon the true one as well as can be."""
    a = [complex(x, y) for x, y, _ in poses]
    b = [complex(x, y) for x, y, _ in truth]
    mean_a, mean_b = sum(a) / len(a), sum(b) / len(b)
    turn = sum((q - mean_b) * (p - mean_a).conjugate() for p, q in zip(a, b))
    turn /= abs(turn) or 1.0
    return math.sqrt(statistics.mean(abs((q - mean_b) - turn * (p - mean_a)) ** 2 for p, q in zip(a, b)))


def figures(poses: list, truth: list) -> dict:
    errors = []
    for i, j in revisits(truth):
        told, true = logs.between(poses[j], poses[i]), logs.between(truth[j], truth[i])
        errors.append(math.dist(told[:2], true[:2]))
    errors.sort()
    return {"revisits": len(errors), "mean_m": statistics.mean(errors) if errors else math.nan, "p50_m": errors[len(errors) // 2] if errors else math.nan,
            "most_m": errors[-1] if errors else math.nan, "shape_m": laid_upon(poses, truth)}


def run(program, path: pathlib.Path, folder: pathlib.Path, settings):
    command = [program, "map", path, "--out", folder / "map", "--threads", "1", "--loops", *[word for setting in settings for word in ("--set", setting)]]
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return json.loads((folder / "map/report.json").read_text()), [pose for _, pose in trajectory(folder / "map/trajectory.tum")]


def measure(program, say, named, only=(), kinds=(), settings=(), keep=None, seed=1):
    for path in sorted(path for name in named for path in pathlib.Path(name).glob("*.log")):
        if only and path.stem.removesuffix("-corrected") not in only:
            continue
        log, wheels = read(path)
        truth = [scan.odometry for scan in log.scans]
        steps = [logs.between(a, b) for a, b in zip(truth, truth[1:])]
        for kind in kinds:
            with tempfile.TemporaryDirectory() as name:
                folder = keep / f"{log.name}-{kind}" if keep else pathlib.Path(name)
                folder.mkdir(parents=True, exist_ok=True)
                written = path
                told = truth
                if kind != "file":
                    changed = with_odometry(log, told_by(kind, steps, wheels, seed))
                    told = [scan.odometry for scan in changed.scans]
                    written, _ = logs.write(changed, folder)
                report, poses = run(program, written, folder, settings)
            before, after = figures(told, truth), figures(poses, truth)
            say(f"{log.name:18} {kind:7} {after['revisits']:4} revisits, told {before['mean_m']:7.2f} m (shape {before['shape_m']:6.2f}); mapped {after['mean_m']:7.3f} m "
                f"(median {after['p50_m']:6.3f}, most {after['most_m']:6.2f}, shape {after['shape_m']:6.2f}), {report['closures']:4} closures, {report['cpu_s']:5.1f} s")


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("folder", nargs="+")
    words.add_argument("--only", default="")
    words.add_argument("--odometry", default="file,wheels,drift,worse,slips,none")
    words.add_argument("--set", action="append", default=[])
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--keep", type=pathlib.Path)
    words.add_argument("--program", default=LAPWING)
    asked = words.parse_args()
    measure(asked.program, lambda text: print(text, flush=True), asked.folder, [word for word in asked.only.split(",") if word],
            asked.odometry.split(","), asked.set, asked.keep, asked.seed)


if __name__ == "__main__":
    sys.exit(main())
