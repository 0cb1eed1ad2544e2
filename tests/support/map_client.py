"""A station with its map, and what it knows of vehicles. Not a test itself."""

import contextlib
import json
import re
import signal
import subprocess
import urllib.request

import harness


class Station:
    def __init__(self, process, address, link_port):
        self.process = process
        self.address = address
        self.link_port = link_port

    def vehicles(self) -> dict[int, dict]:
        """By system id."""
        with urllib.request.urlopen(f"{self.address}/api/v1/vehicles", timeout=10) as answer:
            return {vehicle["system_id"]: vehicle for vehicle in json.load(answer)["vehicles"]}

    def interrupt(self):
        self.process.send_signal(signal.SIGINT)


def said_before_listening(process) -> str:
    """What a station prints until its map can be reached, or until it ends."""
    said = []
    for line in process.stderr:
        said.append(line)
        if "listening" in line:
            break
    return "".join(said)


@contextlib.contextmanager
def station(*arguments):
    """A station on free ports of loopback, until the block ends."""
    port = harness.free_udp_port()
    command = [harness.LAPWING, "station", "--link", f"udpin://127.0.0.1:{port}", "--port", "0", *arguments]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    try:
        said = said_before_listening(process)
        address = re.search(r"http://127\.0\.0\.1:\d+", said)
        assert address, said
        yield Station(process, address[0], port)
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=20)
