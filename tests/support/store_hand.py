"""A program of the store's own that writes for ever and says what was accepted (src/map/store/testing/store_hand.cpp)."""

import pathlib
import subprocess
import threading

import harness

PROGRAM = pathlib.Path(harness.LAPWING).parent / "store_hand"


class Hand:
    """Writes to a store until it is killed."""

    def __init__(self, address: str, writer: str, least_free_bytes: int = 0):
        self.accepted = 0
        self.refusals: list[str] = []
        self._lines = threading.Condition()
        self.process = subprocess.Popen([PROGRAM, "write", address, writer, str(least_free_bytes)], stdout=subprocess.PIPE, text=True)
        self._reader = threading.Thread(target=self._read)
        self._reader.start()

    def _read(self) -> None:
        for line in self.process.stdout:
            word, _, rest = line.rstrip("\n").partition(" ")
            with self._lines:
                if word == "accepted":
                    self.accepted = int(rest)
                else:
                    self.refusals.append(f"{word} {rest}")
                self._lines.notify_all()

    def wait(self, condition, what: str, timeout: float = 60) -> None:
        with self._lines:
            assert self._lines.wait_for(lambda: condition(self), timeout), f"not within {timeout} s: {what}; {self.refusals[-3:]}"

    def kill(self) -> int:
        """With SIGKILL; how many things it said had been accepted."""
        self.process.kill()
        self.process.wait()
        self._reader.join()
        return self.accepted


def check(address: str, writer: str, accepted: int) -> str:
    """That all of these are there, and nothing is half; what was seen."""
    done = subprocess.run([PROGRAM, "check", address, writer, str(accepted)], capture_output=True, text=True, timeout=240, check=False)
    assert done.returncode == 0, f"of {accepted} by {writer}: {done.stdout}{done.stderr}"
    return done.stdout.strip()
