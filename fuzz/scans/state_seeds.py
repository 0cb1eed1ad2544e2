"""Writes small states of mappings for the fuzzer, after docs/reference/slam.md. usage: state_seeds.py FOLDER"""

import pathlib
import struct
import sys
import zlib


def sensor(beams: int) -> bytes:
    return struct.pack("<fffI", 0.1, 0, 80, beams) + struct.pack(f"<{beams}f", *(-1.5 + 3 * i / max(1, beams - 1) for i in range(beams)))


def key_frame(number: int, beams: int) -> bytes:
    pose = (0.25 * number, 0, 0)
    return struct.pack("<IBd3dd3dI", number, 0, 0.25 * number, *pose, float(number), *pose, 0) + struct.pack(f"<{beams}f", *(2 + 0.1 * i for i in range(beams)))


def constraint(start: int, end: int, is_loop: bool) -> bytes:
    return struct.pack("<IIB3d9d", start, end, is_loop, 0.25 * (end - start), 0, 0, 400, 0, 0, 0, 400, 0, 0, 0, 2500)


def state(frames: int, beams: int, parameters=()) -> bytes:
    payload = struct.pack("<I", len(parameters))
    for name, value in parameters:
        payload += struct.pack("<I", len(name)) + name.encode() + struct.pack("<d", value)
    payload += struct.pack("<BBd", 1, 1, 0.25)
    payload += struct.pack("<I", 1) + sensor(beams)
    payload += struct.pack("<II", frames, frames) + b"".join(key_frame(i, beams) for i in range(frames))
    constraints = [constraint(i, i + 1, False) for i in range(frames - 1)] + ([constraint(0, frames - 1, True)] if frames > 2 else [])
    payload += struct.pack("<I", len(constraints)) + b"".join(constraints)
    payload += struct.pack("<I", 1) + struct.pack("<I", 5) + b"a.clf" + struct.pack("<IId", frames, frames, 0.25 * frames)
    payload += b"".join(struct.pack("<dI3d", float(i), i, 0, 0, 0) for i in range(frames))
    payload += struct.pack("<4I", 3, 1, 1, 0)
    payload += struct.pack("<B3d3d", 1, 0.25 * frames, 0, 0, 0.25, 0, 0) + struct.pack("<Idd", 2, 0.5, 1.5) + struct.pack("<Id", 1, 0.25)
    return payload + struct.pack("<3d3dd", 0.25 * frames, 0, 0, 0.25 * frames, 0, 0, float(frames))


def main():
    folder = pathlib.Path(sys.argv[1])
    for name, payload in (("one", state(1, 3)), ("some", state(4, 12, [("loops.submap_frames", 3), ("front_end.key_step_m", 0.3)])), ("many", state(20, 24))):
        (folder / name).write_bytes(b"\0" + payload)
        head = b"LWslam\r\n" + struct.pack("<IQI", 1, len(payload), zlib.crc32(payload))
        (folder / f"{name}-file").write_bytes(b"\1" + head + payload)


if __name__ == "__main__":
    main()
