"""`lapwing run` flies a vehicle whose protocol side is pymavlink: its parser judges every frame that we send."""

import math

import copter
import flight

field = flight.Field(speedup=1, leg_time=0.3)
vehicle = field.add()
ended = field.fly("""
v = pick { type 'UAV'; timeout 20.seconds }
there = mission {
  name 'There and back'
  home location(41.1780, -8.5980, 90)
  takeOff location(41.1780, -8.5980, 110)
  move 60, 0
  move 0, 40
  returnHomeAndLand()
}
execute v: there
message 'landed'
""", "--timeout", "100")
ended.expect(0, "landed")
assert vehicle.uploads == 1, f"{vehicle.uploads} uploads"
commands = [item.command for item in vehicle.items]
assert commands == [16, 22, 16, 16, 21], f"items on the wire: {commands}"
north = math.radians(vehicle.items[2].x / 1e7 - copter.HOME[0]) * 6378137
assert abs(north - 60) < 1, f"move 60, 0 went {north} m north"
beats = vehicle.ground_heartbeats
assert len(beats) >= 3 and all(b - a < 1.6 for a, b in zip(beats, beats[1:])), f"heartbeats at {beats}"
assert ended.report["outcome"] == "done", ended
assert ended.report["vehicles"][0]["system_id"] == 7, ended
assert ended.missions()[0]["items"] == 5, ended
print(f"pymavlink parsed every frame of a mission of {len(commands)} items")
