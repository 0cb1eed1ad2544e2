#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/settings/folder.hpp"
#include "autonomy/states/machine.hpp"
#include "base/async/scope.hpp"
#include "base/async/side_thread.hpp"
#include "base/log.hpp"
#include "bus/participant/bus.hpp"
#include "onboard/decide/flight_hand.hpp"
#include "onboard/decide/flight_listener.hpp"
#include "onboard/decide/lateness.hpp"
#include "onboard/decide/operator_desk.hpp"
#include "onboard/decide/survey_processes.hpp"
#include "vehicle/energy/drain_meter.hpp"

namespace lapwing::onboard {

struct DecideSettings {
  std::filesystem::path state_folder = "lapwing-onboard";  ///< hover heights over boots, diagnostics
  std::vector<std::string> relies_on = {};                 ///< of `known_processes`
  link::operator_link::ServeSettings desk = {};
  autonomy::Options machine = {};
};

/// The process that decides: feeds the machine of operation states 20 times a second with what bus and operator say,
/// and carries out what it says. Nothing in a frame waits; files are written beside the loop.
class Decide {
 public:
  /// `bus` outlives it. Errors: those of the folder, of the bus and of the operator's port.
  [[nodiscard]] static base::Result<std::unique_ptr<Decide>> open(base::Loop& loop, bus::Bus& bus,
                                                                  DecideSettings settings, base::Logger log);
  Decide(Decide const&) = delete;
  Decide& operator=(Decide const&) = delete;

  /// Leaves the drone in a safe state, and then calls `done`, after 8 s at most: one in the air has been seen to return
  /// home or land, one on the ground to be disarmed.
  void leave(std::function<void()> done);

 private:
  Decide(base::Loop& loop, DecideSettings const& settings, base::Logger log);
  base::Result<> open_parts(bus::Bus& bus, DecideSettings settings);
  base::Task<> decide();
  void step();
  [[nodiscard]] autonomy::Told tell();
  /// What flying draws, as far as this flight and the one before have shown.
  void learn_drain(autonomy::FlightController& flight);
  /// What operators want now. What follows a Configure waits until that state, which takes nothing, has ended with the
  /// next frame; but Kill waits for nothing.
  [[nodiscard]] std::vector<autonomy::Command> due_commands();
  void carry_out(autonomy::Said const& said, autonomy::Told const& told);
  void keep(autonomy::Said const& said);
  base::Task<> save_heights(autonomy::HoverHeights heights);
  base::Task<> save_diagnostics(std::string text);
  [[nodiscard]] std::optional<autonomy::Command> command_to_leave() const;
  void leave_if_safe(autonomy::Told const& told);

  base::Loop& loop_;
  base::Logger log_;
  std::filesystem::path folder_name_;
  std::optional<autonomy::Machine> machine_;
  vehicle::DrainMeter drain_;
  std::unique_ptr<FlightListener> flight_;
  std::unique_ptr<FlightHand> hand_;
  std::unique_ptr<SurveyProcesses> processes_;
  std::unique_ptr<OperatorDesk> desk_;
  std::vector<autonomy::Command> held_;  ///< for the next frame
  std::vector<std::string> to_tell_;     ///< to the operator, with the next frame
  std::optional<autonomy::State> logged_state_;
  Lateness lateness_;
  std::function<void()> done_;
  base::TimePoint leaves_until_{};
  bool has_been_told_to_come_down_ = false;
  std::optional<base::SideThread<autonomy::Folder>> folder_;
  base::Scope scope_;
};

}  // namespace lapwing::onboard
