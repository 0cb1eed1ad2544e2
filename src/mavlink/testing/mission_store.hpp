#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "base/async/scope.hpp"
#include "mavlink/exchange/mission_transfer.hpp"
#include "mavlink/testing/fake_vehicle.hpp"

/// What the tests of the mission protocol share.
namespace lapwing::mavlink::testing {

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

/// Way points at heights from `first_m` up.
inline std::vector<MissionItem> mission_of(std::size_t size, double first_m = 100.0) {
  std::vector<MissionItem> items(size);
  for (std::size_t i = 0; i < size; ++i) {
    items[i].seq = static_cast<std::uint16_t>(i);
    items[i].frame = MavFrame::global;
    items[i].command = MavCmd::nav_waypoint;
    items[i].place = {
        .lat_rad = 0.7 + 1e-5 * static_cast<double>(i), .lon_rad = -0.1, .z_m = first_m + static_cast<double>(i)};
  }
  return items;
}

inline base::Result<> upload(Bench& bench, std::vector<MissionItem> items, TransferOptions options = {},
                             TransferProgress progress = {}) {
  return bench.loop.run_until_done(upload_mission(bench.ground, Bench::target, std::move(items), MissionType::mission,
                                                  options, std::move(progress)));
}
inline base::Result<HeldPlan> download(Bench& bench, TransferOptions options = {}, TransferProgress progress = {},
                                       HeldPlan known = {}) {
  return bench.loop.run_until_done(download_mission(bench.ground, Bench::target, MissionType::mission, options,
                                                    std::move(progress), std::move(known)));
}

/// A bench with a mission store, through whose link nothing gets for a time, either way, from the third second on.
struct CutBench : Bench {
  explicit CutBench(base::Duration lasting) : Bench({.delay = 50ms}) { scope_.spawn(cut(lasting)); }

  MissionStore store{*vehicle};

 private:
  base::Task<void> cut(base::Duration lasting) {
    co_await loop.sleep(2s);
    hub.cut(true);
    co_await loop.sleep(lasting);
    hub.cut(false);
  }

  base::Scope scope_{loop};
};

constexpr TransferOptions patient{.outage_limit = 60s};
/// As `lapwing mission` is: for a bad link that is not too much.
constexpr TransferOptions very_patient{.tries = 12, .outage_limit = 60s};

}  // namespace lapwing::mavlink::testing
