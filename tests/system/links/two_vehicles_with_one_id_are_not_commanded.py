"""Two vehicles with one system id: both are named, nothing is sent to fly either of them, and the script halts."""

import flight

SCRIPT = flight.MISSION + """
v = pick { type 'UAV'; timeout 20.seconds }
execute v: there
message 'landed'
"""

field = flight.Field()
twins = [field.add(7), field.add(7)]
ended = field.fly(SCRIPT)
ended.expect(3, "two vehicles use system id 7", "give one of them another")
for twin in twins:
    address = "127.0.0.1:%d" % twin.link.port.getsockname()[1]
    ended.expect(3, address)
    assert not twin.was_told_to_fly(), twin.heard
    assert twin.uploads == 0, "a mission was uploaded to one of two"
assert "landed" not in ended.out
assert ended.report["outcome"] == "halted", ended
# On a busy machine the script may pick the first one some milliseconds before the second one is told from it.
if "START There and back" in ended.err:
    assert "two vehicles use system id 7" in ended.report["errors"][0]["message"], ended
else:
    assert "Could not find required vehicles!" in ended.report["errors"][0]["message"], ended
    ended.expect(3, "vehicle 7 is not heard, or shares its id")

# One of the two comes later, in mid-mission: the flying one is left alone, the script is told.
field = flight.Field(leg_time=3)
first = field.add(7)


def second_appears(now):
    if first.current >= 2 and len(field.copters) == 1:
        field.add(7)


ended = field.fly(SCRIPT, happens=second_appears)
ended.expect(3, "two vehicles use system id 7")
assert first.armed and first.current >= 2, "the first flies on with the mission that it holds"
assert not field.copters[1].was_told_to_fly(), field.copters[1].heard
print("both were named and neither commanded")
