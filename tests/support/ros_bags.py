"""Drives as bags of ROS 2, written by others' programs: rosbags (both storages) and Foxglove's own library of MCAP. Not a test itself."""

import dataclasses
import math
import pathlib
import typing

import numpy
from mcap.writer import CompressionType, Writer as McapWriter
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

STORE = get_typestore(Stores.ROS2_HUMBLE)
SCAN, ODOMETRY, FRAMES = "sensor_msgs/msg/LaserScan", "nav_msgs/msg/Odometry", "tf2_msgs/msg/TFMessage"


@dataclasses.dataclass
class Drive:
    """`scans`: (time in seconds, ranges, (x, y, yaw)), the laser's beams from `start` on in steps of `step`, counterclockwise."""
    scans: list
    start: float
    step: float
    range_max: float
    mount: tuple = (0.0, 0.0, 0.0)
    is_upside_down: bool = False
    says_odometry: bool = True  # by nav_msgs/Odometry, else by /tf

    def messages(self) -> typing.Iterator[tuple]:
        """(topic, type, nanoseconds, message) in order of time."""
        types = STORE.types
        for topic, kind, time, message in self._told(types):
            yield topic, kind, round(time * 1e9), STORE.serialize_cdr(message, kind)

    def _told(self, types):
        first = self.scans[0][0]
        yield "/tf_static", FRAMES, first, types[FRAMES]([self._frame(types, first, "base_link", "laser", self.mount, self.is_upside_down)])
        for time, ranges, pose in self.scans:
            if self.says_odometry:
                yield "/odom", ODOMETRY, time, self._odometry(types, time, pose)
            else:
                yield "/tf", FRAMES, time, types[FRAMES]([self._frame(types, time, "odom", "base_link", pose, False)])
            yield "/scan", SCAN, time, self._scan(types, time, ranges)

    def _scan(self, types, time, ranges):
        told = numpy.array(ranges[::-1] if self.is_upside_down else ranges, dtype=numpy.float32)
        start = -(self.start + self.step * (len(ranges) - 1)) if self.is_upside_down else self.start
        return types[SCAN](_header(types, time, "laser"), start, start + self.step * (len(ranges) - 1), self.step, 0.0, 0.0, 0.0,
                           self.range_max, told, numpy.zeros(0, dtype=numpy.float32))

    @staticmethod
    def _odometry(types, time, pose):
        g = "geometry_msgs/msg/"
        none, zero = numpy.zeros(36), types[g + "Vector3"](0.0, 0.0, 0.0)
        place = types[g + "Pose"](types[g + "Point"](pose[0], pose[1], 0.0), _rotation(types, pose[2], False))
        return types[ODOMETRY](_header(types, time, "odom"), "base_link", types[g + "PoseWithCovariance"](place, none),
                               types[g + "TwistWithCovariance"](types[g + "Twist"](zero, zero), none))

    @staticmethod
    def _frame(types, time, parent, child, pose, is_upside_down):
        g = "geometry_msgs/msg/"
        transform = types[g + "Transform"](types[g + "Vector3"](pose[0], pose[1], 0.2), _rotation(types, pose[2], is_upside_down))
        return types[g + "TransformStamped"](_header(types, time, parent), child, transform)


def _header(types, time, frame):
    stamp = round(time * 1e9)
    return types["std_msgs/msg/Header"](types["builtin_interfaces/msg/Time"](stamp // 10**9, stamp % 10**9), frame)


def _rotation(types, yaw, is_upside_down):
    """Upside down: half a turn about the x axis first."""
    x, y, z, w = (math.cos(yaw / 2), math.sin(yaw / 2), 0.0, 0.0) if is_upside_down else (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))
    return types["geometry_msgs/msg/Quaternion"](x, y, z, w)


def by_rosbags(drive: Drive, folder: pathlib.Path, storage: StoragePlugin, packed: CompressionMode | None = None):
    """A folder with metadata.yaml, as `ros2 bag record` leaves it."""
    writer = Writer(folder, version=9, storage_plugin=storage)
    if packed is not None:
        writer.set_compression(packed, CompressionFormat.ZSTD)
    with writer:
        connections = {}
        for topic, kind, time, data in drive.messages():
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=STORE)
            writer.write(connections[topic], time, data)


def by_mcap(drive: Drive, path: pathlib.Path, compression=CompressionType.ZSTD, is_chunked: bool = True, **options):
    """A file alone; `options`: those of mcap.writer.Writer."""
    with path.open("wb") as file:
        writer = McapWriter(file, compression=compression, use_chunking=is_chunked, **options)
        writer.start(profile="ros2", library="")
        channels = {}
        for topic, kind, time, data in drive.messages():
            if topic not in channels:
                schema = writer.register_schema(name=kind, encoding="ros2msg", data=STORE.generate_msgdef(kind, ros_version=2)[0].encode())
                channels[topic] = writer.register_channel(topic=topic, message_encoding="cdr", schema_id=schema)
            writer.add_message(channel_id=channels[topic], log_time=time, data=bytes(data), publish_time=time)
        writer.finish()
