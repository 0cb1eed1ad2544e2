"""lapwing lsp, driven by messages as editors send them: questions, changes, nonsense, and its end."""

import statistics
import time

import harness
from editor import URI, Editor, applied

SCRIPT = """// Where everybody starts.
base = location(41.1780, -8.5980, 90)
west = mission {
  name 'West half'
  home base
  takeOff location(41.1780, -8.5980, 110), 20
  surveyArea 80, 60, 20, 'NORTH_WEST'
}
scout = pick { type 'UAV'; timeout 60.seconds }
execute scout: waitFor { battery(scout) > 0.9 } then west
"""


def labels(completion):
    return {item["label"] for item in completion["items"]}


def place_of(text: str, words: str, into: int = 0):
    before = text[: text.index(words) + into]
    return before.count("\n"), len(before) - before.rfind("\n") - 1


editor = Editor()
can = editor.initialize()["capabilities"]
assert can["hoverProvider"] and can["renameProvider"]["prepareProvider"] and can["positionEncoding"] == "utf-16"
assert editor.open(SCRIPT) == []

# Questions about words.
hover = editor.ask("textDocument/hover", editor.at(*place_of(SCRIPT, "takeOff", 3)))
assert all(word in hover["contents"]["value"] for word in ("takeOff pos, pitch = 15", "degrees", "mission")), hover
hover = editor.ask("textDocument/hover", editor.at(*place_of(SCRIPT, "home base", 6)))
assert "a position" in hover["contents"]["value"] and "Where everybody starts." in hover["contents"]["value"], hover
assert editor.ask("textDocument/hover", editor.at(1, 5)) is None
(target,) = editor.ask("textDocument/definition", editor.at(*place_of(SCRIPT, "then west", 6)))
assert target["uri"] == URI and target["range"]["start"] == {"line": 2, "character": 0}, target
help_ = editor.ask("textDocument/signatureHelp", editor.at(*place_of(SCRIPT, "60, 20")))
assert help_["activeParameter"] == 1 and help_["signatures"][help_["activeSignature"]]["parameters"][1]["label"] == "width"
outline = editor.ask("textDocument/documentSymbol", {"textDocument": {"uri": URI}})
assert [one["name"] for one in outline] == ["base", "west", "scout"], outline

# Completion: in the block, behind a point, in quotes.
assert {"takeOff", "speed", "returnHomeAndLand"} <= labels(editor.ask("textDocument/completion", editor.at(*place_of(SCRIPT, "takeOff"))))
assert {"minutes", "km"} <= labels(editor.ask("textDocument/completion", editor.at(*place_of(SCRIPT, "seconds", 2))))
assert labels(editor.ask("textDocument/completion", editor.at(*place_of(SCRIPT, "UAV", 1)))) == {"UAV", "UGV", "USV", "UUV"}

# Rename: everywhere, keys and all; refused where it would break something.
where = editor.at(*place_of(SCRIPT, "battery(scout)", 9))
assert editor.ask("textDocument/prepareRename", where)["placeholder"] == "scout"
edits = editor.ask("textDocument/rename", {**where, "newName": "first"})["changes"][URI]
renamed = applied(SCRIPT, edits)
assert "first = pick" in renamed and "execute first: waitFor { battery(first)" in renamed and "scout" not in renamed
assert editor.refuse("textDocument/rename", {**where, "newName": "west"})["code"] == -32803
assert editor.refuse("textDocument/rename", {**where, "newName": "pick"})["code"] == -32602

# Changes: incremental ones in UTF-16 units, several at once; mistakes appear and vanish.
line = SCRIPT.count("\n")
end = {"start": {"line": line, "character": 0}, "end": {"line": line, "character": 0}}
editor.change({"range": end, "text": "message '🐦' + bass\n"})
(mistake,) = editor.diagnostics()
assert mistake["code"] == "unknown-name" and mistake["range"]["start"] == {"line": line, "character": 15}, mistake
assert "did you mean base?" in mistake["message"]
(fix,) = editor.ask("textDocument/codeAction", {"textDocument": {"uri": URI}, "range": mistake["range"], "context": {"diagnostics": [mistake]}})
assert fix["edit"]["changes"][URI] == [{"range": mistake["range"], "newText": "base"}], fix
editor.change({"range": mistake["range"], "text": "base"}, {"range": end, "text": "x=1\n"}, version=3)
assert editor.diagnostics() == []
assert editor.ask("textDocument/semanticTokens/full", {"textDocument": {"uri": URI}})["data"]

# Twenty keys at once are one check: x=1 becomes x=yyy...1.
behind = {"line": line, "character": 2}
editor.write(
    b"".join(
        editor.framed({"method": "textDocument/didChange", "params": {"textDocument": {"uri": URI, "version": 4 + key},
                       "contentChanges": [{"range": {"start": behind, "end": behind}, "text": "y"}]}})
        for key in range(20)
    )
)
(mistake,) = editor.diagnostics()
assert mistake["code"] == "unknown-name" and mistake["range"]["end"]["character"] == 23, mistake
hover = editor.ask("textDocument/hover", editor.at(*place_of(SCRIPT, "scout = pick", 2)))
assert editor.notices == [], "the diagnostics were told once"
assert "vehicles" in hover["contents"]["value"], hover

# Each mistake with one way out has a fix.
wrong = "v = pick { type: 'UAV' }\nexecute v: { message 'x' }\nidle(5)\n"
editor.change({"text": wrong}, version=30)
mistakes = editor.diagnostics()
whole = {"start": {"line": 0, "character": 0}, "end": {"line": 9, "character": 0}}
fixes = editor.ask("textDocument/codeAction", {"textDocument": {"uri": URI}, "range": whole, "context": {"diagnostics": mistakes}})
mended = applied(wrong, [edit for fix in fixes for edit in fix["edit"]["changes"][URI]])
assert mended == "v = pick { type 'UAV' }\nexecute v: action { message 'x' }\nexecute idle(5)\n", (mended, fixes)

# What an editor draws: folds, words between the words, selections, symbols.
editor.change({"text": SCRIPT}, version=31)
editor.diagnostics()
about = {"textDocument": {"uri": URI}, "range": whole}
assert {"startLine": 2, "endLine": 6} in editor.ask("textDocument/foldingRange", about)
hints = [hint["label"] for hint in editor.ask("textDocument/inlayHint", about)]
assert "len:" in hints and " m" in hints and " 20 m above home" in hints, hints
(chosen,) = editor.ask("textDocument/selectionRange", {"textDocument": {"uri": URI}, "positions": [{"line": 5, "character": 4}]})
assert chosen["parent"]["range"]["start"] == {"line": 5, "character": 2}, chosen
assert [one["name"] for one in editor.ask("workspace/symbol", {"query": "SCT"})] == ["scout"]

# Formatting gives the edits that lapwing fmt makes.
ugly = "x=1\nif(x){\n      message x\n}\n"
editor.change({"text": ugly}, version=40)
editor.diagnostics()
edits = editor.ask("textDocument/formatting", {"textDocument": {"uri": URI}, "options": {"tabSize": 8, "insertSpaces": False}})
assert applied(ugly, edits) == "x = 1\nif (x) {\n  message x\n}\n", edits
part = {"start": {"line": 2, "character": 0}, "end": {"line": 2, "character": 3}}
edits = editor.ask("textDocument/rangeFormatting", {"textDocument": {"uri": URI}, "range": part, "options": {}})
assert applied(ugly, edits) == "x=1\nif(x){\n  message x\n}\n", edits

# A request that was cancelled before its turn is answered so. All three messages arrive in one piece.
editor.write(
    editor.framed({"id": "a", "method": "textDocument/hover", "params": editor.at(0, 0)})
    + editor.framed({"id": "b", "method": "textDocument/hover", "params": editor.at(0, 0)})
    + editor.framed({"method": "$/cancelRequest", "params": {"id": "b"}})
)
assert "result" in editor.answer("a")
assert editor.answer("b")["error"]["code"] == -32800

# Nonsense is answered, and the next message is understood.
assert editor.refuse("textDocument/dance", {})["code"] == -32601
assert editor.refuse("textDocument/hover", editor.at(0, 0) | {"textDocument": {"uri": "file:///other"}})["code"] == -32602
editor.notify("$/whatever", {})
for noise, code in (
    (b"Content-Length: 7\r\n\r\n{\"id\":]", -32700),
    (b"Content-Length: 2\r\n\r\n[]", -32600),
    (b"Content-Length: banana\r\n\r\n", -32700),
    (b"no header at all\r\n\r\n", -32700),
    (b"Content-Length: 50000000\r\n\r\n" + b"x" * 50000000, -32700),
    (b"Content-Length: 99999999999999999999999999\r\n\r\n{\"id\":1}", -32700),
):
    editor.write(noise)
    message = editor.receive(60)
    assert message["error"]["code"] == code and message["id"] is None, (noise[:60], message)
assert editor.ask("textDocument/hover", editor.at(0, 0))["contents"]["value"]

# 2,000 lines: questions are answered at once.
long = "".join(SCRIPT.replace("base", f"b{i}").replace("west", f"w{i}").replace("scout", f"s{i}") for i in range(200))
begin = time.perf_counter()
editor.change({"text": long}, version=50)
editor.diagnostics()
read_ms = (time.perf_counter() - begin) * 1000
line = long.count("\n") - 1
figures = {}
for method, column in (("hover", 10), ("completion", 25)):
    took = []
    for _ in range(21):
        begin = time.perf_counter()
        editor.ask(f"textDocument/{method}", editor.at(line, column))
        took.append((time.perf_counter() - begin) * 1000)
    figures[method] = statistics.median(took)
print(f"{line + 1} lines: read and checked {read_ms:.1f} ms after a key, hover {figures['hover']:.2f} ms, completion {figures['completion']:.2f} ms")
assert figures["hover"] < 200 and figures["completion"] < 200, figures

# The end: shutdown, then exit.
assert editor.ask("shutdown", None) is None
assert editor.refuse("textDocument/hover", editor.at(0, 0))["code"] == -32600
editor.notify("exit", {})
assert editor.end() == (0, ""), "shutdown and exit end with 0"

early = Editor()
assert early.refuse("textDocument/hover", early.at(0, 0))["code"] == -32002
early.notify("exit", {})
assert early.end()[0] == 1, "exit without shutdown ends with 1"

gone = Editor()
gone.initialize()
assert gone.end()[0] == 1, "an editor that goes away ends the server"
print("an editor is served")
