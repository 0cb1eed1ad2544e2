"""lapwing fmt: in place, --check, standard input; broken scripts stay as they are; the examples keep their meaning."""

import os
import pathlib
import subprocess
import tempfile

import harness


def through_stdin(*arguments: str, text: str):
    done = subprocess.run([harness.LAPWING, "fmt", *arguments], input=text, capture_output=True, text=True, timeout=30)
    return done.returncode, done.stdout, done.stderr


UGLY = "x=1\nmission{\n      takeOff p\n   }\n"
TIDY = "x = 1\nmission {\n  takeOff p\n}\n"

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    ugly, tidy, broken, link = (folder / f"{stem}.dolphin" for stem in ("ugly", "tidy", "broken", "link"))
    ugly.write_text(UGLY)
    tidy.write_text(TIDY)
    broken.write_text("x=(1\n")
    ugly.chmod(0o750)
    link.symlink_to(ugly)

    out, _ = harness.expect_exit(1, "fmt", "--check", str(ugly), str(tidy))
    assert out == f"{ugly}\n", out
    assert ugly.read_text() == UGLY, "--check writes nothing"

    out, err = harness.expect_exit(2, "fmt", str(broken), str(link), str(tidy))
    assert out == f"{link}\n" and "never closed" in err, (out, err)
    assert broken.read_text() == "x=(1\n", "a script that does not parse is left alone"
    assert ugly.read_text() == TIDY, "the others are formatted all the same"
    assert link.is_symlink() and ugly.stat().st_mode & 0o777 == 0o750, "links and permissions stay"
    assert sorted(os.listdir(folder)) == ["broken.dolphin", "link.dolphin", "tidy.dolphin", "ugly.dolphin"]
    harness.expect_exit(0, "fmt", "--check", str(ugly), str(tidy))
    harness.expect_exit(0, "fmt", str(ugly))

    assert through_stdin("-", text=UGLY) == (0, TIDY, "")
    assert through_stdin("--stdin", text=UGLY) == (0, TIDY, "")
    assert through_stdin("--stdin", "--check", text=TIDY) == (0, "", "")
    assert through_stdin("--stdin", "--check", text=UGLY) == (1, "<stdin>\n", "")
    code, out, err = through_stdin("-", text="x = (1\n")
    assert (code, out) == (2, "") and "<stdin>:1:5" in err, err

    harness.expect_exit(2, "fmt")
    _, err = harness.expect_exit(2, "fmt", str(folder / "missing.dolphin"))
    assert "no such file" in err

    for example in sorted((harness.ROOT / "examples").glob("*.dolphin")):
        code, once, _ = through_stdin("-", text=example.read_text())
        assert code == 0, example
        assert through_stdin("--check", "-", text=once) == (0, "", ""), f"{example}: formatting twice changes it"
print("scripts are formatted")
