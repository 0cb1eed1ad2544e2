"""A camera on the network spoils its pictures in flight: torn ones between good ones are passed over, what is no picture at all ends the stream, which is opened again at
once, and the drone flies on; black ones alone, and none at all, are a Malfunction for a drone that relies on its vision. What is wrong is named, it is not armed without a
camera, and all is well when that is."""

import survey
from drone import Drone, Operator, arm, take_off
from fake_camera import FakeCamera
from ros_drone import RosDrone
from drone_faults.vision_health import Vision

with FakeCamera() as camera, Drone(decide='relies_on = ["vision"]', processes=survey.tables(camera=camera.table)) as drone:
    ros = RosDrone(drone.domain)
    vision = Vision(ros)
    operator = Operator(drone.port)
    vision.wait(lambda v: v.level == 0, "vision is well", 60)
    take_off(operator)

    for shows in (("good", "torn"), ("garbage", *("good",) * 1000)):
        seen = vision.count("pictures_looked_at")
        camera.shows = shows
        vision.wait(lambda _, since=seen: vision.count("pictures_looked_at") >= since + 12, f"after {shows[0]} ones pictures are looked at")
        assert operator.wait_for_state("Hover", 5)["Health Status"] == 0, (shows[:2], operator.last)
        print(shows[:2], vision.last().level, vision.last().message, {one.key: one.value for one in vision.last().values})

    camera.shows = ("black",)
    operator.wait_for_state("Malfunction", 15)
    operator.wait(lambda o: "vision has failed" in o.last["Health Reason"] and "black" in o.last["Health Reason"], "why")
    written = drone.folder / "state/malfunction.txt"
    operator.wait(lambda _: written.is_file() and "black" in written.read_text(), "it is written down")
    operator.wait(lambda o: o.last["State"] == "Idle" and not o.last["Armed"], "it has landed", 60)
    camera.shows = ()
    gone = vision.wait(lambda v: v.level == 2, "vision says that its camera is gone")
    print("gone:", gone.message)
    operator.command("Arm")
    operator.wait_for_error("Arm is refused: vision has failed")
    camera.shows = ("good",)
    vision.wait(lambda v: v.level == 0, "the camera is opened again")
    arm(operator)
    camera.shows = ()
    operator.wait_for_state("Malfunction", 20)
    operator.wait(lambda o: not o.last["Armed"] and o.last["State"] == "Idle", "the motors have stopped on the ground", 20)
    operator.cut()
    assert all(one["restarts"] == 0 for one in drone.health().values()), drone.health()
