"""Listing 1 of the report, word for word: three underwater vehicles each get one of three plans that were drawn elsewhere,
at once, over MAVLink."""

import pathlib
import tempfile

import harness
import wire

LISTING = harness.ROOT / "examples/listing1.dolphin"
HOME = "38.43462,-8.86118,0"
AUTO = 3


def plan(east: float) -> str:
    """Three places, three metres under water."""
    places = [(38.4350, -8.86118 + east), (38.4353, -8.86118 + east), (38.43462, -8.86118 + east)]
    rows = ["0\t1\t0\t16\t0\t0\t0\t0\t38.43462\t-8.86118\t0\t1"]
    rows += [f"{number}\t0\t0\t16\t0\t0\t0\t0\t{lat}\t{lon}\t-3\t1" for number, (lat, lon) in enumerate(places, 1)]
    return "\n".join(["QGC WPL 110", *rows, ""])


def payload(vehicles: int):
    return [word for number in range(1, vehicles + 1) for word in ("--payload", f"{number}=Sidescan")]


with tempfile.TemporaryDirectory() as folder:
    for number in (1, 2, 3):
        pathlib.Path(folder, f"survey{number}.waypoints").write_text(plan(number * 0.0002))

    seen, run = wire.flown(str(LISTING), "sub:3", HOME, "--plans", folder, "--timeout", "1500", *payload(3))
    assert run.returncode == 0, run.stderr
    assert run.stdout == "Program message: Done!\n", run.stdout
    flown = []
    for vehicle in (1, 2, 3):
        # Home, some centimetres off, and three places each, three metres down.
        (items,) = seen.missions(vehicle)
        assert [item.command for item in items] == [16, 16, 16, 16], items
        assert abs(items[0].z) < 0.5 and [round(item.z, 2) for item in items[1:]] == [-3, -3, -3], items
        assert AUTO in seen.modes(vehicle), seen.modes(vehicle)
        flown.append(round((items[1].y / 1e7 + 8.86118) / 0.0002, 2))
    # Each plan to the vehicle that was nearest to it, so each to one.
    assert sorted(flown) == [1, 2, 3], flown
    # All three are under way at once.
    under_way = [next(i for i, one in enumerate(seen.seen) if one.vehicle == vehicle and not one.to_vehicle
                      and one.message.get_type() == "HEARTBEAT" and one.message.custom_mode == AUTO)
                 for vehicle in (1, 2, 3)]
    ended = [max(i for i, one in enumerate(seen.seen) if one.vehicle == vehicle and one.to_vehicle) for vehicle in (1, 2, 3)]
    assert max(under_way) < min(ended), (under_way, ended)

    # Without side scans, with too few vehicles, or somewhere else the program halts at once: it asks for no waiting.
    for vehicles, equipment, home in ((3, payload(2), HOME), (2, payload(2), HOME), (3, payload(3), "38.5,-8.86118,0")):
        seen, run = wire.flown(str(LISTING), f"sub:{vehicles}", home, "--plans", folder, *equipment)
        assert run.returncode == 3 and "Could not find required vehicles!" in run.stderr, run.stderr
        assert not any(seen.missions(vehicle) for vehicle in range(1, vehicles + 1))

    # The same within one program, which takes place, vehicles' equipment and the place from the script.
    out, _ = harness.expect_exit(0, "run", str(LISTING), "--sim", "sub:3", "--plans", folder)
    assert out == "Program message: Done!\n", out
    out, _ = harness.expect_exit(0, "plan", str(LISTING), "--plans", folder)
    assert "sub 3" in out and "Done!" in out, out
print("three plans were surveyed by three subs")
