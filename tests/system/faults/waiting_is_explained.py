"""Whoever runs a script learns every few seconds what it waits for: nobody there, a vehicle that is not ready, or takes no items, or cannot
be reached to be stopped."""

import pathlib
import signal
import subprocess
import tempfile
import time

import copter
import flight
import harness

PICK = "v = pick { type 'UAV'; timeout 20.seconds }\n"
FLY = flight.MISSION + PICK + "execute v: there\n"


def nobody_is_there():
    port = harness.free_udp_port()
    with tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(folder, "nobody.dolphin")
        script.write_text("v = pick { type 'UAV'; timeout 15.seconds }\n")
        out, err = harness.expect_exit(3, "run", str(script), "--link", f"udpin://127.0.0.1:{port}", "--speedup", "10")
    for words in (f"no vehicle heard yet for 3 s on udpin://127.0.0.1:{port}", "pick waits for 1 UAV, 3 of 15 s: no vehicle was heard",
                  "Requirements were not met!", f"no vehicle was heard on udpin://127.0.0.1:{port}"):
        assert words in out + err, f"no {words!r} in\n{out}\n{err}"
    assert (out + err).count("no vehicle heard yet") == 2, err


def the_wrong_ones_are_there():
    field = flight.Field()
    field.add()
    ended = field.fly("v = pick { type 'UGV'; payload 'Sonar'; timeout 8.seconds }\n")
    ended.expect(3, "pick waits for 1 UGV with Sonar, ", " of 8 s: vehicle 7 is a UAV, has no Sonar", "Requirements were not met!",
                 "  vehicle 7 is a UAV, has no Sonar")


def it_is_not_ready():
    field = flight.Field()
    vehicle = field.add()
    vehicle.faults.estimated = False
    begun = field.now()

    def gets_ready(now):
        vehicle.faults.estimated = now - begun > 25

    field.fly(FLY, happens=gets_ready).expect(0, "'There and back': waiting until the vehicle is ready for 3 s: no position estimate")


def it_takes_no_items():
    field = flight.Field(speedup=20)
    vehicle = field.add()
    vehicle.faults.asks_no_further_than = 1
    ended = field.fly(FLY)
    ended.expect(1, "uploading 1/7 for 3 s: it asks for no more items",
                 "stopped asking for mission items: the last that it wanted was item 1, of 7")
    assert "holds 0 items" not in ended.out + ended.err, ended


def it_cannot_be_reached():
    field = flight.Field(speedup=1)
    vehicle = field.add()
    with tempfile.TemporaryDirectory() as folder:
        script, said = pathlib.Path(folder, "fly.dolphin"), pathlib.Path(folder, "said")
        script.write_text(FLY)
        with said.open("w") as file:
            run = subprocess.Popen([harness.LAPWING, "run", str(script), "--link", f"udpin://127.0.0.1:{field.port}"], stdout=file,
                                   stderr=subprocess.STDOUT)
            try:
                deadline = time.monotonic() + 60
                while not (vehicle.mode == copter.AUTO and vehicle.current >= 2) and time.monotonic() < deadline:
                    field.step()
                vehicle.faults.silent = True
                run.send_signal(signal.SIGINT)
                while "Ctrl-C again ends at once" not in said.read_text() and time.monotonic() < deadline:
                    field.step()
                run.send_signal(signal.SIGINT)
                assert run.wait(timeout=10) == 130, said.read_text()
            finally:
                if run.poll() is None:
                    run.kill()
                    run.wait()
        text = said.read_text()
    for words in ("copter 7 has not stopped yet, asked again and again for 3 s: nothing heard from it for ",
                  "still waiting for copter 7 to stop; Ctrl-C again ends at once: it does then what it was told last"):
        assert words in text, f"no {words!r} in\n{text}"


for case in (nobody_is_there, the_wrong_ones_are_there, it_is_not_ready, it_takes_no_items, it_cannot_be_reached):
    begun = time.monotonic()
    case()
    print(f"{case.__name__}: {time.monotonic() - begun:.1f} s")
