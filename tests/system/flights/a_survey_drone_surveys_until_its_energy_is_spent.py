"""A survey drone with a small battery and more ground than that lasts for: what flying draws is learned on the way, the planner is told how long there is to fly, and the survey
ends by itself, for want of energy. The drone is over home with more than its reserve, not pulled home out of the survey; nobody commands it, and it lands when the reserve is
reached."""

import json
import math
import sys

import harness
import survey
from drone import IS_ARDUPILOT, Drone, Operator, take_off
from ros_drone import Float64, RosDrone

if IS_ARDUPILOT:
    print("skipped: its battery is the simulated copter's, small and told by how fast it empties")
    sys.exit(harness.SKIPPED)

# Some five minutes of flying on a full battery, of which a fifth is left above the reserve. Most of the area is grass without a slot.
VEHICLE, BATTERY = "copter:1@36%", ("--battery-mah", "1500")
LEAST_RESERVE = 0.15  # docs/reference/operation-states.md
area = [survey.on_globe(*corner) for corner in ((-60, 11), (60, 11), (60, 90), (-60, 90))]
tables = survey.tables(survey="lot_lost_s = 3600").replace(json.dumps(survey.AREA), json.dumps(area))

with Drone(decide='relies_on = ["vision", "mapper", "planner"]', processes=tables, vehicle=VEHICLE, simulator=BATTERY) as drone:
    ros = RosDrone(drone.domain)
    left = ros.reader("/flying_time_left", Float64)
    times = []

    def hear() -> list[float]:
        times.extend(one.data for one in left.take(100) if isinstance(one, Float64))
        return times

    operator = Operator(drone.port)
    take_off(operator)
    operator.command("Autonomous Explore")
    operator.wait_for_state("AutonomousExplore", 5)
    operator.wait(lambda _: hear(), "it is known what flying draws", 60)
    began = len(operator.heartbeats)

    def far_m(heartbeat: dict) -> float:
        return math.hypot(heartbeat["Local Position X"], heartbeat["Local Position Y"])

    over = operator.wait_for_error("the survey is over", 100)
    assert "energy" in over, over
    turned = operator.last
    operator.wait(lambda o: far_m(o.last) < 2, "it is over home", 40)
    home = operator.last
    assert home["State"] == "AutonomousExplore", "by its planner, and not because the battery is low"
    assert home["Battery Percentage"] > LEAST_RESERVE, home
    assert not any("the battery has" in one for one in operator.errors), operator.errors
    operator.wait_for_state("Land", 60)
    operator.wait_for_error("and the way home and the landing need")
    operator.wait(lambda o: o.last["State"] == "Idle" and not o.last["Armed"], "it has landed", 60)
    assert far_m(operator.last) < 3 and operator.last["Battery Percentage"] > 0.02, operator.last
    operator.cut()
    farthest = max(far_m(one) for one in operator.heartbeats[began:])
    print(f"turned {far_m(turned):.0f} m from home (farthest {farthest:.0f} m) with {turned['Battery Percentage']:.2f}, over home with {home['Battery Percentage']:.2f}, "
          f"landed with {operator.last['Battery Percentage']:.2f}; first told {times[0]:.0f} s, last {hear()[-1]:.0f} s")
    assert far_m(turned) > 10, "the survey was far from home when it ended"
    # What it was told goes down to nothing over home.
    assert times[0] > 20 and hear()[-1] < 5, (times[0], times[-1])
