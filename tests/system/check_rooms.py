"""Check that every #include between rooms points downwards. usage: check_rooms.py REPO"""

import pathlib
import re
import sys

# A room may include itself and every room on a line below its own. Rooms of one line do not know each other.
HOUSE = [
    {"apps"},
    {"station", "onboard", "sim", "dryrun"},
    {"lsp"},
    {"dolphin", "fleet", "robot", "imm", "autonomy", "route"},
    {"tasks"},
    {"plan"},
    {"parameters"},
    {"slam", "explore", "vision", "video"},
    {"mavlink", "bus"},
    {"vehicle", "map"},
    {"link"},
    {"geo"},
    {"base"},
]
# Only apps join the language and the platforms with a program; a simulated world speaks MAVLink and knows no platform.
LEVEL = {room: level for level, rooms in enumerate(HOUSE) for room in rooms}
INCLUDE = re.compile(r'^\s*#include\s+"([a-z_0-9]+)/([^"]+)"')


def main() -> int:
    source = pathlib.Path(sys.argv[1]) / "src"
    wrong = []
    for path in sorted(source.rglob("*.[ch]pp")):
        room = path.relative_to(source).parts[0]
        if room not in LEVEL:
            wrong.append(f"{path}: room {room!r} is not in the house plan (HOUSE in this script)")
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            other = match.group(1)
            if other == room:
                continue
            if other not in LEVEL or LEVEL[other] <= LEVEL[room]:
                wrong.append(f"{path}:{number}: {room} must not include {other}/{match.group(2)}")
            elif "/internal/" in match.group(0):
                wrong.append(f"{path}:{number}: {match.group(2)} is private to {other}")
    print("\n".join(wrong) if wrong else "every include points downwards")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
