"""A survey drone surveys a car park by itself, with a simulated camera: an operator configures it, arms it, takes off and lets it explore; it flies
until there is nothing more to learn, says so, and comes home when told. What it has written is compared with what is true."""

import time

import survey
from drone import Drone, Operator, take_off

with Drone(decide='relies_on = ["vision", "mapper", "planner"]', processes=survey.tables()) as drone:
    operator = Operator(drone.port)
    operator.wait(lambda o: o.last, "the first heartbeat", 20)
    operator.command("Configure", Min=7, Des=9, Max=12)
    take_off(operator)
    began = time.monotonic()
    operator.command("Autonomous Explore")
    operator.wait_for_state("AutonomousExplore", 5)
    over = operator.wait_for_error("the survey is over", 150)
    took = time.monotonic() - began
    assert "nothing more to learn" in over, over
    highest = max(one["Relative Altitude"] or 0 for one in operator.heartbeats)
    assert highest < 12.6, highest
    operator.wait(lambda o: o.last["Occupancy Map"] and any(cell >= 0 for cell in o.last["Occupancy Map"]["Cells"]), "the map", 5)
    assert operator.last["State"] == "AutonomousExplore", "it waits there for a command"
    on_the_ground = survey.found_slots(drone.folder)["features"]
    operator.wait(lambda o: {one["id"] for one in o.slots} == {one["id"] for one in on_the_ground}, "the slots", 5)

    # A place of the lot, and one beyond it, by the planner's word.
    operator.command("Autonomous Move", X=0, Y=22)
    operator.wait_for_state("AutonomousMove", 5)
    operator.wait_for_state("Hover", 30)
    operator.command("Autonomous Move", X=0, Y=-9)
    operator.wait_for_state("DesiredLocationError", 10)

    operator.command("Land")
    operator.wait(lambda o: o.last["State"] == "Idle" and not o.last["Armed"], "it has landed", 60)
    operator.cut()

found = survey.found_slots(drone.folder)
told = survey.compare(found)
print(f"{took:.0f} s, coverage {found['survey']['coverage']:.3f}, {found['survey']['pictures']} pictures, {told}")
assert found["survey"]["is_over"] and found["survey"]["ending"] == "nothing more to learn", found["survey"]
assert found["survey"]["coverage"] > 0.95, found["survey"]
assert told["found"] >= 0.95 * told["true"], told
assert told["right"] >= 0.97 * told["found"], told
assert told["extra"] <= 1, told
assert all("age_s" in one["properties"] and one["properties"]["writer"] for one in found["features"])
