"""The simulator is stopped: within 3.5 s every viewer is told that its vehicles are silent, since when, and with what severity;
one acknowledges it, all hear of that; when it goes on the alarm goes. Thirty silent vehicles are no thirty lines in the log."""

import json
import signal
import subprocess
import threading
import time
import urllib.request

import harness
import map_client

VEHICLES = 30


def silent(message):
    return [alarm for alarm in message["alarms"] if alarm["kind"] == "silent"]


port = harness.free_udp_port()
command = [harness.LAPWING, "station", "--link", f"udpin://127.0.0.1:{port}", "--port", "0"]
process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
try:
    address = map_client.address_in(map_client.said_before_listening(process))
    said = []
    reader = threading.Thread(target=lambda: said.extend(process.stderr))  # or the station waits for somebody to read
    reader.start()
    sim = ("sim", "--vehicles", f"copter:{VEHICLES}", "--out", f"udpout://127.0.0.1:{port}")
    with harness.lapwing(*sim) as simulator:
        first, second = map_client.Viewer(address), map_client.Viewer(address)
        known = set()
        first.wait_for("vehicles", lambda m: known.update(v["id"] for v in m["vehicles"]) or len(known) == VEHICLES, 30)
        time.sleep(2)  # telemetry flows: what is heard now comes several times a second

        simulator.send_signal(signal.SIGSTOP)
        stopped = time.monotonic()
        told = first.wait_for("alarms", lambda m: len(silent(m)) == VEHICLES, 10)
        took = time.monotonic() - stopped
        assert took < 3.5, f"{took:.2f} s"
        alarm = silent(told)[0]
        assert alarm["severity"] == "warning" and "silent" in alarm["text"] and 2 < alarm["age_s"] < 4, alarm
        second.wait_for("alarms", lambda m: len(silent(m)) == VEHICLES, 5)
        with urllib.request.urlopen(f"{address}/api/v1/vehicles", timeout=10) as answer:
            for vehicle in json.load(answer)["vehicles"]:
                assert vehicle["silent"] and vehicle["age_s"]["silent"] > 2, vehicle
                assert vehicle["connection"] == "ok", "to scripts it is lost after their time-out"
                assert all("loss" not in link for link in vehicle["links"]), vehicle["links"]

        second.send({"type": "acknowledge_alarms", "id": "a", "numbers": [alarm["number"]]})
        seen = first.wait_for("alarms", lambda m: any("acknowledged_by" in a for a in m["alarms"]), 5)
        assert [a["number"] for a in seen["alarms"] if "acknowledged_by" in a] == [alarm["number"]], seen

        simulator.send_signal(signal.SIGCONT)
        first.wait_for("alarms", lambda m: not m["alarms"], 5)
finally:
    process.send_signal(signal.SIGINT)
    process.wait(timeout=20)
    reader.join()
lines = [line for line in said if "silent" in line]
assert 1 <= len(lines) <= 4, lines
assert any("vehicles silent: copter" in line for line in lines), lines
print(f"told within {took:.2f} s, acknowledged, and over")
