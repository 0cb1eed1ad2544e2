#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/async/scope.hpp"
#include "base/error.hpp"
#include "base/log.hpp"
#include "vehicle/control.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::vehicle {

/// The commander that every script of this process is.
inline constexpr auto script_commander = "script";

/// Who commands which vehicle, whatever platform has it: one, or nobody. Shows it in the vehicle's state. One a
/// process.
///
/// A request is granted when the commander yields or has not answered in time. While commands are barred, nobody can
/// claim a vehicle. Of a vehicle that is not in the registry nobody has the command, and nobody gets it. Thread-bound.
class Authority {
 public:
  /// Called when a vehicle goes from one commander to another against the first one's will.
  using Loss = std::function<void(VehicleId const&, Commander const& to)>;

  /// Loop and registry outlive this.
  Authority(base::Loop& loop, Registry& registry, base::Logger log)
      : loop_(loop), registry_(registry), log_(std::move(log)), scope_(loop) {}
  Authority(Authority const&) = delete;
  Authority& operator=(Authority const&) = delete;

  /// Each platform has one, which looks whether the vehicle is its own. They outlive the last take-over.
  void add_on_loss(Loss on_loss) { on_loss_.push_back(std::move(on_loss)); }
  /// While there is a reason nobody claims anything.
  void bar(std::optional<std::string> reason) { barred_ = std::move(reason); }
  [[nodiscard]] std::optional<std::string> const& barred() const { return barred_; }

  /// The vehicle is `by`'s from now on, if nobody else has it. Errors: refused, names who has it or why it is barred;
  /// not_found.
  base::Result<> claim(VehicleId const& id, Commander const& by);
  /// The same whoever has it.
  void take(VehicleId const& id, Commander const& by);
  /// Nobody's, or whoever's has asked, if it is `by`'s. False when it is not.
  bool yield(VehicleId const& id, Commander const& by);
  /// `by` is gone: what he has is yielded, what he asked for he does not get.
  void forget(VehicleId const& id, Commander const& by);
  /// Turns the request down. False when the vehicle is not `by`'s.
  bool keep(VehicleId const& id, Commander const& by);
  /// Granted at once when nobody has it, else after `timeout` unless the commander answers. Errors: refused (somebody
  /// else asks already), not_found.
  base::Result<> request(VehicleId const& id, Commander by, base::Duration timeout);

 private:
  /// Null when it is not in the registry.
  [[nodiscard]] VehicleState* find(VehicleId const& id);
  void give(VehicleState& vehicle, Commander const& to);
  base::Task<> grant_later(VehicleId id, Commander by, base::TimePoint at);

  base::Loop& loop_;
  Registry& registry_;
  base::Logger log_;
  std::vector<Loss> on_loss_;
  std::optional<std::string> barred_;
  base::Scope scope_;
};

}  // namespace lapwing::vehicle
