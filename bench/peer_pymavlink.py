"""One exchange as pymavlink's users write it, as bench_exchange does it with Lapwing.

usage: peer_pymavlink.py PORT command|parameter|parameters|upload [ITEMS]; prints the seconds that it took and how many things went over.

Each message is sent again a second after the last, twelve times at most, as ours is. An upload that either side gave up begins again, as an
operator would have it. After two minutes it is over."""

import sys
import time

from pymavlink import mavutil

PORT, WHAT, ITEMS = int(sys.argv[1]), sys.argv[2], int(sys.argv[3]) if len(sys.argv) > 3 else 20
TRIES, GIVE_UP_S = 12, 120.0

link = mavutil.mavlink_connection(f"udpin:127.0.0.1:{PORT}", source_system=255, source_component=190)
if link.wait_heartbeat(timeout=60) is None:
    sys.exit("no vehicle")
link.mav.heartbeat_send(6, 8, 0, 0, 4)
started = time.monotonic()


def receive(kinds, seconds):
    if time.monotonic() - started > GIVE_UP_S:
        sys.exit("gave up")
    return link.recv_match(type=kinds, blocking=True, timeout=seconds)


def answer(send, kinds, fits):
    """None when there is none."""
    for _ in range(TRIES):
        send()
        deadline = time.monotonic() + 1.0
        while (left := deadline - time.monotonic()) > 0:
            message = receive(kinds, left)
            if message is not None and fits(message):
                return message
    return None


def command() -> int:
    done = answer(lambda: link.mav.command_long_send(1, 1, 511, 0, 33, 200_000, 0, 0, 0, 0, 0), ["COMMAND_ACK"],
                  lambda ack: ack.command == 511 and ack.result == 0)
    return 1 if done else sys.exit("gave up")


def parameter() -> int:
    done = answer(lambda: link.mav.param_set_send(1, 1, b"RTL_ALT", 2500.0, 9), ["PARAM_VALUE"],
                  lambda value: value.param_id == "RTL_ALT" and value.param_value == 2500.0)
    return 1 if done else sys.exit("gave up")


def parameters() -> int:
    """As MAVProxy does it: the list, then what is missing in batches of ten, asked for after a second of silence."""
    link.param_fetch_all()
    seen, count, heard, beat = {}, None, time.monotonic(), time.monotonic()
    while count is None or len(seen) < count:
        message = receive("PARAM_VALUE", 0.1)
        now = time.monotonic()
        if now - beat > 1:
            link.mav.heartbeat_send(6, 8, 0, 0, 4)
            beat = now
        if message is not None:
            heard = now
            if message.param_index != 65535:
                count = message.param_count
                seen[message.param_index] = message.param_value
        elif now - heard > 1:
            heard = now
            if count is None:
                link.param_fetch_all()
                continue
            for index in [i for i in range(count) if i not in seen][:10]:
                link.param_fetch_one(index)
    return len(seen)


def uploaded_once() -> bool:
    def item(seq):
        link.mav.mission_item_int_send(1, 1, seq, 0, 16, 0, 1, 0, 0, 0, 0, int((41.178 + seq * 1e-4) * 1e7),
                                       int(-8.598e7) + (seq % 2) * 6000, 110, 0)

    kinds = ["MISSION_REQUEST", "MISSION_REQUEST_INT", "MISSION_ACK"]
    is_request = lambda message: message.get_type() != "MISSION_ACK"
    wanted = answer(lambda: link.mav.mission_count_send(1, 1, ITEMS, 0), kinds, is_request)
    while wanted is not None and is_request(wanted):
        seq = wanted.seq
        wanted = answer(lambda: item(seq), kinds, lambda message: is_request(message) or message.type != 13)
    return wanted is not None and wanted.type == 0


def upload() -> int:
    while not uploaded_once():
        pass
    return ITEMS


exchanges = {"command": command, "parameter": parameter, "parameters": parameters, "upload": upload}
count = exchanges[WHAT]()
print(f"{time.monotonic() - started:.4f} {count}")
