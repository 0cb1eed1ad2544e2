"""A robot with cameras in a simulated building explores while the program that looks at its pictures is killed, and hangs; while the disk is full on
which its map is kept; and while nobody is connected for a minute. Each is said with its module and code, stops nothing, and is over when it is over. The
disk is a small tmpfs, which needs the right to mount; without it that part is left out."""

import contextlib
import os
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import time

import harness
from station import Station

WING = harness.ROOT / "examples/buildings/wing.toml"
SCRIPT = """
robot = pick { id 'robot1'; timeout 60.seconds }
execute robot: drive { explore(); returnToStart() } >> drive { explore(); returnToStart() }
"""
MEBIBYTE = 1024 * 1024
CUT_S = 60

if not (pathlib.Path(harness.LAPWING).parent / "lapwing-vision").exists():
    print("skipped: lapwing-vision was not built (setup/packages-vision.txt)")
    sys.exit(harness.SKIPPED)

web, port = harness.free_tcp_port(), harness.free_tcp_port()
station = Station(web)


def health() -> dict:
    return station.ask("health")[1]["vehicles"][0]


def module(name: str) -> dict:
    return next((m for m in health()["modules"] if m["module"] == name), {})


def code(name: str) -> int:
    return (module(name).get("error") or {}).get("code", 0)


def says(name: str, number: int, seconds: float = 60):
    harness.wait_until(lambda: code(name) == number, seconds, f"{name} says {number}; {health()}")


def drives_on(way_m: float = 0.3):
    begin = station.vehicle("robot1")["track_m"]
    harness.wait_until(lambda: station.vehicle("robot1")["track_m"] > begin + way_m, 90, f"the robot drives on; {health()}")


def eyes_of(process) -> int:
    """The one that looks: a child of the station, on whichever of its threads."""
    for children in pathlib.Path(f"/proc/{process.pid}/task").glob("*/children"):
        for child in children.read_text().split():
            with contextlib.suppress(OSError):
                if "look" in pathlib.Path(f"/proc/{child}/cmdline").read_text().split("\0"):
                    return int(child)
    return 0


@contextlib.contextmanager
def small_disk():
    """160 MB, and whether it is one."""
    with tempfile.TemporaryDirectory() as folder:
        is_mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=160m", "tmpfs", folder], capture_output=True, check=False).returncode == 0
        try:
            yield pathlib.Path(folder), is_mounted
        finally:
            if is_mounted:
                subprocess.run(["umount", "--lazy", folder], check=True)


with small_disk() as (disk, is_small), harness.lapwing(
        "station", "--robot", f"sim:{WING}", "--store", str(disk / "store"), "--old-parts", f"tcpin://127.0.0.1:{port}", "--link",
        f"udpin://127.0.0.1:{harness.free_udp_port()}", "--port", str(web)) as process:
    harness.wait_until(station.up, 30, "the station answers")
    harness.wait_until(lambda: station.vehicle("robot1").get("position"), 30, "the robot knows where it is")
    operator = socket.create_connection(("127.0.0.1", port), timeout=10)
    assert station.ask("script", {"name": "wing.dolphin", "source": SCRIPT})[0] == 202
    drives_on()
    says("CM", 0)
    harness.wait_until(lambda: eyes_of(process), 60, "somebody looks at pictures")

    # Dead: started anew by itself.
    eyes = eyes_of(process)
    os.kill(eyes, signal.SIGKILL)
    says("POI", 504)
    drives_on()
    says("POI", 0, 120)
    harness.wait_until(lambda: eyes_of(process) not in (0, eyes), 60, "another one looks")

    # Hanging: silent first, then ended and started anew.
    eyes = eyes_of(process)
    os.kill(eyes, signal.SIGSTOP)
    harness.wait_until(lambda: module("POI")["state"] == "silent", 60, f"the eyes are silent; {health()}")
    assert health()["may_move"], health()
    drives_on()
    harness.wait_until(lambda: module("POI")["state"] == "ready" and code("POI") == 0 and eyes_of(process) not in (0, eyes), 120,
                       f"another one looks; {health()}")

    if is_small:
        ballast = disk / "ballast"
        ballast.write_bytes(b"x" * (120 * MEBIBYTE))
        says("MMU", 304)
        assert health()["may_move"], health()
        drives_on()
        ballast.unlink()
        says("MMU", 0)

    # Nobody is connected for a minute: at every look the robot may move, and it does.
    operator.close()
    says("CM", 601)
    cut = time.monotonic()
    begin = station.vehicle("robot1")["track_m"]
    while time.monotonic() - cut < CUT_S:
        assert health()["may_move"] or module("PLN")["state"] == "silent" or module("MMU")["state"] == "silent", health()
    assert station.vehicle("robot1")["track_m"] > begin + 1, "it did not drive meanwhile"
    with socket.create_connection(("127.0.0.1", port), timeout=10):
        says("CM", 0)
        drives_on()
print(f"drove on, {'with' if is_small else 'without'} a full disk")
