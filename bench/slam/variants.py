"""What a mapper has not been tuned on, made of logs that it has: pieces, backwards, mirrored, worse or no odometry, fewer beams.

usage: variants.py [FOLDER]... [--only WORD[,WORD]] [--set NAME=NUMBER]... [--keep DIR]; FOLDER holds logs with relations (default LAPWING_SLAM_LOGS).
The last two columns lay each variant's trajectory beside that of the whole log's map: metres over pairs of moments that lie near each other there.
"""

import argparse
import bisect
import copy
import json
import math
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile

import carmen_logs as logs

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LAPWING = ROOT / "build/release/bin/lapwing"


def piece(log, first: float, last: float):
    log.scans = log.scans[int(first * len(log.scans)):int(last * len(log.scans))]
    low, high = log.scans[0].time, log.scans[-1].time
    log.relations = [r for r in log.relations if low <= min(r[:2]) and max(r[:2]) <= high]


def backwards(log):
    end = log.scans[-1].time
    for scan in log.scans:
        scan.time = end - scan.time
    log.scans.reverse()
    log.relations = [(end - t1, end - t2, *motion) for t1, t2, *motion in log.relations]


def mirrored(log):
    count = len(log.scans[0].ranges)
    log.start = -(log.start + log.step * (count - 1))
    for scan in log.scans:
        scan.ranges.reverse()
        x, y, yaw = scan.odometry
        scan.odometry = (x, -y, -yaw)
    log.relations = [(t1, t2, x, -y, -yaw) for t1, t2, x, y, yaw in log.relations]


def worse_odometry(log, slips: bool, seed: int = 1):
    """Each step's length by 10 percent and turn by 5 percent at random, 5 percent too long, 0.6 degrees to one side a metre; slips: now and then
    wheels that turn for a second and get nowhere, or the other way round."""
    chance = random.Random(seed)
    told, at, slipping = (0.0, 0.0, 0.0), log.scans[0].odometry, 0
    for scan in log.scans:
        x, y, yaw = logs.between(at, scan.odometry)
        at = scan.odometry
        length = math.hypot(x, y)
        if slips and slipping == 0 and length > 0.02 and chance.random() < 0.01:
            slipping = 5
        factor = 1.05 + chance.gauss(0.0, 0.1)
        if slipping:
            slipping -= 1
            factor = 0.1
        told = logs.after(told, (x * factor, y * factor, yaw * (1.0 + chance.gauss(0.0, 0.05)) + 0.01 * length + chance.gauss(0.0, 0.02) * math.sqrt(length)))
        scan.odometry = told


def without_odometry(log):
    for scan in log.scans:
        scan.odometry = (0.0, 0.0, 0.0)


def jumping_odometry(log):
    """Counters that begin anew: a jump of metres in the middle."""
    half = len(log.scans) // 2
    for scan in log.scans[half:]:
        scan.odometry = logs.after((5.0, -3.0, 1.5), scan.odometry)


def thinned(log, beams: int, most_m: float = 0.0):
    count = len(log.scans[0].ranges)
    kept = [round(i * (count - 1) / (beams - 1)) for i in range(beams)]
    log.step *= (count - 1) / (beams - 1)
    for scan in log.scans:
        scan.ranges = [scan.ranges[i] if most_m == 0.0 else min(scan.ranges[i], most_m) for i in kept]
    log.most = most_m


def every_other(log, step: int):
    log.scans = log.scans[::step]
    kept = {round(scan.time, 2) for scan in log.scans}
    log.relations = [r for r in log.relations if round(r[0], 2) in kept and round(r[1], 2) in kept]


VARIANTS = {
    "whole": lambda log: None,
    "third-1": lambda log: piece(log, 0, 1 / 3),
    "third-2": lambda log: piece(log, 1 / 3, 2 / 3),
    "third-3": lambda log: piece(log, 2 / 3, 1),
    "half-1": lambda log: piece(log, 0, 1 / 2),
    "half-2": lambda log: piece(log, 1 / 2, 1),
    "middle": lambda log: piece(log, 1 / 4, 3 / 4),
    "backwards": backwards,
    "mirrored": mirrored,
    "worse": lambda log: worse_odometry(log, False),
    "slips": lambda log: worse_odometry(log, True),
    "jump": jumping_odometry,
    "no-odometry": without_odometry,
    "90-beams": lambda log: thinned(log, 90),
    "short": lambda log: thinned(log, len(log.scans[0].ranges), 8.0),
    "half-rate": lambda log: every_other(log, 2),
    "11-beams": lambda log: thinned(log, 11, 5.0),
}


def trajectory(path: pathlib.Path) -> list:
    poses = []
    for line in path.read_text().splitlines():
        time, x, y, _, _, _, z, w = (float(word) for word in line.split())
        poses.append((time, (x, y, 2 * math.atan2(z, w))))
    return sorted(poses)


def at(poses: list, time: float) -> tuple:
    next_ = bisect.bisect(poses, (time,))
    near = [poses[i] for i in (next_ - 1, next_) if 0 <= i < len(poses)]
    return min(near, key=lambda pose: abs(pose[0] - time))[1]


def near_pairs(poses: list, within_m: float = 4.0, apart_s: float = 30.0, most: int = 400) -> list:
    """Pairs of moments far apart in time at places that are near each other: where a loop must have been closed."""
    chance = random.Random(7)
    some = chance.sample(poses, min(len(poses), 400))
    pairs = [(a, b) for i, a in enumerate(some) for b in some[i + 1:]
             if abs(a[0] - b[0]) > apart_s and math.dist(a[1][:2], b[1][:2]) < within_m]
    return chance.sample(pairs, min(len(pairs), most))


def beside(poses: list, whole: list) -> tuple:
    low, high = poses[0][0], poses[-1][0]
    errors = []
    for (t1, p1), (t2, p2) in near_pairs([pose for pose in whole if low <= pose[0] <= high]):
        told, true = logs.between(at(poses, t1), at(poses, t2)), logs.between(p1, p2)
        errors.append(math.dist(told[:2], true[:2]))
    return (statistics.mean(errors), max(errors)) if errors else (math.nan, math.nan)


def run(program, log, settings, keep: pathlib.Path | None):
    """The report, and the trajectory."""
    with tempfile.TemporaryDirectory() as name:
        folder = keep or pathlib.Path(name)
        folder.mkdir(parents=True, exist_ok=True)
        path, relations = logs.write(log, folder)
        command = [program, "map", path, "--out", folder / "map", "--threads", "1", "--loops", *[word for setting in settings for word in ("--set", setting)]]
        subprocess.run([*command, *(["--relations", relations] if relations else [])], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        path.unlink()
        return json.loads((folder / "map/report.json").read_text()), trajectory(folder / "map/trajectory.tum")


def measure(program, say, named=(), only=(), settings=(), keep=None) -> list:
    rows = []
    for folder in logs.folders(named):
        original = logs.read(folder)
        whole = None
        for name, change in VARIANTS.items():
            if only and name not in only and name != "whole":
                continue
            log = copy.deepcopy(original)
            change(log)
            report, poses = run(program, log, settings, keep / f"{original.name}-{name}" if keep else None)
            if name == "backwards":
                end = original.scans[-1].time
                poses = sorted((end - time, pose) for time, pose in poses)
            if name == "mirrored":
                poses = [(time, (x, -y, -yaw)) for time, (x, y, yaw) in poses]
            whole = whole or poses
            mean, most = beside(poses, whole)
            errors = report.get("relations", {}).get("component", {})
            row = {"log": original.name, "variant": name, "relations": report.get("relations", {}).get("count", 0), "closures": report["closures"],
                   "translation_m": errors.get("translation_m", {}).get("mean"), "most_m": errors.get("translation_m", {}).get("max"),
                   "rotation_deg": errors.get("rotation_deg", {}).get("mean"), "beside_whole_m": mean, "beside_whole_most_m": most, "cpu_s": report["cpu_s"]}
            rows.append(row)
            figure = (f"{row['translation_m']:.4f} m (most {row['most_m']:6.3f}) {row['rotation_deg']:6.3f} deg" if errors else "no relations".ljust(36))
            say(f"slam    {original.name:10} {name:12} {row['relations']:5} relations {figure}  {row['closures']:4} closures, beside the whole "
                f"{mean:7.3f} m (most {most:7.3f}), {row['cpu_s']:5.1f} s")
    return rows


def main():
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("folder", nargs="*")
    words.add_argument("--only", default="")
    words.add_argument("--set", action="append", default=[])
    words.add_argument("--keep", type=pathlib.Path)
    words.add_argument("--program", default=LAPWING)
    asked = words.parse_args()
    measure(asked.program, lambda text: print(text, flush=True), asked.folder, [word for word in asked.only.split(",") if word], asked.set, asked.keep)


if __name__ == "__main__":
    sys.exit(main())
