"""Print ctest's outcome: what was skipped and why, how each failed test ended, and "N passed, N failed, N skipped".

usage: summarise.py JUNIT_XML

Exits 1 when a test failed or none ran.
"""

import sys
import xml.etree.ElementTree as ElementTree

# Of a failed test's output: what it printed first lies far above, but a reader of the end alone shall know what failed.
LAST_LINES = 30


def main() -> int:
    counts = {"passed": 0, "failed": 0, "skipped": 0}
    failed = []
    for case in ElementTree.parse(sys.argv[1]).getroot().iter("testcase"):
        status = case.get("status")
        if status == "run":
            counts["passed"] += 1
        elif status in ("notrun", "disabled") and case.find("skipped") is not None:
            counts["skipped"] += 1
            reason = (case.findtext("system-out") or "").strip().splitlines()
            print(f"skipped: {case.get('name')}: {reason[-1] if reason else 'no reason given'}")
        elif status == "disabled":
            counts["skipped"] += 1
            print(f"skipped: {case.get('name')}: disabled, a known limit")
        else:
            counts["failed"] += 1
            failed.append(case)
    for case in failed:
        print(f"failed: {case.get('name')}")
        for line in (case.findtext("system-out") or "").rstrip().splitlines()[-LAST_LINES:]:
            print(f"    {line}")
    print(", ".join(f"{number} {word}" for word, number in counts.items()))
    return 1 if counts["failed"] or not counts["passed"] else 0


if __name__ == "__main__":
    sys.exit(main())
