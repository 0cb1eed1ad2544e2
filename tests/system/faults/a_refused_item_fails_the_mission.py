"""A vehicle NACKs a mission: the error names the item and the vehicle's reason, and nothing is armed or started."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

import copter
import flight

SCRIPT = flight.MISSION + """
v = pick { type 'UAV'; timeout 20.seconds }
execute v: there
message 'landed'
"""


def refuse(words, **faults):
    field = flight.Field()
    vehicle = field.add()
    for name, value in faults.items():
        setattr(vehicle.faults, name, value)
    ended = field.fly(SCRIPT)
    ended.expect(1, *words)
    field.stay(5)
    assert not vehicle.armed and vehicle.mode == copter.STABILIZE, (vehicle.armed, vehicle.mode)
    assert not vehicle.was_told_to_fly(), vehicle.heard
    assert "landed" not in ended.out
    error = ended.report["errors"][0]
    assert ended.report["outcome"] == "error" and error["file"].endswith("script.dolphin"), ended
    assert error["line"] == SCRIPT.split("\n").index("execute v: there") + 1, ended
    for word in words:
        assert word in error["message"], ended
    assert ended.missions()[0]["outcome"] == "failed", ended


refuse(["item 3", "command not supported"], refused_item=3)
refuse([f"item {flight.ITEMS - 1}", "command not supported"], refused_mission=True)
refuse(["item 2", "no space"], refused_item=2, refusal=mavlink.MAV_MISSION_NO_SPACE)
print("three refusals were explained")
