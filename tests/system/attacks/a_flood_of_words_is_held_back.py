"""A script that prints without end, and a viewer that asks without end: what is too much is left out and counted, on standard output
and in the log; what others said stays in the history; an emergency stop and its line come through. A long table is printed whole."""

import pathlib
import re
import tempfile
import time

import ground
import harness

FLOOD = "while (true) { message 'again' }\n"
TABLE = "1.upto(30_000) { message \"row ${it}\" }\n"
COUNT = re.compile(r"(\d{1,3}(?:,\d{3})*) lines? left out")


def texts(station, source: str):
    return [line["text"] for line in station.get("/api/v1/log")["lines"] if line["source"] == source]


with tempfile.TemporaryDirectory() as folder:
    table = pathlib.Path(folder, "table.dolphin")
    table.write_text(TABLE)
    out, _ = harness.expect_exit(0, "run", str(table), "--link", f"udpin://127.0.0.1:{harness.free_udp_port()}")
    rows = [line for line in out.splitlines() if " row " in line]
    assert len(rows) == 30_000 and "left out" not in out, out[-200:]

    said = pathlib.Path(folder, "said.txt")
    with said.open("w") as file, ground.station(stdout=file) as station:
        before = {source: texts(station, source) for source in ("lapwing", "fleet", "station")}
        status, answer = station.post("/api/v1/script", {"name": "flood", "source": FLOOD})
        assert status == 202, answer
        time.sleep(3.0)
        began = time.monotonic()
        status, answer = station.post("/api/v1/emergency-stop")
        assert status in (200, 202), answer
        assert time.monotonic() - began < 2.0
        harness.wait_until(lambda: station.get("/api/v1/status")["script"]["state"] not in ("running", "stopping"), 10, "the script ends")
        harness.wait_until(lambda: COUNT.search(said.read_text()), 10, "how much was left out is said")
        lines = station.get("/api/v1/log")["lines"]
        assert any(line["level"] == "error" and "EMERGENCY STOP" in line["text"] for line in lines), lines[-5:]
        for source, those in before.items():
            now = texts(station, source)
            assert all(text in now for text in those), f"{source} lost {[text for text in those if text not in now]}"

        viewer = station.viewer()
        ping = b'{"type":"stop_script"}'
        frame = bytes([0x81, 0x80 | len(ping)]) + bytes(4) + ping
        for _ in range(60):
            viewer._socket.sendall(frame * 500)  # 30,000 lines of the station's log
            time.sleep(0.01)
        harness.wait_until(lambda: any(line["level"] == "error" and "EMERGENCY STOP" in line["text"]
                                       for line in station.get("/api/v1/log")["lines"]), 10, "the emergency stop stays in the history")
        kept = texts(station, "script")
        assert len(kept) > 100, "the script's words were pushed out by the viewer's"
        asked = sum("stop asked for by a viewer" in line for line in station.said)
        assert asked < 15_000, f"{asked} lines"
    words = said.read_text()
    left_out = sum(int(match.replace(",", "")) for match in COUNT.findall(words))
    assert left_out > 0 and len(words) < 4_000_000, f"{len(words)} bytes, {left_out} lines left out"
print(f"{len(words) / 1e6:.1f} MB printed, {left_out:,} lines left out")
