"""`lapwing run` with several scripts, with a time-out, with events of real flights; and what does not go together."""

import json
import pathlib
import tempfile

import harness

FLIGHT = """
v = pick { type 'UAV'; timeout 30 }
execute v: mission { name 'hop'; home location(41.1780, -8.5980, 90); takeOff location(41.1780, -8.5980, 100); returnHomeAndLand() }
message 'down'
"""

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)

    def script(text: str, file: str) -> str:
        path = folder / file
        path.write_text(text)
        return str(path)

    one = script("x = 1\nmessage 'one'\nv = pick { id 'a1' }\nexecute task('A:0.2')", "one.dolphin")
    two = script("v = pick { id 'a1' }\nmessage v", "two.dolphin")  # released at the end of the first
    out, _ = harness.expect_exit(0, "run", "--platform", "test", one, two)
    assert out == "Program message: one\nProgram message: { a1 }\n", out

    # The first that fails is the last; what does not check keeps all of them from moving anything.
    halts = script("message 'h'\nhalt 'enough'", "halts.dolphin")
    out, _ = harness.expect_exit(3, "run", "--platform", "test", one, halts, two)
    assert out == "Program message: one\nProgram message: h\n", out
    wrong = script("message y", "wrong.dolphin")
    out, err = harness.expect_exit(2, "run", "--platform", "test", one, wrong)
    assert out == "" and "y is not defined" in err, (out, err)

    # A time-out counts in the script's own time.
    endless = script("v = pick {}\nexecute task('A:1000')", "endless.dolphin")
    out, err = harness.expect_exit(3, "run", "--platform", "test", "--timeout", "2", "--events", "-", endless)
    events = [json.loads(line) for line in out.splitlines()]
    assert [(event["t"], event["event"]) for event in events] == [(0, "ALLOC"), (0, "START"), (2, "STOP")], events
    assert "time-out" in err, err
    for option in (["--link", "udpin://127.0.0.1:1"], ["--sim", "copter:1"], ["--report", "r.json"]):
        _, err = harness.expect_exit(2, "run", "--platform", "test", one, *option)
        assert f"{option[0]} does not go with --platform test" in err, err

    # Events of vehicles: the items are those that the vehicle gets. Two flights, one after the other.
    flight = script(FLIGHT, "flight.dolphin")
    events_file = folder / "events.jsonl"
    out, _ = harness.expect_exit(0, "run", "--sim", "copter:1", "--events", str(events_file), flight, flight)
    assert out == "Program message: down\n" * 2, out
    events = [json.loads(line) for line in events_file.read_text().splitlines()]
    assert [event["event"] for event in events] == ["ALLOC", "START", "DONE"] * 2, events
    assert [item["command"] for item in events[1]["items"]] == [16, 22, 21], events[1]

    # Whoever carries what is said on the command line; simulated vehicles stand where the script is at home.
    far = script("v = pick { type 'UAV'; payload 'Lamp'; timeout 10 }\nmessage v\nmessage position(v)\n"
                 "h = location(10.5, 20.25, 300)\n", "far.dolphin")
    out, _ = harness.expect_exit(0, "run", "--sim", "copter:1", far)
    assert out.splitlines() == ["Program message: { 1 }", "Program message: (10.500000,20.250000,300.000)"], out
    nobody = script("p = 'Lamp'\np = 'Torch'\nv = pick { payload p; timeout 5 }\nmessage v", "nobody.dolphin")
    harness.expect_exit(3, "run", "--sim", "copter:2", nobody)
    out, _ = harness.expect_exit(0, "run", "--sim", "copter:2", "--payload", "2=Rope,Torch", nobody)
    assert out == "Program message: { 2 }\n", out
    _, err = harness.expect_exit(2, "run", "--sim", "copter:2", "--payload", "Torch", nobody)
    assert "ID=NAME" in err, err
print("the scripts took turns")
