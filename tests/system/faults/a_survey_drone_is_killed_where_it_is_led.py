"""Kill in each state in which a survey drone is led, by its planner, by the operator, or because something is wrong with the lot or the place."""

from drone_faults.drone_states import LED
from drone_faults.kill import kill_in

kill_in(*LED)
