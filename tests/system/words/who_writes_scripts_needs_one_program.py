"""What writers of scripts use is one small program; each other verb is in a program beside it, and is missed only when it is asked for."""

import pathlib
import shutil
import subprocess
import tempfile

import harness

EXAMPLE = harness.ROOT / "examples/survey.dolphin"
PROGRAM = pathlib.Path(harness.LAPWING)


with tempfile.TemporaryDirectory() as folder:
    alone = pathlib.Path(folder) / "lapwing"
    shutil.copy(PROGRAM, alone)

    def said(*words: object) -> subprocess.CompletedProcess:
        return subprocess.run([alone, *map(str, words)], capture_output=True, text=True, timeout=60, stdin=subprocess.DEVNULL)

    assert said("check", EXAMPLE).returncode == 0
    assert said("fmt", "--check", EXAMPLE).returncode == 0
    overview = said("--help").stdout
    for verb in ("run", "demo", "plan", "mission", "check", "fmt", "lsp", "sim", "replay", "station", "param", "signing", "route", "doctor"):
        assert f"  {verb} " in overview, overview
    for words in (("run", EXAMPLE), ("help", "station"), ("plan", "--help")):
        missing = said(*words)
        assert missing.returncode == 1 and not missing.stdout, missing
        assert f"cannot start {folder}/lapwing-vehicles: No such file" in missing.stderr, missing
        assert f"./lapwing {words[1] if words[0] == 'help' else words[0]} makes" in missing.stderr, missing
    typo = said("rum")
    assert typo.returncode == 2 and "there is no command 'rum'" in typo.stderr and "run" in typo.stderr, typo

# With the other program beside it a verb is the same process, so that its exit code and its signals are those of the verb.
out, _ = harness.expect_exit(0, "help", "run")
assert "--on-stop" in out, out
_, err = harness.expect_exit(2, "run", "no-such-file.dolphin")
assert "no-such-file.dolphin" in err, err
# What a room for vehicles, maps or cameras brings along must not come in by the back door.
small, large = (path.stat().st_size for path in (PROGRAM, PROGRAM.parent / "lapwing-vehicles"))
assert small * 2 < large, (small, large)
# Nor is anybody to wait for what a database server's library brings for logging in: whoever opens a store on a server loads it.
loaded = subprocess.run(["ldd", PROGRAM.parent / "lapwing-vehicles"], capture_output=True, text=True, check=True).stdout
assert "libsqlite3" in loaded and "libpq" not in loaded and "libldap" not in loaded, loaded
print(f"{small / 2**20:.1f} MiB beside {large / 2**20:.1f} MiB")
