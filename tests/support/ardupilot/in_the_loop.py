"""ArduPilots in the loop (SITL), each started freshly in a folder of its own. Not a test itself.

`LAPWING_SITL` in the environment is the folder of an ArduPilot's source in which `./waf configure --board sitl` and
`./waf copter rover plane` have been; what has not been built there is left out.
"""

import contextlib
import os
import pathlib
import signal
import subprocess
import tempfile

PROGRAMS = {  # model and parameters of each, as ArduPilot's own sim_vehicle.py starts it
    "copter": ("arducopter", "+", "default_params/copter.parm"),
    "rover": ("ardurover", "rover", "default_params/rover.parm"),
    "plane": ("arduplane", "plane", "models/plane.parm"),
}
HOME = (41.178, -8.598, 90)


def source() -> pathlib.Path | None:
    named = os.environ.get("LAPWING_SITL")
    return pathlib.Path(named) if named else None


def families() -> list[str]:
    """Those that have been built."""
    return [family for family in PROGRAMS if program(family).exists()]


def program(family: str) -> pathlib.Path:
    return source() / "build/sitl/bin" / PROGRAMS[family][0]


@contextlib.contextmanager
def started(family: str, port: int, speedup: float = 5):
    """The process of one that sends to that UDP port and forgets all parameters of before."""
    _, model, defaults = PROGRAMS[family]
    with tempfile.TemporaryDirectory() as folder, open(pathlib.Path(folder, "log"), "w") as log:
        process = subprocess.Popen(
            [program(family), "--model", model, "--speedup", str(speedup), "--wipe", "--sysid", "1",
             "--home", ",".join(map(str, (*HOME, 0))), "--defaults", source() / "Tools/autotest" / defaults,
             "--serial0", f"udpclient:127.0.0.1:{port}"], cwd=folder, stdout=log, stderr=log, stdin=subprocess.DEVNULL)
        try:
            yield process
        finally:
            process.send_signal(signal.SIGCONT)
            process.terminate()
            try:
                process.wait(timeout=10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
