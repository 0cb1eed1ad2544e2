"""A flood of random datagrams on the MAVLink port, some of them damaged frames: the mission is flown all the same."""

import pathlib
import random
import socket
import subprocess
import tempfile
import time

import harness

SCRIPT = """
v = pick { type 'UAV'; timeout 60.seconds }
execute v: mission {
  home location(41.1780, -8.5980, 90)
  takeOff location(41.1780, -8.5980, 100)
  move 30, 0
  returnHomeAndLand()
}
message 'landed'
"""

random.seed(7)
port = harness.free_udp_port()
with tempfile.TemporaryDirectory() as folder:
    script = pathlib.Path(folder, "short.dolphin")
    script.write_text(SCRIPT)
    with harness.lapwing("sim", "--vehicles", "copter:1", "--out", f"udpout://127.0.0.1:{port}"):
        run = subprocess.Popen([harness.LAPWING, "run", str(script), "--link", f"udpin://127.0.0.1:{port}"],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        sent, deadline = 0, time.monotonic() + 200
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as flood:
            while run.poll() is None and time.monotonic() < deadline:
                for _ in range(50):
                    start = random.choice([b"\xfd", b"\xfe", b"\xfd\xff", b""])
                    flood.sendto(start + random.randbytes(random.randrange(400)), ("127.0.0.1", port))
                    sent += 1
                time.sleep(0.01)
        if run.poll() is None:
            run.kill()
        out, err = run.communicate()
assert run.returncode == 0, f"exit {run.returncode} after {sent} datagrams\n{out}\n{err}"
assert "landed" in out
print(f"flown under {sent} datagrams of garbage")
