"""One mission upload with MAVSDK's uploader. usage: peer_upload_mavsdk.py PORT ITEMS; prints the seconds."""

import asyncio
import socket
import sys
import time

from mavsdk import System
from mavsdk.mission_raw import MissionItem

PORT, ITEMS = int(sys.argv[1]), int(sys.argv[2])


async def main():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        server_port = probe.getsockname()[1]
    drone = System(port=server_port)
    await drone.connect(system_address=f"udpin://127.0.0.1:{PORT}")
    async for state in drone.core.connection_state():
        if state.is_connected:
            break
    items = [MissionItem(seq, 0, 16, int(seq == 0), 1, 0.0, 0.0, 0.0, 0.0, int((41.178 + seq * 1e-4) * 1e7),
                         int(-8.598e7) + (seq % 2) * 6000, 110.0, 0) for seq in range(ITEMS)]
    started = time.monotonic()
    await drone.mission_raw.upload_mission(items)
    print(f"{time.monotonic() - started:.4f}")


asyncio.run(asyncio.wait_for(main(), 120))
