#include "perceive/health.hpp"

#include <fmt/format.h>

namespace lapwing::perceive {

using namespace std::chrono_literals;
using bus::DiagnosticStatus;

namespace {

/// Without a picture that shows something, vision has failed; the first one may take a while.
constexpr base::Duration longest_blind = 2s;
/// Slower than that and ground is flown over unseen.
constexpr double slow_s = 1.0;
constexpr base::Duration oldest_pose = 2s;

DiagnosticStatus status(std::string name, std::uint8_t level, std::string message) {
  return {.level = level, .name = std::move(name), .message = std::move(message), .hardware_id = "lapwing"};
}

template <class Value>
void add(DiagnosticStatus& to, std::string key, Value const& value) {
  to.values.push_back({std::move(key), fmt::format("{}", value)});
}
void add_ms(DiagnosticStatus& to, std::string key, double seconds) {
  constexpr double ms = 1000.0;
  to.values.push_back({std::move(key), fmt::format("{:.0f}", ms * seconds)});
}

struct Verdict {
  std::uint8_t level = DiagnosticStatus::ok;
  std::string words = {};
};

bool is_late(SightRecord const& record, base::TimePoint now) {
  return now - record.good_at.value_or(record.began) > longest_blind;
}

Verdict verdict_on(SightRecord const& record, bool is_late) {
  auto const level = is_late ? DiagnosticStatus::error : DiagnosticStatus::warn;
  auto const& film = record.film;
  if (!film.fault.empty()) return {level, film.fault};
  if (!film.is_open) return {level, "the camera is not open: it is not known yet where the drone is"};
  if (!record.place_fault.empty()) return {level, record.place_fault};
  if (!record.picture_fault.empty()) return {level, fmt::format("a picture shows nothing: {}", record.picture_fault)};
  if (is_late) return {level, "no picture comes"};
  if (record.took_s > slow_s)
    return {DiagnosticStatus::warn,
            fmt::format("too slow: to look at a picture takes {:.1f} s; a smaller one would do", record.took_s)};
  return {};
}

Verdict verdict_on_mapping(ThoughtRecord const& record) {
  if (!record.pose_age) return {DiagnosticStatus::error, "no pose has come from the flight controller"};
  if (*record.pose_age > oldest_pose)
    return {DiagnosticStatus::error, fmt::format("no pose for {:.1f} s", base::to_seconds(*record.pose_age))};
  if (!record.has_home) return {DiagnosticStatus::warn, "home is not known yet"};
  if (record.took_s > slow_s)
    return {DiagnosticStatus::warn, fmt::format("too slow: mapping and planning took {:.1f} s", record.took_s)};
  return {};
}

}  // namespace

std::optional<DiagnosticStatus> vision_health(SightRecord const& record, base::TimePoint now) {
  bool const late = is_late(record, now);
  if (!record.good_at && !late) return std::nullopt;
  auto [level, words] = verdict_on(record, late);
  auto told = status("vision", level, std::move(words));
  add(told, "pictures", record.film.pictures);
  add(told, "pictures_failed", record.film.failed);
  add(told, "pictures_looked_at", record.looked_at);
  add(told, "pictures_blind", record.blind);
  told.values.push_back({"looks_a_second", fmt::format("{:.2f}", record.looks_a_s)});
  add_ms(told, "look_ms", record.took_s);
  return told;
}

DiagnosticStatus mapper_health(ThoughtRecord const& record) {
  auto [level, words] = verdict_on_mapping(record);
  auto told = status("mapper", level, std::move(words));
  auto const& figures = record.figures;
  told.values.push_back({"coverage", fmt::format("{:.3f}", figures.coverage)});
  add(told, "slots", figures.slots);
  add(told, "free", figures.free);
  add(told, "taken", figures.taken);
  add(told, "pictures_mapped", figures.sights);
  add(told, "pictures_unplaced", record.unplaced);
  add(told, "pictures_passed_over", record.passed_over);
  return told;
}

DiagnosticStatus planner_health(ThoughtRecord const& record) {
  bool const is_faulty = !record.fault.empty();
  auto told = status("planner", is_faulty ? DiagnosticStatus::error : DiagnosticStatus::ok, record.fault);
  add(told, "explores", record.explores);
  add(told, "has_goal", record.has_goal);
  add_ms(told, "think_ms", record.took_s);
  return told;
}

}  // namespace lapwing::perceive
