"""Scripts fly on simulated PX4 vehicles as they do on ArduPilot's, alone and side by side."""

import harness


def fly(name: str, vehicles: str, *messages: str, options=()):
    script = str(harness.ROOT / "examples" / f"{name}.dolphin")
    out, err = harness.expect_exit(0, "run", script, "--sim", vehicles, *options, seconds=200)
    for message in messages:
        assert f"Program message: {message}" in out, f"no {message!r} in\n{out}\n{err}"
    assert "Armed by external command" in out + err, "no PX4 vehicle took part"


fly("survey", "px4:2,px4-rover:1")
fly("patrol", "px4:1,copter:1", "Back home: the watch is over")
fly("rover_and_drone", "px4:1,px4-rover:1", "Sample 3 is taken", "3 samples are in")
fly("error_handling", "px4:2", "Both halves are surveyed")
fly("relay", "px4:2", "4 turns, and nobody missed the quarry", options=("--swap-batteries", "30"))
# Over a bad link.
fly("patrol", "px4:1,copter:1", "Back home: the watch is over", options=("--loss", "0.1", "--delay", "0.1", "--seed", "3"))
print("PX4 vehicles fly the examples")
