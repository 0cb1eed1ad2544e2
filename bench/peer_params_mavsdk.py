"""Every parameter with MAVSDK's get_all_params. usage: peer_params_mavsdk.py PORT; prints the seconds and how many."""

import asyncio
import socket
import sys
import time

from mavsdk import System


async def main():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        server_port = probe.getsockname()[1]
    drone = System(port=server_port)
    await drone.connect(system_address=f"udpin://127.0.0.1:{sys.argv[1]}")
    async for state in drone.core.connection_state():
        if state.is_connected:
            break
    started = time.monotonic()
    params = await drone.param.get_all_params()
    took, count = time.monotonic() - started, len(params.int_params) + len(params.float_params) + len(params.custom_params)
    print(f"{took:.4f} {count}", flush=True)


asyncio.run(asyncio.wait_for(main(), 120))
