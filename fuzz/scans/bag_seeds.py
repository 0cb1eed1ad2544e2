"""Writes small bags of ROS 2 for the fuzzer. usage: bag_seeds.py FOLDER"""

import pathlib
import sqlite3
import struct
import sys


def cdr(*parts) -> bytes:
    """Little-endian CDR of (format, values...), text as str; each number lies evenly behind the four bytes of the beginning."""
    body = b""
    for part in parts:
        if isinstance(part, str):
            part = ("I", len(part) + 1), part.encode() + b"\0"
        else:
            part = (part,)
        for one in part:
            if isinstance(one, bytes):
                body += one
                continue
            for value in one[1:]:
                body += b"\0" * (-len(body) % struct.calcsize(one[0])) + struct.pack("<" + one[0], value)
    return b"\0\1\0\0" + body


def messages() -> list:
    scan = cdr(("I", 0, 500_000_000), "laser", ("f", -1, 1, 1, 0, 0, 0.1, 9), ("I", 3), ("f", 1, 2, 3), ("I", 0))
    moments = [cdr(("I", second, 0), "odom", "base", ("d", second, 0, 0, 0, 0, 0, 1), ("d", *[0] * 36), ("d", *[0] * 42)) for second in (0, 1)]
    frames = [cdr(("I", 1), ("I", second, 0), parent, child, ("d", second, 0, 0, 0, 0, 0, 1)) for second, parent, child in
              ((0, "base", "laser"), (0, "odom", "base"), (1, "odom", "base"))]
    return [("/tf_static", "tf2_msgs/msg/TFMessage", frames[0]), ("/tf", "tf2_msgs/msg/TFMessage", frames[1]),
            ("/tf", "tf2_msgs/msg/TFMessage", frames[2]), ("/odom", "nav_msgs/msg/Odometry", moments[0]),
            ("/odom", "nav_msgs/msg/Odometry", moments[1]), ("/scan", "sensor_msgs/msg/LaserScan", scan)]


def record(opcode: int, content: bytes) -> bytes:
    return struct.pack("<BQ", opcode, len(content)) + content


def text(value: str) -> bytes:
    return struct.pack("<I", len(value)) + value.encode()


def records(all_messages: list) -> bytes:
    done, ids = b"", {}
    for topic, kind, bytes_ in all_messages:
        if topic not in ids:
            ids[topic] = struct.pack("<H", len(ids) + 1)
            done += record(3, ids[topic] + text(kind) + text("ros2msg") + text(""))
            done += record(4, ids[topic] * 2 + text(topic) + text("cdr") + bytes(4))
        done += record(5, ids[topic] + bytes(20) + bytes_)
    return done


def packed(name: str, content: bytes) -> bytes:
    """Frames of one block that is stored as it is."""
    if name == "zstd":
        return struct.pack("<IBI", 0xfd2fb528, 0xa0, len(content)) + struct.pack("<I", len(content) << 3 | 1)[:3] + content
    if name == "lz4":
        return bytes.fromhex("04224d18604082") + struct.pack("<I", len(content) | 1 << 31) + content + bytes(4)
    return content


def mcap(name: str, content: bytes) -> bytes:
    inside = packed(name, content)
    chunk = bytes(16) + struct.pack("<QI", len(content), 0) + text(name) + struct.pack("<Q", len(inside)) + inside
    return b"\x89MCAP0\r\n" + record(6, chunk) + record(15, bytes(4))


def write_sqlite(path: pathlib.Path, all_messages: list):
    with sqlite3.connect(path) as database:
        database.execute("PRAGMA page_size=512")
        database.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT,type TEXT,serialization_format TEXT,offered_qos_profiles TEXT)")
        database.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER,timestamp INTEGER,data BLOB)")
        names = list(dict.fromkeys((topic, kind) for topic, kind, _ in all_messages))
        for number, (topic, kind) in enumerate(names):
            database.execute("INSERT INTO topics VALUES(?,?,?,'cdr','')", (number, topic, kind))
        for topic, kind, bytes_ in all_messages:
            database.execute("INSERT INTO messages(topic_id,timestamp,data) VALUES(?,0,?)", (names.index((topic, kind)), bytes_))


def main():
    folder = pathlib.Path(sys.argv[1])
    everything = messages()
    for name in ("", "lz4", "zstd"):
        (folder / f"mcap-{name or 'plain'}").write_bytes(mcap(name, records(everything)))
    (folder / "mcap-bare").write_bytes(b"\x89MCAP0\r\n" + records(everything) + record(2, bytes(20)))
    write_sqlite(folder / "sqlite", everything)


main()
