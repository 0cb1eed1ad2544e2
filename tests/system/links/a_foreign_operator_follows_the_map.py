"""An operator's program in plain Python that asks for it gets the occupancy map whole, with a number, and then what changes, numbered on; it sees by the number that something is
missing and gets the whole map again when it asks. Who does not ask gets the whole map in each heartbeat, as the seed has it. By frames and in bare JSON. Every message is held against
the schema of the reference."""

import time

import harness
from drone import READY_S, Drone, Operator
from drone_faults.played_survey import NO_TURN, header
from ros_drone import RosDrone
from ros_robot import MapMetaData, OccupancyGrid, Point, Pose, Time
from schema import Schema

schema = Schema("operator-map.schema.json")
assert not schema.faults({"Type": "Map", "Send": "Changes"})
assert schema.faults({"Type": "Map", "Send": "Poems"}) and schema.faults({"Type": "Map Changes", "Revision": 2, "Since": 1, "Changes": [[1, 101]]})


class Mapper:
    """Whoever tells maps on the bus."""

    def __init__(self, ros: RosDrone):
        ros.wait(lambda r: r.home, "home is known", READY_S)
        self._home, self._maps = ros.home.position, ros.writer("/occupancy_map", OccupancyGrid)

    def tell(self, columns: int, cells: list[int], *operators: Operator) -> None:
        """Again until all of them have it: who has just come to the bus may miss the first."""
        info = MapMetaData(Time(0, 0), 0.5, columns, len(cells) // columns, Pose(Point(self._home.x - 1, self._home.y + 2, 0.0), NO_TURN))

        def is_known() -> bool:
            self._maps.write(OccupancyGrid(header(), info, cells))
            time.sleep(0.2)
            return all(shown_to(one) == cells for one in operators)

        harness.wait_until(is_known, 20, f"the map {cells} is known: {[shown_to(one) for one in operators]}")


def shown_to(operator: Operator) -> list[int] | None:
    shown = operator.map if operator.map_messages else operator.last.get("Occupancy Map")
    return shown and shown["Cells"]


def check(messages: list[dict]) -> None:
    for one in messages:
        faults = schema.faults(one, "map" if one["Type"] == "Map" else "changes")
        assert not faults, (faults, one)
        if one["Type"] == "Map":
            assert len(one["Cells"]) == one["Columns"] * one["Rows"], one


with Drone() as drone:
    mapper = Mapper(RosDrone(drone.domain))
    seed, follower = Operator(drone.port, name="seed"), Operator(drone.port, name="follower")
    follower.follow_map()
    mapper.tell(3, [0, 100, -1, 50, 0, 0], seed, follower)
    first = follower.map_messages[0]
    assert first == {"Type": "Map", "Revision": first["Revision"], "Columns": 3, "Rows": 2, "Resolution": 0.5, "Origin X": first["Origin X"],
                     "Origin Y": first["Origin Y"], "Cells": [0, 100, -1, 50, 0, 0]}, first
    assert abs(first["Origin X"] + 1) < 0.01 and abs(first["Origin Y"] - 2) < 0.01, first
    assert follower.last["Occupancy Map"] is None and not seed.map_messages

    mapper.tell(3, [0, 100, 30, 50, 0, 0], seed, follower)
    assert follower.map_messages[1] == {"Type": "Map Changes", "Revision": first["Revision"] + 1, "Since": first["Revision"], "Changes": [[2, 30]]}, follower.map_messages
    known = len(follower.heartbeats)
    follower.wait(lambda o: len(o.heartbeats) > known + 3, "time passes")
    assert len(follower.map_messages) == 2, "of what does not change nothing is told"
    assert all(one["Occupancy Map"] is None for one in follower.heartbeats[known:])

    # As if a message had not come: the next one does not follow what is there.
    follower.map["Revision"] -= 1
    mapper.tell(3, [0, 100, 30, 50, 0, 99], seed, follower)
    assert follower.misses == 1 and [one["Type"] for one in follower.map_messages[2:]] == ["Map Changes", "Map"], follower.map_messages[2:]
    mapper.tell(3, [1, 100, 30, 50, 0, 98], seed, follower)
    assert follower.map_messages[-1]["Changes"] == [[0, 1], [5, 98]], follower.map_messages[-1]
    # One of another shape is told whole.
    mapper.tell(2, [5, 6, 7, 8], seed, follower)
    assert follower.map_messages[-1]["Type"] == "Map" and follower.misses == 1

    follower.command("Map", Send="Poems")
    follower.wait_for_error("a Map is asked for with Send")
    # It holds for one connection, and until the other is asked for.
    follower.command("Map", Send="Heartbeat")
    follower.wait(lambda o: o.last["Occupancy Map"] and o.last["Occupancy Map"]["Cells"] == [5, 6, 7, 8], "the map in heartbeats", 5)
    follower.follow_map()
    follower.wait(lambda o: o.last["Occupancy Map"] is None, "and beside them", 5)
    follower.cut()
    follower.connect()
    follower.wait(lambda o: o.last["Occupancy Map"] is not None, "a new connection begins as the seed has it", 5)
    check(follower.map_messages)
    print([one["Type"] for one in follower.map_messages])
    seed.cut()
    follower.cut()

# Old programs' way: one JSON object after the other.
drone.config.write_text(drone.config.read_text().replace('mode = "framed"', 'mode = "json"'))
with drone:
    mapper = Mapper(RosDrone(drone.domain))
    plain = Operator(drone.port, plain=True)
    mapper.tell(3, [0, 100, -1], plain)
    assert not plain.map_messages
    plain.follow_map()
    plain.wait(lambda o: o.map and o.map["Cells"] == [0, 100, -1], "the whole map", 5)
    mapper.tell(3, [0, 100, 7], plain)
    assert plain.map_messages[-1]["Changes"] == [[2, 7]], plain.map_messages
    assert plain.last["Occupancy Map"] is None
    check(plain.map_messages)
    plain.cut()
