"""`lapwing onboard` on a simulated copter: an operator in plain Python configures, arms, takes off, moves and lands it, over the framed link and
then in bare JSON; whatever is malformed or comes in the wrong state is answered. What flies loads no vision library."""

import json
import math
import pathlib
import subprocess

import harness
from drone import HOME, Drone, Operator, take_off

program = pathlib.Path(harness.LAPWING).parent / "lapwing-onboard"
libraries = subprocess.run(["ldd", program], capture_output=True, text=True, timeout=30, check=True).stdout
for heavy in ("opencv", "tesseract", "gdal", "gst", "onnx"):
    assert heavy not in libraries, [line for line in libraries.splitlines() if heavy in line]
assert "fastrtps" in libraries, libraries


def far_m(place: dict, x: float, y: float) -> float:
    return math.hypot(place["Local Position X"] - x, place["Local Position Y"] - y)


with Drone() as drone:
    operator = Operator(drone.port)
    operator.wait(lambda o: o.last.get("State") == "Idle" and o.last["Latitude"] is not None and o.last["Battery Percentage"], "a heartbeat in Idle", 40)
    assert abs(operator.last["Latitude"] - HOME[0]) < 1e-4 and abs(operator.last["Longitude"] - HOME[1]) < 1e-4, operator.last
    assert not operator.last["Armed"] and operator.last["Occupancy Map"] is None, operator.last

    # What is no command, or none now, is answered and changes nothing.
    for wrong, words in (("no json", "no JSON"), ('{"Type":"Fly"}', "there is no command 'Fly'"), ('{"Type":"Compulsive Move","X":1}', "Y"),
                         ("[]", "no JSON object"), ('{"Type":"Takeoff"}', "Takeoff is not taken in Idle")):
        operator.say(wrong)
        operator.wait_for_error(words)
    operator.command("Configure", Min=7, Des=25, Max=20)
    operator.wait_for_error("the heights are not taken")
    operator.wait(lambda o: o.last["User Error"] == 3, "Height_Params_Invalid")
    assert not (drone.folder / "state/hover-heights.toml").exists()

    operator.command("Configure", Min=7, Des=9, Max=20)
    operator.wait(lambda o: o.last["User Error"] == 0, "the heights are taken")
    harness.wait_until(lambda: (drone.folder / "state/hover-heights.toml").exists(), 5, "they are kept")

    take_off(operator)
    assert abs(operator.last["Relative Altitude"] - 9) < 1, operator.last
    assert operator.last["Ardupilot State"] == "GUIDED" and operator.last["Health Status"] == 0, operator.last

    operator.command("Compulsive Move", X=20, Y=10)
    operator.wait_for_state("CompulsiveMove", 5)
    there = operator.wait_for_state("Hover", 40)
    assert far_m(there, 20, 10) < 2, there
    # The same move by degrees, back over home.
    operator.command("CompulsiveMove", Lat=HOME[0], Long=HOME[1])
    operator.wait_for_state("CompulsiveMove", 5)
    there = operator.wait_for_state("Hover", 40)
    assert far_m(there, 0, 0) < 2 and abs(there["Relative Altitude"] - 9) < 1.5, there

    operator.command("Compulsive Move", X=50000, Y=0)
    operator.wait_for_error("Compulsive Move is refused")
    # Nobody plans yet: the move by the map ends by itself.
    operator.command("Autonomous Move", X=10, Y=0)
    operator.wait_for_state("AutonomousMove", 5)
    operator.wait_for_state("Hover", 10)

    operator.command("Land")
    operator.wait_for_state("Land", 5)
    operator.wait(lambda o: o.last["State"] == "Idle" and not o.last["Armed"], "it has landed", 60)
    health = drone.health()
    assert all(one["state"] == "running" and one["restarts"] == 0 for one in health.values()), health
    operator.cut()
    print(f"{len(operator.heartbeats)} heartbeats, {len(operator.errors)} messages")

# The next boot has the heights; old operators' programs speak bare JSON.
config = drone.config.read_text().replace('mode = "framed"', 'mode = "json"')
drone.config.write_text(config)
with drone:
    drone.wait_for_log("hover heights 7, 9 and 20 m")
    operator = Operator(drone.port, plain=True)
    operator.wait(lambda o: o.last.get("State") == "Idle", "a heartbeat in Idle")
    operator.say('}{"Type":"Disarm"}\n')
    operator.wait_for_error("what came is no message")
    operator.wait_for_error("Disarm is refused")
    # Two in one packet: the second waits for the first.
    operator.say('{"Type":"Configure","Min":7,"Des":8,"Max":20}{"Type":"Takeoff"}')
    operator.wait_for_error("Takeoff is not taken in Idle")
    operator.say('{"Type":"Nonsense"}')
    operator.wait_for_error("there is no command 'Nonsense'")
    operator.cut()

# Mistakes in the file, each with its place.
bad = drone.folder / "bad.toml"
bad.write_text('[bridge]\nlink = "nowhere"\n[operator]\nprot = 3000\n')
_, errors = harness.expect_exit(2, "onboard", "--config", str(bad))
for words in ("bad.toml:2:8", "nowhere", "prot", "did you mean", "onboard.md"):
    assert words in errors, (words, errors)
bad.write_text('[operator]\naddress = "0.0.0.0"\n[[process]]\nname = "decide"\n')
_, errors = harness.expect_exit(2, "onboard", "--config", str(bad), "--only", "decide")
assert "would let the whole network command the vehicle" in errors, errors
harness.expect_exit(2, "onboard")
assert json.loads((drone.folder / "health.json").read_text())["processes"][0]["state"] == "ended"
