// Commands, message rates, parameters and signing.
#include "mavlink/codec/internal/codec_parts.hpp"
#include "mavlink/wire/intake.hpp"
#include "mavlink/wire/wire.hpp"

#include <common/mavlink_msg_command_ack.hpp>
#include <common/mavlink_msg_command_int.hpp>
#include <common/mavlink_msg_command_long.hpp>
#include <common/mavlink_msg_message_interval.hpp>
#include <common/mavlink_msg_param_error.hpp>
#include <common/mavlink_msg_param_request_list.hpp>
#include <common/mavlink_msg_param_request_read.hpp>
#include <common/mavlink_msg_param_set.hpp>
#include <common/mavlink_msg_param_value.hpp>
#include <common/mavlink_msg_request_data_stream.hpp>
#include <common/mavlink_msg_set_mode.hpp>
#include <common/mavlink_msg_setup_signing.hpp>

namespace lapwing::mavlink::internal {

using namespace ::mavlink::common::msg;

namespace {

auto constexpr local_unit_m = 1e-4;  // of x and y in COMMAND_INT and MISSION_ITEM_INT
auto constexpr unknown_progress = std::numeric_limits<std::uint8_t>::max();

CommandLong read(COMMAND_LONG const& w) {
  return {.target = target(w),
          .command = MavCmd{w.command},
          .confirmation = w.confirmation,
          .params = {w.param1, w.param2, w.param3, w.param4, w.param5, w.param6, w.param7}};
}

CommandInt read(COMMAND_INT const& w) {
  auto const frame = MavFrame{w.frame};
  auto const command = MavCmd{w.command};
  return {.target = target(w),
          .frame = frame,
          .command = command,
          .params = {w.param1, w.param2, w.param3, w.param4},
          .place = place_from_wire(frame, command, w.x, w.y, w.z)};
}

CommandAck read(COMMAND_ACK const& w, Intake& in) {
  CommandAck m{.target = target(w),
               .command = MavCmd{w.command},
               .result = MavResult{w.result},
               .progress = std::nullopt,
               .result_param2 = w.result_param2};
  if (m.result == MavResult::in_progress)
    m.progress = in("progress", limit::fraction, unless(unknown_progress, w.progress, centi));
  return m;
}

SetMode read(SET_MODE const& w) {
  return {.target_system = w.target_system, .base_mode = w.base_mode, .custom_mode = w.custom_mode};
}

RequestDataStream read(REQUEST_DATA_STREAM const& w) {
  return {.target = target(w), .stream = w.req_stream_id, .rate_hz = w.req_message_rate, .start = w.start_stop != 0};
}

MessageInterval read(MESSAGE_INTERVAL const& w) {
  MessageInterval m{.message = MessageId{w.message_id}, .interval = std::nullopt};
  if (w.interval_us > 0) m.interval = std::chrono::microseconds(w.interval_us);
  return m;
}

ParamRequestRead read(PARAM_REQUEST_READ const& w) {
  return {.target = target(w), .name = text(w.param_id), .index = w.param_index};
}

ParamRequestList read(PARAM_REQUEST_LIST const& w) {
  return {.target = target(w)};
}

ParamSet read(PARAM_SET const& w) {
  return {.target = target(w), .name = text(w.param_id), .value = w.param_value, .type = MavParamType{w.param_type}};
}

ParamValue read(PARAM_VALUE const& w) {
  return {.name = text(w.param_id),
          .value = w.param_value,
          .type = MavParamType{w.param_type},
          .count = w.param_count,
          .index = w.param_index};
}

ParamError read(PARAM_ERROR const& w) {
  return {.target = target(w), .name = text(w.param_id), .index = w.param_index, .error = MavParamError{w.error}};
}

SetupSigning read(SETUP_SIGNING const& w) {
  return {.target = target(w), .key = w.secret_key, .initial_timestamp = w.initial_timestamp};
}

}  // namespace

ItemPlace place_from_wire(MavFrame frame, MavCmd command, std::int32_t x, std::int32_t y, float z) {
  if (!has_place(command) || frame == MavFrame::mission)
    return {.x = static_cast<double>(x), .y = static_cast<double>(y), .z_m = z};
  if (is_global(frame)) return {.lat_rad = radians_e7(x), .lon_rad = radians_e7(y), .z_m = z};
  return {.x = x * local_unit_m, .y = y * local_unit_m, .z_m = z};
}

WirePlace place_to_wire(MavFrame frame, MavCmd command, ItemPlace const& place) {
  auto const z = narrow(place.z_m);
  if (!has_place(command) || frame == MavFrame::mission)
    return {rounded<std::int32_t>(place.x), rounded<std::int32_t>(place.y), z};
  if (is_global(frame)) return {degrees_e7(place.lat_rad), degrees_e7(place.lon_rad), z};
  return {rounded<std::int32_t>(place.x / local_unit_m), rounded<std::int32_t>(place.y / local_unit_m), z};
}

std::optional<Message> read_command(Frame const& frame, Intake& in) {
  switch (frame.message_id) {
    case COMMAND_LONG::MSG_ID: return read(unpack<COMMAND_LONG>(frame));
    case COMMAND_INT::MSG_ID: return read(unpack<COMMAND_INT>(frame));
    case COMMAND_ACK::MSG_ID: return read(unpack<COMMAND_ACK>(frame), in);
    case SET_MODE::MSG_ID: return read(unpack<SET_MODE>(frame));
    case REQUEST_DATA_STREAM::MSG_ID: return read(unpack<REQUEST_DATA_STREAM>(frame));
    case MESSAGE_INTERVAL::MSG_ID: return read(unpack<MESSAGE_INTERVAL>(frame));
    case PARAM_REQUEST_READ::MSG_ID: return read(unpack<PARAM_REQUEST_READ>(frame));
    case PARAM_REQUEST_LIST::MSG_ID: return read(unpack<PARAM_REQUEST_LIST>(frame));
    case PARAM_SET::MSG_ID: return read(unpack<PARAM_SET>(frame));
    case PARAM_VALUE::MSG_ID: return read(unpack<PARAM_VALUE>(frame));
    case PARAM_ERROR::MSG_ID: return read(unpack<PARAM_ERROR>(frame));
    case SETUP_SIGNING::MSG_ID: return read(unpack<SETUP_SIGNING>(frame));
    default: return std::nullopt;
  }
}

void write(CommandLong const& m, Frame& frame) {
  COMMAND_LONG w{};
  put_target(w, m.target);
  w.command = static_cast<std::uint16_t>(m.command);
  w.confirmation = m.confirmation;
  put_params(w, m.params);
  w.param5 = m.params[4];
  w.param6 = m.params[5];
  w.param7 = m.params[6];
  pack(w, frame);
}

void write(CommandInt const& m, Frame& frame) {
  auto const place = place_to_wire(m.frame, m.command, m.place);
  COMMAND_INT w{};
  put_target(w, m.target);
  w.frame = static_cast<std::uint8_t>(m.frame);
  w.command = static_cast<std::uint16_t>(m.command);
  put_params(w, m.params);
  w.x = place.x;
  w.y = place.y;
  w.z = place.z;
  pack(w, frame);
}

void write(CommandAck const& m, Frame& frame) {
  COMMAND_ACK w{};
  put_target(w, m.target);
  w.command = static_cast<std::uint16_t>(m.command);
  w.result = static_cast<std::uint8_t>(m.result);
  if (m.result == MavResult::in_progress) w.progress = rounded_or(unknown_progress, m.progress, centi);
  w.result_param2 = m.result_param2;
  pack(w, frame);
}

void write(SetMode const& m, Frame& frame) {
  SET_MODE w{};
  w.target_system = m.target_system;
  w.base_mode = m.base_mode;
  w.custom_mode = m.custom_mode;
  pack(w, frame);
}

void write(RequestDataStream const& m, Frame& frame) {
  REQUEST_DATA_STREAM w{};
  put_target(w, m.target);
  w.req_stream_id = m.stream;
  w.req_message_rate = m.rate_hz;
  w.start_stop = m.start ? 1 : 0;
  pack(w, frame);
}

void write(MessageInterval const& m, Frame& frame) {
  MESSAGE_INTERVAL w{};
  w.message_id = static_cast<std::uint16_t>(m.message);
  w.interval_us = m.interval ? static_cast<std::int32_t>(m.interval->count()) : -1;
  pack(w, frame);
}

void write(ParamRequestRead const& m, Frame& frame) {
  PARAM_REQUEST_READ w{};
  put_target(w, m.target);
  w.param_id = text_field<16>(m.name);
  w.param_index = m.index;
  pack(w, frame);
}

void write(ParamRequestList const& m, Frame& frame) {
  PARAM_REQUEST_LIST w{};
  put_target(w, m.target);
  pack(w, frame);
}

void write(ParamSet const& m, Frame& frame) {
  PARAM_SET w{};
  put_target(w, m.target);
  w.param_id = text_field<16>(m.name);
  w.param_value = m.value;
  w.param_type = static_cast<std::uint8_t>(m.type);
  pack(w, frame);
}

void write(ParamValue const& m, Frame& frame) {
  PARAM_VALUE w{};
  w.param_id = text_field<16>(m.name);
  w.param_value = m.value;
  w.param_type = static_cast<std::uint8_t>(m.type);
  w.param_count = m.count;
  w.param_index = m.index;
  pack(w, frame);
}

void write(ParamError const& m, Frame& frame) {
  PARAM_ERROR w{};
  put_target(w, m.target);
  w.param_id = text_field<16>(m.name);
  w.param_index = m.index;
  w.error = static_cast<std::uint8_t>(m.error);
  pack(w, frame);
}

void write(SetupSigning const& m, Frame& frame) {
  SETUP_SIGNING w{};
  put_target(w, m.target);
  w.secret_key = m.key;
  w.initial_timestamp = m.initial_timestamp;
  pack(w, frame);
}

}  // namespace lapwing::mavlink::internal
