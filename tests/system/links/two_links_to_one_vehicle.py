"""A vehicle on WiFi and on a radio is one vehicle; when the link in use falls silent in mid-mission that mission goes on,
and the next one comes over the other."""

import copter
import flight
import harness
from pymavlink import mavutil

SCRIPT = flight.MISSION + """
v = pick { type 'UAV'; timeout 20.seconds }
execute v: there
execute v: there
message 'landed twice'
"""


class Both:
    """Every `..._send` goes to each of the links, with each link's own sequence, as autopilots do it."""

    def __init__(self, mavs: list):
        self.mavs = mavs

    def __getattr__(self, name: str):
        return lambda *arguments: [getattr(mav, name)(*arguments) for mav in self.mavs]


class CopterOnTwoLinks(copter.Copter):
    def __init__(self, ports: list[int], **named):
        self.radio_port, self.has_wifi, self.on_radio = ports[1], True, 0
        super().__init__(ports[0], **named)

    def power_on(self, now: float):
        super().power_on(now)
        self.radio = mavutil.mavlink_connection(f"udpout:127.0.0.1:{self.radio_port}", source_system=self.system_id,
                                                source_component=1, dialect="ardupilotmega")
        self.radio.mav.seq = 100

    @property
    def mav(self):
        return Both([self.radio.mav] + ([self.link.mav] if self.has_wifi else []))

    def step(self, now: float):
        while (message := self.radio.recv_match(blocking=False)) is not None:
            self.on_radio += message.get_type() not in ("HEARTBEAT", "TIMESYNC", "BAD_DATA")
            self.receive(message, now)
        if self.has_wifi:
            super().step(now)
        else:
            self.live(now)


field = flight.Field()
radio_port = harness.free_udp_port()
twice = CopterOnTwoLinks([field.port, radio_port], speedup=field.speedup, leg_time=3.0)
field.copters.append(twice)


def wifi_ends(now):
    if twice.current >= 2 and twice.has_wifi:
        twice.has_wifi, twice.on_radio = False, 0


ended = field.fly(SCRIPT, "--link", f"udpin://127.0.0.1:{radio_port}", happens=wifi_ends)
ended.expect(0, "landed twice")
assert "two vehicles" not in ended.err, ended
assert "restarted" not in ended.err, ended
assert not twice.has_wifi and twice.complete
assert twice.uploads == 2, f"{twice.uploads} uploads"
assert twice.on_radio >= flight.ITEMS, "the second mission came over the radio"
print("one vehicle on two links, flown on over the second")
