"""ArduPilots in the loop (SITL), each started freshly in a folder of its own. Not a test itself.

`LAPWING_SITL` in the environment is the folder of an ArduPilot's source in which `./waf configure --board sitl` and
`./waf copter rover plane` have been; what has not been built there is left out.
"""

import contextlib
import os
import pathlib
import signal
import socket
import subprocess
import tempfile
import threading

PROGRAMS = {  # model and parameters of each, as ArduPilot's own sim_vehicle.py starts it
    "copter": ("arducopter", "+", ("default_params/copter.parm",)),
    "rover": ("ardurover", "rover", ("default_params/rover.parm",)),
    "skid": ("ardurover", "rover-skid", ("default_params/rover.parm", "default_params/rover-skid.parm")),
    "plane": ("arduplane", "plane", ("models/plane.parm",)),
    "boat": ("ardurover", "motorboat", ("default_params/rover.parm", "default_params/motorboat.parm")),
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


class Instances:
    """Each program in the loop listens at TCP and UDP ports of its own, which its instance number shifts by tens."""

    def __init__(self):
        self._taken, self._lock = set(), threading.Lock()

    @contextlib.contextmanager
    def one(self):
        with self._lock:
            number = next(number for number in range(100) if number not in self._taken and self._is_free(number))
            self._taken.add(number)
        try:
            yield number
        finally:
            with self._lock:
                self._taken.discard(number)

    @staticmethod
    def _is_free(number: int) -> bool:
        for kind, port in ((socket.SOCK_STREAM, 5762), (socket.SOCK_STREAM, 5763), (socket.SOCK_DGRAM, 5501)):
            with socket.socket(socket.AF_INET, kind) as probe:
                try:
                    probe.bind(("127.0.0.1", port + 10 * number))
                except OSError:
                    return False
        return True


INSTANCES = Instances()


@contextlib.contextmanager
def started(family: str, port: int, speedup: float = 5, *, system: int = 1, home=HOME, parameters=(), witness_port: int | None = None):
    """The process of one that sends to that UDP port, and to a witness's too, and forgets all parameters of before but
    these (`NAME=VALUE`)."""
    _, model, defaults = PROGRAMS[family]
    with tempfile.TemporaryDirectory() as folder, open(pathlib.Path(folder, "log"), "w") as log, INSTANCES.one() as instance:
        own = pathlib.Path(folder, "own.parm")
        own.write_text("".join(parameter.replace("=", " ") + "\n" for parameter in parameters))
        files = [str(source() / "Tools/autotest" / name) for name in defaults] + [str(own)]
        witness = ["--serial1", f"udpclient:127.0.0.1:{witness_port}"] if witness_port else []
        process = subprocess.Popen(
            [program(family), "--model", model, "--speedup", str(speedup), "--wipe", "--instance", str(instance), "--sysid", str(system),
             "--home", ",".join(map(str, (*home, 0))), "--defaults", ",".join(files),
             "--serial0", f"udpclient:127.0.0.1:{port}", *witness], cwd=folder, stdout=log, stderr=log, stdin=subprocess.DEVNULL)
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
