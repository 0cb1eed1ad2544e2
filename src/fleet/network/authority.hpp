#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "base/async/scope.hpp"
#include "base/error.hpp"
#include "base/log.hpp"
#include "fleet/state/mavlink_vehicle.hpp"
#include "vehicle/control.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::fleet {

/// The commander that every script of this process is.
inline constexpr auto script_commander = "script";

/// Who commands which vehicle: one, or nobody. Shows it in the vehicle's state.
///
/// A request is granted when the commander yields or has not answered in time. While commands are barred, nobody can
/// claim a vehicle. Thread-bound.
class Authority {
 public:
  /// Called when a vehicle goes from one commander to another against the first one's will.
  using Loss = std::function<void(MavlinkVehicle&, vehicle::Commander const& to)>;

  Authority(base::Loop& loop, vehicle::Registry& registry, base::Logger log)
      : loop_(loop), registry_(registry), log_(std::move(log)), scope_(loop) {}
  Authority(Authority const&) = delete;
  Authority& operator=(Authority const&) = delete;

  void set_on_loss(Loss on_loss) { on_loss_ = std::move(on_loss); }
  /// While there is a reason nobody claims anything.
  void bar(std::optional<std::string> reason) { barred_ = std::move(reason); }
  [[nodiscard]] std::optional<std::string> const& barred() const { return barred_; }

  /// The vehicle is `by`'s from now on, if nobody else has it. Error: refused, names who has it or why it is barred.
  base::Result<> claim(MavlinkVehicle& craft, vehicle::Commander const& by);
  /// The same whoever has it.
  void take(MavlinkVehicle& craft, vehicle::Commander const& by);
  /// Nobody's, or whoever's has asked, if it is `by`'s. False when it is not.
  bool yield(MavlinkVehicle& craft, vehicle::Commander const& by);
  /// `by` is gone: what he has is yielded, what he asked for he does not get.
  void forget(MavlinkVehicle& craft, vehicle::Commander const& by);
  /// Turns the request down. False when the vehicle is not `by`'s.
  bool keep(MavlinkVehicle& craft, vehicle::Commander const& by);
  /// Granted at once when nobody has it, else after `timeout` unless the commander answers. Error: refused (somebody
  /// else asks already).
  base::Result<> request(MavlinkVehicle& craft, vehicle::Commander by, base::Duration timeout);

 private:
  void give(MavlinkVehicle& craft, vehicle::Commander const& to);
  base::Task<> grant_later(MavlinkVehicle& craft, vehicle::Commander by, base::TimePoint at);

  base::Loop& loop_;
  vehicle::Registry& registry_;
  base::Logger log_;
  Loss on_loss_;
  std::optional<std::string> barred_;
  base::Scope scope_;
};

}  // namespace lapwing::fleet
