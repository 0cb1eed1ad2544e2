#include "onboard/decide/survey_processes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/text/printable.hpp"
#include "bus/messages/survey_names.hpp"
#include "onboard/decide/flight_hand.hpp"

namespace lapwing::onboard {

namespace topics = bus::survey::names;
using namespace std::chrono_literals;
using bus::Profile;

namespace {

struct HealthTopic {
  std::string_view process;
  std::string_view topic;
};
constexpr std::array health_topics{HealthTopic{"vision", topics::vision_health},
                                   HealthTopic{"mapper", topics::mapper_health},
                                   HealthTopic{"planner", topics::planner_health}};

/// What is seen is told several times a second.
constexpr base::Duration sight_lasts = 2s;
/// Until it counts that a process has not spoken: three of its reports.
constexpr base::Duration first_report = 3s;
constexpr base::Duration time_left_period = 500ms;

std::optional<double> yaw_of(bus::Quaternion const& q) {
  double const square = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  constexpr double least = 0.25;
  if (!std::isfinite(square) || square < least) return std::nullopt;
  return std::atan2(2 * (q.w * q.z + q.x * q.y), square - 2 * (q.y * q.y + q.z * q.z));
}

}  // namespace

std::vector<std::string_view> known_processes() {
  std::vector<std::string_view> known;
  for (auto const& one : health_topics) known.push_back(one.process);
  return known;
}

std::optional<geo::Box<autonomy::ArmingFrame>> seen_extent(autonomy::OccupancyMap const& map) {
  std::uint32_t left = map.columns, right = 0, low = map.rows, high = 0;
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    if (map.cells[i] < 0) continue;
    auto const column = static_cast<std::uint32_t>(i % map.columns);
    auto const row = static_cast<std::uint32_t>(i / map.columns);
    left = std::min(left, column);
    right = std::max(right, column + 1);
    low = std::min(low, row);
    high = std::max(high, row + 1);
  }
  if (right == 0) return std::nullopt;
  auto const corner = [&](std::uint32_t column, std::uint32_t row) {
    return geo::Point<autonomy::ArmingFrame>(map.origin.x() + column * map.resolution_m,
                                             map.origin.y() + row * map.resolution_m);
  };
  return geo::Box<autonomy::ArmingFrame>{corner(left, low), corner(right, high)};
}

base::Result<std::unique_ptr<SurveyProcesses>> SurveyProcesses::open(base::Loop& loop, bus::Bus& bus,
                                                                     FlightHeard const& flight,
                                                                     std::vector<std::string> const& relies_on) {
  std::unique_ptr<SurveyProcesses> processes(new SurveyProcesses(loop, flight));
  if (auto const opened = processes->open_topics(bus, relies_on); !opened) return std::unexpected(opened.error());
  return processes;
}

base::Result<> SurveyProcesses::open_topics(bus::Bus& bus, std::vector<std::string> const& relies_on) {
  bus::Ends ends(bus);
  auto const keep = [&]<class M>(std::string_view topic, Heard<M>& last) {
    ends.hear<M>(topics_, topic, Profile::sensor_data,
                 [this, &last](M const& message) { last = {message, loop_.now()}; });
  };
  for (auto const& [process, topic] : health_topics) {
    if (std::ranges::find(relies_on, process) == relies_on.end()) continue;
    auto& added = processes_.emplace_back(std::make_unique<Process>(std::string(process)));
    keep(topic, added->health);
  }
  keep(topics::lot_detected, sees_lot_);
  keep(topics::place_in_lot, place_in_lot_);
  keep(topics::planner_setpoint, setpoint_);
  ends.hear<bus::OccupancyGrid>(topics_, topics::occupancy_map, Profile::standard,
                                [this](bus::OccupancyGrid const& grid) { take(grid); });
  ends.hear<bus::String>(topics_, topics::survey_report, Profile::standard,
                         [this](bus::String const& words) { take_report(words.data); });
  ends.hear<bus::String>(topics_, topics::parking_slots, Profile::latched,
                         [this](bus::String const& slots) { slots_ = slots.data; });
  ends.say(heights_, topics::hover_heights, Profile::latched);
  ends.say(flying_time_left_, topics::flying_time_left, Profile::standard);
  ends.say(wanted_, topics::wanted_pose, Profile::standard);
  ends.say(state_, topics::current_state, Profile::latched);
  return ends.result();
}

void SurveyProcesses::take(bus::OccupancyGrid const& grid) {
  auto const& at = grid.info.origin.position;
  auto const origin = flight_.from_home(at);
  bool const fits = grid.data.size() == std::size_t{grid.info.width} * grid.info.height &&
                    grid.data.size() <= autonomy::most_map_cells && std::isfinite(grid.info.resolution) &&
                    grid.info.resolution > 0;
  if (!fits || !origin) return;
  map_ = autonomy::OccupancyMap{.columns = grid.info.width,
                                .rows = grid.info.height,
                                .resolution_m = grid.info.resolution,
                                .origin = {origin->x(), origin->y()},
                                .cells = grid.data};
  lot_ = seen_extent(*map_);
}

/// From another process: it is shown as a line, and not without end.
void SurveyProcesses::take_report(std::string const& words) {
  constexpr std::size_t most = 8;
  if (reports_.size() < most) reports_.push_back(base::printable(words));
}

std::optional<base::Duration> SurveyProcesses::silence_of(Process const& process) const {
  auto const now = loop_.now();
  if (process.health.message) return now - process.health.at;
  // After a start in flight nobody has had time to speak yet.
  if (now - began_ <= first_report) return now - began_;
  return std::nullopt;
}

void SurveyProcesses::tell(autonomy::Told& told) const {
  auto const now = loop_.now();
  for (auto const& process : processes_) {
    autonomy::ProcessHealth health{.name = process->name, .silence = silence_of(*process)};
    if (auto const& report = process->health.message) {
      health.is_well = report->level < bus::DiagnosticStatus::error;
      health.words = report->message;
    }
    told.processes.push_back(std::move(health));
  }
  if (auto const* const sees = sees_lot_.within(sight_lasts, now)) told.sees_lot = sees->data;
  told.lot = lot_;
  if (place_in_lot_.message) told.place = {.is_in_lot = place_in_lot_.message->data, .at = place_in_lot_.at};
  if (!setpoint_.message) return;
  auto const& pose = setpoint_.message->pose;
  if (auto const place = flight_.from_home(pose.position))
    told.setpoint = {.place = *place, .yaw_rad = yaw_of(pose.orientation), .at = setpoint_.at};
}

void SurveyProcesses::hear(autonomy::Said const& said) {
  if (told_state_ != said.state) state_->publish({std::string(autonomy::to_string(said.state))});
  told_state_ = said.state;
  tell_time_left(said);
  if (!said.wanted_place) return;
  if (auto const place = flight_.in_local_frame(said.wanted_place->place))
    wanted_->publish(local_pose(*place, said.wanted_place->yaw_rad));
}

void SurveyProcesses::tell_time_left(autonomy::Said const& said) {
  auto const now = loop_.now();
  if (!said.flying_time_left || now < time_left_due_) return;
  time_left_due_ = now + time_left_period;
  flying_time_left_->publish({base::to_seconds(*said.flying_time_left)});
}

void SurveyProcesses::hear(autonomy::HoverHeights const& heights) {
  if (told_heights_ != heights) heights_->publish({.data = {heights.min_m, heights.desired_m, heights.max_m}});
  told_heights_ = heights;
}

}  // namespace lapwing::onboard
