"""Listing 3 of the report, its two misspelt names mended, over MAVLink: two copters survey their own areas until their own
batteries are low; the round ends when both have landed."""

import pathlib
import tempfile

import harness
import wire

LISTING = (harness.ROOT / "examples/listing3.dolphin").read_text()
MENDED = LISTING.replace("surveyAreaNorth", "surveyNorth").replace("surveyAreaSouth", "surveySouth")
HOME = "40.444233,-7.375234,820"
AUTO = 3


def first_auto(seen, vehicle):
    return next(i for i, one in enumerate(seen.seen) if one.vehicle == vehicle and not one.to_vehicle
                and one.message.get_type() == "HEARTBEAT" and one.message.custom_mode == AUTO)


def first_acknowledged(seen, vehicle):
    return next(i for i, one in enumerate(seen.seen) if one.vehicle == vehicle and not one.to_vehicle
                and one.message.get_type() == "MISSION_ACK" and one.message.type == 0)


with tempfile.TemporaryDirectory() as folder:
    script = pathlib.Path(folder, "listing3.dolphin")
    script.write_text(MENDED)

    seen, run = wire.flown(str(script), "copter:2", HOME, "--timeout", "1500")
    assert run.returncode == 3 and "time-out" in run.stderr, run.stderr
    for vehicle, north in ((1, 1), (2, -1)):
        survey, back = seen.missions(vehicle)
        # As many items as announced: home, take-off, entry, 21 legs with 20 laterals, return.
        counts = [one.message.count for one in seen.of(vehicle, "MISSION_COUNT")]
        assert set(counts) == {len(survey), len(back)} == {45, 2}, counts
        assert (survey[1].command, back[1].command) == (22, 21), (survey[1], back[1])
        assert (survey[3].x / 1e7 - survey[2].x / 1e7) * north > 0.02, (survey[2], survey[3])
        assert first_acknowledged(seen, vehicle) < first_auto(seen, vehicle)
    # Both fly at once.
    second_uploads = [[i for i, one in enumerate(seen.seen) if one.vehicle == vehicle and one.to_vehicle
                       and one.message.get_type() == "MISSION_COUNT"][-1] for vehicle in (1, 2)]
    assert max(first_auto(seen, 1), first_auto(seen, 2)) < min(second_uploads)

    # With one copter the second pick halts after its 30 s, before the first has moved.
    seen, run = wire.flown(str(script), "copter:1", HOME)
    assert run.returncode == 3 and "Could not find required vehicles!" in run.stderr, run.stderr
    assert not seen.missions(1)
print("two copters surveyed at once")
