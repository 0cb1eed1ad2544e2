#pragma once

#include "link/url.hpp"
#include "sim/building/building.hpp"

namespace lapwing::sim::building::testing {

/// Lets the building's time pass with the wall's and serves its first robot's line at `url`, for programs that take it
/// for a real board, until standard input ends.
///
/// Each line of standard input breaks or mends something: `fault sonar-stuck:2`, `mend sonar-stuck`, `mend all`,
/// `restart` (the board loses its power for a moment), `person NUMBER X Y`, and `carry X Y YAW_DEG`. `shoot CAMERA
/// FILE` has one of the cameras to the sides write what it sees (PPM), and tells when it is there. What is true is told
/// on standard output as JSON lines, ten times a second. Gives the program's exit code.
int serve(Building& building, link::Url const& url);

}  // namespace lapwing::sim::building::testing
