#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/async/task.hpp"
#include "base/error.hpp"
#include "base/time.hpp"
#include "geo/position.hpp"
#include "vehicle/slot_counts.hpp"

/// Drones that survey by themselves, as they tell of it over their operator link, for whoever shows and commands them
/// (docs/reference/operation-states.md).
namespace lapwing::vehicle {

/// Something that the drone said, or that became of a command.
struct SurveyWords {
  base::UtcTime at{};
  std::string text = {};
};

struct SurveyDroneView {
  std::string name = {};
  bool is_connected = false;
  std::string trouble = {};  ///< why it is not connected, in words
  std::string state = {};    ///< its operation state, "AutonomousExplore"; empty before its first heartbeat
  std::string mode = {};     ///< of its flight controller; empty where it does not know
  bool is_armed = false;
  bool is_healthy = true;
  std::string health_reason = {};
  std::string user_error = {};  ///< "Desired_Location_Out_Of_Bounds"; empty for none
  std::optional<double> height_m = {};
  std::optional<geo::Wgs84> position = {};
  std::optional<double> battery = {};  ///< 0..1
  std::optional<SlotCounts> slots = {};
  std::optional<double> coverage = {};  ///< 0..1: what it has seen of the area that it surveys
  std::vector<SurveyWords> words = {};  ///< the newest last
};

/// What a drone's camera saw.
struct DronePicture {
  std::shared_ptr<std::string const> jpeg = {};
  base::UtcTime taken{};     ///< by the drone's clock
  std::uint64_t number = 0;  ///< another one for each picture of that view
};
enum class PictureView : std::uint8_t { raw, annotated };

/// A viewer's session with a drone that sends it video.
struct DroneVideo {
  std::string answer = {};   ///< SDP, to the viewer's offer
  std::string session = {};  ///< by which it is ended; nobody guesses it
};

class SurveyDrones {
 public:
  virtual ~SurveyDrones() = default;
  /// In the order in which they were named.
  [[nodiscard]] virtual std::vector<SurveyDroneView> drones() const = 0;
  /// `command`: one JSON object with a `Type`. What becomes of it is among the drone's words. Errors: not_found for a
  /// drone of another name; invalid_input for what is no command; refused while it is not connected, but for Kill,
  /// which waits for a moment.
  [[nodiscard]] virtual base::Result<> command(std::string_view drone, std::string const& command) = 0;
  /// The newest picture of the drone's camera, as soon as it is another one than `after`; the drone sends pictures
  /// while they are asked for. Errors: not_found for a drone of another name; timed_out: NoImage, the camera gives
  /// none; lost: FailedToSend, none can come from there.
  [[nodiscard]] virtual base::Task<base::Result<DronePicture>> picture(std::string drone, PictureView view,
                                                                       std::uint64_t after) = 0;
  /// Has the drone send its video to a viewer, who offers himself as WebRTC has it (SDP). Errors: not_found as above;
  /// refused, the drone says no; lost: FailedToSend, it is not reached or has no such video.
  [[nodiscard]] virtual base::Task<base::Result<DroneVideo>> video(std::string drone, PictureView view,
                                                                   std::string offer) = 0;
  /// Ends it. Errors: as above.
  [[nodiscard]] virtual base::Task<base::Result<>> end_video(std::string drone, std::string session) = 0;
};

}  // namespace lapwing::vehicle
