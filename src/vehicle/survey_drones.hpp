#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <optional>

#include "base/error.hpp"
#include "base/time.hpp"
#include "geo/position.hpp"

/// Drones that survey by themselves, as they tell of it over their operator link, for whoever shows and commands them
/// (docs/reference/operation-states.md).
namespace lapwing::vehicle {

/// Something that the drone said, or that became of a command.
struct SurveyWords {
  base::UtcTime at{};
  std::string text = {};
};

/// Of the places to park that it has found.
struct SlotCounts {
  std::size_t free = 0;
  std::size_t taken = 0;
  std::size_t unknown = 0;
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
  std::vector<SurveyWords> words = {};  ///< the newest last
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
};

}  // namespace lapwing::vehicle
