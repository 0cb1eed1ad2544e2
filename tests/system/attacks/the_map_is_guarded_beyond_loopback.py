"""Beyond loopback the map needs a token: refused without one, 401 or an open door with one, over HTTP and WebSocket; and no
log line holds it. The station's file is checked whole before anything starts."""

import base64
import contextlib
import http.client
import json
import os
import pathlib
import re
import signal
import socket
import subprocess
import tempfile

import harness
import map_client


def status_of(port, path="/api/v1/status", **headers):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=10)
    with contextlib.closing(connection):
        connection.request("GET", path, headers={name.replace("_", "-"): value for name, value in headers.items()})
        answer = connection.getresponse()
        return answer.status, answer.read()


def websocket_status(port, query="", path="/api/v1/ws", **headers):
    upgrade = {
        "Upgrade": "websocket",
        "Connection": "Upgrade",
        "Sec_WebSocket_Version": "13",
        "Sec_WebSocket_Key": base64.b64encode(os.urandom(16)).decode(),
    }
    with socket.create_connection(("127.0.0.1", port), timeout=10) as raw:
        lines = [f"GET {path}{query} HTTP/1.1", f"Host: 127.0.0.1:{port}"]
        lines += [f"{name.replace('_', '-')}: {value}" for name, value in {**upgrade, **headers}.items()]
        raw.sendall("\r\n".join([*lines, "", ""]).encode())
        return int(raw.recv(100).split()[1])


@contextlib.contextmanager
def station(*arguments, secret=None):
    """A station on every address and a free port; gives (port, token in the printed address) and checks what it said: a `secret`
    nowhere, a token that was made up in the map's address alone."""
    link = f"udpin://127.0.0.1:{harness.free_udp_port()}"
    command = [harness.LAPWING, "station", "--link", link, "--port", "0", *arguments]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    try:
        said = map_client.said_before_listening(process)
        address = re.search(r"http://127\.0\.0\.1:(\d+)/(?:#token=(\S+))?", said)
        assert address, said
        yield int(address[1]), address[2]
    finally:
        process.send_signal(signal.SIGINT)
        said += process.communicate(timeout=20)[1]
    assert process.returncode == 0, process.returncode
    assert secret is None or secret not in said, said
    if address[2]:
        logged = [line for line in said.splitlines() if address[2] in line and not line.startswith("    map  http")]
        assert not logged, logged


def is_guarded(port, token):
    bearer = {"Authorization": f"Bearer {token}"}
    assert status_of(port)[0] == 401
    assert status_of(port, Authorization="Bearer " + "0" * len(token))[0] == 401
    code, body = status_of(port, **bearer)
    assert code == 200 and json.loads(body)["protocol"] == 1
    assert status_of(port, "/")[0] in (200, 404), "the app itself holds no secret"
    assert websocket_status(port) == 401
    assert websocket_status(port, "?token=wrong") == 401
    assert websocket_status(port, f"?token={token}") == 101
    assert websocket_status(port, f"?token={token}", "/api/v1/status") == 401, "the address is for the WebSocket alone"
    assert status_of(port, f"/api/v1/status?token={token}", Upgrade="websocket")[0] == 401
    assert websocket_status(port, f"?token={token}", Origin="http://evil.example") == 403
    assert websocket_status(port, f"?token={token}", Origin=f"http://127.0.0.1:{port}") == 101
    assert status_of(port, Host="evil.example", **bearer)[0] == 403, "DNS rebinding"


link = ("--link", f"udpin://127.0.0.1:{harness.free_udp_port()}")  # the default port may be another test's
for verb in (("station", *link), ("demo",)):
    out, err = harness.expect_exit(2, *verb, "--bind", "0.0.0.0", "--port", "0", seconds=30)
    assert "--generate-token" in err and "--token-file" in err, err

with station("--bind", "0.0.0.0", "--generate-token") as (port, token):
    assert len(token) == 48, token
    is_guarded(port, token)

with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder, "station.token")
    file.write_text("a-token-of-our-own-choice\n")
    file.chmod(0o644)
    out, err = harness.expect_exit(2, "station", *link, "--bind", "0.0.0.0", "--token-file", str(file), seconds=30)
    assert f"chmod 600 {file}" in err and "a-token-of-our-own-choice" not in err, err
    file.chmod(0o600)

    config = pathlib.Path(folder, "station.toml")
    config.write_text('links = ["udp:1"]\n[web]\nprot = 1\nport = "x"\n')
    out, err = harness.expect_exit(2, "station", "--config", str(config), seconds=30)
    for words in (f"{config}:1:10: error", f"{config}:3:1: error", "did you mean port?", f"{config}:4:8: error", "3 mistakes"):
        assert words in err, f"no {words!r} in\n{err}"

    config.write_text('[web]\nbind = "0.0.0.0"\nport = 1\ntoken_file = "station.token"\n[map]\nsite = "Field"\nscripts = "."\n')
    pathlib.Path(folder, "mine.dolphin").write_text("message 'mine'\n")
    secret = "a-token-of-our-own-choice"
    with station("--config", str(config), secret=secret) as (port, shown):  # --port 0 goes before the file's
        assert shown is None
        token = secret
        is_guarded(port, token)
        assert json.loads(status_of(port, Authorization=f"Bearer {token}")[1])["site"]["name"] == "Field"
        names = json.loads(status_of(port, "/api/v1/scripts", Authorization=f"Bearer {token}")[1])
        assert names == {"scripts": [{"name": "mine.dolphin"}]}, names

with station() as (port, token):
    assert token is None
    assert status_of(port)[0] == 200 and websocket_status(port) == 101
print("only who has the token gets in")
