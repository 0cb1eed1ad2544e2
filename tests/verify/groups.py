"""Files that can be read as one, each after the other: what they include is then read once for all of them."""

import collections
import collections.abc
import pathlib
import re

# What a line at the left edge declares: of a type the word after its kind, else the last word before its parameters or its value.
TYPE = re.compile(r"^(?:template <.*> )?(?:struct|class|enum class|enum|union|concept) (\w+)|^(?:template <.*> )?using (\w+) =")
VALUE = re.compile(r"^(?:extern \"C\" )?[\w:<>,*&\[\] ]*?(?<!:)\b(\w+)\s*(?:\[\w*\])?[({=;]")
NOT_A_NAME = ("using ", "namespace ", "TEST", "INSTANTIATE_", "static_assert", "BENCHMARK")
# More take more memory than they save time.
MOST_FILES = 12


def declared(text: str) -> set[str]:
    """Names at the outermost level, which clang-format puts at the left edge; a few too many do no harm."""
    names = set()
    for line in text.splitlines():
        if not line[:1].isalpha():
            continue
        if found := TYPE.match(line):
            names.add(found[1] or found[2])
        elif not line.startswith(NOT_A_NAME) and (found := VALUE.match(line)):
            names.add(found[1])
    return names


def groups(files: collections.abc.Iterable[str], kind: collections.abc.Callable[[str], object]) -> list[list[str]]:
    """Files of one kind, none of which declares what another one of its group declares, too."""
    packed: dict[object, list[tuple[list[str], set[str]]]] = collections.defaultdict(list)
    for file in files:
        names = declared(pathlib.Path(file).read_text())
        for together, taken in packed[kind(file)]:
            if len(together) < MOST_FILES and not names & taken:
                together.append(file)
                taken |= names
                break
        else:
            packed[kind(file)].append(([file], names))
    return [together for of_kind in packed.values() for together, _ in of_kind]
