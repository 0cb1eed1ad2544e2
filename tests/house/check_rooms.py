"""Check that every #include is allowed by rooms.toml and no folder is crowded. usage: check_rooms.py REPO [--write]

--write puts the allow list into docs/architecture.md; without it the table there must be the same.
"""

import dataclasses
import functools
import pathlib
import re
import sys
import tomllib

INCLUDE = re.compile(r'^\s*#\s*include\s+(?:"(?P<own>[^"]+)"|<(?P<system>[^>]+)>)', re.MULTILINE)
# More files than that in one folder, and nobody finds the one he looks for. Folders of cases and golden files are read by programs.
MOST_FILES = 30
WATCHED_FOR_CROWDS = ("src", "bench", "fuzz", "web/src", "tests/house", "tests/support", "tests/system", "tests/peers")
TABLE_MARKS = ("<!-- made from tests/house/rooms.toml -->\n", "<!-- end -->\n")
PICTURE_MARKS = ("<!-- drawn from tests/house/rooms.toml -->\n", "<!-- end of the picture -->\n")


def is_test(path: pathlib.PurePath) -> bool:
    return "testing" in path.parts or path.stem.endswith("_test") or path.name.startswith("test_") or path.name == "testing.hpp"


@dataclasses.dataclass(frozen=True)
class Edge:
    """One #include of a header of the house."""
    place: str  # path:line
    header: str


class House:
    def __init__(self, repo: pathlib.Path):
        self.repo = repo
        self.rules = tomllib.loads((pathlib.Path(__file__).parent / "rooms.toml").read_text())
        self.rooms: dict[str, list[str]] = self.rules["rooms"]
        self.files = [path for folder in ("src", "bench", "fuzz") for path in sorted((repo / folder).rglob("*.[ch]pp"))]

    def room(self, path: pathlib.Path) -> str:
        parts = path.relative_to(self.repo).parts
        return parts[1] if parts[0] == "src" else parts[0]

    @functools.cache
    def edges(self, path: pathlib.Path) -> tuple[list[Edge], list[tuple[str, str]]]:
        """What the file includes: headers of the house, and those of others as (place, header)."""
        own, system = [], []
        text = path.read_text()
        for match in INCLUDE.finditer(text):
            place = f"{path.relative_to(self.repo)}:{text.count(chr(10), 0, match.start(0)) + 1}"
            if match["system"]:
                system.append((place, match["system"]))
            elif match["own"].split("/")[0] in self.rooms or (self.repo / "src" / match["own"]).exists():
                own.append(Edge(place, match["own"]))
        return own, system

    @functools.cache
    def reached(self, path: pathlib.Path) -> dict[str, str]:
        """Every header of the house that the file includes, over others too, with the first of its own includes that leads there."""
        found: dict[str, str] = {}
        for edge in self.edges(path)[0]:
            waiting = [edge.header]
            while waiting:
                header = waiting.pop()
                if header in found:
                    continue
                found[header] = edge.place
                target = self.repo / "src" / header
                if target.exists():
                    waiting += [further.header for further in self.edges(target)[0]]
        return found

    def allowed(self, room: str, path: pathlib.Path) -> set[str]:
        rooms = {room, *self.rooms[room]}
        return rooms | set(self.rules["tests"].get(room, [])) if is_test(path) else rooms

    def complaints(self) -> list[str]:
        wrong = []
        for path in self.files:
            room = self.room(path)
            if room not in self.rooms:
                wrong.append(f"{path.relative_to(self.repo)}: the room {room!r} is not in tests/house/rooms.toml")
                continue
            wrong += self.direct(room, path) + self.transitive(room, path) + self.impure(room, path)
        return wrong

    def direct(self, room: str, path: pathlib.Path) -> list[str]:
        wrong = []
        allowed = self.allowed(room, path)
        for edge in self.edges(path)[0]:
            other = edge.header.split("/")[0]
            if other != room and "*" not in allowed and other not in allowed:
                wrong.append(f"{edge.place}: {room} must not include {edge.header}")
                continue
            owner, is_internal, _ = edge.header.rpartition("/internal/")
            if is_internal and room != "fuzz" and (self.repo / "src" / owner) not in path.parents:
                wrong.append(f"{edge.place}: {edge.header} is private to {owner}")
        return wrong

    def crowded(self) -> list[str]:
        """Folders in which one looks for a file too long."""
        folders = [folder for top in WATCHED_FOR_CROWDS for folder in [self.repo / top, *(self.repo / top).rglob("*")] if folder.is_dir()]
        counts = {folder: sum(path.is_file() for path in folder.iterdir()) for folder in folders
                  if not {"node_modules", "__pycache__"} & set(folder.parts)}
        return [f"{folder.relative_to(self.repo)}: {count} files; more than {MOST_FILES} want folders"
                for folder, count in counts.items() if count > MOST_FILES]

    def transitive(self, room: str, path: pathlib.Path) -> list[str]:
        forbidden = set(self.rules["kept_from"].get(room, [])) - self.allowed(room, path)
        if is_test(path):  # what a test may include brings along what that includes
            forbidden -= {far for near in self.rules["tests"].get(room, []) for far in self.closure(near)}
        return [f"{place}: {room} is kept from {header.split('/')[0]}, and this leads to {header}"
                for header, place in self.reached(path).items() if header.split("/")[0] in forbidden]

    def closure(self, room: str) -> set[str]:
        found, waiting = set(), [room]
        while waiting:
            one = waiting.pop()
            if one not in found:
                found.add(one)
                waiting += self.rooms[one]
        return found

    def impure(self, room: str, path: pathlib.Path) -> list[str]:
        rules = self.rules["pure"]
        if room not in rules["rooms"] or is_test(path):
            return []
        wrong = [f"{place}: {room} is pure, and this leads to {header}" for header, place in self.reached(path).items() if header in rules["headers"]]
        own = {f"{path.relative_to(self.repo / 'src')}"} | {header for header in self.reached(path) if header.split("/")[0] == room}
        for header in sorted(own):
            target = self.repo / "src" / header
            system = self.edges(target)[1] if target.exists() else []
            wrong += [f"{place}: {room} is pure and must not include <{name}>" for place, name in system if name.startswith(tuple(rules["system"]))]
        return wrong

    def table(self) -> str:
        lines = ["| room | may include |", "|---|---|"]
        for room, others in self.rooms.items():
            words = {"[]": "(nothing)", "['*']": "everything"}.get(str(others), " ".join(others))
            lines.append(f"| {room} | {words} |")
        return "\n".join(lines) + "\n"

    def picture(self) -> str:
        """The same as a drawing: an arrow to each room that is not reached over another; rooms to come are dashed."""
        rooms = {room: others for room, others in self.rooms.items() if "*" not in others}
        arrows = [f"  {room} --> {other}" for room, others in rooms.items() for other in others
                  if not any(other in self.closure(between) for between in others if between != other)]
        to_come = [room for room in rooms if not (self.repo / "src" / room).is_dir()]
        return "\n".join(["```mermaid", "flowchart TD", *arrows, "  classDef later stroke-dasharray: 4 4",
                          f"  class {','.join(to_come)} later", "```"]) + "\n"


def written(house: House, write: bool) -> list[str]:
    """What docs/architecture.md shows of the allow list, put there or compared."""
    page = house.repo / "docs/architecture.md"
    wrong = []
    for what, marks, new in (("table", TABLE_MARKS, house.table()), ("picture", PICTURE_MARKS, house.picture())):
        before, _, rest = page.read_text().partition(marks[0])
        old, _, after = rest.partition(marks[1])
        if not rest or not after:
            wrong.append(f"{page.relative_to(house.repo)}: the marks round its {what} of rooms are gone: {marks[0].strip()} ... {marks[1].strip()}")
        elif old != new and write:
            page.write_text(before + marks[0] + new + marks[1] + after)
        elif old != new:
            wrong.append(f"{page.relative_to(house.repo)}: its {what} of rooms is old; write it with tests/house/check_rooms.py . --write")
    return wrong


def main() -> int:
    house = House(pathlib.Path(sys.argv[1]).resolve())
    wrong = house.complaints() + house.crowded() + written(house, "--write" in sys.argv[2:])
    print("\n".join(wrong) if wrong else f"every include of {len(house.files)} files is allowed")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
