"""A MAVLink speaker on one UDP socket, packed and read by pymavlink. Not a test itself."""

import select
import socket
import time

from pymavlink.dialects.v20 import ardupilotmega as mavlink


class Peer:
    """Speaks to `port` as (system, component) and keeps what it hears: `heard` in pymavlink's messages, `raw` as it came."""

    def __init__(self, port: int, system: int, component: int = 1, listens: bool = False):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)
        self.socket.bind(("127.0.0.1", port if listens else 0))
        self.there = None if listens else ("127.0.0.1", port)
        self.mav = mavlink.MAVLink(None, srcSystem=system, srcComponent=component)
        self.mav.robust_parsing = True
        self.heard, self.raw = [], []

    def say(self, message) -> bytes:
        packet = message.pack(self.mav)
        self.mav.seq = (self.mav.seq + 1) % 256
        self.say_bytes(packet)
        return packet

    def say_bytes(self, data: bytes):
        self.socket.sendto(data, self.there)

    def heartbeat(self, kind=mavlink.MAV_TYPE_QUADROTOR):
        return self.say(self.mav.heartbeat_encode(kind, mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA, 0, 0, 4))

    def listen(self, seconds: float = 0.0) -> bool:
        """Takes what has arrived, or waits for one datagram so long; False when nothing came."""
        if not select.select([self.socket], [], [], seconds)[0]:
            return False
        data, self.there = self.socket.recvfrom(65536)
        self.raw.append(data)
        self.heard += self.mav.parse_buffer(data) or []
        return True

    def hears(self, wanted, seconds: float = 10.0, what: str = "a message"):
        """The first message that `wanted` is true of; those before it are left in `heard`."""
        deadline = time.monotonic() + seconds
        at = 0
        while True:
            for message in self.heard[at:]:
                if wanted(message):
                    return message
            at = len(self.heard)
            if not self.listen(max(0.0, deadline - time.monotonic())):
                raise AssertionError(f"system {self.mav.srcSystem} did not hear {what} within {seconds} s; "
                                     f"it heard {[m.get_type() for m in self.heard][-20:]}")

    def hears_type(self, kind: str, system: int | None = None, seconds: float = 10.0):
        return self.hears(lambda m: m.get_type() == kind and system in (None, m.get_srcSystem()), seconds, f"{kind} of {system}")

    def forget(self):
        while self.listen():
            pass
        self.heard, self.raw = [], []

    def close(self):
        self.socket.close()
