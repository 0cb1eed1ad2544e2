"""Logs of CARMEN as lists of scans, to be changed and written again; relations likewise."""

import dataclasses
import lzma
import math
import os
import pathlib


@dataclasses.dataclass
class Scan:
    time: float
    ranges: list
    odometry: tuple  # x, y, yaw


@dataclasses.dataclass
class Log:
    name: str
    scans: list
    start: float  # bearing of the first beam
    step: float
    offset: float | None = None  # of the laser, along the robot
    most: float = 0.0  # readings from here on say that nothing came back; 0: not said
    relations: list = dataclasses.field(default_factory=list)  # t1, t2, x, y, yaw


def text_of(path: pathlib.Path) -> str:
    return lzma.open(path, "rt").read() if path.suffix == ".xz" else path.read_text()


def folders(named=()) -> list:
    """Folders with a log and its relations, below those named or LAPWING_SLAM_LOGS."""
    roots = [pathlib.Path(name) for name in named] or [pathlib.Path(root) for root in [os.environ.get("LAPWING_SLAM_LOGS")] if root]
    return sorted({path.parent for root in roots for path in root.rglob("*.relations")})


def read(folder: pathlib.Path) -> Log:
    path = next(path for pattern in ("*.clf", "*.log", "*.clf.xz", "*.log.xz") for path in sorted(folder.glob(pattern)))
    log = Log(path.name.split(".")[0], [], -math.pi / 2, math.pi / 180)
    offsets = []
    for line in text_of(path).splitlines():
        words = line.split()
        if words[:2] == ["PARAM", "robot_frontlaser_offset"]:
            log.offset = float(words[2])
        if not words or words[0] != "FLASER":
            continue
        count = int(words[1])
        x, y, yaw, odo_x, odo_y, odo_yaw, time = (float(word) for word in words[2 + count:9 + count])
        offsets.append(between((odo_x, odo_y, odo_yaw), (x, y, yaw))[0])
        log.step = math.pi / (count if count % 2 == 0 else count - 1)
        log.scans.append(Scan(time, [float(word) for word in words[2:2 + count]], (odo_x, odo_y, odo_yaw)))
    if log.offset is None and offsets and max(offsets) - min(offsets) < 0.004 and abs(offsets[0]) < 1.0:
        log.offset = offsets[0]
    log.scans.sort(key=lambda scan: scan.time)
    for line in text_of(next(folder.glob("*.relations"))).splitlines():
        if line.strip() and not line.startswith("#"):
            t1, t2, x, y, _, _, _, yaw = (float(word) for word in line.split())
            log.relations.append((t1, t2, x, y, yaw))
    return log


def write(log: Log, folder: pathlib.Path) -> tuple:
    """Paths of the log and of its relations; none if it has none."""
    path = folder / "log.clf"
    with path.open("w") as file:
        if log.offset is not None:
            file.write(f"PARAM robot_frontlaser_offset {log.offset}\n")
        for scan in log.scans:
            count = len(scan.ranges)
            x, y, yaw = scan.odometry
            pose = f"{x:.6f} {y:.6f} {yaw:.6f}"
            file.write(f"ROBOTLASER1 0 {log.start:.12f} {log.step * (count - 1):.12f} {log.step:.15f} {log.most} 0.01 0 {count} {' '.join(f'{r:.3f}' for r in scan.ranges)} 0 "
                       f"{pose} {pose} 0 0 0 0 0 {scan.time:.6f} h {scan.time:.6f}\n")
    if not log.relations:
        return path, None
    relations = folder / "log.relations"
    relations.write_text("".join(f"{t1:.6f} {t2:.6f} {x:.6f} {y:.6f} 0 0 0 {yaw:.8f}\n" for t1, t2, x, y, yaw in log.relations))
    return path, relations


def part(log: Log, number: int, count: int) -> Log:
    """One of `count` drives that follow each other, without the relations, which are of the whole."""
    size = len(log.scans)
    return dataclasses.replace(log, name=f"{log.name}-{number + 1}", scans=log.scans[size * number // count:size * (number + 1) // count], relations=[])


def wrap(angle: float) -> float:
    return (angle + math.pi) % (2 * math.pi) - math.pi


def between(a: tuple, b: tuple) -> tuple:
    cosine, sine = math.cos(a[2]), math.sin(a[2])
    x, y = b[0] - a[0], b[1] - a[1]
    return cosine * x + sine * y, -sine * x + cosine * y, wrap(b[2] - a[2])


def after(a: tuple, step: tuple) -> tuple:
    cosine, sine = math.cos(a[2]), math.sin(a[2])
    return a[0] + cosine * step[0] - sine * step[1], a[1] + sine * step[0] + cosine * step[1], wrap(a[2] + step[2])
