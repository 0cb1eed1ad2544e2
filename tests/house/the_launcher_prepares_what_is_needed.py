"""The launcher prepares what a word of the command line needs and no more, one launcher at a time, with the build tool that CMake was
configured with. Its tools are stand-ins that write down how they are called. usage: the_launcher_prepares_what_is_needed.py REPO"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

REPO = pathlib.Path(sys.argv[1]).resolve()

# What stands in for each tool. A build makes the program; two builds at once are an error that the log shows.
TOOL = """#!/bin/bash
echo "$(basename "$0") $*" >> "$CALLS"
case "$(basename "$0") $*" in
  "cmake --preset "*) mkdir -p build/release && touch build/release/build.ninja ;;
  *" -n") [ -f "$ROOT/built" ] && echo "ninja: no work to do." ;;
  "cmake --build "*)
    mkdir "$ROOT/building" 2>/dev/null || echo "two builds at once" >> "$CALLS"
    [ ! -e "$ROOT/gate" ] || read -r _ < "$ROOT/gate"
    mkdir -p "$ROOT/build/release/bin" && cp "$ROOT/program" "$ROOT/build/release/bin/lapwing" && touch "$ROOT/built" && rmdir "$ROOT/building" ;;
  "dpkg-query "*) for package in "${@:3}"; do echo "installed $package"; done ;;
  "node --version") echo v18.0.0 ;;
  "npm --prefix "*" run build") mkdir -p "$ROOT/web/dist" && touch "$ROOT/web/dist/index.html" ;;
  "npm --prefix "*) mkdir -p "$3/node_modules" "$2/node_modules" ;;
esac
exit 0
"""
TOOLS = ("cmake", "ctest", "ninja", "dpkg-query", "apt-get", "node", "npm", "sudo")


class Checkout:
    """A checkout with the launcher and nothing that has to be compiled."""

    def __init__(self, root: pathlib.Path):
        self.root = root
        shutil.copy(REPO / "lapwing", root)
        shutil.copytree(REPO / "setup", root / "setup")
        for packages in ("web", "editors/vscode"):
            (root / packages).mkdir(parents=True)
            shutil.copy(REPO / packages / "package-lock.json", root / packages)
        self.script(root / "program", '#!/bin/bash\necho "lapwing $*" >> "$CALLS"\n')
        self.script(root / ".venv/bin/python", "#!/bin/bash\nexit 0\n")
        for tool in TOOLS:
            self.script(root / "tools" / tool, TOOL)
        self.env = {**os.environ, "PATH": f"{root / 'tools'}:/usr/bin:/bin", "CALLS": str(root / "calls"), "ROOT": str(root)}

    @staticmethod
    def script(path: pathlib.Path, text: str) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def start(self, *words: str) -> subprocess.Popen:
        return subprocess.Popen([self.root / "lapwing", *words], cwd=self.root, env=self.env, stderr=subprocess.PIPE, text=True)

    def run(self, *words: str) -> list[str]:
        """The tools' calls of one launcher."""
        calls = self.root / "calls"
        calls.write_text("")
        launcher = self.start(*words)
        said = launcher.communicate(timeout=60)[1]
        assert launcher.returncode == 0, said
        return calls.read_text().splitlines()


def called(calls: list[str], word: str) -> bool:
    return any(call.startswith(word) for call in calls)


with tempfile.TemporaryDirectory() as folder:
    here = Checkout(pathlib.Path(folder))
    first = here.run("check", "my.dolphin")
    assert first[-1] == "lapwing check my.dolphin", first
    assert called(first, "cmake --preset release") and not called(first, "npm") and not called(first, "node"), first
    assert not any(call.startswith("cmake --build") and "programs" in call for call in first), first
    for word in ("fmt", "lsp", "plan", "sim", "route", "mission", "param", "signing", "help"):
        calls = here.run(word)
        assert calls[-1] == f"lapwing {word}" and not called(calls, "npm"), calls
        assert not called(calls, "ninja"), calls  # another ninja on the PATH would throw the build log away
        assert not called(calls, "apt-get"), calls  # nor is the network needed after the set-up
    (here.root / "built").unlink()
    calls = here.run("plan")
    assert any(call.startswith("cmake --build") and "--target programs" in call for call in calls), calls
    page = here.run("station")
    assert called(page, "npm --prefix") and page[-1] == "lapwing station", page
    for word in ("demo", "run", "replay", "doctor"):
        calls = here.run(word)
        assert calls[-1] == f"lapwing {word}" and not called(calls, "npm"), calls  # the page is there already

    # What looks at what robots see is made for those that have some, and they go on without it.
    (here.root / "built").unlink()
    calls = here.run("run", "a.dolphin")
    assert not any("lapwing-vision" in call for call in calls), calls
    for words in (("demo",), ("run", "a.dolphin", "--robot", "sim:b.toml"), ("station", "--robot=sim:b.toml")):
        (here.root / "built").unlink()
        calls = here.run(*words)
        assert any("--target lapwing-vision" in call for call in calls) and calls[-1] == f"lapwing {' '.join(words)}", calls

    (here.root / "build/release/build.ninja").write_text("bin/lapwing-vision")
    calls = here.run("detect", "doors", "a.jpg", "--out", "o")
    assert calls[-1] == "lapwing detect doors a.jpg --out o" and not called(calls, "npm") and not called(calls, "cmake --preset"), calls
    (here.root / "build/release/build.ninja").write_text("")
    calls = here.run("detect", "doors")
    assert called(calls, "cmake --preset release"), calls  # a build folder from before knows no such program

    # Long flights are left to `verify long`, but what is asked for by its name is run.
    assert any(call.startswith("ctest") and call.endswith("-LE ^long$") for call in here.run("test")), calls
    assert not any("-LE" in call for call in here.run("test", "-R", "^system")), calls

    # A changed source: one build, and a second launcher waits for it.
    (here.root / "built").unlink()
    os.mkfifo(here.root / "gate")
    (here.root / "calls").write_text("")
    one, other = here.start("check", "1"), here.start("check", "2")
    waiting = one if "waiting for it" in (line := one.stderr.readline()) else other
    if waiting is other:
        while "waiting for it" not in (line := other.stderr.readline()):
            assert line, "neither launcher waits"
    with open(here.root / "gate", "w") as gate:
        (here.root / "gate").rename(here.root / "open")
        gate.write("go on\n")
    for launcher in (one, other):
        rest = launcher.communicate(timeout=60)[1]
        assert launcher.returncode == 0, rest
    calls = (here.root / "calls").read_text().splitlines()
    builds = [call for call in calls if call.startswith("cmake --build") and not call.endswith("-n")]
    assert len(builds) == 1 and "two builds at once" not in calls, calls
    assert {"lapwing check 1", "lapwing check 2"} <= set(calls), calls
print("the launcher prepares what is needed")
