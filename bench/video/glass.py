"""Glass to glass: from the moment of exposure until a foreign player has the picture decoded, over H.264 and RTSP, a row a way.

The camera is the test pattern, whose hand goes round once a second: the picture itself says when it was taken, and the delay is what the clock says beyond
that (less than a second, or it would come out too short). The player is GStreamer's gst-launch-1.0; a picture is there when its last byte has been read
from the player. Beside it stands the MJPEG that the H.264 is made of, not decoded: exposure by its X-Timestamp, until its last byte has been read.
Run by hand, with LAPWING_BENCH_SECONDS (30) for each way.
"""

import contextlib
import http.client
import math
import os
import pathlib
import socket
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = ROOT / "build/release/bin"
SECONDS = float(os.environ.get("LAPWING_BENCH_SECONDS", "30"))
WIDTH, HEIGHT = 640, 480
MIDDLE = (0.5 * WIDTH, 0.4 * HEIGHT)  # of the hand, as src/video/camera/pattern_camera.cpp draws it
RADII = [radius * HEIGHT for radius in (0.16, 0.2, 0.24, 0.28)]
STEPS = 1440


def free_tcp_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@contextlib.contextmanager
def drone(rate: int):
    """What sees and what streams, as `lapwing onboard` would start them."""
    pictures, rtsp = free_tcp_port(), free_tcp_port()
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "onboard.toml")
        file.write_text(f'[bus]\ndomain = 77\n[camera]\nkind = "pattern"\nwidth = {WIDTH}\nheight = {HEIGHT}\n'
                        "[survey]\narea = [[1, 2], [1, 2.0003], [1.0003, 2.0003]]\n"
                        f"[stream]\nport = {pictures}\npictures_a_s = {rate}\n[rtsp]\nport = {rtsp}\n")
        processes = [subprocess.Popen([BIN / f"lapwing-{name}", name, "--config", file], stderr=subprocess.DEVNULL) for name in ("perceive", "stream")]
        try:
            for port in (pictures, rtsp):
                wait_for(port)
            yield pictures, rtsp, processes
        finally:
            for process in processes:
                process.terminate()
                process.wait(timeout=10)


def wait_for(port: int) -> None:
    deadline = time.monotonic() + 20
    while True:
        with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port), timeout=1):
            return
        assert time.monotonic() < deadline, f"nobody serves on port {port}"
        time.sleep(0.05)


def cpu_s(processes) -> float:
    """Processor time that they have had so far."""
    ticks = 0
    for process in processes:
        fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
        ticks += int(fields[11]) + int(fields[12])
    return ticks / os.sysconf("SC_CLK_TCK")


def hand(picture: bytes) -> float:
    """Where the hand points, as a fraction of a second; of brightnesses, row after row."""
    x = y = 0.0
    for step in range(STEPS):
        angle = 2 * math.pi * step / STEPS
        across, up = math.sin(angle), math.cos(angle)
        for radius in RADII:
            column, row = round(MIDDLE[0] + radius * across), round(MIDDLE[1] - radius * up)
            weight = max(0, picture[row * WIDTH + column] - 100)  # the disc behind it is dark
            x, y = x + weight * across, y + weight * up
    return math.atan2(x, y) / (2 * math.pi) % 1.0


def rtsp_delays(port: int, path: str, protocols: str, until: float):
    """Of each picture from now on."""
    words = (f"rtspsrc location=rtsp://127.0.0.1:{port}{path} latency=0 protocols={protocols} ! rtph264depay ! h264parse ! openh264dec ! videoconvert ! "
             "video/x-raw,format=GRAY8 ! fdsink sync=false")
    player = subprocess.Popen(["gst-launch-1.0", "-q", *words.split()], stdout=subprocess.PIPE)
    try:
        while time.time() < until and len(picture := player.stdout.read(WIDTH * HEIGHT)) == WIDTH * HEIGHT:
            arrived = time.time()
            yield (arrived - hand(picture)) % 1.0
    finally:
        player.terminate()
        player.wait(timeout=10)


def mjpeg_delays(port: int, path: str, until: float):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=10)
    connection.request("GET", path)
    answer = connection.getresponse()
    head = {}
    while time.time() < until:
        line = answer.readline().strip().decode()
        name, _, value = line.partition(": ")
        head[name] = value
        if line or "X-Timestamp" not in head:
            continue
        answer.read(int(head["Content-Length"]))
        yield time.time() - float(head["X-Timestamp"])
        head = {}
    connection.close()


def row(way: str, rate: int) -> dict:
    with drone(rate) as (pictures, rtsp, processes):
        until = time.time() + SECONDS
        protocol, path = way.split()
        asked = mjpeg_delays(pictures, path, until) if protocol == "http" else rtsp_delays(rtsp, path, protocol, until)
        delays, begun = [], 0.0
        for delay in asked:
            begun = begun or time.time()
            if time.time() > begun + 2:  # players settle
                delays.append(delay)
        used = cpu_s(processes[1:])
    steps = statistics.quantiles(delays, n=100)
    return {"way": way, "asked_a_s": rate, "pictures": len(delays), "p50_ms": 1e3 * steps[49], "p95_ms": 1e3 * steps[94], "p99_ms": 1e3 * steps[98],
            "most_ms": 1e3 * max(delays), "stream_cpu_ms_a_picture": 1e3 * used / len(delays)}


def measure(say) -> list:
    say(f"glass to glass, {WIDTH}x{HEIGHT}, load at the start {os.getloadavg()[0]:.1f}")
    say("| way | pictures asked a second | pictures | p50 | p95 | p99 | most | stream's processor time a picture |")
    say("|---|---|---|---|---|---|---|---|")
    rows = []
    for rate in (10, 30):
        for way in ("tcp /raw", "udp /raw", "tcp /annotated", "http /raw.mjpg", "http /annotated.mjpg"):
            rows.append(row(way, rate))
            say("| {way} | {asked_a_s} | {pictures} | {p50_ms:.0f} ms | {p95_ms:.0f} ms | {p99_ms:.0f} ms | {most_ms:.0f} ms | {stream_cpu_ms_a_picture:.1f} ms |".format(
                **rows[-1]))
    return rows


if __name__ == "__main__":
    sys.exit(not measure(lambda text: print(text, flush=True)))
