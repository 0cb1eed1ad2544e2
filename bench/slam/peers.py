"""The mapper beside others on the same logs, in one run: errors over the relations, processor time and memory of whole programs on one thread.

usage: peers.py PROGRAMS [FOLDER]... [--only LOG[,LOG]] [--repeats N]; PROGRAMS holds what peers/build.sh makes (those of karto, gmapping and cartographer that are
there are run), FOLDERs have logs with relations (default LAPWING_SLAM_LOGS). Everyone reads the same scans and writes a pose for each; their errors are counted
by one function. Cartographer has a second thread for its loops, which its processor time includes.
"""

import argparse
import bisect
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

import carmen_logs as logs
from variants import LAPWING, trajectory

PEERS = ("karto", "gmapping", "cartographer")


def increasing(log):
    """Stamps that each are later than the one before: not everyone bears others."""
    last = -math.inf
    for scan in log.scans:
        scan.time = last = max(scan.time, last + 1e-4)
    return log


def write_scans(log, path: pathlib.Path):
    # Lasers of these logs tell 50 m or 81 m where nothing came back; not all of the logs say which.
    nothing = log.most or (49.9 if max(max(scan.ranges) for scan in log.scans) < 60 else 80.0)
    with path.open("w") as file:
        file.write(f"{len(log.scans[0].ranges)} {log.start:.12f} {log.step:.15f} {nothing} {log.offset or 0.0}\n")
        for scan in log.scans:
            x, y, yaw = scan.odometry
            file.write(f"{scan.time:.6f} {x:.6f} {y:.6f} {yaw:.6f} {' '.join(f'{r:.3f}' for r in scan.ranges)}\n")


def errors_of(poses: list, relations: list) -> dict:
    """Mean differences of the components (m, degrees), as the Freiburg metricEvaluator counts them: the pose nearest to each moment."""
    times = [moment for moment, _ in poses]

    def pose_at(moment: float):
        k = bisect.bisect(times, moment)
        return min(poses[max(0, k - 1):k + 1], key=lambda pose: abs(pose[0] - moment))[1]

    shifts, turns = [], []
    for first, second, x, y, yaw in relations:
        told = logs.between(pose_at(first), pose_at(second))
        shifts.append(math.hypot(told[0] - x, told[1] - y))
        turns.append(abs(math.degrees(logs.wrap(told[2] - yaw))))
    return {"shift_m": statistics.mean(shifts), "median_m": statistics.median(shifts), "most_m": max(shifts), "turn_deg": statistics.mean(turns)}


# A process of its own, for the memory that a child is charged with begins with that of who forks it.
ACCOUNT = """
import json, os, subprocess, sys, time
begun = time.monotonic()
process = subprocess.Popen(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
_, status, used = os.wait4(process.pid, 0)
print(json.dumps({"ended": os.waitstatus_to_exitcode(status), "wall_s": time.monotonic() - begun, "cpu_s": used.ru_utime + used.ru_stime, "peak_mb": used.ru_maxrss / 1024}))
"""


def run(command: list) -> dict:
    """Seconds and megabytes of a program, until it has ended."""
    done = subprocess.run([sys.executable, "-c", ACCOUNT, *[str(word) for word in command]], check=True, text=True, stdout=subprocess.PIPE)
    account = json.loads(done.stdout)
    if account.pop("ended") != 0:
        raise SystemExit(f"peers: {command[0]} failed")
    return account


def poses_in(path: pathlib.Path) -> list:
    rows = [[float(word) for word in line.split()] for line in path.read_text().splitlines()]
    return [(moment, (x, y, yaw)) for moment, x, y, yaw in rows]


def measure(programs: pathlib.Path, say, named=(), only=(), repeats=1):
    chosen = [folder for folder in logs.folders(named) if not only or folder.name in only]
    if not chosen:
        say("peers: no logs; name folders with a log and its relations, or set LAPWING_SLAM_LOGS to a folder of them")
    for folder in chosen:
        log = increasing(logs.read(folder))
        with tempfile.TemporaryDirectory() as name:
            work = pathlib.Path(name)
            path, _ = logs.write(log, work)
            write_scans(log, work / "scans")
            commands = {"lapwing": [LAPWING, "map", path, "--out", work / "map", "--threads", "1"]}
            commands |= {peer: [programs / peer, work / "scans", work / peer] for peer in PEERS if (programs / peer).exists()}
            costs = {who: [] for who in commands}
            for _ in range(repeats):
                for who, command in commands.items():
                    costs[who].append(run(command))
            for who in commands:
                poses = trajectory(work / "map/trajectory.tum") if who == "lapwing" else poses_in(work / who)
                errors = errors_of(poses, log.relations)
                cost = {key: statistics.median(row[key] for row in costs[who]) for key in costs[who][0]}
                say(f"peers   {folder.name:10} {who:12} {errors['shift_m']:.4f} m (median {errors['median_m']:.4f}, most {errors['most_m']:6.2f}) {errors['turn_deg']:6.3f} deg; "
                    f"{cost['cpu_s']:6.1f} s of CPU, {cost['wall_s']:6.1f} s, {cost['peak_mb']:4.0f} MB")


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("programs", type=pathlib.Path)
    words.add_argument("folder", nargs="*")
    words.add_argument("--only", default="")
    words.add_argument("--repeats", type=int, default=1)
    asked = words.parse_args()
    measure(asked.programs, lambda text: print(text, flush=True), asked.folder, [word for word in asked.only.split(",") if word], asked.repeats)


if __name__ == "__main__":
    sys.exit(main())
