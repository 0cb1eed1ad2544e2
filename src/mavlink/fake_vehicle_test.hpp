#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/loop.hpp"
#include "link/impaired_link.hpp"
#include "link/pipe_link.hpp"
#include "mavlink/connection.hpp"
#include "mavlink/mission_transfer.hpp"

/// What the tests of the exchanges share: a ground station and a scripted vehicle on an in-memory link, in simulated
/// time.
namespace lapwing::mavlink::testing {

using namespace std::chrono_literals;

inline base::Task<void> pass(base::Loop& loop, base::Duration time) {
  co_await loop.sleep(time);
}

/// A vehicle that answers by script: `on(message)` is called for everything that reaches it.
class FakeVehicle {
 public:
  FakeVehicle(base::Loop& loop, std::unique_ptr<link::ByteLink> link, Address self = {1, autopilot_component})
      : connection(loop, {.self = self, .heartbeat = heartbeat}, {}),
        subscription_(connection.subscribe([this](Received const& received) {
          if (auto const target = target_of(received.message); target && !addresses(*target, connection.self())) return;
          heard.push_back(received.message);
          if (on) on(received.message);
        })) {
    connection.add_link(std::move(link));
  }

  static Heartbeat heartbeat() {
    return {.type = MavType::quadrotor, .autopilot = MavAutopilot::ardupilotmega, .system_status = MavState::standby};
  }
  void answer(Message message) { (void)connection.send({255, 190}, std::move(message)); }
  template <class M>
  std::vector<M> all() const {
    std::vector<M> found;
    for (auto const& message : heard)
      if (auto const* m = std::get_if<M>(&message)) found.push_back(*m);
    return found;
  }

  std::function<void(Message const&)> on;
  std::vector<Message> heard;
  Connection connection;

 private:
  Subscription subscription_;
};

/// A ground station that already knows vehicle 1.
struct Bench {
  // Without TIMESYNC: which packet a seed loses must not depend on it.
  explicit Bench(link::Impairment impairment = {}, base::Duration timesync_period = {})
      : ground(loop, {.timesync_period = timesync_period}, {}) {
    ground.add_link(hub.take_server());
    vehicle = std::make_unique<FakeVehicle>(loop, link::impair(loop, hub.connect(), impairment));
    loop.run_until_done(heard_vehicle());
  }
  base::Task<void> heard_vehicle() {
    while (!ground.whereabouts(1)) co_await loop.sleep(100ms);
  }
  void run_for(base::Duration time) { loop.run_until_done(pass(loop, time)); }

  base::Loop loop{base::Loop::Pace{.unpaced = true}};
  link::PipeHub hub{loop};
  Connection ground;
  std::unique_ptr<FakeVehicle> vehicle;
  static constexpr Address target{1, autopilot_component};
};

/// The vehicle's side of the mission protocol as ArduPilot plays it: requests item after item, repeats a request every
/// second, gives up after 8 s without a good item, answers an item out of turn with INVALID_SEQUENCE and one after the
/// end with ERROR.
class MissionStore {
 public:
  explicit MissionStore(FakeVehicle& vehicle) : vehicle_(vehicle), scope_(vehicle.connection.loop()) {
    vehicle.on = [this](Message const& message) { take(message); };
  }

  std::vector<MissionItem> items;
  bool asks_with_int = false;                                       ///< MISSION_REQUEST_INT, as PX4 does
  bool silent = false;                                              ///< hears nothing any more
  std::optional<std::size_t> silent_at;                             ///< falls silent when this item comes
  std::optional<std::pair<std::size_t, MavMissionResult>> refuses;  ///< an item, and why
  std::optional<MavMissionResult> refuses_count;
  std::optional<MavMissionResult> refuses_part;  ///< MISSION_WRITE_PARTIAL_LIST, and why
  bool spoils_item_1 = false;                    ///< keeps another height than it was sent
  std::uint32_t opaque_id = 0;                   ///< what it calls its items
  int finished = 0;
  int parts = 0;  ///< uploads of a part

  /// Takes the item that it waits for without a word.
  void swallow(MissionItem const& item) {
    items.push_back(item);
    ++next_;
  }

 private:
  void take(Message const& message) {
    if (silent) return;
    if (auto const* count = std::get_if<MissionCount>(&message)) take_count(*count);
    if (auto const* part = std::get_if<MissionWritePartialList>(&message)) take_part(*part);
    if (auto const* item = std::get_if<MissionItem>(&message)) take_item(*item);
    if (std::get_if<MissionRequestList>(&message)) {
      if (receiving_) return acknowledge(MavMissionResult::denied);
      vehicle_.answer(MissionCount{.count = static_cast<std::uint16_t>(items.size()), .opaque_id = opaque_id});
    }
    if (auto const* request = std::get_if<MissionRequestInt>(&message); request && request->seq < items.size())
      vehicle_.answer(items[request->seq]);
    if (std::get_if<MissionClearAll>(&message)) {
      if (receiving_) return acknowledge(MavMissionResult::error);
      items.clear();
      acknowledge(MavMissionResult::accepted);
    }
  }

  void take_count(MissionCount const& count) {
    if (refuses_count) return acknowledge(*refuses_count);
    receiving_ = false;
    // Not atomic: cut to the new length at once, then written over item by item.
    if (items.size() > count.count) items.resize(count.count);
    if (count.count == 0) return acknowledge(MavMissionResult::accepted);
    receive(0, count.count);
  }

  void take_part(MissionWritePartialList const& part) {
    if (refuses_part) return acknowledge(*refuses_part);
    if (part.start < 0 || part.end < part.start || static_cast<std::size_t>(part.end) >= items.size())
      return acknowledge(MavMissionResult::error);
    ++parts;
    receive(static_cast<std::size_t>(part.start), static_cast<std::size_t>(part.end) + 1);
  }

  void receive(std::size_t first, std::size_t end) {
    next_ = first;
    end_ = end;
    receiving_ = true;
    progressed_ = now();
    request();
    if (!watching_) scope_.spawn(watch());
  }

  void take_item(MissionItem const& item) {
    if (silent_at == item.seq) {
      silent = true;
      return;
    }
    if (!receiving_) return acknowledge(MavMissionResult::error);
    if (item.seq != next_) return acknowledge(MavMissionResult::invalid_sequence);
    if (refuses && refuses->first == item.seq) {
      receiving_ = false;
      return acknowledge(refuses->second);
    }
    progressed_ = now();
    if (next_ == items.size()) items.emplace_back();
    items[next_] = item;
    if (spoils_item_1 && next_ == 1) items[1].place.z_m += 5.0;
    if (++next_ < end_) return request();
    receiving_ = false;
    ++finished;
    acknowledge(MavMissionResult::accepted);
  }

  base::Task<void> watch() {
    watching_ = true;
    while (receiving_) {
      co_await vehicle_.connection.loop().sleep(100ms);
      if (!receiving_ || silent) break;
      if (now() - progressed_ >= 8s) {
        receiving_ = false;
        acknowledge(MavMissionResult::operation_cancelled);
      } else if (now() - requested_ >= 1s) {
        request();
      }
    }
    watching_ = false;
  }

  void request() {
    requested_ = now();
    auto const seq = static_cast<std::uint16_t>(next_);
    if (asks_with_int)
      vehicle_.answer(MissionRequestInt{.seq = seq});
    else
      vehicle_.answer(MissionRequest{.seq = seq});
  }
  void acknowledge(MavMissionResult result) { vehicle_.answer(MissionAck{.result = result}); }
  [[nodiscard]] base::TimePoint now() const { return vehicle_.connection.loop().now(); }

  FakeVehicle& vehicle_;
  bool receiving_ = false;
  bool watching_ = false;
  std::size_t next_ = 0;
  std::size_t end_ = 0;
  base::TimePoint progressed_{};
  base::TimePoint requested_{};
  base::Scope scope_;
};

}  // namespace lapwing::mavlink::testing
