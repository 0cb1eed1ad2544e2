#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/time.hpp"
#include "bus/messages/diagnostics.hpp"
#include "perceive/filming.hpp"
#include "perceive/surveyor.hpp"

namespace lapwing::perceive {

/// How the camera and who looks at its pictures have done, as far as the last report.
struct SightRecord {
  FilmRecord film = {};
  std::string place_fault = {};    ///< why it is not known where the last picture was taken
  std::string picture_fault = {};  ///< why the last picture shows nothing
  base::TimePoint began{};
  std::optional<base::TimePoint> good_at = {};  ///< of the last picture that shows something
  std::uint64_t looked_at = 0;                  ///< pictures
  std::uint64_t blind = 0;                      ///< that show nothing
  double took_s = 0.0;                          ///< to look at the last one
  double looks_a_s = 0.0;
};

/// And who maps and plans.
struct ThoughtRecord {
  std::optional<base::Duration> pose_age = {};  ///< nothing: none was heard
  bool has_home = false;
  std::uint64_t unplaced = 0;     ///< pictures of which it is not known where they were taken
  std::uint64_t passed_over = 0;  ///< sights that came before the one before was on the map
  double took_s = 0.0;            ///< the last time
  std::string fault = {};         ///< why there is no survey
  bool explores = false;
  bool has_goal = false;
  SurveyFigures figures = {};
};

/// Nothing for a moment after the start, until the first picture has shown something or should have: whoever waits for
/// eyes would take anything else for an answer.
[[nodiscard]] std::optional<bus::DiagnosticStatus> vision_health(SightRecord const& record, base::TimePoint now);
[[nodiscard]] bus::DiagnosticStatus mapper_health(ThoughtRecord const& record);
[[nodiscard]] bus::DiagnosticStatus planner_health(ThoughtRecord const& record);

}  // namespace lapwing::perceive
