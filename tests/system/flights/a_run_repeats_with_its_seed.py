"""The same script and seed write the same words and events; another seed writes others."""

import pathlib
import tempfile

import harness

SCRIPT = """
v = pick { count 2 }
t = idle(0)
for (i in 1..10) { t = t >> task("T$i:${Math.random().round(2)}") }
execute t
message System.currentTimeMillis()
message Math.random()
"""

with tempfile.TemporaryDirectory() as folder:
    path = pathlib.Path(folder, "chance.dolphin")
    path.write_text(SCRIPT)

    def written(seed):
        out, _ = harness.expect_exit(0, "run", "--platform", "test", "--events", "-", "--seed", str(seed), str(path))
        return out

    first = written(7)
    assert first.count('"DONE"') == 10, first
    assert first == written(7), "two runs with one seed differ"
    assert first != written(8), "the seed changes nothing"
print("a run repeats")
