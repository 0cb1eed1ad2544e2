"""Wrong arguments end with exit code 2, a busy port with 3, and both with words that help."""

import pathlib
import socket
import tempfile

import harness


def explained(expected, *arguments, words):
    out, err = harness.expect_exit(expected, *arguments, seconds=30)
    for word in words:
        assert word in out + err, f"lapwing {' '.join(arguments)}: no {word!r} in\n{out}\n{err}"


def same(*ways):
    """Each way to ask gets the same answer, and exit code 0."""
    answers = {harness.expect_exit(0, *way, seconds=30) for way in ways}
    assert len(answers) == 1, answers


same(["help"], ["--help"])
same(["help", "run"], ["run", "--help"])
same(["help", "mission", "upload"], ["mission", "upload", "--help"])
explained(2, "help", "fly", words=["there is no command 'fly'"])
explained(2, "hlep", words=["help"])

with tempfile.TemporaryDirectory() as folder:
    script = pathlib.Path(folder, "ok.dolphin")
    script.write_text("message 'ok'")
    explained(2, words=["subcommand"])
    explained(2, "fly", words=["fly"])
    explained(2, "run", words=["script"])
    explained(2, "run", str(pathlib.Path(folder, "missing.dolphin")), "--sim", "copter:1", words=["missing.dolphin", "no such file"])
    explained(2, "run", str(script), "--link", "udp-in:14550", words=["udp-in:14550", "udpin://"])
    explained(2, "run", str(script), "--sim", "submarine:2", words=["submarine", "copter"])
    explained(2, "run", str(script), "--sim", "copter:1", "--on-stop", "hover", words=["hover", "loiter"])
    explained(2, "sim", "--vehicles", "copter:0", "--out", "udpout://127.0.0.1:1", words=["'0'", "copter:2"])
    explained(2, "sim", "--vehicles", "copter:1", "--home", "41,200,0", words=["41,200,0"])
    explained(2, "run", str(script), "--sim", "copter:1", "--home", "41", words=["41", "LAT,LON,ALT"])
    explained(2, "check", folder, words=[folder])

    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as busy:
        busy.bind(("127.0.0.1", 0))
        port = busy.getsockname()[1]
        explained(3, "run", str(script), "--link", f"udpin://127.0.0.1:{port}", words=[str(port), "in use"])
    with socket.socket() as busy:
        busy.bind(("127.0.0.1", 0))
        busy.listen()
        port = busy.getsockname()[1]
        explained(3, "demo", "--port", str(port), words=[str(port), "in use", "--port"])
print("every mistake was explained")
