"""Generate MAVLink headers from the dialect XML that pymavlink carries.

usage: generate_dialect.py DIALECT OUT_DIR

Writes OUT_DIR/cpp11 (typed C++ messages, used by the codec) and OUT_DIR/c (the C library, the benchmark's peer). Of the development
dialect, cpp11 gets the messages that autopilots send already.
"""

import contextlib
import io
import pathlib
import shutil
import sys
import tempfile

import pymavlink
from pymavlink.generator import mavgen


DEVELOPMENT = ("available_modes", "available_modes_monitor", "current_mode")


def generate(language: str, dialect: str, target: pathlib.Path) -> bool:
    xml = pathlib.Path(pymavlink.__file__).parent / "dialects" / "v20" / f"{dialect}.xml"
    if not xml.exists():
        print(f"no dialect {xml}: is the pinned pymavlink installed? run ./lapwing build", file=sys.stderr)
        return False
    shutil.rmtree(target, ignore_errors=True)
    options = mavgen.Opts(str(target), wire_protocol="2.0", language=language, validate=False)
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        made = mavgen.mavgen(options, [str(xml)])
    if not made:
        print(f"mavgen failed for {language}:\n{said.getvalue()}", file=sys.stderr)
    return bool(made)


def main() -> int:
    dialect, out = sys.argv[1], pathlib.Path(sys.argv[2])
    for language, folder in (("C++11", "cpp11"), ("C", "c")):
        if not generate(language, dialect, out / folder):
            return 1
    with tempfile.TemporaryDirectory() as scratch:
        if not generate("C++11", "development", pathlib.Path(scratch)):
            return 1
        (out / "cpp11" / "development").mkdir()
        for name in DEVELOPMENT:
            shutil.copy(pathlib.Path(scratch) / "development" / f"mavlink_msg_{name}.hpp", out / "cpp11" / "development")
    return 0


if __name__ == "__main__":
    sys.exit(main())
