"""A camera on the network, as MJPEG over HTTP, whose pictures can be spoilt while a drone looks at them. Not a test itself."""

import contextlib
import pathlib
import socket
import threading
import time

import harness

SIDE = 480  # pixels
GOOD = (pathlib.Path(__file__).parents[1] / "golden/lots/00.jpg").read_bytes()
_PERIOD_S = 0.1


def _segment(marker: int, content: bytes) -> bytes:
    return bytes((0xFF, marker)) + (2 + len(content)).to_bytes(2, "big") + content


def black() -> bytes:
    """A JPEG of the format of the good one (4:2:0): its first block is as dark as it gets, no other differs from it, and there is no colour."""
    quantities = _segment(0xDB, bytes((0, *(255 for _ in range(64)))))
    frame = _segment(0xC0, bytes((8,)) + SIDE.to_bytes(2, "big") * 2 + bytes((3, 1, 0x22, 0, 2, 0x11, 0, 3, 0x11, 0)))
    # Of differences: 0 says none, 10 one of three bits. Of the rest of a block: 0 says that nothing comes.
    differences = _segment(0xC4, bytes((0x00, 1, 1, *(0 for _ in range(14)), 0, 3)))
    rest = _segment(0xC4, bytes((0x10, 1, *(0 for _ in range(15)), 0)))
    blocks = 6 * (SIDE // 16) ** 2
    bits = "10" + "011" + "0" + "00" * (blocks - 1)
    bits += "1" * (-len(bits) % 8)
    scan = _segment(0xDA, bytes((3, 1, 0, 2, 0, 3, 0, 0, 63, 0))) + int(bits, 2).to_bytes(len(bits) // 8, "big")
    return b"\xff\xd8" + quantities + frame + differences + rest + scan + b"\xff\xd9"


PICTURES = {"good": GOOD, "torn": GOOD[:len(GOOD) // 3], "garbage": bytes(range(255)) * 40, "black": black()}


class FakeCamera:
    """Serves `shows`, in turn, ten times a second; nobody when that is empty."""

    def __init__(self):
        self.port = harness.free_tcp_port()
        self.shows: tuple[str, ...] = ("good",)
        self._ends = False
        self._thread = threading.Thread(target=self._serve, daemon=True)

    @property
    def table(self) -> str:
        return f'kind = "video"\nsource = "http://127.0.0.1:{self.port}/"\nwidth = {SIDE}\nheight = {SIDE}'

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._ends = True
        self._thread.join()

    def _serve(self) -> None:
        with socket.create_server(("127.0.0.1", self.port)) as server:
            server.settimeout(_PERIOD_S)
            while not self._ends:
                with contextlib.suppress(OSError):
                    client, _ = server.accept()
                    with client:
                        self._show(client)

    def _show(self, client: socket.socket) -> None:
        client.settimeout(5)
        client.recv(65536)
        if not self.shows:
            return
        client.sendall(b"HTTP/1.0 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=picture\r\n\r\n")
        before, number = self.shows, 1  # who comes anew sees the second: the first may be what has ended the stream
        while not self._ends and (shows := self.shows):
            if shows is not before:
                before, number = shows, 0
            picture = PICTURES[shows[number % len(shows)]]
            number += 1
            client.sendall(b"--picture\r\nContent-Type: image/jpeg\r\nContent-Length: %d\r\n\r\n" % len(picture) + picture + b"\r\n")
            time.sleep(_PERIOD_S)  # the pace of the camera, which nothing waits for
