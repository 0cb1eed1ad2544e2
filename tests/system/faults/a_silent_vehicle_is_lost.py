"""A vehicle goes silent, in mid-upload and in mid-mission: the task fails as lost, `watch` hears of it, nothing hangs."""

import copter
import flight

PICK = "setConnectionTimeout 5.seconds\nv = pick { type 'UAV'; timeout 20.seconds }\n"
ONCE = flight.MISSION + PICK + "execute v: there\nmessage 'landed'\n"
WATCHED = flight.MISSION + PICK + """
execute watch there[v] onError { text -> message 'handler: ' + text; ignore() }
message 'connected: ' + connected(v)
w = pick { id '7'; timeout 60.seconds }
"""
RETURNS = flight.MISSION + PICK + """
execute watch there[v] onError { text -> message 'handler: ' + text; ignore() }
execute condition { connected(v) }
message 'back'
execute v: there
message 'landed'
"""


def in_upload():
    field = flight.Field()
    vehicle = field.add()
    vehicle.faults.silent_from_item = 2
    ended = field.fly(ONCE)
    ended.expect(3, "copter 7 lost: silent for 5 s")
    vehicle.faults.silent = False  # afterwards it is there again, and nobody flies it
    field.stay(10)
    assert not vehicle.was_told_to_fly() and not vehicle.armed, vehicle.heard


def in_flight(script, returns_after=None):
    field = flight.Field()
    vehicle = field.add()
    silent = []

    def cable_is_pulled(now):
        if vehicle.current >= 3 and not silent:
            vehicle.faults.silent = True
            silent.append(now)
        if returns_after and silent and now > silent[0] + returns_after:
            vehicle.faults.silent = False

    return vehicle, field.fly(script, happens=cable_is_pulled)


in_upload()

vehicle, ended = in_flight(ONCE)
ended.expect(3, "copter 7 lost: silent for 5 s")
assert "landed" not in ended.out
assert ended.report["outcome"] == "halted", ended
assert ended.missions()[0]["outcome"] == "failed", ended

vehicle, ended = in_flight(WATCHED)
ended.expect(3, "handler: ", "copter 7 lost: silent for 5 s", "connected: false", "Could not find required vehicles!")

vehicle, ended = in_flight(RETURNS, returns_after=12)
ended.expect(0, "handler: ", "copter 7 is back", "back", "landed")
assert [mission["outcome"] for mission in ended.missions()] == ["failed", "done"], ended
assert vehicle.uploads == 2 and not vehicle.armed, vehicle.uploads
print("lost in the upload, lost in flight, and taken back")
