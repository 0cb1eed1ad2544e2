"""A player of the drone's camera that takes nothing any more: little is kept for it, others see on, and in the end its connection is ended."""

import pathlib
import socket
import time

import harness
import survey
from drone import Drone
from player import Player

SIZE = (320, 240)
Player.skip_without()
rtsp_port = harness.free_tcp_port()
camera = survey.tables(camera=f'kind = "pattern"\nwidth = {SIZE[0]}\nheight = {SIZE[1]}')
streams = f"[stream]\nport = {harness.free_tcp_port()}\npictures_a_s = 60\n[rtsp]\nport = {rtsp_port}\n"


def exactly(connection: socket.socket, count: int) -> bytes:
    data = connection.recv(count, socket.MSG_WAITALL)
    assert len(data) == count, "the server has ended the connection"
    return data


def ask(connection: socket.socket, number: int, what: str, *headers: str) -> dict[str, str]:
    """One request of RTSP; the headers of its answer."""
    connection.sendall("\r\n".join((f"{what} RTSP/1.0", f"CSeq: {number}", *headers, "", "")).encode())
    # Packets of the stream may come before the answer: "$", a channel and their length go before each (RFC 2326, 10.12).
    while (first := exactly(connection, 1)) == b"$":
        exactly(connection, int.from_bytes(exactly(connection, 3)[1:], "big"))
    head = first
    while not head.endswith(b"\r\n\r\n"):
        head += exactly(connection, 1)
    first, *lines = head.decode().split("\r\n")
    assert " 200 " in first, head
    answer = dict(line.split(": ", 1) for line in lines if line)
    exactly(connection, int(answer.get("Content-Length", 0)))
    return answer


def hang() -> socket.socket:
    """Begins to look, and reads nothing more."""
    connection = socket.socket()
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    connection.settimeout(30)
    connection.connect(("127.0.0.1", rtsp_port))
    path = f"rtsp://127.0.0.1:{rtsp_port}/raw"
    ask(connection, 1, f"DESCRIBE {path}", "Accept: application/sdp")
    session = ask(connection, 2, f"SETUP {path}/stream=0", "Transport: RTP/AVP/TCP;unicast;interleaved=0-1")["Session"].split(";")[0]
    ask(connection, 3, f"PLAY {path}", f"Session: {session}")
    return connection


def resident_kib(pid: int) -> int:
    return next(int(line.split()[1]) for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines() if line.startswith("VmRSS"))


def connections() -> int:
    """That the server has not ended: state 01 in the kernel's table. Who hangs does not see the end, behind all that it has not read."""
    rows = [line.split() for line in pathlib.Path("/proc/net/tcp").read_text().splitlines()[1:]]
    return sum(row[1].endswith(f":{rtsp_port:04X}") and row[3] == "01" for row in rows)


with Drone(processes=camera + streams) as drone:
    drone.wait_for_log(f"rtsp://127.0.0.1:{rtsp_port}/annotated")
    watching = Player(rtsp_port, "/raw", SIZE)
    watching.wait_for(10)
    pid = drone.pid("stream")
    before = resident_kib(pid)
    hung = [hang() for _ in range(4)]
    # The kernel's table is no picture of one moment: while other programs open and close connections a row may be missed.
    harness.wait_until(lambda: connections() == 1 + len(hung), 5, "all of them have places")
    deadline = time.monotonic() + 90
    while connections() > 1:
        assert time.monotonic() < deadline, "they have kept their places"
        watching.wait_for(30, seconds=5)
        grown = resident_kib(pid) - before
        assert grown < 30_000, f"{grown} KiB more are kept for those who hang"
        time.sleep(0.1)
    watching.wait_for(30, seconds=5)
    assert drone.pid("stream") == pid, "it has served all along"
    watching.end()
