"""`kill -9` of the ground process in mid-mission: the vehicle finishes the mission that it holds and lands at home."""

import pathlib
import subprocess
import tempfile
import time

from pymavlink import mavutil

import harness

SPEEDUP = 5
SCRIPT = """
v = pick { type 'UAV'; timeout 60.seconds }
execute v: mission {
  home location(41.1780, -8.5980, 90)
  takeOff location(41.1780, -8.5980, 110)
  move 60, 0
  returnHomeAndLand()
}
"""

port = harness.free_udp_port()
with tempfile.TemporaryDirectory() as folder:
    script = pathlib.Path(folder, "short.dolphin")
    script.write_text(SCRIPT)
    with harness.lapwing("sim", "--vehicles", "copter:1", "--out", f"udpout://127.0.0.1:{port}", "--speedup", str(SPEEDUP)):
        run = subprocess.Popen([harness.LAPWING, "run", str(script), "--link", f"udpin://127.0.0.1:{port}", "--speedup",
                                str(SPEEDUP)], stderr=subprocess.PIPE, text=True)
        harness.wait_until(
            lambda: run.poll() is None and " flies '" in run.stderr.readline(), 60,
            "the mission under way", pause=0)
        time.sleep(10 / SPEEDUP)
        run.kill()
        run.communicate()

        # Somebody else looks at the vehicle afterwards, on the port that the dead process has left.
        link = mavutil.mavlink_connection(f"udpin:127.0.0.1:{port}", source_system=254)
        seen = []

        def disarmed():
            beat = link.recv_match(type="HEARTBEAT", blocking=True, timeout=1)
            if beat is None:
                return False
            armed = bool(beat.base_mode & mavutil.mavlink.MAV_MODE_FLAG_SAFETY_ARMED)
            seen.append((beat.custom_mode, armed))
            return not armed

        harness.wait_until(disarmed, 90, "the copter landed and disarmed by itself", pause=0)
        assert seen[0] == (3, True), f"it was still flying its mission when we looked: {seen[:3]}"
print("the vehicle flew on, landed and disarmed")
