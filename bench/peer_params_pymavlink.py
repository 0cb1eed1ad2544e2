"""Every parameter as MAVProxy fetches them with pymavlink: the list, then what is missing in batches of ten, asked for after a second
of silence. usage: peer_params_pymavlink.py PORT; prints the seconds and how many."""

import sys
import time

from pymavlink import mavutil

link = mavutil.mavlink_connection(f"udpin:127.0.0.1:{sys.argv[1]}", source_system=255, source_component=190)
link.wait_heartbeat(timeout=30)
link.mav.heartbeat_send(6, 8, 0, 0, 4)
started = time.monotonic()
link.param_fetch_all()
seen, count, heard, beat = {}, None, time.monotonic(), time.monotonic()
while count is None or len(seen) < count:
    message = link.recv_match(type="PARAM_VALUE", blocking=True, timeout=0.1)
    now = time.monotonic()
    if now - started > 120:
        print("gave up", file=sys.stderr)
        sys.exit(1)
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
print(f"{time.monotonic() - started:.4f} {len(seen)}")
