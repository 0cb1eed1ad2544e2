"""Every test of a survey drone flies a real ArduPilot in the loop in place of the simulated copter, and ends as it does there.

    LAPWING_SITL=~/ardupilot ardupilot_flies_survey_drones.py [NAME]...
"""

import os
import pathlib
import re
import subprocess
import sys
import time

import harness
from ardupilot import in_the_loop

FOLDER = pathlib.Path(__file__).parents[1] / "system"
TESTS = sorted(file for file in FOLDER.glob("*/*.py") if re.search(r"^from drone", file.read_text(), re.MULTILINE))
LONGEST_S = 600

if not in_the_loop.source() or "copter" not in in_the_loop.families():
    print("skipped: no ArduPilot named (LAPWING_SITL)")
    sys.exit(harness.SKIPPED)

wanted = [file for file in TESTS if not sys.argv[1:] or file.stem in sys.argv[1:]]
assert wanted, f"no such test of a survey drone: {sys.argv[1:]}"
failed = []
for file in wanted:
    began = time.monotonic()
    done = subprocess.run([sys.executable, file], env={**os.environ, "LAPWING_FLIGHT_CONTROLLER": "ardupilot"}, timeout=LONGEST_S, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    outcome = {0: "ok", harness.SKIPPED: "skipped"}.get(done.returncode, "FAILED")
    print(f"{outcome} {file.stem}: {time.monotonic() - began:.0f} s: {done.stdout.strip().splitlines()[-1:]}",
          flush=True)
    if outcome == "FAILED":
        failed.append(file.stem)
        print("\n".join(done.stdout.splitlines()[-40:]), flush=True)
assert not failed, failed
