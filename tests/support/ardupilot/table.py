"""The table of what ArduPilot answers: how its rows are written. Not a test itself."""

import dataclasses
from typing import Callable

from ardupilot.vehicle import Vehicle

SEEN = "4.6.0-dev fbb7858"


@dataclasses.dataclass
class Row:
    name: str
    ask: Callable[[Vehicle], object]
    answer: object
    seen: str = SEEN


class Rows(list):
    """The cases of one family of vehicles."""

    def ask(self, name, answer, ask, seen=SEEN):
        self.append(Row(name, ask, answer, seen))

    def row(self, answer, seen=SEEN):
        """A case of some steps: the function's name says what is asked, its value is compared with `answer`."""
        def add(ask):
            self.append(Row(ask.__name__.replace("_", " "), ask, answer, seen))
            return ask
        return add
