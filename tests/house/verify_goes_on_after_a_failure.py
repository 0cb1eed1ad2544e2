"""`./lapwing verify` runs the parts that it is told, goes on after one that fails, and says which. Its tools are stand-ins.
usage: verify_goes_on_after_a_failure.py REPO"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

REPO = pathlib.Path(sys.argv[1]).resolve()
TOOL = """#!/bin/bash
echo "$(basename "$0") $*" | sed "s|$ROOT|.|g" >> "$CALLS"
case "$(basename "$0") $*" in
  *"$BROKEN"*) echo "the words of the tool"; exit 7 ;;
esac
"""


def verify(root: pathlib.Path, *words: str, broken: str = "nothing is") -> tuple[int, str, list[str]]:
    calls = root / "calls"
    calls.write_text("")
    done = subprocess.run([sys.executable, root / "tests/verify/verify.py", *words], capture_output=True, text=True, timeout=60,
                          env={**os.environ, "PATH": f"{root / 'tools'}:/usr/bin:/bin", "CALLS": str(calls), "ROOT": str(root), "BROKEN": broken})
    return done.returncode, done.stdout + done.stderr, calls.read_text().splitlines()


with tempfile.TemporaryDirectory() as folder:
    root = pathlib.Path(folder)
    for file in ("tests/verify/verify.py", "fuzz/CMakeLists.txt"):
        (root / file).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(REPO / file, root / file)
    for tool in ("tools/cmake", "tools/ctest", "fuzz/run.sh"):
        (root / tool).parent.mkdir(exist_ok=True)
        (root / tool).write_text(TOOL)
        (root / tool).chmod(0o755)

    code, said, calls = verify(root, "clang", "asan")
    assert code == 0 and said.endswith("2 passed, 0 failed\n"), said
    assert calls == [*2 * ["cmake --preset asan", "cmake --build ./build/asan --target all -- -k 0"], calls[-1]], calls
    assert calls[-1].startswith("ctest --test-dir ./build/asan -L ^unit$"), calls

    code, said, calls = verify(root, "clang", "tsan", broken="--build " + str(root / "build/asan"))
    assert code == 1 and said.endswith("1 passed, 1 failed\n") and "clang: FAILED" in said, said
    assert "see build/verify/clang.log" in said and "the words of the tool" in (root / "build/verify/clang.log").read_text(), said
    assert any("build/tsan" in call for call in calls), calls

    # One fuzz target that finds something keeps no other from being tried.
    code, said, calls = verify(root, "fuzz", "--fuzz-seconds", "3", broken="run.sh frame")
    tried = [call.split()[1] for call in calls if call.startswith("run.sh")]
    known = [line.split("(")[1].split()[0] for line in (REPO / "fuzz/CMakeLists.txt").read_text().splitlines() if line.lstrip().startswith("lapwing_fuzz(")]
    assert code == 1 and sorted(tried) == sorted(known) and "build/fuzz/failures: frame" in said, (said, tried)
    assert all(call.endswith(" 3 ./build/asan") for call in calls if call.startswith("run.sh")), calls

    for words, wrong in ((("nonsense",), "there is no part nonsense"), (("--fuzz-seconds", "0"), "must be 1 or more")):
        code, said, calls = verify(root, *words)
        assert code == 2 and wrong in said and not calls, said
    code, said, calls = verify(root, "--list")
    assert code == 0 and len(said.splitlines()) == 7 and not calls, said
print("verify goes on after a failure")
