"""Whether a map hangs on the mapper's parameters: each by 30 percent down and up, all others as they are.

usage: sensitivity.py [FOLDER]... [--only PARAMETER[,PARAMETER]] [--logs NAME[,NAME]] [--out FILE.json]; FOLDER holds logs with relations (default
LAPWING_SLAM_LOGS). What stands in FILE.json is not run again.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import carmen_logs as logs

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LAPWING = ROOT / "build/release/bin/lapwing"

# As in src/slam: those that say when a place is looked for, when it is believed, and what is weighed against what.
PARAMETERS = {
    "front_end.key_step_m": 0.2, "front_end.key_turn_rad": 0.12, "front_end.point_information": 250, "front_end.edge_share": 0.1,
    "loops.every_m": 1.0, "loops.submap_frames": 15, "loops.query_frames": 9, "loops.least_score": 0.5, "loops.window_sigmas": 2.5,
    "loops.least_matches": 120, "loops.most_conflict": 0.2, "loops.ambiguous_rival": 0.85, "loops.small_shift_m": 0.35, "loops.witnesses": 2,
    "loops.point_information": 5, "loops.tolerance": 20, "loops.drift_turn": 0.006, "loops.drift_shift": 0.03,
    "joint.radius_m": 4.0, "joint.last_scale_m": 0.03, "joint.point_information": 250,
}


def error(program, path, relations, settings) -> dict:
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "map", path, "--out", folder, "--threads", "1", "--relations", relations, *[word for setting in settings for word in ("--set", setting)]],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        report = json.loads(pathlib.Path(folder, "report.json").read_text())
    return {"translation_m": report["relations"]["component"]["translation_m"]["mean"], "rotation_deg": report["relations"]["component"]["rotation_deg"]["mean"],
            "closures": report["closures"], "cpu_s": report["cpu_s"]}


def settings_of(only) -> list:
    """Words `name=value`; first none at all."""
    chosen = [(name, value) for name, value in PARAMETERS.items() if not only or name in only]
    return [""] + [f"{name}={round(factor * value) if isinstance(value, int) and value < 50 else factor * value:g}" for name, value in chosen for factor in (0.7, 1.3)]


def main():
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("folder", nargs="*")
    words.add_argument("--only", default="")
    words.add_argument("--logs", default="")
    words.add_argument("--out", type=pathlib.Path)
    words.add_argument("--program", default=LAPWING)
    asked = words.parse_args()
    found = json.loads(asked.out.read_text()) if asked.out and asked.out.exists() else {}
    with tempfile.TemporaryDirectory() as name:
        unpacked = []
        for folder in logs.folders(asked.folder):
            log = logs.read(folder)
            if asked.logs and log.name not in asked.logs.split(","):
                continue
            path = pathlib.Path(name, f"{log.name}.clf")
            path.write_text(logs.text_of(next(p for pattern in ("*.clf", "*.clf.xz") for p in folder.glob(pattern))))
            unpacked.append((log.name, path, next(folder.glob("*.relations"))))
        for setting in settings_of([word for word in asked.only.split(",") if word]):
            row = found.setdefault(setting, {})
            for log, path, relations in unpacked:
                if log not in row:
                    row[log] = error(asked.program, path, relations, [setting] if setting else [])
                    if asked.out:
                        asked.out.write_text(json.dumps(found, indent=1) + "\n")
            print(f"{setting or 'as it is':36} " + "  ".join(f"{log} {row[log]['translation_m']:.4f} m" for log, _, _ in unpacked), flush=True)


if __name__ == "__main__":
    sys.exit(main())
