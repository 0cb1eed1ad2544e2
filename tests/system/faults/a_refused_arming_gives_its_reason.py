"""A vehicle denies arming: the error has its own words, and its mode was not touched."""

import copter
import flight

SCRIPT = flight.MISSION + """
v = pick { type 'UAV'; timeout 20.seconds }
try {
  execute v: there
} catch (TaskError e) {
  message 'caught ' + e.message
}
execute v: there
"""

field = flight.Field()
vehicle = field.add()
vehicle.faults.arming_refusal = "Arm: Throttle too high"
ended = field.fly(SCRIPT)
ended.expect(1, "arming refused: Arm: Throttle too high")
assert "caught" in ended.out and "Throttle too high" in ended.out, ended
field.stay(5)
assert vehicle.uploads == 2 and not vehicle.armed, ended
assert vehicle.mode == copter.STABILIZE and vehicle.modes_commanded() == [], vehicle.modes_commanded()
assert [mission["outcome"] for mission in ended.missions()] == ["failed", "failed"], ended
assert "Throttle too high" in ended.missions()[0]["error"], ended
print("the vehicle's own reason was passed on")
