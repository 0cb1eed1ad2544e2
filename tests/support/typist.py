"""How long an editor waits while somebody types into a long script: typist.py [LINES]... Not a test itself.

Types 20 letters, each followed by the questions that editors ask at once (hover, completion), as fast as they are answered, and
prints the slowest answer; then what is asked about the whole text, the diagnostics, and 20 keys at once. In milliseconds on the clock, and
in parentheses of the server's own work.
"""

import pathlib
import sys
import time

import editor

PART = """base{0} = location(41.1780, -8.5980, 90)
west{0} = mission {{
  name 'West half {0}'
  home base{0}
  takeOff base{0}, 20
  surveyArea 80, 60, 20, 'NORTH_WEST'
}}
scout{0} = pick {{ type 'UAV'; timeout 60.seconds }}
execute scout{0}: waitFor {{ battery(scout{0}) > 0.9 }} then west{0}
release scout{0}
"""


def cpu_ms(someone: editor.Editor) -> float:
    """What the server has worked so far: what a busy machine does not change."""
    return int(pathlib.Path(f"/proc/{someone.process.pid}/schedstat").read_text().split()[0]) / 1e6


def figures(lines: int) -> list[str]:
    text = "".join(PART.format(i) for i in range(lines // 10)) + "\nmessage \n"
    line, column = text.count("\n") - 1, len("message ")
    someone = editor.Editor()
    someone.initialize()
    took: dict[str, tuple[float, float]] = {}

    def measure(what: str, action):
        """The slowest of that name: milliseconds on the clock, and of the server's work."""
        begin, worked = time.perf_counter(), cpu_ms(someone)
        action()
        once = ((time.perf_counter() - begin) * 1000, cpu_ms(someone) - worked)
        took[what] = tuple(map(max, took.get(what, once), once))

    def change(version: int, at: int, letter: str):
        place = {"line": line, "character": at}
        someone.change({"range": {"start": place, "end": place}, "text": letter}, version=version)

    def ask(method: str, at: int = 0):
        whole = {"start": {"line": line - 40, "character": 0}, "end": {"line": line, "character": 0}}
        return someone.ask(f"textDocument/{method}", someone.at(line, at, range=whole))

    def key(number: int, method: str):
        change(number, column, "b")
        ask(method, column + 1)

    measure("open", lambda: someone.open(text))
    for number in range(20):
        measure("key and hover", lambda: key(2 + number, "hover"))
    for number in range(20):
        measure("key and completion", lambda: key(30 + number, "completion"))
    for method in ("semanticTokens/full", "inlayHint", "foldingRange", "documentSymbol"):
        measure(method, lambda: ask(method))
    ask("codeAction")
    someone.notices.clear()
    measure("diagnostics after a key", lambda: (change(60, column, "x"), someone.diagnostics()))
    measure("20 keys, then hover", lambda: ([change(70 + one, column, "x") for one in range(20)], ask("hover", column)))
    someone.ask("shutdown", None)
    someone.notify("exit", {})
    someone.process.wait()
    return [f"{what} {on_clock:.1f} ms ({worked:.1f})" for what, (on_clock, worked) in took.items()]


def main():
    for lines in [int(one) for one in sys.argv[1:]] or [300, 5000, 20000]:
        print(f"{lines} lines: {', '.join(figures(lines))}")


if __name__ == "__main__":
    main()
