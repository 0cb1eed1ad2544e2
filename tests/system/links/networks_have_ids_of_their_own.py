"""Two networks: a copter 7 in each, flown by one script; none of the two is taken for the other."""

import copter
import flight
import harness

SCRIPT = flight.MISSION + """
one = pick { type 'UAV'; timeout 20.seconds }
other = pick { type 'UAV'; timeout 20.seconds }
execute one: there, other: there
message 'both landed'
"""

field = flight.Field()
port = harness.free_udp_port()
near = field.add(7)
north = copter.Copter(port, 7, field.speedup, field.leg_time)
field.copters.append(north)
ended = field.fly(SCRIPT, "--link", f"north=udpin://127.0.0.1:{port}")
ended.expect(0, "both landed", "north/copter 7", "copter 7 found")
assert "two vehicles use" not in ended.err, ended
assert {vehicle["id"] for vehicle in ended.report["vehicles"]} == {"7", "north/7"}, ended.report
for each in (near, north):
    assert each.complete and each.uploads == 1, each.uploads
print("both flown, each in its network")
