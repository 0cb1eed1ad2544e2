"""What the operator link has accepted as durable arrives once and in order: over kill -9 of the process that keeps it, again and again, and over a disk
that fills up. The full disk is a small tmpfs, which needs the right to mount."""

import contextlib
import pathlib
import subprocess
import sys
import tempfile

import harness
from operator_link import DURABLE, Hand, Station

with tempfile.TemporaryDirectory() as folder:
    station = None
    accepted = 0
    for round_ in range(6):
        hand = Hand("serve", "drone", 0, f"queue={folder}")
        hand.tell("flood 3000 200")
        if station is None:
            station = Station(hand.port)
        station.port = hand.port
        if round_ % 2 == 0:  # in the other rounds nobody is there
            station.connect()
            station.hear_until(lambda: len(station.messages) >= 400 * (round_ + 1), "some have come")
        hand.wait(lambda: hand.count("accepted") > 1000, "some are kept")
        hand.kill()
        accepted = max(accepted, int([line for line in hand.lines if line.startswith("accepted")][-1].split()[1]))
        with contextlib.suppress(OSError):
            station.cut()
    hand = Hand("serve", "drone", 0, f"queue={folder}")
    hand.tell("say durable the end")
    station.port = hand.port
    station.connect()
    station.hear_until(lambda: station.messages[-1][2] == "the end", "everything has come", seconds=60)
    numbers = [number for _, number, _ in station.messages]
    assert numbers == list(range(1, numbers[-1] + 1)), "once and in order"
    assert numbers[-1] > accepted, (numbers[-1], accepted)
    hand.end()
    print(f"6 x kill -9: {numbers[-1]} messages, each once and in order, all of the {accepted} that were accepted")

with tempfile.TemporaryDirectory() as folder:
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=2m", "tmpfs", folder], capture_output=True, text=True, check=False)
    if mounted.returncode != 0:
        print(f"skipped the full disk: none can be mounted here ({mounted.stderr.strip()})")
        sys.exit(harness.SKIPPED)
    try:
        ballast = pathlib.Path(folder, "ballast")
        ballast.write_bytes(b"x" * 1024 * 1024)
        hand = Hand("serve", "drone", 0, f"queue={folder}/queue")
        hand.tell("flood 5000 1000")
        hand.wait_for("refused")
        assert "No space left on device" in hand.wait_for("refused") and "Make room on that disk" in hand.wait_for("refused"), hand.wait_for("refused")
        hand.wait(lambda: hand.count("accepted") + hand.count("refused") == 5000, "it answers each")
        accepted = hand.count("accepted")
        hand.kill()  # while it was full
        hand = Hand("serve", "drone", 0, f"queue={folder}/queue")
        hand.tell("waiting")
        assert hand.wait_for("waiting") == f"waiting {accepted}", (hand.lines, accepted)
        hand.tell("say durable too much" + "x" * 5000)
        hand.wait_for("refused")
        ballast.unlink()
        hand.tell("say durable with room again")
        hand.wait_for("accepted")
        station = Station(hand.port)
        station.connect()
        station.hear_until(lambda: len(station.messages) == accepted + 1, "all that was accepted")
        assert station.messages[-1][2] == "with room again" and [lane for lane, _, _ in station.messages] == [DURABLE] * (accepted + 1)
        hand.end()
        print(f"a full disk: {accepted} accepted before, all of them there after kill -9, and with room again it went on")
    finally:
        subprocess.run(["umount", "--lazy", folder], check=True)
