#pragma once

#include <deque>
#include <optional>
#include <string>

#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "host/survey/survey_desk.hpp"
#include "vehicle/control.hpp"

namespace lapwing::host {

/// The emergency stop of survey drones. Nothing else of what operators do with vehicles goes this way: they take their
/// commands in their own words (`SurveyDesk`).
class SurveyControl final : public vehicle::VehicleControl {
 public:
  /// `desk` and `loop` outlive this. `usual`: what a stop does that says nothing else.
  SurveyControl(base::Loop& loop, SurveyDesk& desk, vehicle::StopAction usual, base::Logger log);
  SurveyControl(SurveyControl const&) = delete;
  SurveyControl& operator=(SurveyControl const&) = delete;

  [[nodiscard]] bool has(vehicle::VehicleId const&) const override { return false; }
  base::Result<std::uint64_t> command(vehicle::VehicleCommand command, std::span<vehicle::VehicleId const> vehicles,
                                      vehicle::Commander by, bool takes_over) override;
  [[nodiscard]] std::deque<vehicle::CommandRecord> const& commands() const override { return no_commands_; }
  /// Says it again once a second to each drone until that one says that it is so.
  void emergency_stop(std::optional<vehicle::StopAction> action, vehicle::Commander by) override;
  void release_emergency_stop(vehicle::Commander by) override;
  [[nodiscard]] vehicle::EmergencyStop const& emergency() const override { return emergency_; }
  base::Result<> request_control(vehicle::VehicleId const& id, vehicle::Commander by) override;
  base::Result<> yield_control(vehicle::VehicleId const& id, vehicle::Commander by) override;
  base::Result<> keep_control(vehicle::VehicleId const& id, vehicle::Commander by) override;
  void forget(vehicle::Commander const&) override {}
  [[nodiscard]] std::uint64_t revision() const override { return revision_; }

 private:
  void stop_all();
  base::Task<> keep_stopped();

  base::Loop& loop_;
  SurveyDesk& desk_;
  vehicle::StopAction usual_;
  base::Logger log_;
  std::uint64_t revision_ = 0;
  std::deque<vehicle::CommandRecord> no_commands_;
  vehicle::EmergencyStop emergency_;
  base::Task<> stopping_;
};

}  // namespace lapwing::host
