#pragma once

#include "mavlink/codec/internal/fields.hpp"

/// Where the vehicle is and how it moves.
namespace lapwing::mavlink::internal {

template <class M = GpsRaw, class W = dialect::GPS_RAW_INT>
inline constexpr auto gps_raw = layout<M, W>(std::tuple{
    field<&M::time, &W::time_usec>(),
    field<&M::fix, &W::fix_type>(),
    place<&M::position, &W::lat, &W::lon, &W::alt>,
    field<&M::hdop, &W::eph>(limit::dilution, centi),
    field<&M::vdop, &W::epv>(limit::dilution, centi),
    field<&M::ground_speed_m_s, &W::vel>(limit::speed_m_s, centi),
    field<&M::course_rad, &W::cog>(Heading{limit::bearing_rad, centidegree}),
    field<&M::satellites, &W::satellites_visible>(),
    field<&M::horizontal_accuracy_m, &W::h_acc>(accuracy),
    field<&M::vertical_accuracy_m, &W::v_acc>(accuracy),
});

template <class M = Attitude, class W = dialect::ATTITUDE>
inline constexpr auto attitude = layout<M, W>(std::tuple{
    field<&M::since_boot, &W::time_boot_ms>(),
    field<&M::roll_rad, &W::roll>(limit::angle_rad),
    field<&M::pitch_rad, &W::pitch>(limit::angle_rad),
    field<&M::yaw_rad, &W::yaw>(limit::angle_rad),
    field<&M::roll_rate_rad_s, &W::rollspeed>(limit::turn_rate_rad_s),
    field<&M::pitch_rate_rad_s, &W::pitchspeed>(limit::turn_rate_rad_s),
    field<&M::yaw_rate_rad_s, &W::yawspeed>(limit::turn_rate_rad_s),
});

template <class M = GlobalPosition, class W = dialect::GLOBAL_POSITION_INT>
inline constexpr auto global_position = layout<M, W>(std::tuple{
    field<&M::since_boot, &W::time_boot_ms>(),
    place<&M::position, &W::lat, &W::lon, &W::alt>,
    field<&M::relative_alt_m, &W::relative_alt>(limit::altitude_m, milli),
    vector<&M::velocity_m_s, &W::vx, &W::vy, &W::vz>(limit::velocity_m_s, centi),
    field<&M::heading_rad, &W::hdg>(Heading{limit::bearing_rad, centidegree}),
});

template <class M = LocalPosition, class W = dialect::LOCAL_POSITION_NED>
inline constexpr auto local_position = layout<M, W>(std::tuple{
    field<&M::since_boot, &W::time_boot_ms>(),
    vector<&M::position_m, &W::x, &W::y, &W::z>(limit::offset_m),
    vector<&M::velocity_m_s, &W::vx, &W::vy, &W::vz>(limit::velocity_m_s),
});

template <class M = VfrHud, class W = dialect::VFR_HUD>
inline constexpr auto vfr_hud = layout<M, W>(std::tuple{
    field<&M::airspeed_m_s, &W::airspeed>(limit::speed_m_s),
    field<&M::ground_speed_m_s, &W::groundspeed>(limit::speed_m_s),
    field<&M::heading_rad, &W::heading>(Heading{limit::angle_rad, degree}),
    field<&M::throttle, &W::throttle>(limit::fraction, centi),
    field<&M::alt_m, &W::alt>(limit::altitude_m),
    field<&M::climb_m_s, &W::climb>(limit::velocity_m_s),
});

template <class M = NavControllerOutput, class W = dialect::NAV_CONTROLLER_OUTPUT>
inline constexpr auto nav_controller_output = layout<M, W>(std::tuple{
    field<&M::nav_roll_rad, &W::nav_roll>(limit::angle_rad, degree),
    field<&M::nav_pitch_rad, &W::nav_pitch>(limit::angle_rad, degree),
    field<&M::nav_bearing_rad, &W::nav_bearing>(limit::angle_rad, degree),
    field<&M::target_bearing_rad, &W::target_bearing>(limit::angle_rad, degree),
    field<&M::waypoint_distance_m, &W::wp_dist>(),
    field<&M::alt_error_m, &W::alt_error>(limit::offset_m),
    field<&M::airspeed_error_m_s, &W::aspd_error>(limit::airspeed_error),
    field<&M::cross_track_error_m, &W::xtrack_error>(limit::offset_m),
});

template <class M = Wind, class W = dialect::WIND>
inline constexpr auto wind = layout<M, W>(std::tuple{
    field<&M::from_rad, &W::direction>(limit::angle_rad, degree),
    field<&M::speed_m_s, &W::speed>(limit::wind_speed_m_s),
    field<&M::down_m_s, &W::speed_z>(limit::wind_m_s),
});

template <class M = WindCov, class W = dialect::WIND_COV>
inline constexpr auto wind_cov = layout<M, W>(std::tuple{
    field<&M::time, &W::time_usec>(),
    field<&M::north_m_s, &W::wind_x>(limit::wind_m_s),
    field<&M::east_m_s, &W::wind_y>(limit::wind_m_s),
    field<&M::down_m_s, &W::wind_z>(limit::wind_m_s),
    not_told<&W::var_horiz, &W::var_vert, &W::wind_alt>,
});

template <class M = HomePosition, class W = dialect::HOME_POSITION>
inline constexpr auto home_position = layout<M, W>(std::tuple{
    place<&M::position, &W::latitude, &W::longitude, &W::altitude>,
    vector<&M::local_m, &W::x, &W::y, &W::z>(limit::offset_m),
    not_told<&W::q>,  // how the ground lies
});

template <class M = GpsGlobalOrigin, class W = dialect::GPS_GLOBAL_ORIGIN>
inline constexpr auto gps_global_origin = layout<M, W>(std::tuple{
    place<&M::position, &W::latitude, &W::longitude, &W::altitude>,
});

template <class M = SetGpsGlobalOrigin, class W = dialect::SET_GPS_GLOBAL_ORIGIN>
inline constexpr auto set_gps_global_origin = layout<M, W>(std::tuple{
    field<&M::target_system, &W::target_system>(),
    place<&M::position, &W::latitude, &W::longitude, &W::altitude>,
});

template <class M = DistanceSensor, class W = dialect::DISTANCE_SENSOR>
inline constexpr auto distance_sensor = layout<M, W>(std::tuple{
    field<&M::since_boot, &W::time_boot_ms>(),
    field<&M::least_m, &W::min_distance>(limit::range_m, centi),
    field<&M::most_m, &W::max_distance>(limit::range_m, centi),
    field<&M::distance_m, &W::current_distance>(limit::range_m, centi),
    field<&M::id, &W::id>(),
    field<&M::orientation, &W::orientation>(),
});

template <class M = ObstacleDistance, class W = dialect::OBSTACLE_DISTANCE>
inline constexpr auto obstacle_distance = layout<M, W>(std::tuple{
    field<&M::time, &W::time_usec>(),
    field<&M::distances_m, &W::distances>(in_centimetres),
    field<&M::step_rad, &W::increment>(limit::angle_rad, degree, 0),
    field<&M::exact_step_rad, &W::increment_f>(limit::angle_rad, degree),
    field<&M::least_m, &W::min_distance>(limit::range_m, centi),
    field<&M::most_m, &W::max_distance>(limit::range_m, centi),
    field<&M::first_bearing_rad, &W::angle_offset>(limit::angle_rad, degree),
    field<&M::frame, &W::frame>(),
});

template <class M = CameraFeedback, class W = dialect::CAMERA_FEEDBACK>
inline constexpr auto camera_feedback = layout<M, W>(std::tuple{
    field<&M::time, &W::time_usec>(),
    field<&M::camera, &W::cam_idx>(),
    field<&M::image, &W::img_idx>(),
    place<&M::position, &W::lat, &W::lng, &W::alt_msl>,
    field<&M::relative_alt_m, &W::alt_rel>(limit::altitude_m),
    field<&M::roll_rad, &W::roll>(limit::angle_rad, degree),
    field<&M::pitch_rad, &W::pitch>(limit::angle_rad, degree),
    field<&M::yaw_rad, &W::yaw>(limit::angle_rad, degree),
    field<&M::completed_captures, &W::completed_captures>(),
});

template <class M = SetPositionTargetLocalNed, class W = dialect::SET_POSITION_TARGET_LOCAL_NED>
inline constexpr auto local_setpoint = layout<M, W>(std::tuple{
    field<&M::since_boot, &W::time_boot_ms>(),
    field<&M::frame, &W::coordinate_frame>(),
    field<&M::ignore, &W::type_mask>(),
    wanted_vector<&M::position_m, &W::x, &W::y, &W::z>,
    wanted_vector<&M::velocity_m_s, &W::vx, &W::vy, &W::vz>,
    wanted_vector<&M::acceleration_m_s2, &W::afx, &W::afy, &W::afz>,
    field<&M::yaw_rad, &W::yaw>(),
    field<&M::yaw_rate_rad_s, &W::yaw_rate>(),
});

template <class M, class W>
inline constexpr auto global_setpoint = layout<M, W>(std::tuple{
    field<&M::frame, &W::coordinate_frame>(),
    field<&M::ignore, &W::type_mask>(),
    field<&M::lat_rad, &W::lat_int>(in_degrees_e7),
    field<&M::lon_rad, &W::lon_int>(in_degrees_e7),
    field<&M::alt_m, &W::alt>(),
    wanted_vector<&M::velocity_m_s, &W::vx, &W::vy, &W::vz>,
    wanted_vector<&M::acceleration_m_s2, &W::afx, &W::afy, &W::afz>,
    field<&M::yaw_rad, &W::yaw>(),
    field<&M::yaw_rate_rad_s, &W::yaw_rate>(),
});
template <class M, class W>
inline constexpr auto position_target = layout<M, W>(std::tuple{
    field<&M::since_boot, &W::time_boot_ms>(),
    part<&M::setpoint>(global_setpoint<GlobalSetpoint, W>),
});

using MotionLayouts =
    Layouts<gps_raw<>, attitude<>, global_position<>, local_position<>, vfr_hud<>, nav_controller_output<>, wind<>,
            wind_cov<>, home_position<>, gps_global_origin<>, camera_feedback<>, set_gps_global_origin<>,
            distance_sensor<>, obstacle_distance<>, local_setpoint<>,
            position_target<SetPositionTargetGlobalInt, dialect::SET_POSITION_TARGET_GLOBAL_INT>,
            position_target<PositionTargetGlobalInt, dialect::POSITION_TARGET_GLOBAL_INT>>;

}  // namespace lapwing::mavlink::internal
