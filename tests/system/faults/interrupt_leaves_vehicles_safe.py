"""Ctrl-C in mid-mission: every vehicle is commanded into the stop mode, seen from outside, then exit 130."""

import pathlib
import signal
import socket
import subprocess
import tempfile
import time

from pymavlink import mavutil

import harness

SCRIPT = """
vs = pick { count 2; type 'UAV'; timeout 60.seconds }
m = mission {
  home location(41.1780, -8.5980, 90)
  takeOff location(41.1780, -8.5980, 110)
  move 300, 0
  returnHomeAndLand()
}
execute vs: m | m
"""
BRAKE, RTL, LAND, AUTO = 17, 6, 9, 3


def interrupt_with(on_stop: str, expected_mode: int):
    """The test stands between simulator and `run` as a relay, and reads what the vehicles report."""
    run_port = harness.free_udp_port()
    relay = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    relay.bind(("127.0.0.1", 0))
    relay.setblocking(False)
    upstream, modes, parser = {}, {}, mavutil.mavlink.MAVLink(None)
    parser.robust_parsing = True
    altitude = {}

    def pump():
        try:
            while True:
                data, sender = relay.recvfrom(2048)
                if sender not in upstream:
                    upstream[sender] = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
                    upstream[sender].setblocking(False)
                upstream[sender].sendto(data, ("127.0.0.1", run_port))
                for message in parser.parse_buffer(data) or []:
                    if message.get_type() == "HEARTBEAT":
                        modes[message.get_srcSystem()] = message.custom_mode
                    if message.get_type() == "GLOBAL_POSITION_INT":
                        altitude[message.get_srcSystem()] = message.relative_alt / 1000
        except (BlockingIOError, ConnectionRefusedError):
            pass
        for vehicle, upward in upstream.items():
            try:
                while True:
                    relay.sendto(upward.recv(2048), vehicle)
            except (BlockingIOError, ConnectionRefusedError):
                pass

    with tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(folder, "long.dolphin")
        script.write_text(SCRIPT)
        with harness.lapwing("sim", "--vehicles", "copter:2", "--out", f"udpout://127.0.0.1:{relay.getsockname()[1]}"):
            run = subprocess.Popen([harness.LAPWING, "run", str(script), "--link", f"udpin://127.0.0.1:{run_port}",
                                    "--on-stop", on_stop], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

            def pump_until(condition, seconds, what):
                deadline = time.monotonic() + seconds
                while not condition():
                    assert time.monotonic() < deadline, f"not within {seconds} s: {what}; modes {modes}, heights {altitude}"
                    assert run.poll() is None or what == "the end", f"run ended early\n{run.communicate()}"
                    pump()
                    time.sleep(0.002)

            pump_until(lambda: len(altitude) == 2 and all(height > 5 for height in altitude.values()), 90, "both airborne")
            assert set(modes.values()) == {AUTO}, modes
            run.send_signal(signal.SIGINT)
            pump_until(lambda: run.poll() is not None, 20, "the end")
            assert run.returncode == 130, f"exit {run.returncode}\n{run.communicate()}"
            for _ in range(20):
                pump()
                time.sleep(0.01)
            assert set(modes.values()) == {expected_mode}, f"--on-stop {on_stop}: modes {modes}"
    for each in (relay, *upstream.values()):
        each.close()


interrupt_with("loiter", BRAKE)
interrupt_with("rtl", RTL)
print("held with loiter, returned with rtl")
