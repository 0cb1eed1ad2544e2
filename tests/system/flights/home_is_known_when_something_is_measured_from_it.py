"""A vehicle that has just been heard has not told its home yet. Fences round home, and how far home would be moved, are judged by it
all the same: a copter out in the field is not refused its own home, and does not leave its own fence."""

import pathlib
import tempfile

import harness
from plausibility.flights import FIELD, flight

ONE = "v = pick { timeout 30.seconds }\nexecute v: m\n"
OUT = flight("move 180, 0", land=False) + ONE
BEYOND = "m = mission { goPos 41.1825, -8.5980, 120 }\n" + ONE
BACK = "m = mission { home " + FIELD + "; move 100, 0, 30; returnHomeAndLand() }\n" + ONE
FENCE = ("FENCE_ENABLE=1", "FENCE_TYPE=7", "FENCE_RADIUS=300")


def run(script: str, *where: str):
    """(exit code, what was logged) of a station of its own."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "script.dolphin")
        file.write_text(script)
        code, _, err = harness.finish("run", str(file), *where)
        return code, err


link = harness.free_udp_port()
where = ("--link", f"udpin://127.0.0.1:{link}", "--speedup", "10")
with harness.lapwing("sim", "--vehicles", "copter:1", "--home", "41.1780,-8.5980,90", "--speedup", "10", "--out", f"udpout://127.0.0.1:{link}",
                     *(word for parameter in FENCE for word in ("--param", parameter))):
    code, err = run(OUT, *where)
    assert code == 0, err
    code, err = run(BEYOND, *where)
    assert code != 0 and "outside copter 1's own fence: 300 m round home (FENCE_RADIUS)" in err and " flies '" not in err, (code, err)
    code, err = run(BACK, *where)
    assert code == 0 and "home_moved" not in err, (code, err)
print("home is known when something is measured from it")
