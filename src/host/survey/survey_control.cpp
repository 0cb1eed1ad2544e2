#include "host/survey/survey_control.hpp"

#include <utility>

#include <fmt/format.h>

#include "host/survey/survey_stop.hpp"

namespace lapwing::host {

using namespace std::chrono_literals;
using vehicle::Commander;
using vehicle::VehicleId;

namespace {

std::unexpected<base::Error> not_here() {
  return base::fail(base::ErrorKind::not_found, "survey drones are commanded in their own words",
                    "POST /api/v1/survey/{drone}/commands");
}

}  // namespace

SurveyControl::SurveyControl(base::Loop& loop, SurveyDesk& desk, vehicle::StopAction usual, base::Logger log)
    : loop_(loop), desk_(desk), usual_(usual), log_(std::move(log)) {}

base::Result<std::uint64_t> SurveyControl::command(vehicle::VehicleCommand, std::span<VehicleId const>, Commander,
                                                   bool) {
  return not_here();
}
base::Result<> SurveyControl::request_control(VehicleId const&, Commander) {
  return not_here();
}
base::Result<> SurveyControl::yield_control(VehicleId const&, Commander) {
  return not_here();
}
base::Result<> SurveyControl::keep_control(VehicleId const&, Commander) {
  return not_here();
}

void SurveyControl::emergency_stop(std::optional<vehicle::StopAction> action, Commander by) {
  auto const usual = emergency_.is_latched ? emergency_.action : usual_;
  emergency_ = {.is_latched = true, .action = action.value_or(usual), .by = std::move(by), .since = loop_.utc_now()};
  desk_.bar(fmt::format("the emergency stop of {} is latched", emergency_.by));
  for (auto const& drone : desk_.drones()) emergency_.vehicles.push_back({.vehicle = {drone.name}});
  stop_all();
  stopping_ = keep_stopped();
  stopping_.start();
}

void SurveyControl::release_emergency_stop(Commander by) {
  if (!std::exchange(emergency_.is_latched, false)) return;
  ++revision_;
  stopping_ = {};
  desk_.bar({});
  log_.warn(fmt::format("emergency stop of survey drones released by {}", by));
}

void SurveyControl::stop_all() {
  for (auto& outcome : emergency_.vehicles) {
    auto stop = survey_stop(emergency_.action, desk_.heartbeat(outcome.vehicle.text));
    if (stop.command) {
      ++outcome.tries;
      if (auto const sent = desk_.stop(outcome.vehicle.text, *stop.command); !sent) stop.detail = sent.error().message;
    }
    outcome.is_acknowledged = outcome.is_confirmed = stop.is_done;
    outcome.detail = std::move(stop.detail);
  }
  ++revision_;
}

base::Task<> SurveyControl::keep_stopped() {
  while (true) {
    co_await loop_.sleep(1s);
    stop_all();
  }
}

}  // namespace lapwing::host
