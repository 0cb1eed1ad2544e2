"""A vehicle restarts in mid-mission: the task fails and says so; the vehicle can be flown again afterwards."""

import copter
import flight

PICK = "v = pick { type 'UAV'; timeout 20.seconds }\n"
ONCE = flight.MISSION + PICK + "execute v: there\nmessage 'landed'\n"
TWICE = flight.MISSION + PICK + """
execute watch there[v] onError { text -> message 'handler: ' + text; ignore() }
execute v: there
message 'landed'
"""


def reboot_in_flight(script, keeps_mission):
    field = flight.Field()
    vehicle = field.add()
    reboots = []

    def reboots_once(now):
        if vehicle.current >= 3 and vehicle.is_flying() and not reboots:
            vehicle.heard.clear()
            vehicle.reboot(now, keeps_mission)
            reboots.append(now)

    return field, vehicle, field.fly(script, happens=reboots_once)


for keeps_mission in (True, False):
    field, vehicle, ended = reboot_in_flight(ONCE, keeps_mission)
    ended.expect(3, "copter 7 restarted")
    assert "landed" not in ended.out
    field.stay(5)
    assert not vehicle.armed and vehicle.mode == copter.STABILIZE, (vehicle.armed, vehicle.mode)
    assert not vehicle.was_told_to_fly(), vehicle.heard
    assert ended.missions()[0]["outcome"] == "failed", ended

field, vehicle, ended = reboot_in_flight(TWICE, keeps_mission=False)
ended.expect(0, "handler: ", "copter 7 restarted", "landed")
assert [mission["outcome"] for mission in ended.missions()] == ["failed", "done"], ended
print("a restart ended the mission and nothing else")
