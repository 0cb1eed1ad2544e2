"""Sources that can be compiled as one, each after the other: what they include is then read once for all of them.

usage: together.py LIST OUT.cmake. The list has a line "target<TAB>source" for each source; what is written sets CMake's UNITY_GROUP.
A file that would say the same as before is left as it is, so that CMake runs again only if the groups changed.
"""

import collections
import collections.abc
import functools
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
# What a line at the left edge declares: of a type the word after its kind, else the last word before its parameters or its value.
TYPE = re.compile(r"^(?:template <.*> )?(?:struct|class|enum class|enum|union|concept) (\w+)|^(?:template <.*> )?using (\w+) =")
VALUE = re.compile(r"^(?:extern \"C\" )?[\w:<>,*&\[\] ]*?(?<!:)\b(\w+)\s*(?:\[\w*\])?[({=;]")
MACRO = re.compile(r"^#define (\w+)")
NOT_A_NAME = ("using ", "namespace ", "TEST", "INSTANTIATE_", "static_assert", "BENCHMARK")
# A second meaning to a namesake in another source's headers, but none to the same line in another source.
USING = re.compile(r"^using [\w:]+::(\w+);", re.MULTILINE)
# What brings names to all that follow in a group: only files go together that bring the same ones. Units of time do no harm.
OPENS = re.compile(r"^using (?:enum|namespace) (?!std::\w+_literals;).*", re.MULTILINE)


def names_in(text: str, is_source: bool = True) -> set[str]:
    """Names at the outermost level, which clang-format puts at the left edge; a few too many do no harm. Of a header only types count:
    functions of one name get along."""
    names = set()
    for line in text.splitlines():
        if is_source and (found := MACRO.match(line)):
            names.add(found[1])
        if not line[:1].isalpha():
            continue
        if found := TYPE.match(line):
            names.add(found[1] or found[2])
        elif is_source and not line.startswith(NOT_A_NAME) and (found := VALUE.match(line)):
            names.add(found[1])
    return names


@functools.cache
def headers_of(file: pathlib.Path) -> frozenset[pathlib.Path]:
    """Of the repository, which a file names itself."""
    wanted = INCLUDE.findall(file.read_text())
    return frozenset(path for name in wanted for path in (file.parent / name, ROOT / "src" / name) if path.is_file())


@functools.cache
def types_in(header: pathlib.Path) -> frozenset[tuple[pathlib.Path, str]]:
    return frozenset((header, name) for name in names_in(header.read_text(), is_source=False))


def brought(file: pathlib.Path) -> set[tuple[pathlib.Path, str]]:
    """Types of the headers that a file reads, directly or not; two headers may have two of one name, each in its room."""
    seen: set[pathlib.Path] = set()
    ahead = set(headers_of(file))
    while ahead:
        seen |= ahead
        ahead = set().union(*(headers_of(one) for one in ahead)) - seen
    return set().union(*(types_in(header) for header in seen))


class Group:
    """Sources that go together."""

    def __init__(self) -> None:
        self.files: list[str] = []
        self._names: set[str] = set()
        self._used: set[str] = set()
        self._brought: set[tuple[pathlib.Path, str]] = set()

    def takes(self, names: set[str], used: set[str], types: set[tuple[pathlib.Path, str]]) -> bool:
        # What a source declares or uses has a second meaning only by headers that it does not read itself.
        strange_to_it = {name for _, name in self._brought - types}
        strange_to_us = {name for _, name in types - self._brought}
        return not (names & self._names or (names | used) & strange_to_it or (self._names | self._used) & strange_to_us)

    def add(self, file: str, names: set[str], used: set[str], types: set[tuple[pathlib.Path, str]]) -> None:
        self.files.append(file)
        self._names |= names
        self._used |= used
        self._brought |= types


def groups(files: collections.abc.Iterable[str], kind: collections.abc.Callable[[str], object], most: int) -> list[list[str]]:
    """Files of one kind, at most so many, none of which declares what another one of its group declares, too."""
    packed: dict[object, list[Group]] = collections.defaultdict(list)
    for file in files:
        path = pathlib.Path(file)
        text = path.read_text() if path.exists() else ""
        types = brought(path) if text else set()
        names = names_in(text)
        used = set(USING.findall(text))
        alike = packed[kind(file), frozenset(OPENS.findall(text))]
        for group in alike:
            if len(group.files) < most and group.takes(names, used, types):
                break
        else:
            group = Group()
            alike.append(group)
        group.add(file, names, used, types)
    return [group.files for of_kind in packed.values() for group in of_kind]


def main() -> None:
    listed, out, most = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), int(sys.argv[3])
    of_target: dict[str, list[str]] = collections.defaultdict(list)
    for line in listed.read_text().splitlines():
        target, source = line.split("\t")
        of_target[target].append(source)
    lines = []
    for target, sources in of_target.items():
        for number, together in enumerate(groups(sources, lambda _: None, most)):
            words = " ".join(f'"{source}"' for source in together)
            group = f"PROPERTIES UNITY_GROUP {number}" if len(together) > 1 else "PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON"
            lines.append(f"set_source_files_properties({words} TARGET_DIRECTORY {target} {group})\n")
    said = "".join(lines)
    if not out.exists() or out.read_text() != said:
        out.write_text(said)
    # A source that is gone must not stop the build before CMake learns that it is gone: so they are told in a file, not in a rule.
    out.with_suffix(".d").write_text(f"{out}: {' '.join(source for sources in of_target.values() for source in sources)}\n")


if __name__ == "__main__":
    main()
