"""The examples are formatted, do what they promise in a dry run, and fly on the simulator over MAVLink."""

import harness

EXAMPLES = harness.ROOT / "examples"


def expect_lines(text: str, *words: str):
    """All of them, in this order."""
    at = 0
    for word in words:
        found = text.find(word, at)
        assert found >= 0, f"no {word!r} behind the first {at} characters of\n{text}"
        at = found + len(word)


def example(name: str, vehicles: str, *messages: str, exit_code: int = 0, flies: bool = True):
    script = str(EXAMPLES / f"{name}.dolphin")
    out, _ = harness.expect_exit(exit_code, "plan", script, "--vehicles", vehicles)
    expect_lines(out, *(f"Program message: {message}" for message in messages))
    if flies:
        out, _ = harness.expect_exit(exit_code, "run", script, "--sim", vehicles, seconds=280)
        expect_lines(out, *(f"Program message: {message}" for message in messages))


TURNS = [f"turn {n + 1}: copter {n % 2 + 1} is on station" for n in range(4)]

for name in ("survey", "relay", "patrol", "rover_and_drone", "error_handling", "car_park"):
    script = str(EXAMPLES / f"{name}.dolphin")
    harness.expect_exit(0, "fmt", "--check", script)
    out, _ = harness.expect_exit(0, "check", script)
    assert out.endswith("no mistakes found\n"), out
    if name == "car_park":
        continue  # dry runs know nothing of lots; a_script_surveys_a_car_park flies one
    out, _ = harness.expect_exit(0, "plan", script)  # the vehicles that it picks
    assert "still in the air" not in out, out

example("relay", "copter:2", *TURNS, "4 turns, and nobody missed the quarry")
example("patrol", "copter:2", "Back home: the watch is over")
example("patrol", "copter:1,copter:1@40%", "Back home: a battery is low", flies=False)
example("rover_and_drone", "copter:1,rover:1", "Sample 1 is taken", "Sample 2 is taken", "Sample 3 is taken", "3 samples are in")

# Each of the ways that error_handling.dolphin names at its top.
example("error_handling", "copter:2", "Both halves are surveyed", flies=False)
example("error_handling", "copter:1,copter:1@20%", "East half: ", "East half: tried again", "Both halves are surveyed")
example("error_handling", "copter:1", "One copter only", "Both halves are surveyed", flies=False)
example("error_handling", "copter:2@20%", "West half: ", "East half: ", exit_code=1)
print("the examples do what they promise")
