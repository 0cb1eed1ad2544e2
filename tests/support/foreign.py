"""Another ground station, that rides along with Lapwing on `--forward`. Not a test itself."""

import harness
from mavlink_peer import Peer, mavlink


class Foreign(Peer):
    def __init__(self):
        self.port = harness.free_udp_port()
        super().__init__(self.port, 254, 190, listens=True)

    @property
    def forward(self) -> tuple[str, str]:
        return "--forward", f"udpout://127.0.0.1:{self.port}"

    def upload(self, items):
        self.say(self.mav.mission_count_encode(1, 1, len(items)))
        for wanted in range(len(items)):
            self.hears(lambda m, seq=wanted: m.get_type() in ("MISSION_REQUEST", "MISSION_REQUEST_INT") and m.seq == seq,
                       what=f"the request for item {wanted}")
            self.say(items[wanted])
        self.hears_type("MISSION_ACK")

    def point(self, seq, command, lat, lon, alt):
        return self.mav.mission_item_int_encode(1, 1, seq, 0, command, 0, 1, 0, 0, 0, 0, round(lat * 1e7), round(lon * 1e7), alt)

    def waypoints(self, *places):
        """Home and those places, as items."""
        return [self.point(seq, mavlink.MAV_CMD_NAV_WAYPOINT, *place) for seq, place in enumerate(places)]

    def skip_to(self, item):
        self.say(self.mav.command_long_encode(1, 1, mavlink.MAV_CMD_DO_SET_MISSION_CURRENT, 0, item, 0, 0, 0, 0, 0, 0))

    def set_parameter(self, name, value):
        """Again until the vehicle says that it has it."""
        def has_it():
            self.say(self.mav.param_set_encode(1, 1, name.encode(), value, mavlink.MAV_PARAM_TYPE_REAL32))
            self.listen(0.3)
            return any(m.get_type() == "PARAM_VALUE" and m.param_id == name and m.param_value == value for m in self.heard)

        self.heard.clear()
        self.hears_type("HEARTBEAT", 1)
        harness.wait_until(has_it, 15, f"{name} is {value}", pause=0)

    def waits_for_item(self, number, seconds=90):
        self.hears(lambda m: m.get_type() == "MISSION_CURRENT" and m.seq == number, seconds, f"item {number}")
        self.heard.clear()
