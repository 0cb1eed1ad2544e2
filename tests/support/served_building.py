"""A simulated building whose robot's board is served over TCP by a program of its own, so that other programs take it for a real one; it is
broken and mended from here, and tells the truth. Not a test itself."""

import json
import pathlib
import struct
import subprocess
import threading
import time
import zlib

import harness

HAND = pathlib.Path(harness.LAPWING).parent / "building_hand"


def _png(ppm: bytes) -> bytes:
    """Of a binary PPM."""
    _, size, _, pixels = ppm.split(b"\n", 3)
    width, height = map(int, size.split())
    rows = b"".join(b"\0" + pixels[row:row + 3 * width] for row in range(0, 3 * width * height, 3 * width))

    def chunk(name: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 1)) + chunk(b"IEND", b"")


class ServedBuilding:
    def __init__(self, file: pathlib.Path):
        self.port = harness.free_tcp_port()
        self.truth: dict = {}
        self.shots: list[str] = []
        self._came = threading.Condition()
        self.process = subprocess.Popen([HAND, "serve", str(file), f"tcpin://127.0.0.1:{self.port}"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                        bufsize=1)
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        self.comes(lambda truth: truth, 20, "the building is there")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self._reader.join()
        self.process.stdin.close()
        self.process.stdout.close()

    def _read(self):
        for line in self.process.stdout:
            with self._came:
                told = json.loads(line)
                if "shot" in told:
                    self.shots.append(told["shot"])
                else:
                    self.truth = told
                self._came.notify_all()

    def does(self, *words):
        """`fault sonar-stuck:2`, `mend all`, ...: built into the building's hand."""
        self.process.stdin.write(" ".join(map(str, words)) + "\n")

    def comes(self, true, seconds: float, what: str):
        """Waits until the truth is so, looking at each that is told."""
        deadline = time.monotonic() + seconds
        with self._came:
            while not true(self.truth):
                if not self._came.wait(deadline - time.monotonic()) or time.monotonic() > deadline:
                    raise AssertionError(f"not within {seconds} s: {what}; it is {self.truth}")

    def shoot(self, camera: int, file: pathlib.Path) -> bytes:
        """What one of the cameras to the sides sees now, as a PNG file."""
        self.does("shoot", camera, file)
        self.comes(lambda _: str(file) in self.shots, 60, f"a picture of camera {camera}")
        self.shots.remove(str(file))
        return _png(file.read_bytes())

    def drives(self, way_m: float = 0.3, seconds: float = 60):
        """It gets so far from where it is now."""
        begin = dict(self.truth)
        self.comes(lambda truth: abs(truth["x_m"] - begin["x_m"]) + abs(truth["y_m"] - begin["y_m"]) > way_m, seconds, f"the robot drives {way_m} m")

    def stands(self, seconds: float = 10):
        """Nothing turns its wheels, and it has come to rest."""
        self.comes(lambda truth: truth["voltages"] == [0, 0] and abs(truth["speed_m_s"]) < 0.005, seconds, "the robot stands")

    def passes(self, time_s: float):
        """So much of its own time."""
        until = self.truth["time_s"] + time_s
        self.comes(lambda truth: truth["time_s"] >= until, 5 * time_s + 10, f"{time_s} s have gone by in the building")
