#include "slam/mapper_parameters.hpp"

#include <array>
#include <type_traits>

namespace lapwing::slam {
namespace {

template <auto part, auto member>
constexpr Parameter parameter(std::string_view name) {
  using Number = std::remove_cvref_t<decltype((std::declval<MapperOptions>().*part).*member)>;
  return {name, [](MapperOptions const& options) { return static_cast<double>((options.*part).*member); },
          [](MapperOptions& options, double value) {
            if constexpr (std::is_integral_v<Number>) value = value < 0 ? value - 0.5 : value + 0.5;
            (options.*part).*member = static_cast<Number>(value);
          }};
}

template <auto member>
constexpr Parameter rate(std::string_view name) {
  return {name, [](MapperOptions const& options) { return options.loops.rates.*member; },
          [](MapperOptions& options, double value) { options.loops.rates.*member = value; }};
}

using M = MapperOptions;
using L = LoopOptions;
using J = JointOptions;
using G = GatherOptions;

constexpr std::array table{
    parameter<&M::frame, &FrameOptions::most_range_m>("frame.most_range_m"),
    parameter<&M::front_end, &FrontEndOptions::key_step_m>("front_end.key_step_m"),
    parameter<&M::front_end, &FrontEndOptions::key_turn_rad>("front_end.key_turn_rad"),
    parameter<&M::front_end, &FrontEndOptions::grid_frames>("front_end.grid_frames"),
    parameter<&M::front_end, &FrontEndOptions::point_information>("front_end.point_information"),
    parameter<&M::front_end, &FrontEndOptions::edge_share>("front_end.edge_share"),
    parameter<&M::loops, &L::every_m>("loops.every_m"),
    parameter<&M::loops, &L::least_gap_m>("loops.least_gap_m"),
    parameter<&M::loops, &L::submap_frames>("loops.submap_frames"),
    parameter<&M::loops, &L::query_frames>("loops.query_frames"),
    parameter<&M::loops, &L::least_score>("loops.least_score"),
    parameter<&M::loops, &L::window_m>("loops.window_m"),
    parameter<&M::loops, &L::window_rad>("loops.window_rad"),
    parameter<&M::loops, &L::window_sigmas>("loops.window_sigmas"),
    parameter<&M::loops, &L::most_deviations>("loops.most_deviations"),
    parameter<&M::loops, &L::most_window_m>("loops.most_window_m"),
    parameter<&M::loops, &L::most_branches>("loops.most_branches"),
    parameter<&M::loops, &L::most_window_rad>("loops.most_window_rad"),
    parameter<&M::loops, &L::most_candidates>("loops.most_candidates"),
    parameter<&M::loops, &L::least_matches>("loops.least_matches"),
    parameter<&M::loops, &L::most_conflict>("loops.most_conflict"),
    parameter<&M::loops, &L::ambiguous_rival>("loops.ambiguous_rival"),
    parameter<&M::loops, &L::small_shift_m>("loops.small_shift_m"),
    parameter<&M::loops, &L::small_turn_rad>("loops.small_turn_rad"),
    parameter<&M::loops, &L::witnesses>("loops.witnesses"),
    parameter<&M::loops, &L::point_information>("loops.point_information"),
    parameter<&M::loops, &L::tolerance>("loops.tolerance"),
    parameter<&M::loops, &L::most_contradiction>("loops.most_contradiction"),
    parameter<&M::loops, &L::most_contradiction_in_doubt>("loops.most_contradiction_in_doubt"),
    parameter<&M::loops, &L::late_sigmas>("loops.late_sigmas"),
    parameter<&M::loops, &L::late_deviations>("loops.late_deviations"),
    parameter<&M::loops, &L::late_rounds>("loops.late_rounds"),
    rate<&DriftRates::shift_per_sqrt_m>("loops.drift_shift"),
    rate<&DriftRates::turn_per_sqrt_m>("loops.drift_turn"),
    rate<&DriftRates::turn_per_rad>("loops.drift_turn_per_rad"),
    rate<&DriftRates::unseen_share>("loops.drift_unseen"),
    parameter<&M::prune, &PruneOptions::passes>("prune.passes"),
    parameter<&M::prune, &PruneOptions::near_m>("prune.near_m"),
    parameter<&M::prune, &PruneOptions::near_rad>("prune.near_rad"),
    parameter<&M::prune, &PruneOptions::most_loops>("prune.most_loops"),
    parameter<&M::joint, &J::rounds>("joint.rounds"),
    parameter<&M::joint, &J::neighbours>("joint.neighbours"),
    parameter<&M::joint, &J::radius_m>("joint.radius_m"),
    parameter<&M::joint, &J::first_gate_m>("joint.first_gate_m"),
    parameter<&M::joint, &J::last_gate_m>("joint.last_gate_m"),
    parameter<&M::joint, &J::first_scale_m>("joint.first_scale_m"),
    parameter<&M::joint, &J::last_scale_m>("joint.last_scale_m"),
    parameter<&M::joint, &J::point_information>("joint.point_information"),
    parameter<&M::gather, &G::few_readings>("gather.few_readings"),
    parameter<&M::gather, &G::least_m>("gather.least_m"),
    parameter<&M::gather, &G::most_m>("gather.most_m"),
    parameter<&M::gather, &G::most_turn_rad>("gather.most_turn_rad"),
    parameter<&M::gather, &G::enough_points>("gather.enough_points"),
    parameter<&M::gather, &G::submap_frames>("gather.submap_frames"),
    parameter<&M::gather, &G::query_frames>("gather.query_frames"),
    parameter<&M::gather, &G::least_matches>("gather.least_matches"),
    parameter<&M::gather, &G::least_score>("gather.least_score"),
    parameter<&M::gather, &G::odometry_spread>("gather.odometry_spread"),
    parameter<&M::gather, &G::point_information>("gather.point_information"),
    parameter<&M::fill, &FillOptions::neighbours>("fill.neighbours"),
    parameter<&M::fill, &FillOptions::radius_m>("fill.radius_m"),
    parameter<&M::fill, &FillOptions::stride>("fill.stride"),
    parameter<&M::joint, &J::first_stride>("joint.first_stride"),
};

}  // namespace

std::span<Parameter const> all_parameters() {
  return table;
}

bool is_usable(Parameter const& parameter, double value) {
  constexpr double factor = 1000.0;
  auto const usual = parameter.get({});
  if (!(value >= usual / factor && value <= usual * factor)) return false;
  MapperOptions options;
  parameter.set(options, value);
  return parameter.get(options) > 0.0;  // of whole numbers a small one becomes none
}

}  // namespace lapwing::slam
