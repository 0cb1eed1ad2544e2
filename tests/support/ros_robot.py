"""A robot that ROS 2 drives, on a foreign middleware (Cyclone DDS): a disc with a laser in a room, which drives as cmd_vel says. Not a
test itself."""

import math
import os
import tempfile
import threading
import time
from dataclasses import dataclass

# Loopback alone, whether or not it does multicast; packets as large as it takes.
_CONFIGURATION = """<CycloneDDS><Domain id="any"><General><Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces>
<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>
<MaxAutoParticipantIndex>15</MaxAutoParticipantIndex><Peers><Peer address="127.0.0.1"/></Peers></Discovery></Domain></CycloneDDS>"""
with tempfile.NamedTemporaryFile("w", suffix=".xml", delete=False) as _file:
    _file.write(_CONFIGURATION)
os.environ["CYCLONEDDS_URI"] = f"file://{_file.name}"

from cyclonedds.core import Policy, Qos  # noqa: E402  (reads its configuration when it is imported)
from cyclonedds.domain import DomainParticipant  # noqa: E402
from cyclonedds.idl import IdlStruct  # noqa: E402
from cyclonedds.idl.types import array, float32, float64, int8, int32, sequence, uint8, uint32  # noqa: E402
from cyclonedds.pub import DataWriter  # noqa: E402
from cyclonedds.sub import DataReader  # noqa: E402
from cyclonedds.topic import Topic  # noqa: E402
from cyclonedds.util import duration  # noqa: E402


def message(package: str, name: str):
    """Its type's name is the one that ROS 2 makes."""
    return {"typename": f"{package}::msg::dds_::{name}_"}


@dataclass
class Time(IdlStruct, **message("builtin_interfaces", "Time")):
    sec: int32
    nanosec: uint32


@dataclass
class Header(IdlStruct, **message("std_msgs", "Header")):
    stamp: Time
    frame_id: str


@dataclass
class Vector3(IdlStruct, **message("geometry_msgs", "Vector3")):
    x: float64
    y: float64
    z: float64


@dataclass
class Point(IdlStruct, **message("geometry_msgs", "Point")):
    x: float64
    y: float64
    z: float64


@dataclass
class Quaternion(IdlStruct, **message("geometry_msgs", "Quaternion")):
    x: float64
    y: float64
    z: float64
    w: float64


@dataclass
class Pose(IdlStruct, **message("geometry_msgs", "Pose")):
    position: Point
    orientation: Quaternion


@dataclass
class PoseWithCovariance(IdlStruct, **message("geometry_msgs", "PoseWithCovariance")):
    pose: Pose
    covariance: array[float64, 36]


@dataclass
class Twist(IdlStruct, **message("geometry_msgs", "Twist")):
    linear: Vector3
    angular: Vector3


@dataclass
class TwistStamped(IdlStruct, **message("geometry_msgs", "TwistStamped")):
    header: Header
    twist: Twist


@dataclass
class TwistWithCovariance(IdlStruct, **message("geometry_msgs", "TwistWithCovariance")):
    twist: Twist
    covariance: array[float64, 36]


@dataclass
class Transform(IdlStruct, **message("geometry_msgs", "Transform")):
    translation: Vector3
    rotation: Quaternion


@dataclass
class TransformStamped(IdlStruct, **message("geometry_msgs", "TransformStamped")):
    header: Header
    child_frame_id: str
    transform: Transform


@dataclass
class TFMessage(IdlStruct, **message("tf2_msgs", "TFMessage")):
    transforms: sequence[TransformStamped]


@dataclass
class Odometry(IdlStruct, **message("nav_msgs", "Odometry")):
    header: Header
    child_frame_id: str
    pose: PoseWithCovariance
    twist: TwistWithCovariance


@dataclass
class PoseStamped(IdlStruct, **message("geometry_msgs", "PoseStamped")):
    header: Header
    pose: Pose


@dataclass
class Path(IdlStruct, **message("nav_msgs", "Path")):
    header: Header
    poses: sequence[PoseStamped]


@dataclass
class PoseWithCovarianceStamped(IdlStruct, **message("geometry_msgs", "PoseWithCovarianceStamped")):
    header: Header
    pose: PoseWithCovariance


@dataclass
class MapMetaData(IdlStruct, **message("nav_msgs", "MapMetaData")):
    map_load_time: Time
    resolution: float32
    width: uint32
    height: uint32
    origin: Pose


@dataclass
class OccupancyGrid(IdlStruct, **message("nav_msgs", "OccupancyGrid")):
    header: Header
    info: MapMetaData
    data: sequence[int8]


@dataclass
class LaserScan(IdlStruct, **message("sensor_msgs", "LaserScan")):
    header: Header
    angle_min: float32
    angle_max: float32
    angle_increment: float32
    time_increment: float32
    scan_time: float32
    range_min: float32
    range_max: float32
    ranges: sequence[float32]
    intensities: sequence[float32]


@dataclass
class CompressedImage(IdlStruct, **message("sensor_msgs", "CompressedImage")):
    header: Header
    format: str
    data: sequence[uint8]


_STANDARD = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepLast(10))
_SENSOR = Qos(Policy.Reliability.BestEffort, Policy.History.KeepLast(5))
_LATCHED = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepLast(1), Policy.Durability.TransientLocal)
_NOTHING = Vector3(0.0, 0.0, 0.0)
_LASER_AHEAD_M = 0.1
_BEAMS = 180
_STEP_S = 0.05


def _turned(yaw: float) -> Quaternion:
    return Quaternion(0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))


class RosRobot:
    """Drives until it is closed, in a thread of its own. `walls`: pieces ((x, y), (x, y)) in metres; it begins at the origin and looks
    along x. `picture`: what its camera sees wherever it is, a JPEG file; empty: it has no camera. `of_today`: its driver takes stamped commands, its
    frames are told in its own namespace, and its laser counts angles from 0 and gives other numbers of beams from turn to turn."""

    def __init__(self, domain: int, namespace: str, walls, picture: bytes = b"", of_today: bool = False):
        self.walls = walls
        self.x = self.y = self.yaw = 0.0
        self.driven_m = 0.0
        self.touches = 0
        self.heard: list[tuple[float, float, float]] = []  # when, and what was asked for
        participant = DomainParticipant(domain)
        self._odometry = DataWriter(participant, Topic(participant, f"rt{namespace}/odom", Odometry), qos=_STANDARD)
        self._scans = DataWriter(participant, Topic(participant, f"rt{namespace}/scan", LaserScan), qos=_SENSOR)
        self._frames = DataWriter(participant, Topic(participant, f"rt{namespace if of_today else ''}/tf_static", TFMessage), qos=_LATCHED)
        self._picture = list(picture)
        self._pictures = picture and DataWriter(participant, Topic(participant, f"rt{namespace}/image_raw/compressed", CompressedImage), qos=_SENSOR)
        self._commands = DataReader(participant, Topic(participant, f"rt{namespace}/cmd_vel", TwistStamped if of_today else Twist), qos=_STANDARD)
        self._is_of_today = of_today
        self._speed = self._turn = 0.0
        self._commanded = 0.0
        self._ends = threading.Event()
        self._thread = threading.Thread(target=self._live, daemon=True)

    def __enter__(self):
        laser = TransformStamped(Header(self._stamp(), "base_link"), "laser",
                                 Transform(Vector3(_LASER_AHEAD_M, 0.0, 0.2), Quaternion(1.0, 0.0, 0.0, 0.0)))  # upside down
        self._frames.write(TFMessage([laser]))
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._ends.set()
        self._thread.join()

    @staticmethod
    def _stamp() -> Time:
        now = time.time()
        return Time(int(now), int(now % 1 * 1e9))

    def _live(self):
        step = 0
        while not self._ends.wait(_STEP_S):
            for command in self._commands.take(10):
                twist = command.twist if isinstance(command, TwistStamped) else command
                if isinstance(twist, Twist):
                    self._speed, self._turn = twist.linear.x, twist.angular.z
                    self._commanded = time.monotonic()
                    self.heard.append((self._commanded, self._speed, self._turn))
            if time.monotonic() - self._commanded > 0.5:  # as the drivers of many bases do
                self._speed = self._turn = 0.0
            self._move()
            self._tell_odometry()
            step += 1
            if step % 2 == 0:
                self._tell_scan(_BEAMS + (step % 7 - 3 if self._is_of_today else 0))
            if self._pictures and step % 4 == 0:
                self._pictures.write(CompressedImage(Header(self._stamp(), "camera"), "jpeg", self._picture))

    def _move(self):
        self.yaw += self._turn * _STEP_S
        self.x += self._speed * _STEP_S * math.cos(self.yaw)
        self.y += self._speed * _STEP_S * math.sin(self.yaw)
        self.driven_m += abs(self._speed) * _STEP_S
        if min(_distance((self.x, self.y), wall) for wall in self.walls) < 0.15:
            self.touches += 1

    def _tell_odometry(self):
        none = [0.0] * 36
        pose = Pose(Point(self.x, self.y, 0.0), _turned(self.yaw))
        twist = Twist(Vector3(self._speed, 0.0, 0.0), Vector3(0.0, 0.0, self._turn))
        self._odometry.write(Odometry(Header(self._stamp(), "odom"), "base_link", PoseWithCovariance(pose, none), TwistWithCovariance(twist, none)))

    def _tell_scan(self, beams: int):
        at = (self.x + _LASER_AHEAD_M * math.cos(self.yaw), self.y + _LASER_AHEAD_M * math.sin(self.yaw))
        step = 2 * math.pi / beams
        first = 0.0 if self._is_of_today else -math.pi
        # It hangs upside down: what it takes for its left is the robot's right.
        ranges = [_range(at, self.yaw - (first + i * step), self.walls) for i in range(beams)]
        self._scans.write(LaserScan(Header(self._stamp(), "laser"), first, first + 2 * math.pi - step, step, 0.0, 0.1, 0.05, 8.0, ranges, []))


class Onlooker:
    """Who looks on with RViz: reads what is told of a robot, and keeps it until it is asked for."""

    def __init__(self, domain: int, namespace: str, tf_topic: str):
        participant = DomainParticipant(domain)

        def reader(topic: str, kind, qos):
            return DataReader(participant, Topic(participant, f"rt{topic}", kind), qos=qos)

        self._maps = reader(f"{namespace}/map", OccupancyGrid, _LATCHED)
        many = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepAll)
        self._poses = reader(f"{namespace}/pose", PoseWithCovarianceStamped, many)
        self._ways = reader(f"{namespace}/plan", Path, many)
        self._frames = reader(tf_topic, TFMessage, many)

    @staticmethod
    def _taken(reader, kind):
        return [one for one in reader.take(100_000) if isinstance(one, kind)]

    def maps(self) -> list[OccupancyGrid]:
        return self._taken(self._maps, OccupancyGrid)

    def poses(self) -> list[PoseWithCovarianceStamped]:
        return self._taken(self._poses, PoseWithCovarianceStamped)

    def ways(self) -> list[Path]:
        return self._taken(self._ways, Path)

    def frames(self) -> list[TransformStamped]:
        return [frame for told in self._taken(self._frames, TFMessage) for frame in told.transforms]


def _distance(point, wall) -> float:
    (ax, ay), (bx, by) = wall
    dx, dy = bx - ax, by - ay
    share = max(0.0, min(1.0, ((point[0] - ax) * dx + (point[1] - ay) * dy) / (dx * dx + dy * dy)))
    return math.hypot(ax + share * dx - point[0], ay + share * dy - point[1])


def _range(at, yaw: float, walls) -> float:
    cx, cy = math.cos(yaw), math.sin(yaw)
    nearest = math.inf
    for (ax, ay), (bx, by) in walls:
        dx, dy = bx - ax, by - ay
        across = cx * dy - cy * dx
        if abs(across) < 1e-12:
            continue
        along = ((ax - at[0]) * dy - (ay - at[1]) * dx) / across
        share = ((ax - at[0]) * cy - (ay - at[1]) * cx) / across
        if 0.0 < along < nearest and 0.0 <= share <= 1.0:
            nearest = along
    return nearest


def room(*corners):
    """The walls around a floor, from corner to corner."""
    return list(zip(corners, corners[1:] + corners[:1], strict=True))
