"""The pilot changes the mode in mid-mission: the task fails with that reason and nothing is sent any more but requests for telemetry."""

import copter
import flight

SCRIPT = flight.MISSION + """
v = pick { type 'UAV'; timeout 20.seconds }
try {
  execute v: there
} catch (TaskError e) {
  message 'caught ' + e.message
  pause 10.seconds
  throw e
}
"""

field = flight.Field()
vehicle = field.add()


def pilot_switches(now):
    if vehicle.current >= 3 and vehicle.mode == copter.AUTO:
        vehicle.heard.clear()
        vehicle.pilot_sets_mode(copter.LOITER)


ended = field.fly(SCRIPT, happens=pilot_switches)
ended.expect(1, "caught", "mode changed to LOITER by operator")
telemetry = (copter.mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, copter.mavlink.MAV_CMD_GET_MESSAGE_INTERVAL,
             copter.mavlink.MAV_CMD_REQUEST_MESSAGE)  # is asked for again while it does not come, whoever flies
orders = [str(message) for message in vehicle.heard if getattr(message, "command", None) not in telemetry]
assert orders == [], orders
assert vehicle.mode == copter.LOITER and vehicle.armed
assert ended.missions()[0]["outcome"] == "failed", ended
print("the pilot kept the vehicle")
