"""A foreign player of the drone's camera: GStreamer's gst-launch-1.0. Not a test itself."""

import shutil
import subprocess
import sys
import threading
import time

import harness


class Player:
    """Looks at rtsp://127.0.0.1:PORT/PATH, and keeps the newest picture and how many there were. What is decoded is the brightness of each pixel."""

    def __init__(self, port: int, path: str, size: tuple[int, int], protocols: str = "tcp", password: str = "swordfish"):
        self.width, self.height = size
        source = f"rtspsrc location=rtsp://127.0.0.1:{port}{path} latency=0 protocols={protocols} user-id=viewer user-pw={password}"
        words = f"{source} ! rtph264depay ! h264parse ! openh264dec ! videoconvert ! video/x-raw,format=GRAY8 ! fdsink sync=false"
        self.process = subprocess.Popen(["gst-launch-1.0", "-q", *words.split()], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.count, self.newest, self.words = 0, b"", ""
        threading.Thread(target=self._read, daemon=True).start()
        threading.Thread(target=self._read_words, daemon=True).start()

    @staticmethod
    def skip_without() -> None:
        if not shutil.which("gst-launch-1.0"):
            print("gstreamer1.0-tools is not installed")
            sys.exit(77)

    def _read(self) -> None:
        size = self.width * self.height
        while len(picture := self.process.stdout.read(size)) == size:
            self.newest, self.count = picture, self.count + 1

    def _read_words(self) -> None:
        for line in self.process.stderr:
            self.words += line.decode()

    def wait_for(self, more: int, seconds: float = 20) -> bytes:
        """The newest picture, when so many more have come."""
        known = self.count
        harness.wait_until(lambda: self.count >= known + more or time.sleep(0.02), seconds, f"{more} more pictures; it says: {self.words}")
        return self.newest

    def end(self) -> None:
        self.process.kill()
        self.process.wait()
