"""What a survey drone's vision says of itself on the bus. Not a test itself."""

import time

import harness
from ros_drone import DiagnosticStatus, RosDrone


class Vision:
    """The newest that vision has said of itself."""

    def __init__(self, ros: RosDrone):
        self._reader = ros.reader("/vision_health", DiagnosticStatus)
        self._last = None

    def last(self) -> DiagnosticStatus | None:
        for one in self._reader.take(100):
            self._last = one if isinstance(one, DiagnosticStatus) else self._last
        return self._last

    def count(self, key: str) -> int:
        return int(next((one.value for one in self.last().values if one.key == key), 0)) if self.last() else 0

    def wait(self, condition, what: str, seconds: float = 20) -> DiagnosticStatus:
        harness.wait_until(lambda: (self.last() and condition(self.last())) or time.sleep(0.05), seconds, f"{what}: {self.last()}")
        return self.last()
