"""`--record` keeps what pymavlink reads too; `replay` shows the same vehicles on the same tracks and sends nothing."""

import json
import pathlib
import tempfile

from pymavlink import mavutil

import harness

SCRIPT = """
v = pick { type 'UAV'; timeout 60.seconds }
execute v: mission {
  name 'Square'
  home location(41.178, -8.598, 90)
  takeOff location(41.178, -8.598, 110)
  move 40, 0
  move 0, 40
  returnHomeAndLand()
}
"""

with tempfile.TemporaryDirectory() as folder:
    script = pathlib.Path(folder, "square.dolphin")
    script.write_text(SCRIPT)
    kept = pathlib.Path(folder, "kept")
    report = pathlib.Path(folder, "report.json")
    harness.expect_exit(0, "run", str(script), "--sim", "copter:1", "--record", str(kept), "--report", str(report))
    (log,) = kept.glob("*.tlog")
    assert log.with_suffix(".dolphin").read_text() == SCRIPT
    assert json.loads(log.with_suffix(".json").read_text()) == json.loads(report.read_text())

    reader = mavutil.mavlink_connection(str(log))
    seen, last = {}, 0.0
    while message := reader.recv_match():
        assert message.get_type() != "BAD_DATA", message
        assert message._timestamp >= last - 0.001
        last = message._timestamp
        sender = (message.get_srcSystem(), message.get_type())
        seen[sender] = seen.get(sender, 0) + 1
    assert seen[(1, "GLOBAL_POSITION_INT")] > 100, seen
    assert seen[(255, "MISSION_ITEM_INT")] >= 5, seen
    assert seen[(1, "MISSION_ACK")] >= 1, seen

    replayed = pathlib.Path(folder, "replayed.json")
    out, err = harness.expect_exit(0, "replay", str(kept), "--headless", "--report", str(replayed))
    assert f"{sum(seen.values())} packets" in out, (out, sum(seen.values()))
    flown, shown = (json.loads(path.read_text())["vehicles"][0] for path in (report, replayed))
    assert abs(flown["track_m"] - shown["track_m"]) < 1, (flown["track_m"], shown["track_m"])
    assert shown["type"] == "copter"

    harness.expect_exit(2, "replay", folder, "--headless")
    harness.expect_exit(2, "replay", str(script), "--headless")
print("recordings are played back")
