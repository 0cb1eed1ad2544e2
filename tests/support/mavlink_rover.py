"""A companion computer between a rover's autopilot and Lapwing: it passes MAVLink on, and tells what a laser would see among walls that
only it knows, as OBSTACLE_DISTANCE. Not a test itself."""

import contextlib
import math
import select
import socket
import threading
import time

from pymavlink.dialects.v20 import ardupilotmega as mavlink

import harness

REACH_M, SECTORS = 8.0, 72
HOLD, GUIDED, MANUAL = 4, 15, 0


def box(x0, y0, x1, y1):
    return [(x0, y0, x1, y0), (x1, y0, x1, y1), (x1, y1, x0, y1), (x0, y1, x0, y0)]


# Two rooms of 4 by 4 m behind each other, with a doorway of 1.2 m between them; the rover starts in the first, looking at it.
TWO_ROOMS = box(-1.5, -2.0, 6.5, 2.0) + [(2.5, -2.0, 2.5, -0.6), (2.5, 0.6, 2.5, 2.0)]
TWO_ROOMS_M2 = 32.0


def distance(walls, x, y, bearing):
    """To the nearest wall that way; infinite where there is none."""
    dx, dy, nearest = math.cos(bearing), math.sin(bearing), math.inf
    for x0, y0, x1, y1 in walls:
        ax, ay = x1 - x0, y1 - y0
        cross = dx * ay - dy * ax
        if abs(cross) < 1e-9:
            continue
        way = ((x0 - x) * ay - (y0 - y) * ax) / cross
        share = ((x0 - x) * dy - (y0 - y) * dx) / cross
        if way > 0 and 0 <= share <= 1:
            nearest = min(nearest, way)
    return nearest


class Companion:
    def __init__(self, autopilot_port: int, lapwing_port: int, walls=TWO_ROOMS, speedup: float = 1.0):
        self.walls, self.speedup, self.is_cut = walls, speedup, False
        self.mode, self.is_armed, self.texts, self.moments, self.nearest_m = None, False, [], [], math.inf
        self.pose = self.start = self.speed = self.turn_rate = None  # x north, y west, counterclockwise from north
        self._autopilot = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._autopilot.bind(("127.0.0.1", autopilot_port))
        self._there = None
        self._lapwing = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._lapwing.connect(("127.0.0.1", lapwing_port))
        # What made one ready, that nobody listens yet, may be told by a send in between: then there is nothing to read.
        self._lapwing.setblocking(False)
        self._reader = mavlink.MAVLink(None)
        self._reader.robust_parsing = True
        self._companion = mavlink.MAVLink(None, srcSystem=1, srcComponent=196)
        self._pilot = mavlink.MAVLink(None, srcSystem=250, srcComponent=1)
        self._ends = threading.Event()
        self._thread = threading.Thread(target=self._live, daemon=True)
        self._thread.start()

    def close(self):
        self._ends.set()
        self._thread.join()
        self._autopilot.close()
        self._lapwing.close()

    def pilot_sets_mode(self, number: int):
        message = self._pilot.command_long_encode(1, 1, mavlink.MAV_CMD_DO_SET_MODE, 0, 1, number, 0, 0, 0, 0, 0)
        self._autopilot.sendto(message.pack(self._pilot), self._there)

    def steers(self, speed_m_s: float, turn_rate_rad_s: float):
        """As a ground station that knows of no kill."""
        message = self._pilot.set_position_target_local_ned_encode(0, 1, 1, 8, 0x5C7, 0, 0, 0, speed_m_s, 0, 0, 0, 0, 0, 0, turn_rate_rad_s)
        self._autopilot.sendto(message.pack(self._pilot), self._there)

    def place(self):
        """Metres ahead and to the left of where it started, and how far it has turned."""
        x, y = self.pose[0] - self.start[0], self.pose[1] - self.start[1]
        c, s = math.cos(self.start[2]), math.sin(self.start[2])
        return x * c + y * s, y * c - x * s, self.pose[2] - self.start[2]

    # ---- its thread

    def _live(self):
        told = 0.0
        while not self._ends.is_set():
            for ready in select.select([self._autopilot, self._lapwing], [], [], 0.02 / self.speedup)[0]:
                with contextlib.suppress(ConnectionRefusedError, BlockingIOError):
                    if ready is self._autopilot:
                        data, self._there = ready.recvfrom(65536)
                        for message in self._reader.parse_buffer(data) or []:
                            self._hear(message)
                        if not self.is_cut:
                            self._lapwing.send(data)
                    else:
                        data = ready.recv(65536)
                        if self._there and not self.is_cut:
                            self._autopilot.sendto(data, self._there)
            if self.pose and time.monotonic() - told > 0.1 / self.speedup and not self.is_cut:
                told = time.monotonic()
                with contextlib.suppress(ConnectionRefusedError, BlockingIOError):
                    self._lapwing.send(self._ranges().pack(self._companion))
                self._companion.seq = (self._companion.seq + 1) % 256

    def _hear(self, message):
        if message.get_srcSystem() != 1 or message.get_srcComponent() != 1:
            return
        kind = message.get_type()
        if kind == "HEARTBEAT":
            self.mode, self.is_armed = message.custom_mode, bool(message.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)
        elif kind == "STATUSTEXT":
            self.texts.append(message.text)
        elif kind == "ATTITUDE":
            self.yaw, self.turn_rate = -message.yaw, -message.yawspeed
        elif kind == "LOCAL_POSITION_NED" and self.turn_rate is not None:
            self.pose = (message.x, -message.y, self.yaw)
            self.start = self.start or self.pose
            self.speed = math.hypot(message.vx, message.vy)
            self.moments.append((time.monotonic(), self.speed, self.turn_rate))

    def _ranges(self):
        x, y, yaw = self.place()
        distances = []
        for sector in range(SECTORS):  # clockwise
            metres = distance(self.walls, x, y, yaw - math.radians(sector * 360 / SECTORS))
            self.nearest_m = min(self.nearest_m, metres)
            distances.append(round(min(metres, REACH_M + 0.01) * 100))
        return self._companion.obstacle_distance_encode(time.monotonic_ns() // 1000, mavlink.MAV_DISTANCE_SENSOR_LASER, distances, 5, 10,
                                                        round(REACH_M * 100), 0, 0, mavlink.MAV_FRAME_BODY_FRD)


@contextlib.contextmanager
def companion(autopilot_port: int, speedup: float = 1.0):
    """(it, the port at which Lapwing listens)"""
    port = harness.free_udp_port()
    one = Companion(autopilot_port, port, speedup=speedup)
    try:
        yield one, port
    finally:
        one.close()
