"""Vision and planner of a survey drone, played by a program on a foreign middleware. Not a test itself."""

import threading

import ros_robot
from ros_drone import Bool, DiagnosticStatus, PoseStamped, RosDrone
from ros_robot import Header, OccupancyGrid, Pose, Quaternion

NO_TURN = Quaternion(0.0, 0.0, 0.0, 1.0)


def header() -> Header:
    return Header(ros_robot.RosRobot._stamp(), "map")


class Survey:
    """Says ten times a second what it is set to say."""

    def __init__(self, ros: RosDrone):
        self.level, self.words = 0, ""
        self.sees_lot = self.place_in_lot = self.setpoint = None
        self._health = [ros.writer(topic, DiagnosticStatus) for topic in ("/vision_health", "/path_plan_health")]
        self._lot, self._place = ros.writer("/park_lot_detected", Bool), ros.writer("/des_loc_inbound", Bool)
        self._setpoints, self.maps = ros.writer("/path_plan_setpoint", PoseStamped), ros.writer("/occupancy_map", OccupancyGrid)
        self._ends = threading.Event()
        self._thread = threading.Thread(target=self._say, daemon=True)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._ends.set()
        self._thread.join()

    def _say(self):
        while not self._ends.wait(0.1):
            self._health[0].write(DiagnosticStatus(self.level, "vision", self.words, "", []))
            self._health[1].write(DiagnosticStatus(0, "planner", "", "", []))
            if self.sees_lot is not None:
                self._lot.write(Bool(self.sees_lot))
            if self.place_in_lot is not None:
                self._place.write(Bool(self.place_in_lot))
            if self.setpoint is not None:
                self._setpoints.write(PoseStamped(header(), Pose(self.setpoint, NO_TURN)))
