"""Who takes pictures for robots (`lapwing shoot`) has them of a stream, as most cameras on a network give: from RTSP, a new one each time, and again by
itself when the stream was gone."""

import json
import os
import signal
import subprocess

import harness
import survey
from drone import Drone
from player import Player

WIDTH, HEIGHT = 320, 240
Player.skip_without()
port = harness.free_tcp_port()
camera = survey.tables(camera=f'kind = "pattern"\nwidth = {WIDTH}\nheight = {HEIGHT}')
streams = f"[stream]\nport = {harness.free_tcp_port()}\n[rtsp]\nport = {port}\n"


class Shooter:
    def __init__(self, source: str):
        self.question = {"look": "shot", "source": source, "wanted_width": WIDTH, "wanted_height": HEIGHT}
        self.program = subprocess.Popen([harness.LAPWING, "shoot"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def ask(self) -> tuple[dict, bytes]:
        self.program.stdin.write(json.dumps(self.question).encode() + b"\n")
        self.program.stdin.flush()
        head = json.loads(self.program.stdout.readline())
        return head, self.program.stdout.read(head["bytes"])

    def picture(self) -> bytes:
        """Empty while there is none."""
        head, pixels = self.ask()
        if "error" in head:
            return b""
        assert (head["width"], head["height"], len(pixels)) == (WIDTH, HEIGHT, 3 * WIDTH * HEIGHT), head
        return pixels

    def end(self) -> int:
        self.program.stdin.close()
        return self.program.wait(20)


nobody = Shooter(f"rtsp://127.0.0.1:{harness.free_tcp_port()}/raw")
head, _ = nobody.ask()
assert "rtsp://127.0.0.1" in head["error"], head
assert nobody.end() == 0

with Drone(processes=camera + streams) as drone:
    drone.wait_for_log(f"rtsp://127.0.0.1:{port}/annotated")
    shooter = Shooter(f"rtsp://127.0.0.1:{port}/raw")
    first = harness.wait_until(shooter.picture, 30, "a picture comes")
    harness.wait_until(lambda: (newer := shooter.picture()) and newer != first, 10, "the next is a new one")
    before = drone.pid("stream")
    os.kill(before, signal.SIGKILL)
    harness.wait_until(lambda: not shooter.picture() or drone.pid("stream") != before, 30, "the stream is gone")
    harness.wait_until(lambda: drone.pid("stream") != before and shooter.picture(), 60, "pictures come again")
    assert shooter.end() == 0
