"""A disk that fills up while a store is written: refused before it is full, and when it is; what was accepted stays; with room again it
goes on by itself. On a small tmpfs, which needs the right to mount."""

import contextlib
import pathlib
import subprocess
import sys
import tempfile

import harness
import store_hand

MEBIBYTE = 1024 * 1024
SIZE = 24 * MEBIBYTE


@contextlib.contextmanager
def small_disk():
    with tempfile.TemporaryDirectory() as folder:
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={SIZE}", "tmpfs", folder], capture_output=True, text=True, check=False)
        if mounted.returncode != 0:
            print(f"skipped: no small disk can be mounted here ({mounted.stderr.strip()})")
            sys.exit(harness.SKIPPED)
        try:
            yield pathlib.Path(folder)
        finally:
            subprocess.run(["umount", "--lazy", folder], check=True)


def fill_up(least_free_bytes: int, says: tuple[str, ...]) -> None:
    with small_disk() as disk:
        ballast = disk / "ballast"
        ballast.write_bytes(b"x" * (14 * MEBIBYTE))
        store = str(disk / "store")
        hand = store_hand.Hand(store, "robot", least_free_bytes)
        try:
            hand.wait(lambda hand: hand.refusals, "it says that the disk is full")
            assert any(reason in hand.refusals[-1] for reason in says), hand.refusals[-1]
            accepted = hand.accepted
            assert accepted > 0, "there was room for something"
            hand.wait(lambda hand: len(hand.refusals) > 5, "it goes on saying so")
            assert hand.accepted == accepted, "and takes nothing meanwhile"
            ballast.unlink()
            hand.wait(lambda hand: hand.accepted > accepted + 100, "with room again it goes on")
        finally:
            accepted = hand.kill()
        print(f"with {least_free_bytes} bytes to stay free:", store_hand.check(store, "robot", accepted))


# Before: a part of the disk stays free for others.
fill_up(4 * MEBIBYTE, ("shall stay free",))
# When it is: nothing was to stay free.
fill_up(0, ("disk is full", "No space left on device", "shall stay free"))

# Killed while it was full, with pages half written: opened again it has what it had.
with small_disk() as disk:
    ballast = disk / "ballast"
    ballast.write_bytes(b"x" * (14 * MEBIBYTE))
    hand = store_hand.Hand(str(disk / "store"), "robot")
    try:
        hand.wait(lambda hand: hand.refusals, "it says that the disk is full")
    finally:
        accepted = hand.kill()
    ballast.unlink()
    print("killed on a full disk:", store_hand.check(str(disk / "store"), "robot", accepted))
