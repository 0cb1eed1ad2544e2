"""Whether logs give the same maps as bags of ROS 2 that hold the same: each log is written as bags by others' programs (tests/support/ros_bags.py) and mapped.

usage: bags.py [FOLDER]...; FOLDER holds logs with relations (default LAPWING_SLAM_LOGS). Needs what setup/requirements-test.txt names.
Both have the same numbers: angles as a message has them, in single precision, and as the range from which on nothing is there the largest reading less half a
percent, which is what the reader of logs finds.
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/support"))

import carmen_logs as logs  # noqa: E402
import ros_bags  # noqa: E402
from mcap.writer import CompressionType  # noqa: E402
from rosbags.rosbag2 import StoragePlugin  # noqa: E402

LAPWING = ROOT / "build/release/bin/lapwing"


def mapped(path: pathlib.Path, relations: pathlib.Path, out: pathlib.Path):
    began = time.monotonic()
    subprocess.run([LAPWING, "map", path, "--out", out, "--relations", relations, "--threads", "1"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    poses = [[float(word) for word in line.split()] for line in (out / "trajectory.tum").read_text().splitlines()]
    return poses, json.loads((out / "report.json").read_text()), time.monotonic() - began


def single(number: float) -> float:
    return float(ros_bags.numpy.float32(number))


def say(what: str, path: pathlib.Path, result, first):
    poses, report, seconds = result
    shift = report["relations"]["component"]["translation_m"]["mean"]
    turn = report["relations"]["component"]["rotation_deg"]["mean"]
    apart = max(math.dist(a[1:3], b[1:3]) for a, b in zip(poses, first, strict=True))
    print(f"{what:34} {path.stat().st_size / 1e6:6.1f} MB  {len(poses):6} scans  {shift:.5f} m  {turn:.4f} degrees  {apart:.2e} m from the log's poses  {seconds:.1f} s", flush=True)


def compare(folder: pathlib.Path):
    log = logs.read(folder)
    log.start, log.step = single(log.start), single(log.step)
    log.most = single(0.995 * max(max(scan.ranges) for scan in log.scans))
    drive = ros_bags.Drive([(scan.time, scan.ranges, scan.odometry) for scan in log.scans], log.start, log.step, log.most, (log.offset or 0.0, 0.0, 0.0))
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        path, relations = logs.write(log, work)
        of_log = mapped(path, relations, work / "out")
        say(f"{log.name}, CARMEN", path, of_log, of_log[0])
        for storage in StoragePlugin:
            bag = work / storage.name
            ros_bags.by_rosbags(drive, bag, storage)
            say(f"{log.name}, rosbags {storage.name}", next(file for file in bag.iterdir() if file.suffix != ".yaml"), mapped(bag, relations, work / "out"), of_log[0])
        bag = work / "lz4.mcap"
        ros_bags.by_mcap(drive, bag, CompressionType.LZ4)
        say(f"{log.name}, mcap LZ4", bag, mapped(bag, relations, work / "out"), of_log[0])


if __name__ == "__main__":
    for one in logs.folders(sys.argv[1:]):
        compare(one)
