"""Bags of ROS 2 that others' programs wrote (rosbags 0.11: SQLite and MCAP, mcap 1.6: MCAP with every packing) give the map of the same
drive as a log of CARMEN: to the micrometre where they hold the same numbers. What is read here was written by code of other people, after
rosbag2's tables and MCAP's specification, and encoded in CDR by a third reading of them: our own writers in the unit tests could share a
mistake with our readers. One of them is then laid on the map of the log, and one made one map with it."""

import json
import math
import pathlib
import sys
import tempfile

import corridors
import harness

try:
    import ros_bags
except ImportError as error:
    print(f"rosbags and mcap are not installed: {error}")
    sys.exit(harness.SKIPPED)

from mcap.writer import CompressionType, IndexType  # noqa: E402
from rosbags.rosbag2 import CompressionMode, StoragePlugin  # noqa: E402

BEAMS, START, STEP, MOUNT = 180, -math.pi / 2, math.pi / 180, 0.25


def as_float(number: float) -> float:
    """As a message has it, so that the log of CARMEN has the same."""
    return float(ros_bags.numpy.float32(number))


def a_drive() -> list:
    scans, x, y, yaw, time = [], 1.0, 1.5, 0.0, 1000.0
    for i in range(150):
        turn = math.pi / 2 / 20 if 70 <= i < 90 else 0.0
        yaw += turn
        x, y = x + 0.12 * math.cos(yaw), y + (0.12 if y < 7 else 0.0) * math.sin(yaw)
        time += 0.1
        lx, ly = x + MOUNT * math.cos(yaw), y + MOUNT * math.sin(yaw)
        ranges = [as_float(round(corridors.seen(corridors.WALLS, lx, ly, yaw + START + b * STEP), 2)) for b in range(BEAMS)]
        # Its wheels tell each turn two hundredths too large.
        scans.append((time, ranges, (round(x, 6), round(y, 6), round(1.02 * yaw, 6))))
    return scans


def write_carmen(scans: list, path: pathlib.Path):
    lines = [f"PARAM robot_frontlaser_offset {MOUNT}\n"]
    for time, ranges, (x, y, yaw) in scans:
        pose = f"{x:.6f} {y:.6f} {yaw:.6f}"
        lines.append(f"ROBOTLASER1 0 {START:.9f} {STEP * (BEAMS - 1):.9f} {STEP:.12f} 80 0.01 0 {BEAMS} {' '.join(repr(r) for r in ranges)} 0 "
                     f"{pose} {pose} 0 0 0 0 0 {time:.6f} h {time:.6f}\n")
    path.write_text("".join(lines))


def mapped(log: pathlib.Path, out: pathlib.Path, *options: str) -> tuple:
    """The trajectory (time, x, y, z and w of the turn), the report, what was said."""
    _, said = harness.expect_exit(0, "map", str(log), "--out", str(out), "--threads", "1", *options)
    numbers = [[float(word) for word in line.split()] for line in (out / "trajectory.tum").read_text().splitlines()]
    return [(row[0], row[1], row[2], row[6], row[7]) for row in numbers], json.loads((out / "report.json").read_text()), said


def furthest(a: list, b: list) -> float:
    assert len(a) == len(b), f"{len(a)} scans, {len(b)} scans"
    return max(max(abs(p - q) for p, q in zip(one, other)) for one, other in zip(a, b))


def bags(scans: list, folder: pathlib.Path):
    """(what, path), each as another program wrote it."""
    drive = ros_bags.Drive(scans, START, STEP, 80.0, (MOUNT, 0.0, 0.0))
    for storage in StoragePlugin:
        path = folder / f"rosbags-{storage.name.lower()}"
        ros_bags.by_rosbags(drive, path, storage)
        yield f"rosbags, {storage.name}, folder", path
        yield f"rosbags, {storage.name}, file", next(file for file in path.iterdir() if file.suffix in (".db3", ".mcap"))
    path = folder / "messages"
    ros_bags.by_rosbags(drive, path, StoragePlugin.SQLITE3, CompressionMode.MESSAGE)
    yield "rosbags, each message packed", path
    for compression in CompressionType:
        path = folder / f"{compression.name}.mcap"
        ros_bags.by_mcap(drive, path, compression, chunk_size=50_000)
        yield f"mcap, {compression.name}", path
    path = folder / "bare.mcap"
    ros_bags.by_mcap(drive, path, is_chunked=False, index_types=IndexType.NONE, use_statistics=False, use_summary_offsets=False)
    yield "mcap, no chunks, no index", path
    path = folder / "frames.mcap"
    ros_bags.by_mcap(ros_bags.Drive(scans, START, STEP, 80.0, (MOUNT, 0.0, 0.0), says_odometry=False), path)
    yield "mcap, odometry by /tf", path
    path = folder / "upside_down.mcap"
    ros_bags.by_mcap(ros_bags.Drive(scans, START, STEP, 80.0, (MOUNT, 0.0, 0.0), is_upside_down=True), path)
    yield "mcap, laser upside down", path


def a_file_cut_off(whole: pathlib.Path, of_log: list, folder: pathlib.Path):
    path = folder / "cut.mcap"
    path.write_bytes(whole.read_bytes()[:whole.stat().st_size * 2 // 3])
    poses, report, said = mapped(path, folder / "cut")
    assert 50 < len(poses) < len(of_log), len(poses)
    assert "cut off" in said and "cut off" in report["bag"]["remarks"][0], (said, report["bag"])


def a_packed_file_is_explained(scans: list, folder: pathlib.Path):
    path = folder / "packed"
    ros_bags.by_rosbags(ros_bags.Drive(scans[:5], START, STEP, 80.0), path, StoragePlugin.SQLITE3, CompressionMode.FILE)
    _, said = harness.expect_exit(2, "map", str(path), "--out", str(folder / "out"))
    assert "unzstd" in said, said


def a_bag_is_laid_on_the_map(bag: pathlib.Path, of_log: list, folder: pathlib.Path):
    """The map of the log of CARMEN, the scans of the bag; where the robot began is searched for, or told."""
    known = ("--localise", str(folder / "carmen/map.yaml"))
    for start in ((), ("--start", "1,1.5,0")):
        poses, report, _ = mapped(bag, folder / "known", *known, *start)
        assert report["lost"] == 0 and ("start" in report) == (not start), report
        apart = max(math.hypot(a[1] - b[1], a[2] - b[2]) for a, b in zip(of_log, poses, strict=True))
        print(f"on the known map {start}: {apart:.3f} m")
        assert apart < 0.15, apart
    assert not (folder / "known/map.pgm").exists(), "no map is made"


def nonsense_on_a_known_map_is_explained(bag: pathlib.Path, folder: pathlib.Path):
    yaml = str(folder / "carmen/map.yaml")
    _, said = harness.expect_exit(2, "map", str(bag), "--out", str(folder / "out"), "--localise", yaml, "--start", "1,2")
    assert "not x,y,heading" in said, said
    harness.expect_exit(2, "map", str(bag), "--out", str(folder / "out"), "--start", "1,2,3")
    _, said = harness.expect_exit(2, "map", str(bag), "--out", str(folder / "out"), "--localise", str(bag))
    assert "is no ROS map" in said, said
    # A room of two by two metres is no place for this drive.
    cells = bytes(0 if x in (0, 39) or y in (0, 39) else 254 for y in range(40) for x in range(40))
    (folder / "cell.pgm").write_bytes(b"P5\n40 40\n255\n" + cells)
    (folder / "cell.yaml").write_text("image: cell.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n")
    _, said = harness.expect_exit(3, "map", str(bag), "--out", str(folder / "out"), "--localise", str(folder / "cell.yaml"))
    assert "no place on the map fits" in said, said
    assert json.loads((folder / "out/report.json").read_text())["lost"] == 150


def a_bag_and_a_log_are_one_map(scans: list, of_log: list, folder: pathlib.Path):
    """Two robots' drives that share a part of the way, each counted from a place of its own: a bag and a log of CARMEN."""
    ros_bags.by_mcap(ros_bags.Drive(scans[:100], START, STEP, 80.0, (MOUNT, 0.0, 0.0)), folder / "one.mcap", CompressionType.LZ4)
    write_carmen([(time, ranges, (-y - 30.0, x + 7.0, yaw + math.pi / 2)) for time, ranges, (x, y, yaw) in scans[60:]], folder / "two.log")
    logs = (str(folder / "one.mcap"), str(folder / "two.log"))
    out = folder / "both"
    harness.expect_exit(0, "map", *logs, "--out", str(out), "--threads", "1")
    report = json.loads((out / "report.json").read_text())
    assert [one["scans"] for one in report["logs"]] == [100, 90] and report["scans"] == 190, report["logs"]
    assert report["logs"][1]["closures"] >= 3 and report["bag"][0]["scan_topic"] == "/scan", report
    ways = [[[float(word) for word in line.split()] for line in (out / f"trajectory-{i}.tum").read_text().splitlines()] for i in (1, 2)]
    apart = max(math.hypot(a[1] - b[1], a[2] - b[2]) for a, b in zip([*of_log[:100], *of_log[60:]], [*ways[0], *ways[1]], strict=True))
    print(f"a bag and a log: {apart:.3f} m from the drive in one piece")
    assert apart < 0.1, apart
    assert (out / "map.yaml").exists() and not (out / "trajectory.tum").exists()


def logs_that_are_no_one_building_are_named(bag: pathlib.Path, folder: pathlib.Path):
    # A square room, in the middle of which the robot stands and turns.
    def wall(angle: float) -> float:
        return as_float(min(4.0 / max(abs(math.cos(angle)), 1e-9), 4.0 / max(abs(math.sin(angle)), 1e-9)))

    room = [(float(i), [wall(0.05 * i + START + b * STEP) for b in range(BEAMS)], (0.0, 0.0, 0.05 * i)) for i in range(60)]
    write_carmen(room, folder / "elsewhere.log")
    _, said = harness.expect_exit(2, "map", str(bag), str(folder / "elsewhere.log"), "--out", str(folder / "none"))
    assert "elsewhere.log: it shares no place with the others" in said, said
    assert not (folder / "none/map.pgm").exists()
    yaml = str(folder / "carmen/map.yaml")
    _, said = harness.expect_exit(2, "map", str(bag), str(bag), "--out", str(folder / "none"), "--localise", yaml)
    assert "one log on a map" in said, said


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scans = a_drive()
        write_carmen(scans, folder / "drive.log")
        of_log, _, _ = mapped(folder / "drive.log", folder / "carmen")
        for what, path in bags(scans, folder):
            of_bag, report, said = mapped(path, folder / "out")
            apart = furthest(of_log, of_bag)
            print(f"{what}: {apart:.1e}")
            # Bearings of the log are counted in double numbers, those of a message in float: some 1e-7 a beam.
            assert apart < 1e-4, (what, apart)
            assert report["bag"]["scan_topic"] == "/scan" and report["bag"]["remarks"] == [], report["bag"]
            assert report["bag"]["odometry"] == ("/tf (odom to base_link)" if "/tf" in what else "/odom"), report["bag"]
        a_bag_is_laid_on_the_map(folder / "LZ4.mcap", of_log, folder)
        nonsense_on_a_known_map_is_explained(folder / "LZ4.mcap", folder)
        a_bag_and_a_log_are_one_map(scans, of_log, folder)
        logs_that_are_no_one_building_are_named(folder / "LZ4.mcap", folder)
        a_file_cut_off(folder / "LZ4.mcap", of_log, folder)
        a_packed_file_is_explained(scans, folder)


main()
