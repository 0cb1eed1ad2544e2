"""The flight bridge alone, and a program on ROS 2 with another middleware: it hears the topics that MAVROS has, in its frames and units, and flies
the drone by its services and setpoints. A mode that there is not, a parameter that there is not, and places that are none change nothing."""

import math
import time

import ros_robot
from drone import HOME, READY_S, Drone
from ros_drone import GeoPoint, GeoPose, GeoPoseStamped, PoseStamped, RosDrone, integer
from ros_robot import Header, Point, Pose, Quaternion

ANY_HEADING = Quaternion(0.0, 0.0, 0.0, 0.0)


def header() -> Header:
    return Header(ros_robot.RosRobot._stamp(), "map")


with Drone(processes='[[process]]\nname = "bridge"\n') as drone:
    ros = RosDrone(drone.domain)
    ros.wait(lambda r: r.state and r.state.connected and r.pose and r.fix and r.home and r.battery and r.system_status and r.height, "every topic", READY_S)
    ros.wait(lambda r: r.system_status.sensors_health & 1 << 28, "its checks pass", READY_S)
    assert not ros.state.armed and ros.state.mode == "STABILIZE", ros.state
    assert abs(ros.fix.latitude - HOME[0]) < 1e-4 and abs(ros.fix.longitude - HOME[1]) < 1e-4 and ros.fix.status.status == 0, ros.fix
    assert abs(ros.fix.altitude - 100) < 1, ros.fix
    assert abs(time.time() - ros.fix.header.stamp.sec) < 5, ros.fix
    assert 0.5 < ros.battery.percentage <= 1 and 10 < ros.battery.voltage < 20 and ros.battery.present, ros.battery
    assert abs(math.hypot(ros.pose.pose.orientation.z, ros.pose.pose.orientation.w) - 1) < 0.01, ros.pose

    assert not ros.set_mode(0, "NO SUCH MODE").mode_sent
    assert not ros.set_parameter(False, "NO_SUCH_PARAM", integer(1), seconds=20).success
    told = ros.set_parameter(False, "RTL_ALT", integer(1200))
    assert told.success and told.value.integer_value == 1200, told

    deadline = time.monotonic() + READY_S
    assert ros.set_mode(0, "GUIDED").mode_sent
    ros.wait(lambda r: r.state.mode == "GUIDED", "GUIDED")
    while not ros.arming(True).success:
        assert time.monotonic() < deadline, "it is not armed"
        time.sleep(0.5)
    ros.wait(lambda r: r.state.armed, "armed")
    assert ros.takeoff(0.0, 0.0, 0.0, 0.0, 10.0).success
    ros.wait(lambda r: abs(r.height.data - 10) < 0.5, "10 m")
    assert ros.arming(False).result == 4 or ros.state.armed, "nobody disarms what flies"

    local, globe = ros.writer("/mavros/setpoint_position/local", PoseStamped), ros.writer("/mavros/setpoint_position/global", GeoPoseStamped)

    def steer(say, is_there, what: str):
        deadline = time.monotonic() + 40
        while not is_there():
            assert time.monotonic() < deadline, (what, ros.pose)
            say()
            time.sleep(0.1)

    home = ros.home.position

    def place():
        at = ros.pose.pose.position
        return at.x - home.x, at.y - home.y, at.z - home.z

    # East is x, north is y, above is z.
    wanted = PoseStamped(header(), Pose(Point(home.x + 15, home.y + 8, home.z + 12), ANY_HEADING))
    steer(lambda: local.write(wanted), lambda: math.dist(place(), (15, 8, 12)) < 1.5, "the local setpoint")
    assert (ros.fix.longitude - HOME[1]) * 111_320 * math.cos(math.radians(HOME[0])) > 12 and (ros.fix.latitude - HOME[0]) * 111_320 > 6, ros.fix
    local.write(PoseStamped(header(), Pose(Point(math.nan, 0.0, 10.0), ANY_HEADING)))
    back = GeoPoseStamped(header(), GeoPose(GeoPoint(HOME[0], HOME[1], ros.home.geo.altitude + 10), ANY_HEADING))
    steer(lambda: globe.write(back), lambda: math.dist(place(), (0, 0, 10)) < 1.5, "the global setpoint")

    assert ros.set_mode(0, "LAND").mode_sent
    ros.wait(lambda r: not r.state.armed, "it has landed", 60)
    print("flown by a foreign program:", ros.state.mode)
