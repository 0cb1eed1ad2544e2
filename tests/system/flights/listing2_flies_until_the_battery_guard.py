"""Listing 2 of the report, word for word, over MAVLink: fly until the battery falls below 30 %, return, and again."""

import harness
import wire

LISTING = str(harness.ROOT / "examples/listing2.dolphin")
HOME = "40.444233,-7.375234,820"
AUTO = 3
SURVEY = [(16, 40.444233, -7.375234, 820), (22, 40.444233, -7.375234, 1200), (16, 40.4451294, -7.3728766, 1300),
          (17, 40.4469299, -7.3716984, 1280)]
RETURN = [(16, 40.444233, -7.375234, 820), (21, 40.444233, -7.375234, 820)]


def is_mission(items, expected):
    return len(items) == len(expected) and all(
        item.command == command and abs(item.x / 1e7 - lat) < 1e-5 and abs(item.y / 1e7 - lon) < 1e-5
        and abs(item.z - alt) < 0.05 for item, (command, lat, lon, alt) in zip(items, expected))


def battery_at_uploads(seen):
    """What the vehicle last said of its battery before each upload, in percent."""
    levels, level = [], None
    for one in seen.of(1, "SYS_STATUS", "BATTERY_STATUS", "MISSION_COUNT"):
        if one.to_vehicle:
            levels.append(level)
        else:
            level = one.message.battery_remaining
    return levels


# Somebody changes the battery a minute after each landing; the second round begins with a full one.
seen, run = wire.flown(LISTING, "copter:1", HOME, "--timeout", "1900", sim=("--swap-batteries", "60"))
assert run.returncode == 3 and "time-out" in run.stderr, run.stderr
missions = seen.missions(1)
assert len(missions) >= 3, (len(missions), run.stderr)
for number, items in enumerate(missions):
    assert is_mission(items, RETURN if number % 2 else SURVEY), (number, items)
assert missions[0][1].param1 == 15 and missions[0][2].param2 == 50 and missions[0][3].param3 == 50, missions[0]

# The guards: no survey below 90 %, and home as soon as it is less than 30 %.
levels = battery_at_uploads(seen)
assert levels[0] >= 90 and levels[2] >= 90, levels
assert 27 <= levels[1] <= 30, levels
assert AUTO in seen.modes(1), seen.modes(1)

# A battery that nobody changes keeps it on the ground: a dry run says so.
out, _ = harness.expect_exit(3, "plan", LISTING, "--timeout", "3000")
for words in ("waitFor {battery(v1) >= 0.9}", "every vehicle stands disarmed", "--swap-batteries"):
    assert words in out, out
out, _ = harness.expect_exit(3, "plan", LISTING, "--timeout", "3000", "--swap-batteries", "60")
assert out.count("Return to base  done") >= 2, out
print("two rounds were flown")
