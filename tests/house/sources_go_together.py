"""Sources are compiled as one where none declares what another one does, and CMake hears of it only when that changes.
usage: sources_go_together.py REPO"""

import pathlib
import shutil
import subprocess
import sys
import tempfile

REPO = pathlib.Path(sys.argv[1]).resolve()


def groups(root: pathlib.Path, texts: dict[str, str], most: int = 6) -> list[list[str]]:
    """The sources among these, as they go together."""
    for name, text in texts.items():
        path = root / "src/room" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    listed = root / "list.txt"
    listed.write_text("".join(f"room\t{root}/src/room/{name}\n" for name in texts if name.endswith(".cpp")))
    subprocess.run([sys.executable, str(root / "cmake/together.py"), str(listed), str(root / "groups.cmake"), str(most)], check=True)
    return [[pathlib.Path(word.strip('"')).name for word in line.split() if word.endswith('.cpp"')]
            for line in (root / "groups.cmake").read_text().replace("(", " ").splitlines()]


with tempfile.TemporaryDirectory() as folder:
    root = pathlib.Path(folder)
    (root / "cmake").mkdir()
    shutil.copy(REPO / "cmake/together.py", root / "cmake/together.py")

    assert groups(root, {"a.cpp": "int a() {\n", "b.cpp": "int b() {\n", "c.cpp": "int c() {\n"}) == [["a.cpp", "b.cpp", "c.cpp"]]
    assert groups(root, {"a.cpp": "int a() {\n", "b.cpp": "int b() {\n", "c.cpp": "int c() {\n"}, most=2) == [["a.cpp", "b.cpp"], ["c.cpp"]]
    assert groups(root, {"a.cpp": "int helper() {\n", "b.cpp": "int helper() {\n"}) == [["a.cpp"], ["b.cpp"]]
    assert groups(root, {"a.cpp": "  int helper() {\n", "b.cpp": "int helper() {\n"}) == [["a.cpp", "b.cpp"]], "a member is nobody's namesake"
    assert groups(root, {"a.cpp": "#define SIDE 1\n", "b.cpp": "constexpr int SIDE = 2;\n"}) == [["a.cpp"], ["b.cpp"]]

    # What opens a namespace or an enumeration opens it for all that follow.
    times = "using namespace std::chrono_literals;\n"
    assert groups(root, {"a.cpp": times, "b.cpp": "int b() {\n"}) == [["a.cpp", "b.cpp"]]
    assert groups(root, {"a.cpp": "using enum Kind;\n", "b.cpp": "int b() {\n", "c.cpp": "using enum Kind;\n"}) == [["a.cpp", "c.cpp"], ["b.cpp"]]

    # An alias is a second meaning of a type that another source's headers bring, however far away.
    far = {"far.hpp": "class Order {\n", "near.hpp": '#include "room/far.hpp"\n', "a.cpp": "using Order = int;\n"}
    assert groups(root, far | {"b.cpp": '#include "near.hpp"\n'}) == [["a.cpp"], ["b.cpp"]]
    assert groups(root, far | {"a.cpp": "using other::Order;\n", "b.cpp": '#include "near.hpp"\n'}) == [["a.cpp"], ["b.cpp"]]
    assert groups(root, {"a.cpp": "using other::Order;\n", "b.cpp": "using other::Order;\n"}) == [["a.cpp", "b.cpp"]]
    assert groups(root, {"a.cpp": "int order() {\n", "b.cpp": '#include "near.hpp"\n'}) == [["a.cpp", "b.cpp"]]

    # Groups that stay as they are leave the file as it is; a source that is gone is CMake's to say.
    before = (root / "groups.cmake").stat().st_mtime_ns
    groups(root, {"a.cpp": "int more() {\n", "b.cpp": '#include "near.hpp"\n'})
    assert (root / "groups.cmake").stat().st_mtime_ns == before
    listed = root / "list.txt"
    listed.write_text(listed.read_text() + f"room\t{root}/src/room/gone.cpp\n")
    subprocess.run([sys.executable, str(root / "cmake/together.py"), str(listed), str(root / "groups.cmake"), "6"], check=True)
    assert f"{root}/src/room/gone.cpp" in (root / "groups.d").read_text()
print("sources go together")
