#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "explore/lot/lot_sight.hpp"
#include "geo/position.hpp"
#include "host/eyes/look_frame.hpp"

/// Words between a program with simulated drones and the one that shows them a simulated car park and looks at it for
/// them: `lapwing overlook`. All places are in the frame of a site, whose anchor goes with each request.
namespace lapwing::host {

/// A camera that looks straight down from a gimbal.
struct DownwardPose {
  geo::Point3<geo::SiteFrame> position = {};
  double yaw_rad = 0.0;  ///< where the upper edge of its picture points, counterclockwise from east
};

/// Which car park, and where it is asked about.
struct CarParkPlace {
  std::filesystem::path world;
  /// Of the frame in which places are told; nothing: of the car park itself.
  std::optional<geo::Wgs84> anchor = {};
};

/// A picture to be taken of it, and to be looked at.
struct CarParkLook {
  CarParkPlace place;
  geo::Lens lens;
  base::UtcTime at;
  DownwardPose pose;  ///< as its drone tells it; the camera is somewhere near
};

/// What is true of it at one moment, and where it lies.
struct CarParkTruth {
  struct Slot {
    explore::Corners outline;
    bool is_taken = false;
  };
  geo::Wgs84 anchor;      ///< of the frame
  double ground_m = 0.0;  ///< up, in the frame
  std::vector<Slot> slots = {};
};

// What such requests name in `look`.
inline constexpr auto car_park_look = "car park";
inline constexpr auto car_park_truth = "car park's truth";

[[nodiscard]] LookFrame look_request(CarParkLook const& look);
/// The lens has a width, a height and a view alone: it does not bend. Errors, invalid_input, here and below: what is
/// wrong with the frame; of an answer, what it says could not be done.
[[nodiscard]] base::Result<CarParkLook> look_in(LookFrame const& request);
/// Of the sight, `slots` and `cars`; nothing when no ground was seen well enough.
[[nodiscard]] LookFrame look_answer(std::optional<explore::LotSight> const& sight);
/// `asked`: by which the sight has its view and time.
[[nodiscard]] base::Result<std::optional<explore::LotSight>> sight_in(LookFrame const& answer, CarParkLook const& asked,
                                                                      double ground_m);

[[nodiscard]] LookFrame truth_request(CarParkPlace const& place, base::UtcTime at);
struct TruthQuestion {
  CarParkPlace place;
  base::UtcTime at;
};
[[nodiscard]] base::Result<TruthQuestion> truth_question_in(LookFrame const& request);
[[nodiscard]] LookFrame truth_answer(CarParkTruth const& truth);
[[nodiscard]] base::Result<CarParkTruth> truth_in(LookFrame const& answer);

/// How a camera there sees the ground.
[[nodiscard]] geo::GroundView view_of(geo::Lens const& lens, DownwardPose const& pose, double ground_m);

}  // namespace lapwing::host
