"""What a map of each log costs on one thread, and how good it is: wall and processor seconds, memory, errors by both definitions."""

import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

import carmen_logs as logs

REPEATS = 3


def once(program, log: pathlib.Path, relations: pathlib.Path) -> dict:
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "map", log, "--out", folder, "--threads", "1", "--relations", relations], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return json.loads(pathlib.Path(folder, "report.json").read_text())


def measure(program, say, named=()) -> list:
    chosen = logs.folders(named)
    if not chosen:
        say("slam: no logs; name folders with a log and its relations, or set LAPWING_SLAM_LOGS to a folder of them")
    rows = []
    for folder in chosen:
        with tempfile.TemporaryDirectory() as name:
            packed = next(path for pattern in ("*.clf", "*.log", "*.clf.xz", "*.log.xz") for path in sorted(folder.glob(pattern)))
            path = pathlib.Path(name, "log.clf")
            path.write_text(logs.text_of(packed))
            reports = [once(program, path, next(folder.glob("*.relations"))) for _ in range(REPEATS)]
        first = reports[0]
        row = {"log": folder.name, "scans": first["scans"], "closures": first["closures"], "relations": first["relations"],
               "wall_s": statistics.median(report["wall_s"] for report in reports), "cpu_s": statistics.median(report["cpu_s"] for report in reports),
               "peak_mb": max(report["peak_mb"] for report in reports)}
        rows.append(row)
        by = {kind: first["relations"][kind] for kind in ("component", "motion")}
        say(f"slam    {row['log']:10} {row['scans']:6} scans {row['wall_s']:6.1f} s, {row['cpu_s']:6.1f} s of CPU, {row['peak_mb']:5.0f} MB; " +
            "; ".join(f"{kind} {errors['translation_m']['mean']:.4f} m {errors['rotation_deg']['mean']:.3f} deg" for kind, errors in by.items()))
    return rows


if __name__ == "__main__":
    measure(pathlib.Path(__file__).resolve().parent.parent.parent / "build/release/bin/lapwing", lambda text: print(text, flush=True), sys.argv[1:])
