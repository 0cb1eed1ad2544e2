"""What a reader does with the documents: scripts (```dolphin), commands (```sh), and the ```text that is shown behind them.
Not a test itself.

Words behind `dolphin` say what a block shows:

    mistake     it must not check; the text is what `lapwing check` says
    warns       it checks, with warnings; the text is what `lapwing check` says
    continues   it goes on where the block before ended, and is read together with it
    events      the text has the events of its tasks too (`--events -`), but for who was chosen (ALLOC)
    flown=SPEC  it is flown on simulated vehicles (`run --sim SPEC`) instead of the test platform
    driven=FILE it is carried out by a robot in that simulated building (`run --robot sim:FILE`)
    exit=N      how a run of it ends, 0 if left out
    input=A|B   the answers to its questions
    picture=P   docs/pictures/plan-P.svg is its dry run
    file=NAME   the reader saves it so; my.dolphin if left out

Every other block is run on the test platform; the text is what it writes, warnings and errors of the log behind it.

Words behind `sh` say what a reader has at hand; each line ends with exit code 0 unless they say otherwise, and writes the lines
of the text among others:

    background     it goes on while the rest of the page is read,
    until=TEXT     from when it has written this
    ends=VERB      the reader ends `lapwing VERB` first
    vehicles=SPEC  vehicles send to UDP port 14550
    beside=VERB    `lapwing VERB` runs
    exit=N|M       how it may end
    skipped=WHY    no test can do this: it installs, or ends never
"""

import dataclasses
import pathlib
import re
import sys

FENCE = re.compile(r"^```(\w*) ?(.*)$")
SCRIPT_WORDS = ("mistake", "warns", "continues", "events", "flown", "driven", "exit", "input", "picture", "file")
COMMAND_WORDS = ("background", "until", "ends", "vehicles", "beside", "exit", "skipped")


@dataclasses.dataclass
class Fence:
    """A fenced block as it stands on the page."""

    page: pathlib.Path
    line: int
    language: str
    info: str
    lines: list[str]

    @property
    def end(self) -> int:
        return self.line + len(self.lines) + 1

    def words(self, known: tuple[str, ...]) -> dict[str, str]:
        words = dict(re.match(r"(\w+)=?(.*)", word).groups() for word in self.info.split())
        for word in words:
            if word not in known:
                raise SystemExit(f"{self.page.name}:{self.line}: unknown word behind {self.language}: {word}")
        return words


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


@dataclasses.dataclass
class Commands(Block):
    """Lines for a terminal; what stands behind a # is for people."""


def fences_of(page: pathlib.Path) -> list[Fence]:
    fences: list[Fence] = []
    is_open = False
    for number, line in enumerate(page.read_text().splitlines(), start=1):
        fence = FENCE.match(line)
        if fence and not is_open:
            fences.append(Fence(page, number, fence[1], fence[2], []))
        elif not fence and is_open:
            fences[-1].lines.append(line)
        is_open = is_open != bool(fence)
    return fences


def steps_of(page: pathlib.Path) -> list[Block]:
    """Scripts and commands in order, with the texts that stand behind them."""
    steps: list[Block] = []
    scripts: list[Block] = []
    last_end = -2
    for fence in fences_of(page):
        if fence.language == "dolphin":
            words = fence.words(SCRIPT_WORDS)
            scripts.append(Block(page, fence.line, words, fence.lines, scripts[-1] if "continues" in words else None))
            steps.append(scripts[-1])
        elif fence.language == "sh":
            steps.append(Commands(page, fence.line, fence.words(COMMAND_WORDS), fence.lines))
        else:
            if fence.language == "text" and fence.line - last_end <= 2:
                steps[-1].text, steps[-1].text_line = fence.lines, fence.line
            continue
        last_end = fence.end
    return steps


def blocks_of(page: pathlib.Path) -> list[Block]:
    """The scripts alone."""
    return [step for step in steps_of(page) if not isinstance(step, Commands)]


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
