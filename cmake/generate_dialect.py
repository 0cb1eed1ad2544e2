"""Generate MAVLink headers from the dialect XML that pymavlink carries.

usage: generate_dialect.py DIALECT OUT_DIR

Writes OUT_DIR/cpp11 (typed C++ messages, used by the codec) and OUT_DIR/c (the C library, the benchmark's peer).
"""

import contextlib
import io
import pathlib
import shutil
import sys

import pymavlink
from pymavlink.generator import mavgen


def main() -> int:
    dialect, out = sys.argv[1], pathlib.Path(sys.argv[2])
    xml = pathlib.Path(pymavlink.__file__).parent / "dialects" / "v20" / f"{dialect}.xml"
    if not xml.exists():
        print(f"no dialect {xml}: is the pinned pymavlink installed? run ./lapwing build", file=sys.stderr)
        return 1
    for language, folder in (("C++11", "cpp11"), ("C", "c")):
        target = out / folder
        shutil.rmtree(target, ignore_errors=True)
        options = mavgen.Opts(str(target), wire_protocol="2.0", language=language, validate=False)
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            made = mavgen.mavgen(options, [str(xml)])
        if not made:
            print(f"mavgen failed for {language}:\n{said.getvalue()}", file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
