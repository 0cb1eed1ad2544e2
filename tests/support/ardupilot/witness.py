"""Who sees what an ArduPilot in the loop does, over a link of its own on which nobody is commanded. Not a test itself."""

import contextlib
import threading
import time

import harness
from ardupilot import in_the_loop
from mavlink_peer import Peer, mavlink

HAS_PLACE, IS_STILL_LOST, WOULD_ARM = 0x10, 0x80, 1 << 28
NEEDED = (mavlink.MAVLINK_MSG_ID_EKF_STATUS_REPORT, mavlink.MAVLINK_MSG_ID_SYS_STATUS)


class Witness:
    def __init__(self, port: int, system: int):
        self.system = system
        self.armed_at: float | None = None  # seconds of the calendar, when its own heartbeat first said so
        self.heartbeats, self._beats = 0, threading.Condition()
        self.ready = threading.Event()  # set when it has known where it is and would have armed
        self._located = self._would_arm = False
        self._peer = Peer(port, 254, 190, listens=True)
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._listen, daemon=True)
        self._thread.start()

    def close(self):
        self._ended.set()
        self._thread.join()
        self._peer.close()

    def hears(self, heartbeats: int):
        """Waits for so many more."""
        wanted = self.heartbeats + heartbeats
        with self._beats:
            assert self._beats.wait_for(lambda: self.heartbeats >= wanted, 30), f"vehicle {self.system} is silent"

    def _listen(self):
        while not self._ended.is_set():
            self._peer.listen(0.2)
            for message in self._peer.heard:
                if message.get_srcSystem() == self.system:
                    self._note(message)
            self._peer.heard, self._peer.raw = [], []

    def _note(self, message):
        kind = message.get_type()
        if kind == "HEARTBEAT" and message.autopilot == mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA:
            with self._beats:
                self.heartbeats += 1
                self._beats.notify_all()
            if self.armed_at is None and message.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED:
                self.armed_at = time.time()
            if not self.ready.is_set():
                for number in NEEDED:
                    self._peer.say(self._peer.mav.command_long_encode(self.system, 1, mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, 0, number,
                                                                      1_000_000, 0, 0, 0, 0, 0))
        elif kind == "EKF_STATUS_REPORT":
            self._located = bool(message.flags & HAS_PLACE) and not message.flags & IS_STILL_LOST
        elif kind == "SYS_STATUS":
            self._would_arm = bool(message.onboard_control_sensors_health & WOULD_ARM)
        if self._located and self._would_arm:
            self.ready.set()


# What a busy machine would add: the log's file, which takes so long to open that a rover's watch over its main loop disarms it;
# and a battery that ends within minutes.
PARAMETERS = ("LOG_BACKEND_TYPE=0", "BATT_CAPACITY=20000")


@contextlib.contextmanager
def witnessed(family: str, port: int, speedup: float, system: int = 1, parameters=(), **more):
    """The witness of one that sends to that port, once it knows where it is and would arm."""
    witness_port = harness.free_udp_port()
    witness = Witness(witness_port, system)
    try:
        with in_the_loop.started(family, port, speedup, system=system, parameters=(*PARAMETERS, *parameters),
                                 witness_port=witness_port, **more) as process:
            assert witness.ready.wait(180), f"{family} {system} is not ready to arm; it ended with exit code {process.poll()}"
            yield witness
    finally:
        witness.close()
