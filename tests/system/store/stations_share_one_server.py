"""A store on PostgreSQL with PostGIS: its tests there, two programs that write to it at once and are killed, and a server that fails."""

import os
import pathlib
import random
import subprocess
import time

import harness
import postgres
import store_hand

UNIT_TESTS = pathlib.Path(harness.LAPWING).parent.parent / "src/map/store/map_store_test"

with postgres.cluster(durable=True) as server:
    tests = subprocess.run([UNIT_TESTS, "--gtest_filter=Server*:Care.CopiesToAServerAndBack", "--gtest_brief=1"], timeout=200, check=False,
                           env=dict(os.environ, LAPWING_TEST_POSTGRES=server.address()), capture_output=True, text=True)
    assert tests.returncode == 0 and "SKIPPED" not in tests.stdout, tests.stdout[-3000:]

    server.query("CREATE DATABASE shared")
    store = server.address("shared")
    accepted = {"robot": 0, "drone": 0}

    def keep_best(hands):
        for writer, hand in hands.items():
            accepted[writer] = max(accepted[writer], hand.kill())

    # Both start at once on an empty database, and one of them makes the tables.
    for _ in range(3):
        hands = {writer: store_hand.Hand(store, writer) for writer in accepted}
        try:
            for writer, hand in hands.items():
                before = accepted[writer]
                hand.wait(lambda hand, before=before: hand.accepted > before, f"{writer} writes")
            time.sleep(random.uniform(0.0, 1.0))
        finally:
            keep_best(hands)
        for writer, count in accepted.items():
            print(f"{writer} killed:", store_hand.check(store, writer, count), flush=True)

    # The server fails under both; they wait for it and go on.
    hands = {writer: store_hand.Hand(store, writer) for writer in accepted}
    try:
        for writer, hand in hands.items():
            hand.wait(lambda hand, before=accepted[writer]: hand.accepted > before, f"{writer} writes")
        server.stop()
        for writer, hand in hands.items():
            hand.wait(lambda hand: hand.refusals, f"{writer} says that the server is away")
        server.start()
        reached = {writer: hand.accepted for writer, hand in hands.items()}
        for writer, hand in hands.items():
            hand.wait(lambda hand, before=reached[writer]: hand.accepted > before, f"{writer} goes on")
    finally:
        keep_best(hands)
    for writer, count in accepted.items():
        print(f"{writer}, over a server that failed:", store_hand.check(store, writer, count), flush=True)
    assert server.query("SELECT count(*) > 0 FROM lapwing.slots WHERE NOT ST_IsValid(geom)", "shared") == "f"
