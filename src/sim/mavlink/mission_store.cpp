#include "sim/mavlink/mission_store.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "sim/model/fence_plan.hpp"

namespace lapwing::sim {

using namespace std::chrono_literals;
using mavlink::Address;
using mavlink::MavMissionResult;
using mavlink::MavSeverity;
using mavlink::Message;
using mavlink::MissionType;

namespace {

constexpr base::Duration repeat_after = 1s;
constexpr base::Duration give_up_after = 8s;
constexpr base::Duration px4_repeats_after = 250ms;
constexpr base::Duration px4_gives_up_after = 5s;
constexpr int most_items = 650;  // of the ArduCopter build that was observed

std::string_view words(MissionType type) {
  if (type == MissionType::fence) return "Fence";
  if (type == MissionType::rally) return "Rally";
  return "Mission";
}

}  // namespace

bool MissionStore::handle(Message const& message, Address from, base::Duration now) {
  using namespace mavlink;
  if (auto const* count = std::get_if<MissionCount>(&message)) {
    on(*count, from, now);
  } else if (auto const* partial = std::get_if<MissionWritePartialList>(&message)) {
    on(*partial, from, now);
  } else if (auto const* item = std::get_if<MissionItem>(&message)) {
    on(*item, from, now);
  } else if (auto const* list = std::get_if<MissionRequestList>(&message)) {
    on(*list, from);
  } else if (auto const* wanted = std::get_if<MissionRequestInt>(&message)) {
    on_request(wanted->seq, wanted->type, from, ItemForm::integer);
  } else if (auto const* legacy = std::get_if<MissionRequest>(&message)) {
    on_request(legacy->seq, legacy->type, from, ItemForm::floating);
  } else if (auto const* clear_all = std::get_if<MissionClearAll>(&message)) {
    on(*clear_all, from);
  } else {
    // The ground station's closing MISSION_ACK is ignored, as are partial downloads.
    return std::holds_alternative<MissionAck>(message) || std::holds_alternative<MissionRequestPartialList>(message);
  }
  return true;
}

MissionPlan* MissionStore::plan_of(MissionType type) {
  switch (type) {
    case MissionType::mission: return &plans_.mission;
    case MissionType::fence: return &plans_.fence;
    case MissionType::rally: return &plans_.rally;
    default: return nullptr;
  }
}

void MissionStore::acknowledge(Address to, MavMissionResult result, MissionType type) const {
  ports_.send(to, mavlink::MissionAck{.target = to, .result = result, .type = type});
}

void MissionStore::on(mavlink::MissionCount const& count, Address from, base::Duration now) {
  if (transfer_ && transfer_->peer != from) return acknowledge(from, MavMissionResult::denied, count.type);
  auto* plan = plan_of(count.type);
  if (!plan) return acknowledge(from, MavMissionResult::unsupported, count.type);
  if (count.count > most_items) {
    ports_.say(MavSeverity::warning, fmt::format("Only {} items are supported", most_items));
    return acknowledge(from, MavMissionResult::no_space, count.type);
  }
  transfer_.reset();
  if (count.count == 0) {
    clear(count.type);
    acknowledge(from, MavMissionResult::accepted, count.type);
    return say_plan_is_received(count.type);
  }
  // Not atomic: the old mission is cut to the new length at once, then overwritten item by item.
  if (!is_staged(count.type) && plan->size() > count.count) {
    plan->resize(count.count);
    ports_.mission_changed();
  }
  begin({.peer = from, .type = count.type, .next = 0, .end = count.count, .staged = {}}, now);
}

void MissionStore::on(mavlink::MissionWritePartialList const& partial, Address from, base::Duration now) {
  if (transfer_ && transfer_->peer != from) return acknowledge(from, MavMissionResult::denied, partial.type);
  if (kind_.is_px4()) return;
  if (partial.type != MissionType::mission) return acknowledge(from, MavMissionResult::unsupported, partial.type);
  int const size = static_cast<int>(plans_.mission.size());
  if (partial.start < 0 || partial.start >= size || partial.end >= size || partial.end < partial.start) {
    ports_.say(MavSeverity::warning, "Flight plan update rejected");
    return acknowledge(from, MavMissionResult::error, partial.type);
  }
  begin({.peer = from, .type = partial.type, .next = partial.start, .end = partial.end + 1, .staged = {}}, now);
}

void MissionStore::begin(Transfer transfer, base::Duration now) {
  transfer_ = std::move(transfer);
  transfer_->progressed = now;
  request(now);
}

void MissionStore::request(base::Duration now) {
  transfer_->requested = now;
  auto const seq = static_cast<std::uint16_t>(transfer_->next);
  if (kind_.is_px4()) {
    ports_.send(transfer_->peer,
                mavlink::MissionRequestInt{.target = transfer_->peer, .seq = seq, .type = transfer_->type});
  } else {
    ports_.send(transfer_->peer,
                mavlink::MissionRequest{.target = transfer_->peer, .seq = seq, .type = transfer_->type});
  }
}

void MissionStore::tick(base::Duration now) {
  if (!transfer_) return;
  if (now - transfer_->progressed >= (kind_.is_px4() ? px4_gives_up_after : give_up_after)) {
    ports_.say(MavSeverity::warning, fmt::format("{} upload timeout", words(transfer_->type)));
    acknowledge(transfer_->peer, MavMissionResult::operation_cancelled, transfer_->type);
    transfer_.reset();
  } else if (now - transfer_->requested >= (kind_.is_px4() ? px4_repeats_after : repeat_after)) {
    request(now);
  }
}

void MissionStore::on(mavlink::MissionItem const& item, Address from, base::Duration now) {
  bool const wanted = transfer_ && transfer_->type == item.type && transfer_->next == item.seq;
  if (kind_.is_px4() && !wanted) return;
  if (item.type == MissionType::mission && item.current == 2) return acknowledge(from, ports_.go_to(item), item.type);
  if (!transfer_ || transfer_->type != item.type) return acknowledge(from, MavMissionResult::error, item.type);
  if (transfer_->peer != from) return acknowledge(from, MavMissionResult::denied, item.type);
  if (item.form == mavlink::ItemForm::floating && !warned_of_item_ && !kind_.is_px4()) {
    warned_of_item_ = true;
    ports_.say(MavSeverity::warning, "got MISSION_ITEM; GCS should send MISSION_ITEM_INT");
  }
  // The transfer goes on: the item asked for may still come.
  if (item.seq != transfer_->next) return acknowledge(from, MavMissionResult::invalid_sequence, item.type);
  if (auto const result = check(item); result != MavMissionResult::accepted) {
    transfer_.reset();
    return acknowledge(from, result, item.type);
  }
  store(item);
  transfer_->progressed = now;
  ++transfer_->next;
  if (transfer_->next < transfer_->end) return request(now);
  complete();
}

MavMissionResult MissionStore::check(mavlink::MissionItem const& item) const {
  if (refused_seq_ == item.seq) return refused_with_;
  if (item.type == MissionType::mission) return refusal(item, kind_, transfer_->end);
  return zone_refusal(item);
}

bool MissionStore::is_staged(MissionType type) const {
  return type != MissionType::mission || kind_.is_px4();
}

std::size_t MissionStore::count_of(MissionType type) const {
  auto const& plan = type == MissionType::mission ? plans_.mission
                     : type == MissionType::fence ? plans_.fence
                                                  : plans_.rally;
  bool const without_home = type == MissionType::mission && kind_.is_px4() && !plan.empty();
  return plan.size() - (without_home ? 1 : 0);
}

void MissionStore::store(mavlink::MissionItem const& item) {
  if (is_staged(item.type)) {
    transfer_->staged.push_back(item.type == MissionType::mission ? item : normalised_zone(item));
    auto& kept = transfer_->staged.back();
    if (item.type == MissionType::mission && kept.command == mavlink::MavCmd::do_jump)
      kept.params[0] += 1.0F;  // the plan counts from home
    return;
  }
  auto& plan = plans_.mission;
  auto const seq = static_cast<std::size_t>(item.seq);
  auto const kept = normalised(item);
  bool const changed = seq >= plan.size() || (seq > 0 && !same_item(plan[seq], kept));
  if (seq < plan.size()) {
    plan[seq] = kept;
  } else {
    plan.push_back(kept);
  }
  if (changed) ports_.mission_changed();
}

void MissionStore::complete() {
  auto const done = std::move(*transfer_);
  transfer_.reset();
  if (done.type == MissionType::fence) {
    if (auto const problem = fence_problem(done.staged)) {
      ports_.say(MavSeverity::warning, *problem);
      if (!kind_.is_px4()) ports_.say(MavSeverity::warning, "Fence validation failed");
      return acknowledge(done.peer, MavMissionResult::error, done.type);
    }
    say_fence_is_indexed();
  }
  if (is_staged(done.type)) take_over(done);
  acknowledge(done.peer, MavMissionResult::accepted, done.type);
  say_plan_is_received(done.type);
}

void MissionStore::say_plan_is_received(MissionType type) {
  if (type == MissionType::mission && !kind_.is_px4()) ports_.say(MavSeverity::info, "Flight plan received");
}

void MissionStore::take_over(Transfer done) {
  if (done.type == MissionType::mission) done.staged.insert(done.staged.begin(), item_zero());
  *plan_of(done.type) = std::move(done.staged);
  if (done.type != MissionType::mission) return ports_.zones_changed();
  ports_.mission_cleared();  // PX4 begins a new mission at its begin
  ports_.mission_changed();
}

void MissionStore::on(mavlink::MissionRequestList const& request_list, Address from) {
  if (transfer_) return acknowledge(from, MavMissionResult::denied, request_list.type);
  if (!plan_of(request_list.type)) return acknowledge(from, MavMissionResult::unsupported, request_list.type);
  auto const count = static_cast<std::uint16_t>(count_of(request_list.type));
  ports_.send(from, mavlink::MissionCount{.target = from, .count = count, .type = request_list.type});
}

void MissionStore::on_request(int seq, MissionType type, Address from, mavlink::ItemForm form) {
  auto const* plan = plan_of(type);
  if (!plan) return acknowledge(from, MavMissionResult::unsupported, type);
  // ArduPilot lets nobody read while somebody writes, but who asks in the old way.
  bool const is_busy = transfer_ && form == mavlink::ItemForm::integer && !kind_.is_px4();
  if (is_busy) return acknowledge(from, MavMissionResult::denied, type);
  if (form == mavlink::ItemForm::floating && !warned_of_request_ && !kind_.is_px4()) {
    warned_of_request_ = true;
    ports_.say(MavSeverity::warning, "got MISSION_REQUEST; use MISSION_REQUEST_INT!");
  }
  auto const count = static_cast<std::uint16_t>(count_of(type));
  if (seq >= count) {
    if (!kind_.is_px4()) ports_.send(from, mavlink::MissionCount{.target = from, .count = count, .type = type});
    return acknowledge(from, MavMissionResult::error, type);
  }
  bool const is_mission = type == MissionType::mission;
  auto const index = static_cast<std::size_t>(is_mission ? plan_index(kind_, seq) : seq);
  auto item = is_mission && index == 0 ? item_zero() : (*plan)[index];
  if (is_mission && kind_.is_px4() && item.command == mavlink::MavCmd::do_jump) item.params[0] -= 1.0F;
  item.target = from;
  item.seq = static_cast<std::uint16_t>(seq);
  item.form = form;
  ports_.send(from, item);
}

mavlink::MissionItem MissionStore::item_zero() const {
  mavlink::MissionItem item;
  item.command = mavlink::MavCmd::nav_waypoint;
  if (auto const home = ports_.home()) {
    item.place.lat_rad = home->lat_rad;
    item.place.lon_rad = home->lon_rad;
    item.place.z_m = home->alt_m;
  }
  return item;
}

void MissionStore::on(mavlink::MissionClearAll const& clear_all, Address from) {
  if (clear_all.type == MissionType::all && kind_.is_px4()) {
    for (auto const type : {MissionType::mission, MissionType::fence, MissionType::rally}) clear(type);
    return acknowledge(from, MavMissionResult::accepted, clear_all.type);
  }
  if (!plan_of(clear_all.type)) return acknowledge(from, MavMissionResult::unsupported, clear_all.type);
  if (transfer_) return acknowledge(from, MavMissionResult::error, clear_all.type);
  clear(clear_all.type);
  acknowledge(from, MavMissionResult::accepted, clear_all.type);
}

void MissionStore::clear(MissionType type) {
  plan_of(type)->clear();
  type == MissionType::mission ? ports_.mission_cleared() : ports_.zones_changed();
  if (type == MissionType::fence) say_fence_is_indexed();
}

/// What an ArduPilot in the loop says whenever it has stored a fence, be it an empty one.
void MissionStore::say_fence_is_indexed() {
  if (!kind_.is_px4()) ports_.say(MavSeverity::debug, "Fence Indexed OK");
}

void MissionStore::refuse_item(std::optional<int> seq, MavMissionResult result) {
  refused_seq_ = seq;
  refused_with_ = result;
}

}  // namespace lapwing::sim
