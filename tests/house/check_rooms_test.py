"""Each forbidden include that is planted in a copy of the sources is found, and said where it stands. usage: check_rooms_test.py REPO"""

import pathlib
import shutil
import subprocess
import sys
import tempfile

REPO = pathlib.Path(sys.argv[1]).resolve()
CHECK = REPO / "tests/house/check_rooms.py"

# file, what is written at its head, and what must be said of it
PLANTED = [
    ("src/dolphin/machine/engine.hpp", '"mavlink/connection/connection.hpp"', "dolphin must not include mavlink/connection/connection.hpp"),
    ("src/station/station.hpp", '"fleet/control/fleet_control.hpp"', "station must not include fleet/control/fleet_control.hpp"),
    ("src/station/station.hpp", '"dolphin/machine/engine.hpp"', "station must not include dolphin/machine/engine.hpp"),
    ("src/slam/pose2.hpp", '"link/byte_link.hpp"', "slam must not include link/byte_link.hpp"),
    ("src/slam/pose2.hpp", '"mavlink/wire/frame.hpp"', "slam must not include mavlink/wire/frame.hpp"),
    ("src/slam/pose2.hpp", '"vehicle/registry.hpp"', "slam must not include vehicle/registry.hpp"),
    ("src/slam/pose2.hpp", "<fstream>", "slam is pure and must not include <fstream>"),
    ("src/tasks/task.hpp", '"plan/mission.hpp"', "tasks must not include plan/mission.hpp"),
    ("src/lsp/server_test.cpp", '"fleet/control/fleet_control.hpp"', "lsp must not include fleet/control/fleet_control.hpp"),
    ("src/station/messages/vehicle_fields.cpp", '"tasks/internal/executor.hpp"', "tasks/internal/executor.hpp is private to tasks"),
    ("src/fleet/network/fleet.cpp", '"mavlink/path/internal/path_merge.hpp"', "path_merge.hpp is private to mavlink/path"),
    ("src/mavlink/wire/frame.cpp", '"mavlink/path/internal/path_merge.hpp"', "path_merge.hpp is private to mavlink/path"),
    ("bench/decode.cpp", '"sim/internal/nothing.hpp"', "sim/internal/nothing.hpp is private to sim"),
    # What an allowed header leads to counts, too.
    ("src/geo/position.hpp", '"base/async/loop.hpp"', "plan is pure, and this leads to base/async/loop.hpp"),
    ("src/vehicle/vehicle_state.hpp", '"mavlink/wire/frame.hpp"', "station is kept from mavlink, and this leads to mavlink/wire/frame.hpp"),
    ("src/cellar/wine.hpp", '"base/error.hpp"', "the room 'cellar' is not in tests/house/rooms.toml"),
]


def said(repo: pathlib.Path) -> tuple[int, str]:
    done = subprocess.run([sys.executable, CHECK, repo], capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout


with tempfile.TemporaryDirectory() as folder:
    copy = pathlib.Path(folder)
    for part in ("src", "bench", "fuzz"):
        shutil.copytree(REPO / part, copy / part, ignore=lambda place, names: [name for name in names
                        if not name.endswith((".cpp", ".hpp")) and not (pathlib.Path(place) / name).is_dir()])
    (copy / "docs").mkdir()
    shutil.copy(REPO / "docs/architecture.md", copy / "docs")
    assert said(copy)[0] == 0, said(copy)[1]
    for file, header, words in PLANTED:
        path = copy / file
        before = path.read_text() if path.exists() else None
        path.parent.mkdir(exist_ok=True)
        path.write_text(f"#include {header}\n{before or ''}")
        code, text = said(copy)
        assert code == 1 and words in text, f"{header} in {file}: {text}"
        if before is None:
            shutil.rmtree(path.parent)
        else:
            path.write_text(before)
    for number in range(31):
        (copy / f"src/vehicle/word_{number}.hpp").write_text("#pragma once\n")
    code, text = said(copy)
    assert code == 1 and "src/vehicle: " in text and "want folders" in text, text
    for number in range(31):
        (copy / f"src/vehicle/word_{number}.hpp").unlink()
    page = copy / "docs/architecture.md"
    page.write_text(page.read_text().replace("| tasks | base geo vehicle |", "| tasks | everything |"))
    code, text = said(copy)
    assert code == 1 and "its table of rooms is old" in text, text
    subprocess.run([sys.executable, CHECK, copy, "--write"], check=True, capture_output=True, timeout=60)
    assert page.read_text() == (REPO / "docs/architecture.md").read_text()
print(f"{len(PLANTED)} planted includes are found")
