#include "plan/performance.hpp"

namespace lapwing::plan {

namespace {

constexpr Performance copter{.cruise_m_s = 10.0,
                             .climb_m_s = 2.5,
                             .descent_m_s = 1.5,
                             .accel_m_s2 = 2.5,
                             .brake_m_s2 = 1.75,
                             .vertical_accel_m_s2 = 0.8,
                             .pass_share = 0.5,
                             .waypoint_radius_m = 2.0,
                             .circle_accel_m_s2 = 1.5,
                             .spool_up_s = 3.0,
                             .landing_m_s = 0.5,
                             .landing_below_m = 10.0,
                             .touch_down_s = 2.0,
                             .return_height_m = 15.0,
                             .return_wait_s = 6.0};

constexpr Performance plane{.cruise_m_s = 22.0,
                            .climb_m_s = 5.0,
                            .descent_m_s = 5.0,
                            .waypoint_radius_m = 50.0,
                            .turn_rate_rad_s = 0.46,  // a bank of 46 degrees at 22 m/s
                            .spool_up_s = 4.0,        // the run on the ground
                            .landing_m_s = 0.4,
                            .landing_below_m = 3.0,
                            .touch_down_s = 10.0,
                            .return_height_m = 100.0,
                            .circle_radius_m = 60.0};

constexpr Performance rover{.cruise_m_s = 5.0,
                            .accel_m_s2 = 2.0,
                            .brake_m_s2 = 1.4,
                            .pass_share = 0.4,
                            .waypoint_radius_m = 2.0,
                            .pivot_s_per_rad = 0.6,
                            .circle_accel_m_s2 = 3.0,
                            .flies = false};

constexpr Performance underwater{.cruise_m_s = 1.5,
                                 .climb_m_s = 0.5,
                                 .descent_m_s = 0.5,
                                 .accel_m_s2 = 0.5,
                                 .brake_m_s2 = 0.35,
                                 .vertical_accel_m_s2 = 0.4,
                                 .pass_share = 0.5,
                                 .waypoint_radius_m = 2.0,
                                 .circle_accel_m_s2 = 0.3,
                                 .landing_m_s = 0.5};

}  // namespace

Performance performance_of(vehicle::Family family) {
  switch (family) {
    case vehicle::Family::plane: return plane;
    case vehicle::Family::rover:
    case vehicle::Family::robot:
    case vehicle::Family::boat: return rover;
    case vehicle::Family::sub: return underwater;
    default: return copter;
  }
}

}  // namespace lapwing::plan
