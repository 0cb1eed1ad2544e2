"""A file that passed clang-tidy is read again when what it is made from changed, and only then. The tool is a stand-in.
usage: tidy_reads_what_changed.py REPO"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

REPO = pathlib.Path(sys.argv[1]).resolve()
# Finds a name in the header for every file, as the tool does, and one in a file that says so. One that includes others is those together,
# which the compiler takes only if the words "lonely" and "also" are not both in them.
TOOL = """#!/bin/bash
[ "$1" = --version ] && echo "version $VERSION" && exit
for word; do [ "$word" = -- ] && break; file=$word; done
files=$(sed -n 's/^#include "\\(.*cpp\\)".*/\\1/p' "$file")
files=${files:-$file}
echo $(for one in $files; do basename "$one"; done) >> "$CALLS"
grep -qs wrong "$ROOT/src/room/deep.hpp" && echo "$ROOT/src/room/deep.hpp:1:1: error: a name [naming]" && status=1
for one in $files; do
  grep -q wrong "$one" && echo "$one:2:1: error: a name [naming]" && status=1
done
cat $files | grep -q lonely && cat $files | grep -q also && echo "$one:1:1: error: twice the same [clang-diagnostic-error]" && status=1
exit ${status:-0}
"""


def tidy(root: pathlib.Path, *words: str, version: str = "1") -> tuple[int, str, list[str]]:
    calls = root / "calls"
    calls.write_text("")
    done = subprocess.run([sys.executable, root / "tests/verify/tidy.py", root / "build", *words], capture_output=True, text=True, timeout=60,
                          env={**os.environ, "PATH": f"{root / 'tools'}:/usr/bin:/bin", "CALLS": str(calls), "ROOT": str(root), "VERSION": version})
    return done.returncode, done.stdout + done.stderr, sorted(calls.read_text().splitlines())


with tempfile.TemporaryDirectory() as folder:
    root = pathlib.Path(folder).resolve()
    texts = {".clang-tidy": "Checks: naming\n", ".venv/bin/clang-tidy": TOOL, "src/room/deep.hpp": "int deep();\n",
             "src/room/near.hpp": '#include "room/deep.hpp"\n', "src/room/a.cpp": '#include "room/near.hpp"\n', "src/room/b.cpp": "int b();\n"}
    for name, text in texts.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    (root / ".venv/bin/clang-tidy").chmod(0o755)
    for name in ("tests/verify", "cmake", "build"):
        (root / name).mkdir(parents=True)
    for name in ("tests/verify/tidy.py", "cmake/together.py"):
        shutil.copy(REPO / name, root / name)
    commands = [{"directory": str(root / "build"), "command": f"c++ {name}", "file": str(root / "src/room" / name)} for name in ("a.cpp", "b.cpp")]
    (root / "build/compile_commands.json").write_text(json.dumps(commands))

    code, said, calls = tidy(root)
    assert code == 0 and calls == ["a.cpp b.cpp"] and said.endswith("2 files read, 0 of them with findings, 0 not read\n"), said
    assert tidy(root)[2] == [], "what passed was read again"

    # A header is found through the headers between; a finding is told whenever it is asked for, until it is mended.
    (root / "src/room/deep.hpp").write_text("int wrong();\n")
    (root / "src/room/b.cpp").write_text("int b();\nint wrong();\n")
    for _ in range(2):
        code, said, calls = tidy(root)
        assert code == 1 and calls == ["a.cpp b.cpp"], (said, calls)
        assert said.count("deep.hpp:1:1") == 1 and said.count("b.cpp:2:1") == 1, said
    (root / "src/room/deep.hpp").write_text(texts["src/room/deep.hpp"])
    assert tidy(root, "room/b")[2] == ["b.cpp"], "another file than the one asked for was read"
    assert [tidy(root)[2], tidy(root)[2]] == [["a.cpp b.cpp"], ["b.cpp"]], "what is mended is read once, what is not each time"

    (root / "src/room/b.cpp").write_text(texts["src/room/b.cpp"])
    tidy(root)
    (root / ".clang-tidy").write_text("Checks: sizes\n")
    assert tidy(root)[2] == ["a.cpp b.cpp"], "rules changed, and files that passed the old ones were not read"
    assert tidy(root, version="2")[2] == ["a.cpp b.cpp"], "the tool changed, and files that passed the old one were not read"

    # Files are read as one unless they declare the same, and apart when the compiler does not take them together: that is nobody's fault.
    (root / "src/room/a.cpp").write_text("int helper();\n")
    (root / "src/room/b.cpp").write_text("struct Other {\n  int helper();\n};\nint helper(int more);\n")
    assert tidy(root)[2] == ["a.cpp", "b.cpp"], "two of one name were read as one"
    (root / "src/room/a.cpp").write_text("int a();  // lonely\n")
    (root / "src/room/b.cpp").write_text("int b();  // also\n")
    code, said, calls = tidy(root)
    assert code == 0 and calls == ["a.cpp", "a.cpp b.cpp", "b.cpp"] and "twice" not in said, (said, calls)
    assert tidy(root)[2] == [], "what passed alone was read again"
print("clang-tidy reads what changed")
