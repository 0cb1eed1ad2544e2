"""An editor that talks to `lapwing lsp`: the base protocol of LSP 3.17 over the program's standard streams."""

import json
import os
import select
import subprocess
import time

import harness

URI = "file:///script.dolphin"


class Editor:
    def __init__(self):
        self.process = subprocess.Popen([harness.LAPWING, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.unread = b""
        self.notices = []
        self.last_id = 0

    def write(self, raw: bytes):
        self.process.stdin.write(raw)
        self.process.stdin.flush()

    @staticmethod
    def framed(message: dict) -> bytes:
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        return b"Content-Length: %d\r\n\r\n%s" % (len(body), body)

    def send(self, message: dict):
        self.write(self.framed(message))

    def receive(self, seconds: float = 20) -> dict:
        """The next message; anything else on standard output fails."""
        deadline = time.monotonic() + seconds
        while b"\r\n\r\n" not in self.unread:
            self._read_more(deadline)
        header, rest = self.unread.split(b"\r\n\r\n", 1)
        assert header.startswith(b"Content-Length: ") and b"\n" not in header, f"no message: {self.unread[:200]!r}"
        length = int(header[16:])
        self.unread = rest
        while len(self.unread) < length:
            self._read_more(deadline)
        body, self.unread = self.unread[:length], self.unread[length:]
        message = json.loads(body)
        assert message["jsonrpc"] == "2.0", message
        return message

    def _read_more(self, deadline: float):
        left = deadline - time.monotonic()
        assert left > 0 and select.select([self.process.stdout], [], [], left)[0], "no answer in time"
        piece = os.read(self.process.stdout.fileno(), 65536)
        assert piece, f"the server is gone: {self.process.stderr.read().decode()}"
        self.unread += piece

    def notify(self, method: str, params: dict):
        self.send({"method": method, "params": params})

    def start(self, method: str, params) -> int:
        self.last_id += 1
        self.send({"id": self.last_id, "method": method, "params": params})
        return self.last_id

    def answer(self, wanted) -> dict:
        """The answer to a request; notifications before it are kept."""
        while True:
            message = self.receive()
            if "method" in message:
                self.notices.append(message)
                continue
            assert message["id"] == wanted, message
            return message

    def ask(self, method: str, params):
        message = self.answer(self.start(method, params))
        assert "result" in message, message
        return message["result"]

    def refuse(self, method: str, params) -> dict:
        return self.answer(self.start(method, params))["error"]

    def diagnostics(self) -> list:
        while not self.notices:
            self.notices.append(self.receive())
        notice = self.notices.pop(0)
        assert notice["method"] == "textDocument/publishDiagnostics", notice
        return notice["params"]["diagnostics"]

    def at(self, line: int, character: int, **more) -> dict:
        return {"textDocument": {"uri": URI}, "position": {"line": line, "character": character}, **more}

    def initialize(self):
        capabilities = {"textDocument": {"completion": {"completionItem": {"snippetSupport": True}}}}
        result = self.ask("initialize", {"processId": None, "rootUri": None, "capabilities": capabilities})
        self.notify("initialized", {})
        return result

    def open(self, text: str) -> list:
        self.notify("textDocument/didOpen", {"textDocument": {"uri": URI, "languageId": "dolphin", "version": 1, "text": text}})
        return self.diagnostics()

    def change(self, *changes: dict, version: int = 2):
        self.notify("textDocument/didChange", {"textDocument": {"uri": URI, "version": version}, "contentChanges": list(changes)})

    def end(self, seconds: float = 10) -> tuple:
        """The exit code and what was written to standard error."""
        out, err = self.process.communicate(timeout=seconds)
        assert out == b"" and self.unread == b"", f"left on standard output: {self.unread + out!r}"
        return self.process.returncode, err.decode()


def applied(text: str, edits: list) -> str:
    """The text after edits that do not overlap; ASCII only."""
    lines = text.splitlines(keepends=True)
    starts = [sum(map(len, lines[:i])) for i in range(len(lines) + 1)]

    def offset(position):
        return starts[position["line"]] + position["character"]

    for edit in sorted(edits, key=lambda one: offset(one["range"]["start"]), reverse=True):
        text = text[: offset(edit["range"]["start"])] + edit["newText"] + text[offset(edit["range"]["end"]) :]
    return text
