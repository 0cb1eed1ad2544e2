#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/interface/told.hpp"
#include "base/async/loop.hpp"
#include "bus/messages/mavros.hpp"
#include "bus/messages/sensors.hpp"
#include "bus/participant/ends.hpp"

namespace lapwing::onboard {

/// The last message of a topic and when it came.
template <class M>
struct Heard {
  std::optional<M> message = {};
  base::TimePoint at{};

  /// Null when there is none, or it is older.
  [[nodiscard]] M const* within(base::Duration age, base::TimePoint now) const {
    return message && now - at <= age ? &*message : nullptr;
  }
};

/// What the bus says of the flight controller, by all that it has said so far.
struct FlightHeard {
  Heard<bus::mavros::State> state = {};  ///< while connected
  Heard<bus::mavros::SysStatus> system_status = {};
  Heard<bus::BatteryState> battery = {};
  Heard<bus::NavSatFix> position = {};
  Heard<bus::Float64> relative_altitude = {};
  Heard<bus::PoseStamped> pose = {};
  Heard<bus::mavros::HomePosition> home = {};

  /// As the machine takes it: what is too old to be believed is left out. Nothing before the state was heard once.
  [[nodiscard]] std::optional<autonomy::FlightController> told(base::TimePoint now) const;
  /// A place of the bus's local frame as seen from home, and the other way round. Nothing while home is not known.
  [[nodiscard]] std::optional<geo::Point3<autonomy::ArmingFrame>> from_home(bus::Point const& local) const;
  [[nodiscard]] std::optional<bus::Point> in_local_frame(geo::Point3<autonomy::ArmingFrame> const& place) const;
};

/// Keeps it up to date.
class FlightListener {
 public:
  /// `bus` outlives it. Errors: those of the bus.
  [[nodiscard]] static base::Result<std::unique_ptr<FlightListener>> open(base::Loop& loop, bus::Bus& bus);
  FlightListener(FlightListener const&) = delete;
  FlightListener& operator=(FlightListener const&) = delete;

  [[nodiscard]] FlightHeard const& heard() const { return heard_; }
  /// What the flight controller has warned of since the last call, each text once in a while.
  [[nodiscard]] std::vector<std::string> take_warnings();

 private:
  explicit FlightListener(base::Loop& loop) : loop_(loop) {}
  base::Result<> open_topics(bus::Bus& bus);
  void take(bus::mavros::StatusText const& text);

  base::Loop& loop_;
  FlightHeard heard_;
  std::vector<std::string> warnings_;
  std::vector<std::pair<std::string, base::TimePoint>> told_;  ///< of late
  bus::Subscriptions topics_;                                  ///< last: nothing comes any more
};

}  // namespace lapwing::onboard
