"""A task that is stopped while it waits, uploads, arms, starts or flies leaves its vehicle at rest; and the next task flies."""

import pathlib
import re
import tempfile

import harness

HOME = "41.1780,-8.5980,90"
SCRIPT = """
h = location(41.1780, -8.5980, 90)
v = pick {{ type '{type}'; timeout 30 }}
m = mission {{ name 'M'; home h; {take_off} move 300, 0; returnHome() }}
execute v: during {seconds} run m
pause 12
message mode(v)
execute v: during 8 run m
pause 10
message mode(v)
"""
TAKE_OFF = "takeOff location(41.1780, -8.5980, 110);"
# Kind, type, take-off, its mode after power-on, the mode in which it holds.
KINDS = [("copter", "UAV", TAKE_OFF, "STABILIZE", "BRAKE"), ("plane", "UAV", TAKE_OFF, "MANUAL", "LOITER"),
         ("rover", "UGV", "", "MANUAL", "HOLD"), ("boat", "USV", "", "MANUAL", "LOITER"), ("sub", "UUV", "", "MANUAL", "POSHOLD")]

with tempfile.TemporaryDirectory() as folder:
    script = pathlib.Path(folder, "stop.dolphin")
    for kind, type_name, take_off, idle_mode, hold_mode in KINDS:
        for seconds in (0.01, 0.1, 0.5, 2, 3, 3.5, 4, 5, 8, 25):
            script.write_text(SCRIPT.format(type=type_name, take_off=take_off, seconds=seconds))
            out, err = harness.expect_exit(0, "run", str(script), "--sim", f"{kind}:1", "--home", HOME, "--seed", "3")
            first, last = re.findall(r"Program message: (\w+)", out)
            # Stopped before it was commanded anything it stands as it stood; the second task stops in flight.
            assert first in (idle_mode, hold_mode) and last == hold_mode, (kind, seconds, out, err)
            assert "could not be stopped" not in err, (kind, seconds, err)
print("every stop reached its vehicle")
