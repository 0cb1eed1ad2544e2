#pragma once

#include <map>
#include <string>
#include <vector>

#include "vehicle/control.hpp"

namespace lapwing::vehicle {

/// The operator's commands of several platforms as one. What concerns a vehicle goes to the platform that has it; the
/// emergency stop goes to all of them at once and is latched while it is with any. With one platform it is that
/// platform, numbers of commands included.
///
/// A vehicle whose id several platforms have is refused every command, stops as well, since nobody knows which of the
/// two would obey; the emergency stop reaches both. Thread-bound.
class JoinedControl final : public VehicleControl {
 public:
  JoinedControl() = default;
  JoinedControl(JoinedControl const&) = delete;
  JoinedControl& operator=(JoinedControl const&) = delete;

  /// One more, before anything else is asked; it outlives this. `name` is what messages call the platform.
  void add(std::string name, VehicleControl& control) { members_.push_back({std::move(name), &control}); }

  [[nodiscard]] bool has(VehicleId const& id) const override { return !owners(id).empty(); }
  base::Result<std::uint64_t> command(VehicleCommand command, std::span<VehicleId const> vehicles, Commander by,
                                      bool takes_over) override;
  [[nodiscard]] std::deque<CommandRecord> const& commands() const override;
  void emergency_stop(std::optional<StopAction> action, Commander by) override;
  void release_emergency_stop(Commander by) override;
  [[nodiscard]] EmergencyStop const& emergency() const override;
  base::Result<> request_control(VehicleId const& id, Commander by) override;
  base::Result<> yield_control(VehicleId const& id, Commander by) override;
  base::Result<> keep_control(VehicleId const& id, Commander by) override;
  void forget(Commander const& by) override;
  [[nodiscard]] std::uint64_t revision() const override;

 private:
  struct Member {
    std::string name;
    VehicleControl* control;
  };
  /// A command as one platform has it.
  struct Part {
    VehicleControl const* control;
    std::uint64_t number;
  };
  [[nodiscard]] bool is_alone() const { return members_.size() == 1; }
  [[nodiscard]] std::vector<Member const*> owners(VehicleId const& id) const;
  /// Errors: not_found, refused (a conflict).
  [[nodiscard]] base::Result<VehicleControl*> owner(VehicleId const& id) const;

  std::vector<Member> members_;
  mutable std::deque<CommandRecord> records_;  ///< brought up to date when somebody asks
  std::map<std::uint64_t, std::vector<Part>> parts_;
  mutable EmergencyStop stop_;  ///< that of all, for who asks
  std::uint64_t last_number_ = 0;
};

}  // namespace lapwing::vehicle
