"""A drive that was cut in two gives the map of the whole when its second half resumes what the first one left, be it that its odometry goes on, that it is told where it
begins or that it is searched for; again and again into the same folder. A state that is cut off, damaged, foreign or newer is refused by name, and nothing is written."""

import json
import math
import pathlib
import sys
import tempfile

import corridors
import harness

BEAMS = 181
# With a pillar, so that no place of them looks like another.
WALLS = [*corridors.WALLS, ((7, 0), (7, 0.5)), ((7, 0.5), (7.6, 0.5)), ((7.6, 0.5), (7.6, 0))]


def a_drive() -> list:
    """There, round the corner and back: (time, ranges, odometry)."""
    scans, x, y, yaw, time = [], 1.0, 1.5, 0.0, 1000.0
    legs = [(78, 0.12, 0), (20, 0, math.pi / 40), (45, 0.12, 0), (40, 0, math.pi / 40), (45, 0.12, 0), (20, 0, -math.pi / 40), (76, 0.12, 0)]
    for steps, ahead, turn in legs:
        for _ in range(steps):
            yaw += turn
            x, y, time = x + ahead * math.cos(yaw), y + ahead * math.sin(yaw), time + 0.1
            ranges = [round(corridors.seen(WALLS, x, y, yaw - math.pi / 2 + b * math.pi / 180), 2) for b in range(BEAMS)]
            scans.append((time, ranges, (x, y, 1.02 * yaw)))
    return scans


def write(scans: list, path: pathlib.Path, shift: float = 0.0) -> str:
    lines = []
    for time, ranges, (x, y, yaw) in scans:
        pose = f"{x + shift:.6f} {y:.6f} {yaw:.6f}"
        lines.append(f"FLASER {BEAMS} {' '.join(f'{r:.2f}' for r in ranges)} {pose} {pose} {time:.6f} h {time:.6f}\n")
    path.write_text("".join(lines))
    return str(path)


def trajectory(path: pathlib.Path) -> list:
    return [[float(word) for word in line.split()][1:3] for line in path.read_text().splitlines()]


def furthest(a: list, b: list) -> float:
    return max(math.dist(one, other) for one, other in zip(a, b, strict=True))


def make(log: str, out: pathlib.Path, *words: str) -> dict:
    harness.expect_exit(0, "map", log, "--out", str(out), "--threads", "1", *words)
    return json.loads((out / "report.json").read_text())


def refused(log: str, folder: pathlib.Path, state: pathlib.Path, why: str, *words: str):
    _, said = harness.expect_exit(2, "map", log, "--out", str(folder / "refused"), "--resume", str(state), *words)
    assert why in said, said
    assert not (folder / "refused/map.pgm").exists(), "nothing is written"


def main():
    scans = a_drive()
    half = len(scans) // 2
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        whole = make(write(scans, folder / "whole.log"), folder / "whole")
        of_whole = trajectory(folder / "whole/trajectory.tum")
        first, later = write(scans[:half], folder / "first.log"), write(scans[half:], folder / "later.log")
        elsewhere = write(scans[half:], folder / "elsewhere.log", shift=50.0)
        before = make(first, folder / "first")
        assert before["state"]["bytes"] == (folder / "first/mapping.state").stat().st_size

        x, y, yaw = scans[half][2]
        told = f"{x:.2f},{y:.2f},{math.degrees(yaw / 1.02):.1f}"
        for log, beginning, words in ((later, "goes on", ()), (elsewhere, "told", ("--start", told)), (elsewhere, "found", ())):
            report = make(log, folder / "both", "--resume", str(folder / "first"), *words)
            assert report["resumed"]["beginning"] == beginning and report["scans"] == whole["scans"], report
            assert [one["log"] for one in report["logs"]] == ["first.log", pathlib.Path(log).name], report["logs"]
            both = trajectory(folder / "both/trajectory-1.tum") + trajectory(folder / "both/trajectory-2.tum")
            apart = furthest(of_whole, both)
            print(f"{beginning}: {apart:.3f} m from the drive in one piece")
            assert apart < 0.1, apart

        quarter = len(scans) // 4
        for i in range(4):
            log = write(scans[i * quarter:(i + 1) * quarter], folder / f"{i}.log")
            report = make(log, folder / "daily", *(("--resume", str(folder / "daily/mapping.state")) if i else ()))
        assert len(report["logs"]) == 4 and report["scans"] == 4 * quarter, report["logs"]

        state = (folder / "first/mapping.state").read_bytes()
        other = folder / "other.state"
        for content, why in ((state[:-100], "other.state: this state of a mapping is cut off"), (state[:9], "cut off in its first bytes"),
                             (state[:500] + bytes([state[500] ^ 1]) + state[501:], "damaged: its checksum does not match"),
                             (state[:8] + b"\x07" + state[9:], "of version 7, and up to version 2 they are read"), (b"P5\n1 1\n255\n0", "no state of a mapping")):
            other.write_bytes(content)
            refused(later, folder, other, why)
        refused(elsewhere, folder, folder / "first", "lie on walls of the map", "--start", "40,40,0")
        _, said = harness.expect_exit(2, "map", first, later, "--out", str(folder / "refused"), "--resume", str(folder / "first"))
        assert "goes on with one log" in said, said
        harness.expect_exit(2, "map", later, "--out", str(folder / "refused"), "--resume", str(folder / "first"), "--set", "loops.witnesses=3")
        _, said = harness.expect_exit(2, "map", first, "--out", str(folder / "refused"), "--set", "loops.submap_frames=0")
        assert "more than nothing" in said, said


if __name__ == "__main__":
    sys.exit(main())
