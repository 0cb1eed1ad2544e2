"""A program that writes to a store is killed at random moments: what it said was accepted is there, and nothing is half.

usage: what_was_accepted_survives_kill_9.py [TIMES]
"""

import pathlib
import random
import sys
import tempfile
import time

import store_hand

TIMES = int(sys.argv[1]) if len(sys.argv) > 1 else 10
# Each time the store is new, or what the last one has left.
TIMES_EACH = 5

moments = random.Random(time.time_ns())
killed = accepted_in_all = 0
while killed < TIMES:
    with tempfile.TemporaryDirectory() as folder:
        store = str(pathlib.Path(folder, "store"))
        accepted = 0
        for _ in range(min(TIMES_EACH, TIMES - killed)):
            hand = store_hand.Hand(store, "robot")
            delay = moments.uniform(0.0, 1.5)
            time.sleep(delay)
            accepted = max(accepted, hand.kill())
            assert not hand.refusals, hand.refusals
            killed += 1
            # Before anything was accepted there need not be a store; the next one makes it, whatever lies there.
            if accepted > 0:
                print(f"killed after {delay:.3f} s:", store_hand.check(store, "robot", accepted), flush=True)
        accepted_in_all += accepted
assert accepted_in_all > 0, "something must have been accepted"
print(f"{killed} times killed, {accepted_in_all} things accepted, all of them there")
