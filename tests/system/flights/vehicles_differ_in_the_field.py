"""Vehicles that ask, answer and report differently are flown all the same: the language's wire cases through the program."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

import copter
import flight

SCRIPT = flight.MISSION + """
v = pick { type 'UAV'; timeout 20.seconds }
execute v: there
message 'landed'
"""


def fly(script=SCRIPT, prepare=lambda vehicle: None, happens=lambda vehicle, now: None, **faults):
    field = flight.Field()
    vehicle = field.add()
    for name, value in faults.items():
        setattr(vehicle.faults, name, value)
    prepare(vehicle)
    return vehicle, field.fly(script, happens=lambda now: happens(vehicle, now))


# 81: it asks with MISSION_REQUEST_INT only. 82: it loses requests and repeats them.
for faults in ({"only_request_int": True}, {"unsent_requests": {1, 4}}):
    vehicle, ended = fly(**faults)
    ended.expect(0, "landed")
    assert vehicle.uploads == 1 and len(vehicle.items) == flight.ITEMS, (faults, vehicle.uploads)

# 85: it is in RTL beforehand and takes its time: the task is not done before AUTO was entered and left.
vehicle, ended = fly(prepare=lambda vehicle: vehicle.pilot_sets_mode(copter.RTL), request_spacing=3.0)
ended.expect(0, "landed")
assert vehicle.complete and not vehicle.armed, "the program ended before the mission did"
assert ended.missions()[0]["upload_s"] > 3 * (flight.ITEMS - 1), ended.missions()

# 87: it lands, disarms and stays in AUTO, and has no word for the end of a mission. 91: AUTO of a copter is mode 3.
vehicle, ended = fly(reports_mission_state=False)
ended.expect(0, "landed")
assert vehicle.mode == copter.AUTO == 3 and not vehicle.armed, vehicle.mode


# 92: a gimbal of the same system has a mode of its own.
def gimbal_beats(vehicle, now):
    if int(now * 2) != vehicle.__dict__.setdefault("gimbal_beat", 0):
        vehicle.gimbal_beat = int(now * 2)
        vehicle.send_heartbeat_of(154, mavlink.MAV_TYPE_GIMBAL, mode=copter.STABILIZE)


vehicle, ended = fly(happens=gimbal_beats)
ended.expect(0, "landed")

# 89: it does not know its battery: every comparison is false, with one warning.
BATTERY = """
v = pick { type 'UAV'; timeout 20.seconds }
message 'low ' + (battery(v) < 0.3) + ', full ' + (battery(v) >= 0.9)
execute idle(3) / { battery(v) < 0.3 || battery(v) >= 0.9 }
message mode(v) + ' at ' + relativeHeight(v)
"""
vehicle, ended = fly(BATTERY, battery=-1)
ended.expect(0, "low false, full false", "STABILIZE at 0")
assert ended.err.count("the battery of vehicle 7 is not known") == 1, ended

# REC-21: the first report is waited for.
vehicle, ended = fly(BATTERY, battery=95)
ended.expect(0, "low false, full true")
assert "is not known" not in ended.err, ended

# It never reports: that is waited for once, up to the connection timeout.
vehicle, ended = fly("setConnectionTimeout 6.seconds\n" + BATTERY, reports_battery=False)
ended.expect(0, "low false, full false")
assert ended.err.count("the battery of vehicle 7 is not known") == 1, ended
print("every wire case was flown")
