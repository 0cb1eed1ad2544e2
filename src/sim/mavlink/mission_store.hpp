#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "base/time.hpp"
#include "mavlink/codec/messages.hpp"
#include "sim/model/mission_plan.hpp"

namespace lapwing::sim {

/// The vehicle's plans (mission, fence, rally points) and its side of the mission protocol. ArduPilot 4.6 asks with
/// MISSION_REQUEST, overwrites a mission in place, repeats after 1 s, gives up after 8 s. PX4 asks with
/// MISSION_REQUEST_INT, has no home item, takes a mission over whole, repeats after 250 ms, gives up after 5 s and says
/// nothing to an item that it did not ask for (MavlinkMissionManager).
class MissionStore {
 public:
  /// What the store needs of the vehicle round it.
  struct Ports {
    std::function<void(mavlink::Address, mavlink::Message)> send;
    std::function<void(mavlink::MavSeverity, std::string)> say;
    /// The mission's item was replaced by a different one, or the mission got longer or shorter.
    std::function<void()> mission_changed;
    std::function<void()> mission_cleared;
    /// The fence or the rally points are others.
    std::function<void()> zones_changed;
    /// A legacy item with current = 2: "go there now".
    std::function<mavlink::MavMissionResult(mavlink::MissionItem const&)> go_to;
    /// Home as item 0; nothing before it is known.
    std::function<std::optional<geo::Wgs84>()> home;
  };
  /// The plans outlive a reboot; transfers do not.
  using Plans = sim::Plans;

  MissionStore(Plans& plans, Ports ports, Kind const& kind = {})
      : plans_(plans), ports_(std::move(ports)), kind_(kind) {}

  /// True when the message belonged to the mission protocol.
  bool handle(mavlink::Message const& message, mavlink::Address from, base::Duration now);
  /// Repeats a request, gives up a dead transfer.
  void tick(base::Duration now);

  /// Answers the item `seq` of an upload with `result` instead of storing it; a fault for tests. Empty: no longer.
  void refuse_item(std::optional<int> seq, mavlink::MavMissionResult result);
  [[nodiscard]] bool receiving() const { return transfer_.has_value(); }

 private:
  struct Transfer {
    mavlink::Address peer;
    mavlink::MissionType type;
    int next = 0;
    int end = 0;  ///< one past the last item
    base::Duration requested{};
    base::Duration progressed{};
    MissionPlan staged;  ///< what is taken over whole: a fence or rally list, PX4's missions
  };

  void on(mavlink::MissionCount const& count, mavlink::Address from, base::Duration now);
  void on(mavlink::MissionWritePartialList const& partial, mavlink::Address from, base::Duration now);
  void on(mavlink::MissionItem const& item, mavlink::Address from, base::Duration now);
  void on(mavlink::MissionRequestList const& request, mavlink::Address from);
  void on_request(int seq, mavlink::MissionType type, mavlink::Address from, mavlink::ItemForm form);
  void on(mavlink::MissionClearAll const& clear, mavlink::Address from);

  MissionPlan* plan_of(mavlink::MissionType type);
  void begin(Transfer transfer, base::Duration now);
  void request(base::Duration now);
  void store(mavlink::MissionItem const& item);
  void take_over(Transfer done);
  [[nodiscard]] std::size_t count_of(mavlink::MissionType type) const;
  [[nodiscard]] bool is_staged(mavlink::MissionType type) const;
  void complete();
  mavlink::MavMissionResult check(mavlink::MissionItem const& item) const;
  void acknowledge(mavlink::Address to, mavlink::MavMissionResult result, mavlink::MissionType type) const;
  void clear(mavlink::MissionType type);
  void say_fence_is_indexed();
  void say_plan_is_received(mavlink::MissionType type);
  [[nodiscard]] mavlink::MissionItem item_zero() const;

  Plans& plans_;
  Ports ports_;
  Kind kind_;
  std::optional<Transfer> transfer_;
  std::optional<int> refused_seq_;
  mavlink::MavMissionResult refused_with_ = mavlink::MavMissionResult::error;
  bool warned_of_item_ = false;
  bool warned_of_request_ = false;
};

}  // namespace lapwing::sim
