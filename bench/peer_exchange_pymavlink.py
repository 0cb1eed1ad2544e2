"""One exchange as pymavlink's users write it. usage: peer_exchange_pymavlink.py PORT command|parameter|upload; prints the seconds.

Each message is sent again a second after the last, twelve times at most, as ours is."""

import sys
import time

from pymavlink import mavutil

PORT, WHAT, TRIES, ITEMS = int(sys.argv[1]), sys.argv[2], 12, 20

link = mavutil.mavlink_connection(f"udpin:127.0.0.1:{PORT}", source_system=255, source_component=190)
if link.wait_heartbeat(timeout=60) is None:
    sys.exit("no vehicle")
link.mav.heartbeat_send(6, 8, 0, 0, 4)


def until(send, kinds, fits) -> object:
    for _ in range(TRIES):
        send()
        deadline = time.monotonic() + 1.0
        while (left := deadline - time.monotonic()) > 0:
            message = link.recv_match(type=kinds, blocking=True, timeout=left)
            if message is not None and fits(message):
                return message
    sys.exit("gave up")


def command():
    until(lambda: link.mav.command_long_send(1, 1, 511, 0, 33, 200_000, 0, 0, 0, 0, 0), ["COMMAND_ACK"],
          lambda ack: ack.command == 511 and ack.result == 0)


def parameter():
    until(lambda: link.mav.param_set_send(1, 1, b"RTL_ALT", 2500.0, 9), ["PARAM_VALUE"],
          lambda value: value.param_id == "RTL_ALT" and value.param_value == 2500.0)


def upload():
    def item(seq):
        link.mav.mission_item_int_send(1, 1, seq, 0, 16, 0, 1, 0, 0, 0, 0, int((41.178 + seq * 1e-4) * 1e7), int(-8.598e7), 110, 0)

    kinds = ["MISSION_REQUEST", "MISSION_REQUEST_INT", "MISSION_ACK"]
    is_request = lambda message: message.get_type() != "MISSION_ACK"
    seq = until(lambda: link.mav.mission_count_send(1, 1, ITEMS, 0), kinds, is_request).seq
    while True:
        message = until(lambda: item(seq), kinds, lambda m: is_request(m) or m.type != 13)
        if not is_request(message):
            return None if message.type == 0 else sys.exit(f"refused: {message.type}")
        seq = message.seq


started = time.monotonic()
{"command": command, "parameter": parameter, "upload": upload}[WHAT]()
print(f"{time.monotonic() - started:.4f}")
