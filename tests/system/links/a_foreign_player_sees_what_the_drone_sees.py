"""GStreamer's own player sees the drone's camera as H.264 over RTSP, plain and drawn in, several at once and each by its own way; a player that hangs and a
process that is killed with -9 are no matter to the others; who does not know the password sees nothing."""

import os
import signal
import time

import harness
import survey
from drone import Drone
from player import Player

WIDTH, HEIGHT = 320, 240
Player.skip_without()


def look(path: str, **how) -> Player:
    return Player(rtsp_port, path, (WIDTH, HEIGHT), **how)


def is_the_pattern(picture: bytes) -> bool:
    """Of its bars the first is white and the last is black, in the picture's uppermost rows."""
    return picture[5 * WIDTH + 15] > 200 and picture[5 * WIDTH + WIDTH - 15] < 40


rtsp_port, pictures_port = harness.free_tcp_port(), harness.free_tcp_port()
drone = Drone(processes=survey.tables(camera=f'kind = "pattern"\nwidth = {WIDTH}\nheight = {HEIGHT}') + f"""
[stream]
port = {pictures_port}
token_file = "camera.token"
[rtsp]
port = {rtsp_port}
most_viewers = 6
""")
token = drone.folder / "camera.token"
token.write_text("swordfish\n")
token.chmod(0o600)

with drone:
    drone.wait_for_log(f"rtsp://127.0.0.1:{rtsp_port}/annotated")
    raw, annotated, by_datagrams = look("/raw"), look("/annotated"), look("/raw", protocols="udp")
    for player in (raw, annotated, by_datagrams):
        first = player.wait_for(1)
        assert is_the_pattern(first), first[:WIDTH:20]
        # Its hand goes round once a second; ten pictures a second come.
        later = player.wait_for(3)
        assert first != later, "it moves"
        changed = sum(abs(a - b) > 60 for a, b in zip(first, later))
        assert changed > 50, f"{changed} pixels are others"

    # A wrong password, and none.
    for password in ("Swordfish", '""'):
        stranger = look("/raw", password=password)
        assert stranger.process.wait(timeout=20) != 0
        assert stranger.count == 0 and "nauthorized" in stranger.words, stranger.words
    # A path that is not there.
    lost = look("/elsewhere")
    assert lost.process.wait(timeout=20) != 0 and lost.count == 0

    # One that hangs takes nothing more; the others go on.
    hung = look("/raw")
    hung.wait_for(1)
    hung.process.send_signal(signal.SIGSTOP)
    raw.wait_for(30)
    annotated.wait_for(1)
    hung.end()

    # Killed, it is started again; so are players, as people do.
    killed = drone.pid("stream")
    for player in (raw, annotated, by_datagrams):
        player.end()
    os.kill(killed, signal.SIGKILL)
    drone.wait_for_log("stream killed by signal 9 (Killed); it is started again")
    harness.wait_until(lambda: (pid := drone.pid("stream")) and pid != killed or time.sleep(0.05), 10, "stream runs again")
    harness.wait_until(lambda: sum(f":{rtsp_port}/annotated" in line for line in drone.log) == 2 or time.sleep(0.05), 10, "it serves again")
    again = look("/annotated")
    assert is_the_pattern(again.wait_for(2))

    # The camera's own process is killed: the player stays, and sees again.
    os.kill(drone.pid("perceive"), signal.SIGKILL)
    drone.wait_for_log("perceive killed by signal 9 (Killed); it is started again")
    harness.wait_until(lambda: sum("the camera is open" in line for line in drone.log) == 2 or time.sleep(0.05), 20, "the camera is open again")
    assert is_the_pattern(again.wait_for(3))
    again.end()

# Beyond loopback without a token nothing is started.
open_to_all = drone.folder / "open.toml"
open_to_all.write_text('[camera]\nkind = "pattern"\n[survey]\narea = [[1, 2], [1, 2.0001], [1.0001, 2]]\n[stream]\n[rtsp]\naddress = "0.0.0.0"\nkbit_a_s = 1\n')
_, errors = harness.expect_exit(2, "onboard", "--config", str(open_to_all))
for words in ("whoever is on the network", "kbit_a_s"):
    assert words in errors, (words, errors)
