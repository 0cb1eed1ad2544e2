"""A client in plain Python, made from the reference alone, speaks with Lapwing's end of an operator link: frames in any pieces, wrong tokens,
cuts, a reader that is slow, and the JSON of old parts."""

import json
import random
import socket
import struct
import time

from operator_link import BYE, COMMAND, DATA, DURABLE, LATEST, Hand, Refused, Station

# Who comes in.
hand = Hand("serve", "drone", 0, "token=the right token")
for token, says in (("", "2 this server asks for a token"), ("wrong", "2 this is not the server's token")):
    try:
        Station(hand.port, token=token).connect()
        raise AssertionError("it came in")
    except Refused as refused:
        assert str(refused) == says, refused
hand.end()

# Both ways, in any pieces, with cuts in between: each message once and in order.
hand = Hand("serve", "drone", 0)
station = Station(hand.port)
station.connect()
station.say(COMMAND, '{"Type":"Arm"}')
station.say(LATEST, "pose 1", key="pose")
hand.wait(lambda: len(hand.texts()) == 2, "both have come")
assert hand.texts() == ['{"Type":"Arm"}', "pose 1"], hand.texts()

chance = random.Random(1)
hand.tell("flood 500 300")
for cut in range(60):
    for _ in range(5):
        station.say(DURABLE, f"of python {station.next[DURABLE]}")
    try:
        for _ in range(chance.randrange(1, 20)):
            station.hear(acknowledge=chance.random() < 0.7)
    except (ConnectionError, socket.timeout) as problem:
        raise AssertionError(f"{problem} after {cut} cuts: {hand.lines[-3:]}") from problem
    station.cut()
    station.connect()
station.hear_until(lambda: len([1 for lane, _, _ in station.messages if lane == DURABLE]) >= 500 and not station.sent[DURABLE], "all have come, both ways")
assert [text.split()[0] for lane, _, text in station.messages if lane == DURABLE] == [str(number) for number in range(1, 501)]
# Taken and acknowledged is not yet printed and read.
hand.wait(lambda: len(hand.texts()) >= 302, "all that was taken is printed")
assert hand.texts()[2:] == [f"of python {number}" for number in range(1, 301)], "once and in order"
print("60 cuts:", len(station.messages), "and", len(hand.texts()), "messages, each once and in order")

# A frame a byte at a time, and many in one piece.
body = struct.pack("<BQIQB", COMMAND, station.next[COMMAND], 0, 0, 0) + b"a byte at a time"
station.next[COMMAND] += 1
station.write(DATA, body, piece=1)
hand.wait_for("got command 2 a byte at a time")

# What is wrong ends the connection, and nothing else: the next one goes on.
for wrong in (b"GET / HTTP/1.1\r\n\r\n", b"LW\x01\x04\xff\xff\xff\x7f\0\0\0\0", b"LW\x01\x05\x01\0\0\0\0\0\0\0x"):
    station.socket.sendall(wrong)
    try:
        while True:
            station.hear()
    except ConnectionError:
        pass
    station.connect()
station.write(BYE, struct.pack("<H", 4) + b"done")
hand.wait_for("event lost station done")
hand.end()

# Commands: a newer one of its key overtakes, and nothing is taken after its expiry.
hand = Hand("serve", "drone", 0, "keep")
station = Station(hand.port)
station.connect()
station.say(COMMAND, "move to 1", key="move")
station.say(COMMAND, "take off", lifetime_ms=200)
station.say(COMMAND, "move to 2", key="move")
station.hear_until(lambda: (COMMAND, 1, 1) in station.returned, "the first is overtaken")
deadline = time.monotonic() + 0.4
station.socket.settimeout(0.1)
while time.monotonic() < deadline:
    try:
        station.hear()
    except socket.timeout:
        pass
station.socket.settimeout(5)
hand.tell("take")
station.hear_until(lambda: (COMMAND, 2, 2) in station.returned and station.acked[COMMAND] == 3, "the second has expired")
hand.wait_for("got")
assert hand.texts() == ["move to 2"], hand.texts()
hand.end()

# Who acknowledges nothing gets a window's worth; who reads nothing is given up, and gets the rest afterwards.
hand = Hand("serve", "drone", 0)
station = Station(hand.port)
station.connect()
hand.tell("flood 2000 1000")
hand.wait(lambda: hand.count("accepted") == 2000, "all are kept")
frames = [station.hear(acknowledge=False) for _ in range(258)]
assert frames.count(DATA) <= 256, frames.count(DATA)
hand.wait_for("event lost station silent for 3.0 s", seconds=15)
station.cut()
station.connect()
station.hear_until(lambda: len(station.messages) == 2000, "the rest")
assert [number for _, number, _ in station.messages] == list(range(1, 2001))
hand.end()

# Old parts: JSON objects, split and joined, with line ends and without.
hand = Hand("serve", "drone", 0, "json")
hand.tell('say durable {"Type":"ErrorLog","Message":"said before anybody came"}')
with socket.create_connection(("127.0.0.1", hand.port), timeout=5) as old:
    reader = old.makefile()
    assert json.loads(reader.readline())["Message"] == "said before anybody came"
    said = [{"Type": "Autonomous Move", "X": number, "Y": [{"a": "}{\\\""}]} for number in range(100)]
    stream = "".join(json.dumps(one, separators=chance.choice(((",", ":"), (", ", " : ")))) + chance.choice(("", "\n", "\r\n", " ")) for one in said)
    while stream:
        size = chance.randrange(1, 50)
        old.sendall(stream[:size].encode())
        stream = stream[size:]
    hand.wait(lambda: len(hand.texts()) == 100, "all have come")
    assert [json.loads(text) for text in hand.texts()] == said
    old.sendall(b'nonsense\n{"Type":"La\n{"Type":"Kill"}')
    hand.wait_for('got durable 101 {"Type":"Kill"}')
    assert hand.count("event malformed") == 2, hand.lines[-4:]
hand.end()
print("spoken by a foreign program in both modes")
