"""Each fuzz target has its case in fuzz/run.sh: one without is built, and never run."""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
targets = set(re.findall(r"^ *lapwing_fuzz\((\w+)", (ROOT / "fuzz/CMakeLists.txt").read_text(), re.MULTILINE))
cases = {name for line in re.findall(r"^  ([\w |]+)\)", (ROOT / "fuzz/run.sh").read_text(), re.MULTILINE) for name in line.split(" | ")}
if len(targets) < 10 or len(cases) < 10:
    sys.exit("this test no longer finds the targets or the cases")
if targets != cases:
    sys.exit(f"without a case in fuzz/run.sh: {sorted(targets - cases)}; without a target: {sorted(cases - targets)}")
