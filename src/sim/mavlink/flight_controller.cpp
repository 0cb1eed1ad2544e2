#include "sim/mavlink/flight_controller.hpp"

#include <fmt/core.h>

#include <array>
#include <bit>
#include <cmath>

#include "mavlink/wire/modes.hpp"
#include "sim/mavlink/sensors.hpp"

namespace lapwing::sim {

using namespace std::chrono_literals;
using namespace mavlink;

namespace {

constexpr base::Duration timesync_period = 10s;
constexpr base::Duration runtime_period = 30s;
/// 75 a step of 50 ms: the 1500 a second of ArduPilot.
constexpr std::size_t parameters_a_step = 75;
constexpr std::string_view hash_name = "_HASH_CHECK";

struct StreamRate {
  std::string_view parameter;
  int stream;  ///< MAV_DATA_STREAM
};
constexpr std::array stream_rates{
    StreamRate{"SR0_RAW_SENS", 1}, StreamRate{"SR0_EXT_STAT", 2}, StreamRate{"SR0_RC_CHAN", 3},
    StreamRate{"SR0_POSITION", 6}, StreamRate{"SR0_EXTRA1", 10},  StreamRate{"SR0_EXTRA2", 11},
    StreamRate{"SR0_EXTRA3", 12},
};

Connection::Options connection_options(FlightController::Setup const& setup, Memory const& memory) {
  // The vehicle's heartbeat is telemetry like any other here: its rate can be changed.
  return {.self = {setup.system_id, autopilot_component},
          .heartbeat = {},
          .timesync_period = {},
          .keys = ring_of(memory.signing_key)};
}

}  // namespace

FlightController::FlightController(base::Loop& loop, Setup const& setup, Site const& site, Memory& memory,
                                   std::unique_ptr<link::ByteLink> link, base::Logger log)
    : loop_(loop),
      site_(site),
      memory_(memory),
      powered_on_(setup.powered_on),
      autopilot_(setup.autopilot, site, memory.parameters, memory.plans),
      telemetry_(setup.autopilot.kind, setup.autopilot.boot.first_heartbeat),
      outputs_(memory.parameters, [this](MavSeverity severity, std::string text) { say(severity, std::move(text)); }),
      missions_(memory.plans, mission_ports(), autopilot_.kind()),
      files_(is_px4() ? nullptr : &memory.parameters),
      connection_(loop, connection_options(setup, memory), log),
      subscription_(connection_.subscribe([this](Received const& received) { receive(received); })),
      log_(std::move(log)) {
  connection_.add_link(std::move(link));
  for (auto const& [name, stream] : stream_rates) follow_stream_rate(name, stream);
  // File transfer has no typed message: nobody but this needs one.
  connection_.set_frame_hook([this](Connection::Direction direction, Frame const& frame, base::TimePoint) {
    if (direction == Connection::Direction::sent || silent()) return;
    for (auto const& answer : files_.answer(frame, connection_.self(), since_power_on()))
      (void)connection_.send(frame.source, answer);
  });
}

void FlightController::follow_stream_rate(std::string_view name, int stream) {
  auto const rate = static_cast<int>(memory_.parameters.value(name));
  // Zero leaves a running stream as it is: ArduPilot only reads these parameters when they are set or at the start.
  if (rate > 0) telemetry_.set_stream(stream, rate, since_power_on());
}

MissionStore::Ports FlightController::mission_ports() {
  auto const keep_count = [this] {
    memory_.parameters.set("MIS_TOTAL", static_cast<float>(memory_.plans.mission.size()));
  };
  return {
      .send = [this](Address to, Message message) { send(to, message); },
      .say = [this](MavSeverity severity, std::string text) { say(severity, std::move(text)); },
      .mission_changed =
          [this, keep_count] {
            keep_count();
            autopilot_.plan_changed();
          },
      .mission_cleared =
          [this, keep_count] {
            keep_count();
            autopilot_.plan_cleared();
          },
      .zones_changed =
          [this] {
            memory_.parameters.set("FENCE_TOTAL", static_cast<float>(memory_.plans.fence.size()));
            memory_.parameters.set("RALLY_TOTAL", static_cast<float>(memory_.plans.rally.size()));
          },
      .go_to = [this](MissionItem const& item) { return go_to_item(item); },
      .home = [this]() -> std::optional<geo::Wgs84> {
        auto const home = autopilot_.home();
        return home ? std::optional(site_.place_at(*home)) : std::nullopt;
      },
  };
}

ReportView FlightController::view() const {
  return {autopilot_, site_, wind_m_s_, loop_.utc_now(), memory_.plans.mission.size(), connection_.self().system};
}

double FlightController::utc_day_s() const {
  auto const utc = loop_.utc_now().time_since_epoch();
  return std::fmod(std::chrono::duration<double>(utc).count(), 86400.0);
}

void FlightController::step(base::Duration dt, geo::Ned wind_m_s) {
  wind_m_s_ = wind_m_s;
  autopilot_.step(since_power_on(), wind_m_s, utc_day_s(), base::to_seconds(dt));
  announce_start();
  missions_.tick(since_power_on());
  drain_outbox();
  step_payload(dt);
  send_parameter_list();
  send_regular();
  send_due();
}

void FlightController::send_due() {
  for (auto const id : telemetry_.take_due(since_power_on())) broadcast_report(id);
}

base::TimePoint FlightController::next_due_between(base::Duration step) const {
  auto const due = telemetry_.next_due_between(step);
  return due == base::Duration::max() ? base::TimePoint::max() : powered_on_ + due;
}

void FlightController::send_regular() {
  auto const now = since_power_on();
  if (now < autopilot_.boot().first_heartbeat) return;
  if (is_px4()) return;
  if (now >= next_timesync_) {
    next_timesync_ = now + timesync_period;
    broadcast(Timesync{.tc1 = {}, .ts1 = now});
  }
  if (now >= next_runtime_) {
    next_runtime_ = now + runtime_period;
    memory_.parameters.set("STAT_RUNTIME", static_cast<float>(std::floor(base::to_seconds(now))));
    if (ground_spoke_) send_parameter(*memory_.parameters.index_of("STAT_RUNTIME"), false, nullptr);
  }
}

/// The texts and the noise of an ArduPilot that starts.
void FlightController::announce_start() {
  if (is_px4()) return;
  struct Line {
    base::Duration at;
    std::string_view text;
  };
  auto const& boot = autopilot_.boot();
  std::array const lines{
      Line{boot.ready_text, "ArduPilot Ready"},         Line{boot.ekf_initialised, "EKF3 IMU0 initialised"},
      Line{boot.gps_fix, "GPS 1: detected u-blox"},     Line{boot.origin_set, "EKF3 IMU0 origin set"},
      Line{boot.position_ok, "EKF3 IMU0 is using GPS"},
  };
  auto const now = since_power_on();
  auto const noise_at = (boot.first_heartbeat + boot.ready_text) / 2;
  if (announced_ < noise_at && now >= noise_at) send_boot_noise();
  for (auto const& line : lines) {
    if (announced_ < line.at && now >= line.at) say(MavSeverity::info, std::string(line.text));
  }
  announced_ = now;
}

/// The gyro calibration writes plain text to the console port, which is the MAVLink port.
void FlightController::send_boot_noise() {
  if (silent()) return;
  auto& link = *connection_.links().front();
  for (std::string_view const text : {"Init Gyro", "*", "*", "\n"}) {
    link::Bytes const bytes(reinterpret_cast<std::uint8_t const*>(text.data()), text.size());
    for (auto const peer : link.standing_peers()) link.send(peer, bytes);
  }
}

void FlightController::drain_outbox() {
  auto const out = std::exchange(autopilot_.outbox(), {});
  if (out.fence_breached) broadcast_report(MessageId::fence_status);
  for (auto const& text : out.texts) say(text.severity, text.text);
  for (auto const& item : out.payload) perform_payload(item);
  if (out.mode_changed) broadcast_report(MessageId::heartbeat);
  if (out.home_changed && autopilot_.home()) {
    broadcast_report(MessageId::home_position);
    broadcast_report(MessageId::gps_global_origin);
  }
  if (out.reached) broadcast(MissionItemReached{wire_seq(autopilot_.kind(), *out.reached)});
  if (out.mission_current_changed && telemetry_.interval(MessageId::mission_current)) {
    broadcast_report(MessageId::mission_current);
  }
}

void FlightController::broadcast_report(MessageId id) {
  if (auto const message = report(id, view())) return broadcast(*message);
  if (auto const message = payload_report(id, 0.0F)) return broadcast(*message);
  if (auto const frame = sensors(id)) broadcast(*frame);
}

std::optional<Frame> FlightController::sensors(MessageId id) const {
  return sensor_report(id, view(), outputs_.pulses(autopilot_));
}

void FlightController::broadcast(Message const& message) {
  if (!silent()) connection_.send_to_all(message);
}

void FlightController::send(Address to, Message const& message) {
  // A ground station that cannot be reached any more is no failure of the vehicle's.
  if (!silent()) (void)connection_.send(to, message);
}

void FlightController::broadcast(Frame const& frame) {
  for (auto const& [peer, listener] : listeners_) send(listener, frame);
}

void FlightController::send(Address to, Frame const& frame) {
  if (!silent()) (void)connection_.send(to, frame);
}

void FlightController::say(MavSeverity severity, std::string text) {
  if (ground_spoke_) broadcast(StatusText{.severity = severity, .text = std::move(text)});
}

void FlightController::receive(Received const& received) {
  if (silent() || since_power_on() < autopilot_.boot().first_heartbeat) return;
  auto const target = target_of(received.message);
  // Components that have no link of their own are not told apart: what is meant for any of them is carried out.
  if (target && target->system != 0 && target->system != connection_.self().system) return;
  if (target && is_for_a_node(*target)) return;
  ground_spoke_ = true;
  listeners_[received.from] = received.source;
  dispatch(received.message, received.source);
  drain_outbox();
}

void FlightController::dispatch(Message const& message, Address from) {
  auto const now = since_power_on();
  if (missions_.handle(message, from, now)) return;
  if (auto const* heartbeat = std::get_if<Heartbeat>(&message)) {
    if (comes_from_the_ground_station(*heartbeat, from)) autopilot_.ground_station_heard();
  } else if (auto const* command_int = std::get_if<CommandInt>(&message)) {
    on(*command_int, from);
  } else if (auto const* command = std::get_if<CommandLong>(&message)) {
    on(as_command_int(*command), from);
  } else if (auto const* mode = std::get_if<SetMode>(&message)) {
    if (mode->base_mode & mode_flag::custom_mode_enabled) (void)autopilot_.set_mode(mode->custom_mode);
  } else if (auto const* stream = std::get_if<RequestDataStream>(&message)) {
    if (!is_px4()) telemetry_.set_stream(stream->stream, stream->start ? stream->rate_hz : 0, now);
  } else if (auto const* timesync = std::get_if<Timesync>(&message)) {
    if (timesync->tc1 == base::Duration{}) send(from, Timesync{.tc1 = now, .ts1 = timesync->ts1});
  } else if (auto const* seq = std::get_if<MissionSetCurrent>(&message)) {
    // A bad number gets no answer.
    if (autopilot_.set_current_item(plan_index(autopilot_.kind(), seq->seq)))
      broadcast_report(MessageId::mission_current);
  } else if (auto const* position = std::get_if<SetPositionTargetGlobalInt>(&message)) {
    on(*position);
  } else if (auto const* steering = std::get_if<SetPositionTargetLocalNed>(&message)) {
    on(*steering);
  } else if (auto const* setup = std::get_if<SetupSigning>(&message)) {
    on(*setup);
  } else {
    dispatch_parameter(message, from);
  }
}

void FlightController::dispatch_parameter(Message const& message, Address from) {
  if (auto const* read = std::get_if<ParamRequestRead>(&message)) {
    on(*read, from);
  } else if (auto const* set = std::get_if<ParamSet>(&message)) {
    on(*set);
  } else if (std::holds_alternative<ParamRequestList>(message)) {
    list_reader_ = from;
    list_next_ = 0;
    if (is_px4()) return send_parameter_hash(from);
    say(MavSeverity::info, "ArduPilot V4.6.0 (Lapwing simulator)");
    say(MavSeverity::info,
        fmt::format("Lapwing sim {} {}", vehicle::to_string(autopilot_.airframe().family), connection_.self().system));
  }
}

void FlightController::on(CommandInt const& command, Address from) {
  auto const result = perform(command, from);
  send(from, CommandAck{.target = from, .command = command.command, .result = result, .progress = {}});
}

void FlightController::on(SetPositionTargetGlobalInt const& target) {
  constexpr std::uint16_t position_ignored = 0b000000000111;
  constexpr std::uint16_t velocity_ignored = 0b000000111000;
  auto const& setpoint = target.setpoint;
  autopilot_.setpoint_heard();
  if (is_px4() && autopilot_.mode().number != px4_offboard) return;
  if ((setpoint.ignore & position_ignored) == 0) {
    MissionItem item;
    item.frame = setpoint.frame;
    item.command = MavCmd::nav_waypoint;
    item.place = {.lat_rad = setpoint.lat_rad, .lon_rad = setpoint.lon_rad, .z_m = setpoint.alt_m};
    (void)go_to_item(item);
  } else if ((setpoint.ignore & velocity_ignored) == 0) {
    (void)autopilot_.guide_velocity(setpoint.velocity_m_s);
  }
}

/// As ArduRover takes it: a speed along the body and a turn rate. Its other forms are not simulated.
void FlightController::on(SetPositionTargetLocalNed const& target) {
  constexpr std::uint16_t velocity_ignored = 0b000000111000;
  constexpr std::uint16_t acceleration_ignored = 0b000111000000;
  constexpr std::uint16_t turn_rate_ignored = 0b100000000000;
  bool const is_in_body = target.frame == MavFrame::body_ned || target.frame == MavFrame::body_offset_ned;
  bool const is_wheels = (target.ignore & (velocity_ignored | turn_rate_ignored)) == 0 &&
                         (target.ignore & acceleration_ignored) == acceleration_ignored;
  if (is_px4() || !is_in_body || !is_wheels) return;
  autopilot_.setpoint_heard();
  (void)autopilot_.guide_wheels({target.velocity_m_s.north, target.yaw_rate_rad_s});
}

MavMissionResult FlightController::go_to_item(MissionItem const& item) {
  auto const home = autopilot_.home();
  if (!home) return MavMissionResult::error;
  auto const point = point_of(item, site_, *home, autopilot_.body().position_m);
  bool const accepted = autopilot_.reposition(point, false) == MavResult::accepted;
  return accepted ? MavMissionResult::accepted : MavMissionResult::error;
}

void FlightController::send_parameter(std::size_t index, bool in_a_list, Address const* to) {
  auto const& all = memory_.parameters.all();
  auto const& parameter = all[index];
  ParamValue const value{.name = parameter.name,
                         .value = is_px4() ? bytewise(parameter) : parameter.value,
                         .type = parameter.type,
                         .count = static_cast<std::uint16_t>(all.size()),
                         .index = static_cast<std::uint16_t>(in_a_list ? index : 65535)};
  if (to) {
    send(*to, value);
  } else {
    broadcast(value);
  }
}

/// PX4's stands before its list and may be asked for by name.
void FlightController::send_parameter_hash(Address to) {
  send(to, ParamValue{.name = std::string(hash_name),
                      .value = std::bit_cast<float>(memory_.parameters.hash()),
                      .type = MavParamType::uint32,
                      .count = static_cast<std::uint16_t>(memory_.parameters.all().size())});
}

bool FlightController::comes_from_the_ground_station(Heartbeat const& heartbeat, Address from) const {
  if (is_px4()) return heartbeat.type == MavType::gcs;
  return from.system == static_cast<int>(memory_.parameters.value("SYSID_MYGCS"));
}

void FlightController::send_parameter_list() {
  if (!list_reader_) return;
  auto const count = memory_.parameters.all().size();
  for (std::size_t sent = 0; sent < parameters_a_step && list_next_ < count; ++sent) {
    send_parameter(list_next_++, true, &*list_reader_);
  }
  if (list_next_ == count) list_reader_.reset();
}

void FlightController::on(ParamRequestRead const& request, Address from) {
  // An unknown name or number gets no answer.
  if (request.index >= 0) {
    auto const index = static_cast<std::size_t>(request.index);
    if (index < memory_.parameters.all().size()) send_parameter(index, true, &from);
  } else if (is_px4() && request.name == hash_name) {
    send_parameter_hash(from);
  } else if (auto const index = memory_.parameters.index_of(request.name)) {
    send_parameter(*index, false, &from);
  }
}

void FlightController::on(ParamSet const& set) {
  auto const index = memory_.parameters.index_of(set.name);
  // A ground station that has the same already returns the hash, so that the list need not be sent.
  bool const knows_all =
      is_px4() && set.name == hash_name && std::bit_cast<std::uint32_t>(set.value) == memory_.parameters.hash();
  if (knows_all) list_reader_.reset();
  if (!index) return;
  auto const type = memory_.parameters.all()[*index].type;
  if (is_px4() && set.type != type) return say(MavSeverity::error, "param types mismatch param: " + set.name);
  if (!memory_.parameters.set(set.name, is_px4() ? from_bytewise(set.value, type) : set.value)) return;
  for (auto const& [name, stream] : stream_rates) {
    if (set.name == name) follow_stream_rate(name, stream);
  }
  send_parameter(*index, false, nullptr);
}

/// As ArduPilot does: kept over restarts, at once in force on every link, zeros switch it off.
void FlightController::on(SetupSigning const& setup) {
  if (autopilot_.armed()) return say(MavSeverity::notice, "ERROR: Won't setup signing when armed");
  bool const is_off = setup.key == SigningKey{} && setup.initial_timestamp == 0;
  memory_.signing_key = is_off ? std::nullopt : std::optional(setup.key);
  connection_.set_keys(ring_of(memory_.signing_key));
}

bool FlightController::pilot_sets_mode(std::uint32_t number) {
  bool const accepted = autopilot_.set_mode(number) == MavResult::accepted;
  drain_outbox();
  return accepted;
}

}  // namespace lapwing::sim
