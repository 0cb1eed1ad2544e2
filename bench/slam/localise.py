"""How well a robot is found and followed on a known map: a log is mapped, then laid on that map, beside the poses of the mapping.

usage: localise.py [FOLDER]...; FOLDER holds logs with relations (default LAPWING_SLAM_LOGS). Two rows a log: the whole log on the map of the whole log, of which
the start is searched; and the second half on the map of the first alone, whose poses are laid upon those of the whole by the poses that both maps have. Of the
second half only what the first has seen can be found; the rest is lost, as it should be. How far the poses of the first half's own mapping are from those of the whole
is told beside it: a map whose loops are not closed yet is bent, and who is found on it is where the map has the place.
"""

import csv
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

import carmen_logs as logs

LAPWING = pathlib.Path(__file__).resolve().parent.parent.parent / "build/release/bin/lapwing"


def run(*arguments):
    subprocess.run([LAPWING, "map", *map(str, arguments), "--threads", "1"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def trajectory(folder: pathlib.Path) -> dict:
    rows = [[float(word) for word in line.split()] for line in (folder / "trajectory.tum").read_text().splitlines()]
    return {row[0]: (row[1], row[2], 2 * math.atan2(row[6], row[7])) for row in rows}


def laid_upon(poses: dict, others: dict):
    """The motion of the plane that lays `poses` upon `others` best, by the moments that both have."""
    both = [(poses[t], others[t]) for t in poses if t in others]
    ax, ay, bx, by = (statistics.fmean(p[who][axis] for p in both) for who in (0, 1) for axis in (0, 1))
    cosine = sum((a[0] - ax) * (b[0] - bx) + (a[1] - ay) * (b[1] - by) for a, b in both)
    sine = sum((a[0] - ax) * (b[1] - by) - (a[1] - ay) * (b[0] - bx) for a, b in both)
    yaw = math.atan2(sine, cosine)
    return bx - math.cos(yaw) * ax + math.sin(yaw) * ay, by - math.sin(yaw) * ax - math.cos(yaw) * ay, yaw


def say(name: str, out: pathlib.Path, truth: dict, motion: tuple):
    report = json.loads((out / "report.json").read_text())
    with (out / "fits.csv").open() as file:
        rows = [row for row in csv.DictReader(file) if row["is_lost"] == "0"]
    shifts, turns = [], []
    for row in rows:
        x, y, yaw = logs.after(motion, (float(row["x_m"]), float(row["y_m"]), float(row["yaw_rad"])))
        true = truth[min(truth, key=lambda t: abs(t - float(row["time_s"])))] if float(row["time_s"]) not in truth else truth[float(row["time_s"])]
        shifts.append(math.hypot(x - true[0], y - true[1]))
        turns.append(math.degrees(abs(logs.wrap(yaw - true[2]))))
    shifts.sort()
    turns.sort()
    at = lambda values, share: values[int(share * (len(values) - 1))]  # noqa: E731
    print(f"{name:26} {report['scans']:6} scans, {report['lost']:5} lost ({report['times_lost']} times), median {at(shifts, 0.5):.3f} m {at(turns, 0.5):.2f} deg, p95 {at(shifts, 0.95):.3f} m "
          f"{at(turns, 0.95):.2f} deg, max {shifts[-1]:.2f} m; {report['scan_ms']['p50']:.2f} ms a scan (p99 {report['scan_ms']['p99']:.2f}), {report['cpu_s']:.1f} s", flush=True)


def measure(folder: pathlib.Path):
    log = logs.read(folder)
    log.relations = []
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        for part in ("whole", "first", "second"):
            (work / part).mkdir()
        whole, _ = logs.write(log, work / "whole")
        first, _ = logs.write(logs.part(log, 0, 2), work / "first")
        second, _ = logs.write(logs.part(log, 1, 2), work / "second")
        run(whole, "--out", work / "map")
        truth = trajectory(work / "map")
        run(whole, "--out", work / "on_map", "--localise", work / "map/map.yaml")
        say(f"{log.name}, whole on whole", work / "on_map", truth, (0.0, 0.0, 0.0))
        run(first, "--out", work / "first_map")
        run(second, "--out", work / "on_first", "--localise", work / "first_map/map.yaml")
        own, motion = trajectory(work / "first_map"), laid_upon(trajectory(work / "first_map"), truth)
        bent = sorted(math.dist(logs.after(motion, pose)[:2], truth[time][:2]) for time, pose in own.items() if time in truth)
        print(f"{log.name}, map of the first half: its poses are {bent[len(bent) // 2]:.3f} m from those of the whole in the middle of all, {bent[len(bent) * 95 // 100]:.3f} m at p95", flush=True)
        say(f"{log.name}, second on first", work / "on_first", truth, motion)


if __name__ == "__main__":
    for one in logs.folders(sys.argv[1:]):
        measure(one)
