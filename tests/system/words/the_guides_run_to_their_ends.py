"""Each guide is followed as a reader would: its scripts are saved, its commands typed in order, its missions flown to their ends.

What the scripts print on the test platform, and what is said of mistakes, is compared by documents_are_checked.py.
"""

import concurrent.futures
import json
import pathlib
import re
import sys
import tempfile
import time

import documents
import harness
import reader

GUIDES = [harness.ROOT / "README.md", *sorted((harness.ROOT / "docs/guide").glob("*.md"))]
# Settings of other programs; editors.md's are tried by those who use them.
FOREIGN = ("cpp", "json", "lua", "toml", "elisp", "ini", "nginx")


def is_as_estimated(mission: dict) -> bool:
    """A mission that was flown to its end took about as long as it should: a hop over nothing is no flight."""
    estimate, actual = mission.get("estimate_s"), mission.get("actual_s")
    if mission["outcome"] != "done" or not estimate or mission.get("estimate_is_endless"):
        return True
    return actual is not None and 0.5 * estimate < actual < 2 * estimate


def fly(block: documents.Block, folder: pathlib.Path):
    """On the simulator, to its end, every mission of it."""
    script, report = folder / "flown.dolphin", folder / "flown.json"
    script.write_text(block.script)
    code, out, err = harness.finish("run", str(script), "--sim", block.words["flown"], "--report", str(report), seconds=reader.LONGEST_S)
    assert code == int(block.words.get("exit", 0)), f"{block.place}: run ends with {code}\n{out}{err}"
    missions = [mission for vehicle in json.loads(report.read_text())["vehicles"] for mission in vehicle["missions"]]
    assert missions, f"{block.place}: nothing is flown\n{out}{err}"
    for mission in missions:
        assert mission["outcome"] in ("done", "stopped") and is_as_estimated(mission), f"{block.place}: {mission}\n{out}{err}"
    still_flying = [word for word in ("still in the air",) if word in out + err]
    assert not still_flying, f"{block.place}: {out}{err}"


def drive(block: documents.Block, folder: pathlib.Path):
    """By a robot in a simulated building, to its end, every drive of it."""
    script, report = folder / "driven.dolphin", folder / "driven.json"
    script.write_text(block.script)
    building = harness.ROOT / block.words["driven"]
    code, out, err = harness.finish("run", str(script), "--robot", f"sim:{building}", "--report", str(report), seconds=reader.LONGEST_S)
    assert code == 0, f"{block.place}: run ends with {code}\n{out}{err}"
    robots = [vehicle["robot"] for vehicle in json.loads(report.read_text())["vehicles"] if "robot" in vehicle]
    outcomes = [one["outcome"] for robot in robots for one in robot["drives"]]
    assert outcomes and set(outcomes) == {"done"}, f"{block.place}: {outcomes}\n{out}{err}"
    assert all(robot["collisions"] == 0 for robot in robots), f"{block.place}: {robots}"


def strays(page: pathlib.Path) -> list[str]:
    """Blocks that nobody would follow: without a language that is known here, or indented."""
    fences = documents.fences_of(page)
    inside = {number for fence in fences for number in range(fence.line, fence.end + 1)}
    known = ("dolphin", "sh", "text", *FOREIGN)
    wrong = [f"{page.name}:{fence.line}: a block without a language" for fence in fences if fence.language not in known]
    before = ""
    for number, line in enumerate(page.read_text().splitlines(), start=1):
        is_list = re.match(r" *([-*]|\d+\.) ", before)
        if number not in inside and line.startswith("    ") and not before.strip() and not is_list:
            wrong.append(f"{page.name}:{number}: an indented block; write ```sh or ```text")
        before = line
    return wrong


def follow(page: pathlib.Path) -> str:
    begin, count = time.monotonic(), 0
    with tempfile.TemporaryDirectory() as name:
        somebody = reader.Reader(pathlib.Path(name))
        try:
            for step in documents.steps_of(page):
                somebody.follow(step)
                if "flown" in step.words:
                    fly(step, pathlib.Path(name))
                if "driven" in step.words:
                    drive(step, pathlib.Path(name))
                count += 1
            somebody.end()
        finally:
            somebody.kill()
    return f"{page.name}: {count} steps in {time.monotonic() - begin:.1f} s"


guides = [guide for guide in GUIDES if len(sys.argv) == 1 or guide.name in sys.argv[1:]]
wrong = [stray for guide in guides for stray in strays(guide)]
with concurrent.futures.ThreadPoolExecutor() as pool:
    for guide, future in [(guide, pool.submit(follow, guide)) for guide in guides]:
        try:
            print(future.result())
        except AssertionError as mistake:
            wrong.append(f"{guide.name}: {mistake}")
assert not wrong, "\n\n".join(wrong)
