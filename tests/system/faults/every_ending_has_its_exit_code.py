"""Each way a script can end: exit code, message, report."""

import json
import pathlib
import tempfile

import harness

CASES = [
    # name, script, exit code, text that must be on stderr or stdout
    ("done", "message 'fine'", 0, "fine"),
    ("throws", "throw new RuntimeException('no luck')", 1, "no luck"),
    ("task_error", "v = pick { }\nm = mission { home location(41.178,-8.598,90); speed 3 }\n"
                   "execute action { throw new RuntimeException('broken') } | idle(5)", 1, "broken"),
    ("does_not_check", "message undefinedName", 2, "undefinedName"),
    ("does_not_parse", "message 'open\nx = (", 2, "error:"),
    ("halts", "message 'before'\nhalt 'enough'\nmessage 'after'", 3, "enough"),
    ("nothing_to_pick", "v = pick { type 'UUV'; timeout 2.seconds }", 3, "Could not find required vehicles!"),
]

with tempfile.TemporaryDirectory() as folder:
    for name, script, expected, text in CASES:
        path, report_path = pathlib.Path(folder, f"{name}.dolphin"), pathlib.Path(folder, f"{name}.json")
        path.write_text(script)
        out, err = harness.expect_exit(expected, "run", str(path), "--sim", "copter:1", "--report", str(report_path))
        assert text in out + err, f"{name}: no {text!r} in\n{out}\n{err}"
        if expected != 2:
            report = json.loads(report_path.read_text())
            assert report["outcome"] == {0: "done", 1: "error", 3: "halted"}[expected], (name, report)
            assert (report["errors"] == []) == (expected == 0), (name, report["errors"])
        if expected in (1, 2):
            assert f"{name}.dolphin:" in err, f"{name}: no file and line in\n{err}"
    assert "after" not in out

    timed = pathlib.Path(folder, "endless.dolphin")
    timed.write_text("while (true) { pause 1.seconds }")
    out, err = harness.expect_exit(3, "run", str(timed), "--sim", "copter:1", "--timeout", "5")
    assert "5 s" in err, err
print(f"{len(CASES) + 1} endings")
