"""The scripts in the documents: fenced blocks of ```dolphin, and the ```text behind some of them. Not a test itself.

Words behind `dolphin` say what a block shows:

    mistake     it must not check; the text is what `lapwing check` says
    warns       it checks, with warnings; the text is what `lapwing check` says
    continues   it goes on where the block before ended, and is read together with it
    events      the text has the events of its tasks too (`--events -`), but for who was chosen (ALLOC)
    checked     it is checked and not run
    exit=N      how a run of it ends, 0 if left out
    input=A|B   the answers to its questions
    picture=P   docs/pictures/plan-P.svg is its dry run

Every other block is run on the test platform; the text is what it writes, warnings and errors of the log behind it.
"""

import dataclasses
import pathlib
import re
import sys

FENCE = re.compile(r"^```(\w*) ?(.*)$")


@dataclasses.dataclass
class Block:
    page: pathlib.Path
    line: int  # of the fence
    words: dict[str, str]
    lines: list[str]
    before: "Block | None" = None  # the block that it continues
    text: list[str] | None = None
    text_line: int = 0  # of the fence of the text

    @property
    def own(self) -> str:
        return "\n".join(self.lines) + "\n"

    @property
    def script(self) -> str:
        return (self.before.script if self.before else "") + self.own

    @property
    def place(self) -> str:
        return f"{self.page.name}:{self.line}"


def words_of(info: str) -> dict[str, str]:
    known = ("mistake", "warns", "continues", "events", "checked", "exit", "input", "picture")
    pairs = (re.match(r"(\w+)=?(.*)", word).groups() for word in info.split())
    words = dict(pairs)
    for word in words:
        if word not in known:
            raise SystemExit(f"unknown word behind dolphin: {word}")
    return words


def blocks_of(page: pathlib.Path) -> list[Block]:
    blocks: list[Block] = []
    language, info, begin, lines, last_end = None, "", 0, [], -2
    for number, line in enumerate(page.read_text().splitlines(), start=1):
        fence = FENCE.match(line)
        if language is None:
            if fence:
                language, info, begin, lines = fence[1], fence[2], number, []
            continue
        if not fence:
            lines.append(line)
            continue
        if language == "dolphin":
            words = words_of(info)
            blocks.append(Block(page, begin, words, lines, blocks[-1] if "continues" in words else None))
            last_end = number
        elif language == "text" and begin - last_end <= 2:
            blocks[-1].text, blocks[-1].text_line = lines, begin
        language = None
    return blocks


def replace_texts(page: pathlib.Path, fresh: dict[int, list[str]]):
    """Puts lines in the place of the text blocks whose fences stand in these lines."""
    out, skips = [], False
    for number, line in enumerate(page.read_text().splitlines(), start=1):
        if skips and line != "```":
            continue
        skips = False
        out.append(line)
        if number in fresh:
            out += fresh[number]
            skips = True
    page.write_text("\n".join(out) + "\n")


def main():
    """documents.py PAGE PICTURE: prints the script of that picture."""
    page, picture = pathlib.Path(sys.argv[1]), sys.argv[2]
    for block in blocks_of(page):
        if block.words.get("picture") == picture:
            print(block.script, end="")
            return
    raise SystemExit(f"{page} has no block with picture={picture}")


if __name__ == "__main__":
    main()
