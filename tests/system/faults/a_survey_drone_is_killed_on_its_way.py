"""Kill on a survey drone's way up and down: armed on the ground, climbing, in the air, landing, and coming home from a malfunction."""

from drone_faults.kill import kill_in

kill_in("Arm", "Takeoff", "Hover", "Land", "Malfunction")
