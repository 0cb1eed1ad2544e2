#include "fleet/testing/autopilot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lapwing::fleet {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using mavlink::MavResult;
using mavlink::MessageId;
using mavlink::MissionState;

namespace {

/// The connection's own questions, whoever else wants something of the vehicle.
bool asks_who_it_is(mavlink::Message const& message) {
  if (std::holds_alternative<mavlink::Timesync>(message)) return true;
  auto const* command = std::get_if<mavlink::CommandLong>(&message);
  if (!command || command->command != mavlink::MavCmd::request_message) return false;
  auto const wanted = static_cast<MessageId>(command->params[0]);
  return wanted == MessageId::autopilot_version || wanted == MessageId::global_position_int;
}

constexpr base::Duration step = 50ms;
constexpr base::Duration upload_patience = 8s;  // ArduPilot's
constexpr base::Duration request_again = 1s;
constexpr base::Duration disarm_delay = 10s;

}  // namespace

TestAutopilot::TestAutopilot(base::Loop& loop, std::unique_ptr<link::ByteLink> link, Options options)
    : loop_(loop), options_(options), booted_(loop.now()), next_beat_(loop.now()), scope_(loop) {
  if (options_.autopilot == mavlink::MavAutopilot::px4) parameters = {{"GF_ACTION", 0.0F}};
  attach(std::move(link));
  scope_.spawn(live());
}

void TestAutopilot::attach(std::unique_ptr<link::ByteLink> link) {
  link_ = std::move(link);
  auto const standing = link_->standing_peers();
  if (!standing.empty()) ground_ = standing.front();
  link_->start([this](link::Peer peer, link::Bytes bytes) {
    ground_ = peer;
    if (is_silent) return;
    parser_.feed(bytes, [this](mavlink::Frame const& frame) { take(frame); });
  });
}

void TestAutopilot::reboot(std::unique_ptr<link::ByteLink> link) {
  mode = 0;
  is_armed = is_flying = is_running_mission_ = is_complete_ = false;
  intervals_.clear();
  upload_.reset();
  booted_ = loop_.now();
  next_beat_ = loop_.now() + 500ms;
  attach(std::move(link));
}

void TestAutopilot::send_as(mavlink::Address source, mavlink::Message const& message) {
  if (is_silent || !ground_) return;
  auto const bytes = mavlink::serialize(mavlink::encode(message, source, sequence_++));
  (void)link_->send(*ground_, bytes.bytes());
}

void TestAutopilot::say(mavlink::MavSeverity severity, std::string text) {
  send(mavlink::StatusText{.severity = severity, .text = std::move(text)});
}

bool TestAutopilot::is_automatic() const {
  return mode == (is_copter() ? copter_mode::automatic : rover_mode::automatic);
}

bool TestAutopilot::has_position() const {
  return loop_.now() - booted_ >= options_.position_ok_after;
}

geo::Wgs84 TestAutopilot::position() const {
  if (place) return *place;
  constexpr double flying_height_m = 20.0;
  return {at_.lat_rad, at_.lon_rad, home.alt_m + (is_flying ? flying_height_m : 0.0)};
}

void TestAutopilot::begin_item() {
  constexpr double top_speed_m_s = 40.0;
  leg_from_ = at_;
  item_began_ = loop_.now();
  auto time = options_.item_time;
  if (current_item < mission.size() && mavlink::has_place(mission[current_item].command)) {
    auto const& there = mission[current_item].place;
    double const far_m = geo::surface_distance_m(at_, {there.lat_rad, there.lon_rad, 0.0});
    time = std::max<base::Duration>(time, base::from_seconds(far_m / top_speed_m_s));
  }
  item_ends_ = item_began_ + time;
}

void TestAutopilot::jump_to(std::uint16_t item) {
  current_item = item;
  begin_item();
}

void TestAutopilot::travel() {
  if (!is_running_mission_ || is_stuck || current_item >= mission.size()) return;
  auto const& there = mission[current_item].place;
  if (!mavlink::has_place(mission[current_item].command)) return;
  double const whole_s = base::to_seconds(item_ends_ - item_began_);
  double const share = std::clamp(base::to_seconds(loop_.now() - item_began_) / whole_s, 0.0, 1.0);
  at_.lat_rad = leg_from_.lat_rad + share * (there.lat_rad - leg_from_.lat_rad);
  at_.lon_rad = leg_from_.lon_rad + share * (there.lon_rad - leg_from_.lon_rad);
}

void TestAutopilot::change_mode(std::uint32_t wanted) {
  mode = wanted;
  if (!is_automatic()) is_running_mission_ = false;
  if (is_automatic() && is_armed && (is_flying || !is_copter())) {
    is_running_mission_ = true;
    is_complete_ = false;
    begin_item();
  }
  if (is_copter() && mode == copter_mode::land) is_flying = false;
  if (mode != copter_mode::guided) climbs_to_m_.reset(), goal.reset();
  if (!is_flying) height_m = 0.0;
  beat();
}

void TestAutopilot::disarm() {
  is_armed = is_flying = is_running_mission_ = false;
  climbs_to_m_.reset();
  goal.reset();
}

int TestAutopilot::commands_heard(MavCmd command) const {
  return static_cast<int>(std::ranges::count_if(heard, [command](mavlink::Message const& message) {
    auto const* plain = std::get_if<mavlink::CommandLong>(&message);
    auto const* placed = std::get_if<mavlink::CommandInt>(&message);
    return (plain && plain->command == command) || (placed && placed->command == command);
  }));
}

std::vector<std::uint32_t> TestAutopilot::modes_commanded() const {
  std::vector<std::uint32_t> modes;
  for (auto const& message : heard) {
    auto const* sent = std::get_if<mavlink::CommandLong>(&message);
    if (!sent || sent->command != MavCmd::do_set_mode || sent->confirmation != 0) continue;
    modes.push_back(static_cast<std::uint32_t>(sent->params[1]));
  }
  return modes;
}

std::vector<MessageId> TestAutopilot::messages_asked_for() const {
  std::vector<MessageId> ids;
  for (auto const& message : heard) {
    auto const* sent = std::get_if<mavlink::CommandLong>(&message);
    if (!sent || sent->command != MavCmd::set_message_interval) continue;
    ids.push_back(static_cast<MessageId>(sent->params[0]));
  }
  return ids;
}

// ---- what it hears

void TestAutopilot::take(mavlink::Frame const& frame) {
  auto const message = mavlink::decode(frame);
  if (!message || std::holds_alternative<mavlink::Heartbeat>(*message)) return;
  auto const target = mavlink::target_of(*message);
  if (target && !mavlink::addresses(*target, options_.address)) return;
  if (!asks_who_it_is(*message)) heard.push_back(*message);
  if (auto const* command = std::get_if<mavlink::CommandLong>(&*message))
    return obey(command->command, command->params, frame.source);
  if (auto const* command = std::get_if<mavlink::CommandInt>(&*message)) {
    bool const is_taken = !ignored_commands.contains(command->command) && !refused_commands.contains(command->command);
    if (is_taken && command->command == MavCmd::do_reposition)
      goal = geo::Wgs84{command->place.lat_rad, command->place.lon_rad, command->place.z_m};
    return obey(command->command, {}, frame.source);
  }
  if (auto const* chosen = std::get_if<mavlink::MissionSetCurrent>(&*message); chosen && takes_set_current_message) {
    current_item = chosen->seq;
    send_message(MessageId::mission_current);
  }
  serve_upload(*message, frame.source);
  serve_parameter(*message);
  serve_parameter(*message);
  serve_download(*message, frame.source);
}

void TestAutopilot::obey(MavCmd command, std::array<float, 7> const& params, mavlink::Address from) {
  if (ignored_commands.contains(command)) return;
  auto result = MavResult::temporarily_rejected;
  if (refused_commands.contains(command)) {
    result = MavResult::failed;
  } else if (times_busy == 0 || command == MavCmd::set_message_interval) {
    result = execute(command, params);
  } else {
    --times_busy;
  }
  send(mavlink::CommandAck{.target = from, .command = command, .result = result, .progress = std::nullopt});
}

MavResult TestAutopilot::execute(MavCmd command, std::array<float, 7> const& params) {
  if (auto const found = modes_by_command.find(command); found != modes_by_command.end()) {
    change_mode(found->second);
    return MavResult::accepted;
  }
  switch (command) {
    case MavCmd::component_arm_disarm:
      if (params[0] == 1.0F) return arm();
      if (is_flying && params[1] != 21196.0F) return MavResult::failed;
      disarm();
      return MavResult::accepted;
    case MavCmd::do_set_mode:
      if (refused_modes.contains(static_cast<std::uint32_t>(params[1]))) return MavResult::failed;
      change_mode(static_cast<std::uint32_t>(params[1]));
      return MavResult::accepted;
    case MavCmd::nav_takeoff:
      if (!is_armed || mode != copter_mode::guided) return MavResult::failed;
      is_flying = true;
      climbs_to_m_ = params[6];
      return MavResult::accepted;
    case MavCmd::do_reposition: change_mode(copter_mode::guided); return MavResult::accepted;
    case MavCmd::mission_start:
      if (is_armed) is_flying = true;
      change_mode(is_copter() ? copter_mode::automatic : rover_mode::automatic);
      return MavResult::accepted;
    case MavCmd::do_set_mission_current:
      current_item = static_cast<std::uint16_t>(params[0]);
      return MavResult::accepted;
    case MavCmd::set_message_interval:
    case MavCmd::get_message_interval:
    case MavCmd::request_message: return serve_stream(command, params);
    case MavCmd::do_set_home: return MavResult::accepted;
    default: return MavResult::unsupported;
  }
}

MavResult TestAutopilot::serve_stream(MavCmd command, std::array<float, 7> const& params) {
  auto const id = static_cast<MessageId>(params[0]);
  if (command == MavCmd::request_message) {
    bool const is_told =
        id == MessageId::home_position ? has_home : id == MessageId::global_position_int && options_.tells_place;
    if (!is_told) return MavResult::unsupported;
    send_message(id);
    return MavResult::accepted;
  }
  if (denied_intervals.contains(id)) return MavResult::denied;
  if (command == MavCmd::get_message_interval) {
    mavlink::MessageInterval answer{.message = id, .interval = std::nullopt};
    if (auto const rate = interval(id)) answer.interval = std::chrono::duration_cast<std::chrono::microseconds>(*rate);
    send(answer);
    return MavResult::accepted;
  }
  if (params[1] < 0.0F) intervals_.erase(id);
  if (params[1] > 0.0F) intervals_[id] = {std::chrono::microseconds(static_cast<long long>(params[1])), loop_.now()};
  return MavResult::accepted;
}

MavResult TestAutopilot::arm() {
  std::optional<std::string> refusal = arming_refusal;
  if (!has_position()) refusal = "Arm: Need Position Estimate";
  if (is_copter() && is_automatic()) refusal = "Arm: AUTO mode not armable";
  if (refusal) {
    say(mavlink::MavSeverity::critical, *refusal);
    return MavResult::failed;
  }
  if (!is_armed) armed_at_ = loop_.now();
  is_armed = true;
  return MavResult::accepted;
}

void TestAutopilot::serve_upload(mavlink::Message const& message, mavlink::Address from) {
  if (auto const* count = std::get_if<mavlink::MissionCount>(&message)) {
    // Not in one step: cut to the new length at once, then written over item by item.
    if (mission.size() > count->count) mission.resize(count->count);
    upload_.reset();
    if (count->count == 0) {
      send(mavlink::MissionAck{.target = from, .result = mavlink::MavMissionResult::accepted});
      return;
    }
    upload_ = Upload{.count = count->count, .last_good = loop_.now(), .next_request = loop_.now(), .partner = from};
  } else if (auto const* item = std::get_if<mavlink::MissionItem>(&message); item && upload_) {
    take_item(*item);
  } else if (auto const* ack = std::get_if<mavlink::MissionAck>(&message); ack && upload_) {
    if (ack->result != mavlink::MavMissionResult::operation_cancelled) return;
    upload_cancelled_ = true;
    upload_.reset();
  }
}

void TestAutopilot::take_item(mavlink::MissionItem item) {
  auto const reply = [&](mavlink::MavMissionResult result) {
    send(mavlink::MissionAck{.target = upload_->partner, .result = result});
  };
  if (item.seq != upload_->taken) return reply(mavlink::MavMissionResult::invalid_sequence);
  if (!upload_->is_asking) return;  // still busy with the item before
  if (silent_from_item == item.seq) {
    is_silent = true;
    return;
  }
  if (refused_item == item.seq) {
    reply(mavlink::MavMissionResult::unsupported);
    upload_.reset();
    return;
  }
  if (forgets_items) item.place.z_m += 100.0;
  if (item.seq == 0) item.place = {.lat_rad = home.lat_rad, .lon_rad = home.lon_rad, .z_m = home.alt_m};
  if (mission.size() <= item.seq) mission.emplace_back();
  mission[item.seq] = item;
  ++upload_->taken;
  upload_->is_asking = false;
  upload_->last_good = loop_.now();
  upload_->next_request = loop_.now() + options_.request_spacing;
  if (upload_->taken < upload_->count) return;
  reply(mavlink::MavMissionResult::accepted);
  upload_.reset();
}

void TestAutopilot::request_item() {
  auto const seq = upload_->taken;
  if (options_.asks_with_request_int) {
    send(mavlink::MissionRequestInt{.target = upload_->partner, .seq = seq});
  } else {
    send(mavlink::MissionRequest{.target = upload_->partner, .seq = seq});
  }
}

void TestAutopilot::serve_download(mavlink::Message const& message, mavlink::Address from) {
  auto const plan_of = [this](mavlink::MissionType type) -> auto const& {
    return type == mavlink::MissionType::fence ? fence : mission;
  };
  if (auto const* list = std::get_if<mavlink::MissionRequestList>(&message)) {
    auto const count = static_cast<std::uint16_t>(plan_of(list->type).size());
    send(mavlink::MissionCount{.target = from, .count = count, .type = list->type});
  }
  auto const answer = [&](std::uint16_t seq, mavlink::MissionType type) {
    auto const& plan = plan_of(type);
    if (seq >= plan.size()) return;
    auto item = plan[seq];
    item.target = from;
    item.seq = seq;
    item.type = type;
    send(item);
  };
  if (auto const* request = std::get_if<mavlink::MissionRequestInt>(&message)) answer(request->seq, request->type);
  if (auto const* request = std::get_if<mavlink::MissionRequest>(&message)) answer(request->seq, request->type);
}

void TestAutopilot::serve_parameter(mavlink::Message const& message) {
  auto const* read = std::get_if<mavlink::ParamRequestRead>(&message);
  auto const found = read ? parameters.find(read->name) : parameters.end();
  if (found == parameters.end()) return;  // as ArduPilot: silent about what it does not have
  send(mavlink::ParamValue{.name = found->first, .value = found->second});
}

// ---- what it does by itself

base::Task<> TestAutopilot::live() {
  while (true) {
    co_await loop_.sleep(step);
    if (loop_.now() >= next_beat_) beat();
    send_due_telemetry();
    move();
    if (upload_ && loop_.now() - upload_->last_good >= upload_patience) {
      send(mavlink::MissionAck{.target = upload_->partner, .result = mavlink::MavMissionResult::operation_cancelled});
      upload_.reset();
    }
    if (upload_ && loop_.now() >= upload_->next_request) {
      request_item();
      upload_->is_asking = true;
      upload_->next_request = loop_.now() + request_again;
    }
    travel();
    advance_mission();
    bool const idles = is_copter() && is_armed && !is_flying && !keeps_armed;
    if (idles && loop_.now() - armed_at_ >= disarm_delay) disarm();
  }
}

void TestAutopilot::move() {
  constexpr double seconds = std::chrono::duration<double>(step).count();
  if (climbs && climbs_to_m_) height_m = std::min(*climbs_to_m_, height_m + 5.0 * seconds);
  if (!goal) return;
  if (tells_target && loop_.now() >= next_target_) {
    mavlink::GlobalSetpoint setpoint;
    setpoint.frame = mavlink::MavFrame::global;
    setpoint.lat_rad = goal->lat_rad;
    setpoint.lon_rad = goal->lon_rad;
    send(mavlink::PositionTargetGlobalInt{loop_.now() - booted_, setpoint});
    next_target_ = loop_.now() + 500ms;
  }
  auto const here = position();
  double const left_m = geo::surface_distance_m(here, *goal);
  if (!moves || left_m < 0.01) return;
  double const share = std::min(1.0, 10.0 * seconds / left_m);
  place = geo::Wgs84{here.lat_rad + share * (goal->lat_rad - here.lat_rad),
                     here.lon_rad + share * (goal->lon_rad - here.lon_rad), here.alt_m};
}

void TestAutopilot::beat() {
  next_beat_ = loop_.now() + 1s;
  std::uint8_t flags = mavlink::mode_flag::custom_mode_enabled;
  if (is_armed) flags |= mavlink::mode_flag::safety_armed;
  auto const status = is_flying ? mavlink::MavState::active : mavlink::MavState::standby;
  send(mavlink::Heartbeat{.type = options_.type,
                          .autopilot = options_.autopilot,
                          .base_mode = flags,
                          .custom_mode = mode,
                          .system_status = status});
}

void TestAutopilot::send_due_telemetry() {
  for (auto& [id, rate] : intervals_) {
    if (loop_.now() < rate.next) continue;
    rate.next = loop_.now() + rate.interval;
    send_message(id);
  }
}

void TestAutopilot::send_message(MessageId id) {
  auto const since_boot = loop_.now() - booted_;
  switch (id) {
    case MessageId::global_position_int: {
      auto const here = has_position() ? false_position.value_or(position()) : geo::Wgs84{};
      return send(mavlink::GlobalPosition{.since_boot = since_boot,
                                          .position = here,
                                          .relative_alt_m = height_m,
                                          .velocity_m_s = velocity_m_s,
                                          .heading_rad = 0.5});
    }
    case MessageId::attitude:
      return send(mavlink::Attitude{.since_boot = since_boot, .roll_rad = 0.0, .pitch_rad = 0.0, .yaw_rad = 0.5});
    case MessageId::sys_status: {
      mavlink::SysStatus status;
      status.sensors_health = arming_refusal ? 0 : mavlink::sensor_flag::prearm_check;
      status.battery_voltage_v = 12.4;
      status.battery_remaining = battery;
      return send(status);
    }
    case MessageId::gps_raw_int: {
      mavlink::GpsRaw gps;
      gps.fix = has_position() ? mavlink::GpsFix::fix_3d : mavlink::GpsFix::no_fix;
      return send(gps);
    }
    case MessageId::ekf_status_report: {
      mavlink::EkfStatusReport report;
      report.flags = has_position() ? 0x33F : 0xA7;  // as ArduCopter 4.6 sends them
      return send(report);
    }
    case MessageId::mission_current: {
      auto state = is_running_mission_ ? MissionState::active : MissionState::not_started;
      if (is_complete_ && reports_complete) state = MissionState::complete;
      auto const total = static_cast<std::uint16_t>(mission.empty() ? 0 : mission.size() - 1);
      return send(mavlink::MissionCurrent{.seq = current_item, .total = total, .state = state});
    }
    case MessageId::extended_sys_state: {
      mavlink::ExtendedSysState state;
      state.landed_state = is_flying ? mavlink::MavLandedState::in_air : mavlink::MavLandedState::on_ground;
      return send(state);
    }
    case MessageId::home_position: return send(mavlink::HomePosition{.position = home, .local_m = {}});
    case MessageId::battery_status: {
      mavlink::BatteryStatus status;
      status.remaining = battery;
      return send(status);
    }
    case MessageId::vfr_hud: return send(mavlink::VfrHud{});
    case MessageId::nav_controller_output: return send(mavlink::NavControllerOutput{});
    case MessageId::rc_channels: return send(mavlink::RcChannels{.count = 8});
    case MessageId::fence_status: return send(mavlink::FenceStatus{});
    case MessageId::wind: return send(mavlink::Wind{});
    default: return;
  }
}

void TestAutopilot::advance_mission() {
  if (!is_running_mission_ || is_stuck || loop_.now() < item_ends_) return;
  if (current_item < mission.size() && mission[current_item].command == MavCmd::nav_loiter_unlim) return;
  finish_item();
}

void TestAutopilot::finish_item() {
  auto const done = current_item;
  send(mavlink::MissionItemReached{.seq = done});
  bool const lands = done < mission.size() && mission[done].command == MavCmd::nav_land;
  if (done + 1 < static_cast<int>(mission.size())) {
    ++current_item;
    return begin_item();
  }
  is_running_mission_ = false;
  is_complete_ = true;
  if (lands) {
    is_flying = false;
    if (!keeps_armed) disarm();
  }
  if (ends_in_rtl) change_mode(copter_mode::rtl);
}

}  // namespace lapwing::fleet
