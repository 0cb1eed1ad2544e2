"""One mission upload as pymavlink's users write it. usage: peer_upload_pymavlink.py PORT ITEMS; prints the seconds."""

import sys
import time

from pymavlink import mavutil

PORT, ITEMS, GIVE_UP_S = int(sys.argv[1]), int(sys.argv[2]), 120.0

link = mavutil.mavlink_connection(f"udpin:127.0.0.1:{PORT}", source_system=255, source_component=190)
link.wait_heartbeat(timeout=30)
link.mav.heartbeat_send(6, 8, 0, 0, 4)
started = time.monotonic()
link.mav.mission_count_send(1, 1, ITEMS, 0)
any_request = False
while True:
    message = link.recv_match(type=["MISSION_REQUEST", "MISSION_REQUEST_INT", "MISSION_ACK"], blocking=True, timeout=1.5)
    if time.monotonic() - started > GIVE_UP_S:
        print("gave up", file=sys.stderr)
        sys.exit(1)
    if message is None:
        if not any_request:
            link.mav.mission_count_send(1, 1, ITEMS, 0)
        continue
    if message.get_type() == "MISSION_ACK":
        if message.type == 13:
            continue
        if message.type == 0:
            break
        # The vehicle gave the upload up: begin again, as an operator would.
        any_request = False
        link.mav.mission_count_send(1, 1, ITEMS, 0)
        continue
    any_request = True
    seq = message.seq
    link.mav.mission_item_int_send(1, 1, seq, 0, 16, 0, 1, 0, 0, 0, 0, int((41.178 + seq * 1e-4) * 1e7),
                                   int(-8.598e7) + (seq % 2) * 6000, 110, 0)
print(f"{time.monotonic() - started:.4f}")
