#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "autonomy/interface/command.hpp"
#include "base/async/loop.hpp"
#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "host/survey/lot_writer.hpp"
#include "host/survey/survey_link.hpp"
#include "vehicle/survey_drones.hpp"

namespace lapwing::host {

/// The operator's seat of survey drones (`lapwing onboard`): keeps connected to each, tells what they say, hands on
/// what they are told and puts what they find on the map.
class SurveyDesk final : public vehicle::SurveyDrones {
 public:
  /// All of these outlive it. Errors: those of `operator_link::connect`, and two of one name.
  [[nodiscard]] static base::Result<std::unique_ptr<SurveyDesk>> open(base::Loop& loop, ::lapwing::map::LiveMap& map,
                                                                      base::Logger log, std::vector<SurveyLink> links);
  SurveyDesk(SurveyDesk const&) = delete;
  SurveyDesk& operator=(SurveyDesk const&) = delete;
  ~SurveyDesk() override;

  [[nodiscard]] std::vector<vehicle::SurveyDroneView> drones() const override;
  /// By an operator, to whom a script loses the drone.
  [[nodiscard]] base::Result<> command(std::string_view drone, std::string const& command) override;
  /// By a script: the same, but that it takes the drone from nobody.
  [[nodiscard]] base::Result<> order(std::string_view drone, std::string const& command);
  /// Told which drone an operator has commanded, before it is.
  void set_on_operator(std::function<void(std::string_view drone)> told) { on_operator_ = std::move(told); }

  [[nodiscard]] base::Task<base::Result<vehicle::DronePicture>> picture(std::string drone, vehicle::PictureView view,
                                                                        std::uint64_t after) override;
  [[nodiscard]] base::Task<base::Result<vehicle::DroneVideo>> video(std::string drone, vehicle::PictureView view,
                                                                    std::string offer) override;
  [[nodiscard]] base::Task<base::Result<>> end_video(std::string drone, std::string session) override;

  /// Why nothing but Land, Disarm and Kill is handed on; empty: everything is.
  void bar(std::string reason) { barred_ = std::move(reason); }
  [[nodiscard]] std::string const& barred() const { return barred_; }
  /// The same as `order`, whatever bars it.
  [[nodiscard]] base::Result<> stop(std::string_view drone, std::string const& command);
  /// The last one, without its map; nothing for a drone that has said none or is not there.
  [[nodiscard]] std::optional<autonomy::report::Heartbeat> heartbeat(std::string_view drone) const;
  [[nodiscard]] bool is_connected(std::string_view drone) const;
  /// How far its survey is; nothing for a drone that has not told or is not there.
  [[nodiscard]] std::optional<autonomy::report::Survey> survey(std::string_view drone) const;
  /// Whenever a drone has said something, is reached or is lost.
  [[nodiscard]] base::Notifier& heard() { return heard_; }

  static constexpr std::size_t words_kept = 20;

 private:
  struct Seat;

  SurveyDesk(base::Loop& loop, base::Logger log);
  [[nodiscard]] Seat* seat_of(std::string_view drone) const;
  [[nodiscard]] base::Result<> send(Seat& seat, autonomy::Command const& command, std::string const& text);
  void hear(Seat& seat);
  void take(Seat& seat, std::string const& text);
  /// On the map, or with the seat. Errors: those of LotWriter.
  [[nodiscard]] base::Result<> show(Seat& seat, autonomy::Report report);
  /// As changes: it is the larger part of what a drone says.
  void ask_for_map(Seat& seat);
  void say(Seat& seat, std::string words);
  /// Looks at the drone's camera until nobody has asked for a while.
  [[nodiscard]] base::Result<> look(Seat& seat, vehicle::PictureView view);
  [[nodiscard]] base::Task<> close_when_idle(Seat& seat, vehicle::PictureView view);
  [[nodiscard]] base::Task<> follow(Seat& seat, link::operator_link::MessageId id, std::string command);

  base::Loop& loop_;
  base::Logger log_;
  std::string barred_;
  std::function<void(std::string_view drone)> on_operator_;
  base::Notifier heard_;
  std::vector<std::unique_ptr<Seat>> seats_;
  base::Scope scope_;
};

}  // namespace lapwing::host
