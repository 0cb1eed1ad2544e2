"""What a mapping loses that ends and goes on later.

usage: resume.py [FOLDER]... [--parts N[,N]] [--apart]; FOLDER holds logs with relations (default LAPWING_SLAM_LOGS). Each log is cut into N drives that follow each
other; the first is mapped, and each later one resumes what the one before left. The relations are measured over all of them. --apart: each drive counts its
odometry from a place of its own, so that where it begins must be found on the map.
"""

import argparse
import dataclasses
import json
import pathlib
import subprocess
import sys
import tempfile

import carmen_logs as logs
from merge import written
from variants import LAPWING


def moved(log, number: int):
    """Its odometry in another frame."""
    frame = (40.0 * number, -7.0 * number, 0.8 * number)
    return dataclasses.replace(log, scans=[dataclasses.replace(scan, odometry=logs.after(frame, scan.odometry)) for scan in log.scans])


def lapwing_map(*words) -> str:
    """What was said against it; nothing: it is done."""
    done = subprocess.run([str(word) for word in (LAPWING, "map", *words, "--threads", "1")], capture_output=True, text=True)
    if done.returncode not in (0, 2):
        raise SystemExit(done.stderr)
    return "" if done.returncode == 0 else done.stderr.strip().splitlines()[-2].partition(": ")[2]


def measure(log, count: int, apart: bool, folder: pathlib.Path):
    _, relations = written(log, folder / "whole")
    parts = [logs.part(log, i, count) for i in range(count)]
    paths = [written(moved(part, i) if apart else part, folder / str(i))[0] for i, part in enumerate(parts)]
    name = f"{log.name:12} {count} parts:"
    words, reports = [], []
    for i, path in enumerate(paths):
        against = lapwing_map(path, "--out", folder / f"map-{i}", *words, *(["--relations", relations] if i + 1 == count else []))
        if against:
            return print(f"{name} part {i + 1}: {against}", flush=True)
        reports.append(json.loads((folder / f"map-{i}/report.json").read_text()))
        words = ["--resume", folder / f"map-{i}"]
    last = reports[-1]
    shift, turn = (last["relations"]["component"][kind] for kind in ("translation_m", "rotation_deg"))
    print(f"{name} {shift['mean']:.4f} m (most {shift['max']:.3f}), {turn['mean']:.3f} degrees; {', '.join(r['resumed']['beginning'] for r in reports[1:])}; "
          f"{last['key_frames']} key frames, {last['closures']} closures; CPU {' + '.join(format(r['cpu_s'], '.1f') for r in reports)} s; "
          f"state {' '.join(format(r['state']['bytes'] / 1e6, '.2f') for r in reports)} MB, written in {last['state']['write_ms']:.0f} ms, read in {last['resumed']['read_ms']:.0f} ms",
          flush=True)


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("folder", nargs="*")
    words.add_argument("--parts", default="2")
    words.add_argument("--apart", action="store_true")
    asked = words.parse_args()
    for folder in logs.folders(asked.folder):
        log = logs.read(folder)
        for count in (int(word) for word in asked.parts.split(",")):
            with tempfile.TemporaryDirectory() as name:
                measure(log, count, asked.apart, pathlib.Path(name))


if __name__ == "__main__":
    sys.exit(main())
