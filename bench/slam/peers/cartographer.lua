-- Cartographer without an IMU, with odometry, from 5 Hz on: its defaults but for what follows.
include "map_builder.lua"
include "trajectory_builder.lua"

MAP_BUILDER.use_trajectory_builder_2d = true
MAP_BUILDER.num_background_threads = 1
MAP_BUILDER.pose_graph.optimization_problem.ceres_solver_options.num_threads = 1
MAP_BUILDER.pose_graph.constraint_builder.log_matches = false
MAP_BUILDER.pose_graph.log_residual_histograms = false
MAP_BUILDER.pose_graph.optimization_problem.odometry_translation_weight = 1e2
MAP_BUILDER.pose_graph.optimization_problem.odometry_rotation_weight = 1e2
MAP_BUILDER.pose_graph.constraint_builder.sampling_ratio = 0.1

local builder = TRAJECTORY_BUILDER.trajectory_builder_2d
builder.use_imu_data = false
builder.use_online_correlative_scan_matching = true
builder.real_time_correlative_scan_matcher.linear_search_window = 0.1
builder.real_time_correlative_scan_matcher.angular_search_window = math.rad(20)
builder.ceres_scan_matcher.occupied_space_weight = 20
builder.ceres_scan_matcher.translation_weight = 10
builder.ceres_scan_matcher.rotation_weight = 1

return { map_builder = MAP_BUILDER, trajectory_builder = TRAJECTORY_BUILDER }
