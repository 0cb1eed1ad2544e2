"""In flight the process that sends video is stopped: it is replaced, and nobody else misses a step. Then the supervisor is stopped: the flight goes on and takes commands, what
fails meanwhile waits, and all is well when it goes on. A second one is refused. When it is killed the drone comes home, and the next start, which comes at once, ends what the one
before has left, another program among it, before it starts anything: none finds its port taken."""

import contextlib
import os
import pathlib
import signal
import socket
import sys
import time

import harness
import survey
from drone import Drone, Operator, arm, take_off
from ros_drone import RosDrone

if not (pathlib.Path(harness.LAPWING).parent / "lapwing-stream").exists():
    print("lapwing-stream is not built here")
    sys.exit(harness.SKIPPED)

LONGEST_SILENCE_S = 3  # after which a supervisor takes a process for one that hangs
rtsp_port = harness.free_tcp_port()
NAMES = ("lights", "bridge", "perceive", "stream", "decide")
PROCESSES = survey.tables(camera='kind = "pattern"\nwidth = 320\nheight = 240') + f"""
[stream]
port = {harness.free_tcp_port()}
[rtsp]
port = {rtsp_port}
""" + "".join(f'[[process]]\nname = "{name}"\n' + ('command = ["sleep", "1000"]\n' if name == "lights" else "") for name in NAMES)


def pids() -> dict[str, int | None]:
    return {name: drone.pid(name) for name in NAMES}


def replaced(name: str, before: int) -> int:
    return harness.wait_until(lambda: (pid := drone.pid(name)) and pid != before and pid or time.sleep(0.05), 20, f"{name} runs again")


def runs(pid: int) -> bool:
    """One that has ended and whose end nobody has asked for yet does not."""
    with contextlib.suppress(OSError):
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    return False


def serves_video() -> bool:
    with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", rtsp_port), timeout=2) as connection:
        connection.sendall(b"OPTIONS * RTSP/1.0\r\nCSeq: 1\r\n\r\n")
        return connection.recv(64).startswith(b"RTSP/1.0 200 ")
    return False


with Drone(processes=PROCESSES) as drone:
    witness = RosDrone(drone.domain)
    operator = Operator(drone.port)
    take_off(operator)
    harness.wait_until(lambda: serves_video() or time.sleep(0.05), 20, "video is served")
    began, before = len(operator.heartbeats), pids()

    os.kill(before["stream"], signal.SIGSTOP)
    drone.wait_for_log("stream stopped by signal 19")
    stream = replaced("stream", before["stream"])
    harness.wait_until(lambda: serves_video() or time.sleep(0.05), 20, "video is served again")
    assert pids() == {**before, "stream": stream}, (before, pids())

    # The supervisor, for longer than it would bear anybody's silence; one of its processes is killed meanwhile.
    drone.log.clear()
    os.kill(drone.onboard.pid, signal.SIGSTOP)
    stopped_at = time.monotonic()
    os.kill(stream, signal.SIGKILL)
    operator.command("Compulsive Move", X=20, Y=0)
    operator.wait_for_state("CompulsiveMove", 5)
    operator.wait_for_state("Hover", 40)
    known = len(operator.heartbeats)
    beats = 2 * LONGEST_SILENCE_S + 2
    operator.wait(lambda o: len(o.heartbeats) > known + beats, "it goes on speaking", 20)
    assert time.monotonic() - stopped_at > LONGEST_SILENCE_S
    assert not any("stream killed" in line for line in drone.log), "nobody has noticed"
    os.kill(drone.onboard.pid, signal.SIGCONT)
    drone.wait_for_log("stream killed by signal 9 (Killed); it is started again")
    stream = replaced("stream", stream)
    assert pids() == {**before, "stream": stream}, (before, pids())
    assert all(one["State"] in ("Hover", "CompulsiveMove") and one["Ardupilot State"] == "GUIDED" for one in operator.heartbeats[began:]), "it has flown on"

    _, errors = harness.expect_exit(3, "onboard", "--config", str(drone.config))
    assert "another lapwing onboard has the state folder" in errors, errors
    assert pids() == {**before, "stream": stream}, "the first one is none the worse"

    # It is killed, and another one is started at once, as systemd does.
    before = pids()
    drone.onboard.kill()
    drone.onboard.wait()
    drone.log.clear()
    drone.start()
    witness.wait(lambda w: w.state.mode == "RTL", "RTL", 10)
    drone.wait_for_log("lights of an earlier start still runs")
    for name in NAMES:
        replaced(name, before[name])
    left = [name for name in NAMES if runs(before[name])]
    assert not left, left
    health = drone.health()
    assert all(one["state"] == "running" and one["restarts"] == 0 for one in health.values()), health
    operator.cut()
    operator.connect()
    operator.wait(lambda o: o.last["State"] == "Idle" and o.last["Ardupilot State"] and not o.last["Armed"], "it has come home", 90)
    arm(operator)
    operator.command("Disarm")
    operator.wait(lambda o: o.last["State"] == "Idle" and not o.last["Armed"], "disarmed", 10)
    operator.cut()
