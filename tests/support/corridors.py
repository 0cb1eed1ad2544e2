"""Two corridors that meet at a corner, and what a laser sees between walls. Not a test itself."""

import math

# Ends of walls, metres; with a niche, so that the walls say where one is along either corridor.
WALLS = [((0, 0), (12, 0)), ((12, 0), (12, 9)), ((12, 9), (9, 9)), ((9, 9), (9, 3)), ((9, 3), (5, 3)), ((5, 3), (5, 4)), ((5, 4), (3, 4)),
         ((3, 4), (3, 3)), ((3, 3), (0, 3)), ((0, 3), (0, 0))]
FARTHEST_M = 80.0


def seen(walls: list, x: float, y: float, angle: float) -> float:
    """Metres to the nearest wall in that direction."""
    nearest = FARTHEST_M
    dx, dy = math.cos(angle), math.sin(angle)
    for (ax, ay), (bx, by) in walls:
        ex, ey = bx - ax, by - ay
        across = dx * ey - dy * ex
        if abs(across) < 1e-9:
            continue
        far = ((ax - x) * ey - (ay - y) * ex) / across
        along = ((ax - x) * dy - (ay - y) * dx) / across
        if far > 0 and 0 <= along <= 1:
            nearest = min(nearest, far)
    return nearest
