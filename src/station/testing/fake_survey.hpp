#pragma once

#include <string>
#include <utility>
#include <vector>

#include "vehicle/survey_drones.hpp"

namespace lapwing::station::testing {

/// Two survey drones: one explores, the other one has not been reached yet.
class FakeSurvey : public vehicle::SurveyDrones {
 public:
  FakeSurvey() {
    list = {{.name = "hawk",
             .is_connected = true,
             .state = "AutonomousExplore",
             .mode = "GUIDED",
             .is_armed = true,
             .user_error = "No_Lot_Detected",
             .height_m = 12.345,
             .position = geo::Wgs84::from_degrees(43.2585, -79.9201),
             .battery = 0.81234,
             .slots = vehicle::SlotCounts{.free = 3, .taken = 4, .unknown = 1},
             .coverage = 0.8125,
             .words = {{.at = base::UtcTime(std::chrono::seconds(1'700'000'000)), .text = "it climbs"}}},
            {.name = "dove", .trouble = "connection refused"}};
  }
  [[nodiscard]] std::vector<vehicle::SurveyDroneView> drones() const override { return list; }
  [[nodiscard]] base::Result<> command(std::string_view drone, std::string const& command) override {
    if (drone != "hawk") return base::fail(base::ErrorKind::refused, "dove is not connected", "connection refused");
    commands.push_back(command);
    return {};
  }

  [[nodiscard]] base::Task<base::Result<vehicle::DronePicture>> picture(std::string drone, vehicle::PictureView view,
                                                                        std::uint64_t after) override {
    if (drone != "hawk") co_return base::fail(base::ErrorKind::timed_out, "NoImage: no picture for 3 s");
    auto const words = view == vehicle::PictureView::raw ? "raw" : "annotated";
    co_return vehicle::DronePicture{.jpeg = std::make_shared<std::string const>(words),
                                    .taken = base::UtcTime(std::chrono::seconds(1'700'000'000)),
                                    .number = after + 1};
  }
  [[nodiscard]] base::Task<base::Result<vehicle::DroneVideo>> video(std::string drone, vehicle::PictureView view,
                                                                    std::string offer) override {
    if (drone != "hawk") co_return base::fail(base::ErrorKind::lost, "FailedToSend: nobody answers at dove:3180");
    auto const words = view == vehicle::PictureView::raw ? "raw" : "annotated";
    co_return vehicle::DroneVideo{.answer = words + (" for " + offer), .session = "5eed"};
  }
  [[nodiscard]] base::Task<base::Result<>> end_video(std::string drone, std::string session) override {
    if (session != "5eed") co_return base::fail(base::ErrorKind::refused, "there is no such session");
    ended.push_back(std::move(drone));
    co_return base::Result<>();
  }

  std::vector<vehicle::SurveyDroneView> list;
  std::vector<std::string> ended;
  std::vector<std::string> commands;
};

}  // namespace lapwing::station::testing
