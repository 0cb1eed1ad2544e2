#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "mavlink/codec/messages.hpp"
#include "vehicle/equipment.hpp"

namespace lapwing::fleet {

/// Follows the pictures that a vehicle takes.
///
/// Up to three messages tell of one picture. The best kind that a vehicle was heard to send counts, others are left
/// alone: CAMERA_IMAGE_CAPTURED of the camera (lost ones can be asked for), CAMERA_FEEDBACK of ArduPilot,
/// CAMERA_TRIGGER (no place: the vehicle's own is taken).
class PictureTrace {
 public:
  /// True when `shown` changed. `missing()` may have grown.
  bool take(mavlink::CameraImageCaptured const& heard, std::uint8_t component, vehicle::Aged<vehicle::Pictures>& shown,
            base::TimePoint now);
  bool take(mavlink::CameraFeedback const& heard, vehicle::Aged<vehicle::Pictures>& shown, base::TimePoint now);
  bool take(mavlink::CameraTrigger const& heard, std::optional<geo::Wgs84> vehicle_position,
            vehicle::Aged<vehicle::Pictures>& shown, base::TimePoint now);

  /// A picture that nobody has told of though later ones were, and whom to ask.
  struct Missing {
    std::uint8_t component = 0;
    std::int32_t image = 0;
    friend auto operator<=>(Missing const&, Missing const&) = default;
  };
  /// Those not yet given out; each only once.
  [[nodiscard]] std::vector<Missing> take_missing();
  [[nodiscard]] bool is_missing(Missing const& picture) const;
  /// The camera counts from 0 again.
  void restart();

 private:
  enum class Source { none, trigger, feedback, captured };
  struct Camera {
    std::optional<std::int64_t> last;  ///< image
    base::Duration since_boot{};       ///< of the last
    std::set<std::int32_t> missing;
  };
  void add(vehicle::Aged<vehicle::Pictures>& shown, std::optional<geo::Wgs84> place, double relative_alt_m,
           base::TimePoint now);
  void add_lost(vehicle::Aged<vehicle::Pictures>& shown, std::int64_t count, base::TimePoint now);
  bool prefers(Source source, vehicle::Aged<vehicle::Pictures>& shown, base::TimePoint now);

  Source source_ = Source::none;
  int number_ = 0;  ///< of the last picture whose place is known
  bool last_has_place_ = false;
  std::map<std::pair<std::uint8_t, std::uint8_t>, Camera> cameras_;  ///< component, camera
  std::optional<std::int64_t> last_feedback_;
  std::optional<std::int64_t> last_trigger_;
  std::vector<Missing> wanted_;
};

}  // namespace lapwing::fleet
