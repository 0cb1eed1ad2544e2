"""A UDP relay that loses packets, for vehicles that cannot lose them themselves. Not a benchmark itself."""

import contextlib
import random
import select
import socket
import threading


class LossyRelay:
    """One vehicle sends to `port`; the ground station listens on `ground_port`."""

    def __init__(self, ground_port: int, loss: float, seed: int, port: int = 0):
        self._ground, self._loss, self._random = ("127.0.0.1", ground_port), loss, random.Random(seed)
        self._field = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._field.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)
        self._field.bind(("127.0.0.1", port))
        self._up = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._up.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)
        self._up.connect(self._ground)
        self._field.setblocking(False)
        self._up.setblocking(False)
        self.port = self._field.getsockname()[1]
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._relay, daemon=True)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._ended.set()
        self._thread.join()
        self._field.close()
        self._up.close()

    def _relay(self):
        vehicle = None
        while not self._ended.is_set():
            ready, _, _ = select.select([self._field, self._up], [], [], 0.1)
            for link in ready:
                # Nobody listens yet or any more: lost, as on any network. Or what was ready was that error.
                with contextlib.suppress(ConnectionRefusedError, BlockingIOError):
                    if link is self._field:
                        data, vehicle = link.recvfrom(65536)
                        if self._random.random() >= self._loss:
                            self._up.send(data)
                    else:
                        data = link.recv(65536)
                        if vehicle and self._random.random() >= self._loss:
                            self._field.sendto(data, vehicle)
