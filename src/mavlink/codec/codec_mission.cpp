// Missions, fences and rally points.
#include "mavlink/codec/internal/codec_parts.hpp"
#include "mavlink/wire/wire.hpp"

#include <common/mavlink_msg_mission_ack.hpp>
#include <common/mavlink_msg_mission_clear_all.hpp>
#include <common/mavlink_msg_mission_count.hpp>
#include <common/mavlink_msg_mission_current.hpp>
#include <common/mavlink_msg_mission_item.hpp>
#include <common/mavlink_msg_mission_item_int.hpp>
#include <common/mavlink_msg_mission_item_reached.hpp>
#include <common/mavlink_msg_mission_request.hpp>
#include <common/mavlink_msg_mission_request_int.hpp>
#include <common/mavlink_msg_mission_request_list.hpp>
#include <common/mavlink_msg_mission_request_partial_list.hpp>
#include <common/mavlink_msg_mission_set_current.hpp>
#include <common/mavlink_msg_mission_write_partial_list.hpp>

namespace lapwing::mavlink::internal {

using namespace ::mavlink::common::msg;

namespace {

auto constexpr no_items = std::numeric_limits<std::uint16_t>::max();  // MISSION_CURRENT.total of an empty mission

/// Numbers of 32 bits that came to the standard later than to the generated dialect stand behind what it knows:
/// `opaque_id` of COUNT and ACK, the three ids of MISSION_CURRENT. A frame's payload is zero behind its end.
std::size_t constexpr count_id_at = 5;
std::size_t constexpr ack_id_at = 4;
std::size_t constexpr current_ids_at = 6;
std::size_t constexpr id_size = 4;

std::uint32_t id_at(Frame const& frame, std::size_t offset) {
  std::uint32_t id = 0;
  for (std::size_t i = id_size; i-- > 0;) id = id << 8U | frame.payload[offset + i];
  return id;
}
void put_id(std::uint32_t id, Frame& frame, std::size_t offset) {
  for (std::size_t i = 0; i < id_size; ++i, id >>= 8U)
    frame.payload[offset + i] = static_cast<std::uint8_t>(id & 0xFFU);
  frame.payload_size = std::max(frame.payload_size, static_cast<std::uint8_t>(offset + id_size));
}

/// All of an item but its place, which the two forms hold differently.
template <class Wire>
MissionItem item_without_place(Wire const& w, ItemForm form) {
  return {.target = target(w),
          .seq = w.seq,
          .frame = MavFrame{w.frame},
          .command = MavCmd{w.command},
          .params = {w.param1, w.param2, w.param3, w.param4},
          .place = {},
          .current = w.current,
          .autocontinue = w.autocontinue != 0,
          .type = MissionType{w.mission_type},
          .form = form};
}

template <class Wire>
Wire wire_without_place(MissionItem const& m) {
  Wire w{};
  put_target(w, m.target);
  w.seq = m.seq;
  w.frame = static_cast<std::uint8_t>(m.frame);
  w.command = static_cast<std::uint16_t>(m.command);
  put_params(w, m.params);
  w.current = m.current;
  w.autocontinue = m.autocontinue ? 1 : 0;
  w.mission_type = static_cast<std::uint8_t>(m.type);
  return w;
}

bool holds_degrees(MissionItem const& m) {
  return has_place(m.command) && is_global(m.frame);
}

MissionItem read(MISSION_ITEM_INT const& w) {
  auto m = item_without_place(w, ItemForm::integer);
  m.place = place_from_wire(m.frame, m.command, w.x, w.y, w.z);
  return m;
}

MissionItem read(MISSION_ITEM const& w) {
  auto m = item_without_place(w, ItemForm::floating);
  auto const x = static_cast<double>(w.x);
  auto const y = static_cast<double>(w.y);
  if (holds_degrees(m))
    m.place = {.lat_rad = x * degree, .lon_rad = y * degree, .z_m = w.z};
  else
    m.place = {.x = x, .y = y, .z_m = w.z};
  return m;
}

MissionCount read(MISSION_COUNT const& w) {
  return {.target = target(w), .count = w.count, .type = MissionType{w.mission_type}};
}

MissionRequest read(MISSION_REQUEST const& w) {
  return {.target = target(w), .seq = w.seq, .type = MissionType{w.mission_type}};
}

MissionRequestInt read(MISSION_REQUEST_INT const& w) {
  return {.target = target(w), .seq = w.seq, .type = MissionType{w.mission_type}};
}

MissionRequestList read(MISSION_REQUEST_LIST const& w) {
  return {.target = target(w), .type = MissionType{w.mission_type}};
}

MissionRequestPartialList read(MISSION_REQUEST_PARTIAL_LIST const& w) {
  return {.target = target(w), .start = w.start_index, .end = w.end_index, .type = MissionType{w.mission_type}};
}

MissionWritePartialList read(MISSION_WRITE_PARTIAL_LIST const& w) {
  return {.target = target(w), .start = w.start_index, .end = w.end_index, .type = MissionType{w.mission_type}};
}

MissionAck read(MISSION_ACK const& w) {
  return {.target = target(w), .result = MavMissionResult{w.type}, .type = MissionType{w.mission_type}};
}

MissionClearAll read(MISSION_CLEAR_ALL const& w) {
  return {.target = target(w), .type = MissionType{w.mission_type}};
}

MissionSetCurrent read(MISSION_SET_CURRENT const& w) {
  return {.target = target(w), .seq = w.seq};
}

MissionCurrent read(MISSION_CURRENT const& w) {
  MissionCurrent m{
      .seq = w.seq, .total = w.total, .state = MissionState{w.mission_state}, .mission_mode = w.mission_mode};
  if (w.total == 0) m.total = std::nullopt;  // an autopilot that does not report it
  if (w.total == no_items) m.total = 0;
  return m;
}

MissionItemReached read(MISSION_ITEM_REACHED const& w) {
  return {.seq = w.seq};
}

template <class Wire, class M>
void write_target_and_type(M const& m, Frame& frame) {
  Wire w{};
  put_target(w, m.target);
  w.mission_type = static_cast<std::uint8_t>(m.type);
  pack(w, frame);
}

template <class Wire, class M>
void write_request(M const& m, Frame& frame) {
  Wire w{};
  put_target(w, m.target);
  w.seq = m.seq;
  w.mission_type = static_cast<std::uint8_t>(m.type);
  pack(w, frame);
}

template <class Wire, class M>
void write_partial_list(M const& m, Frame& frame) {
  Wire w{};
  put_target(w, m.target);
  w.start_index = m.start;
  w.end_index = m.end;
  w.mission_type = static_cast<std::uint8_t>(m.type);
  pack(w, frame);
}

}  // namespace

std::optional<Message> read_mission(Frame const& frame) {
  switch (frame.message_id) {
    case MISSION_ITEM::MSG_ID: return read(unpack<MISSION_ITEM>(frame));
    case MISSION_ITEM_INT::MSG_ID: return read(unpack<MISSION_ITEM_INT>(frame));
    case MISSION_COUNT::MSG_ID: {
      auto m = read(unpack<MISSION_COUNT>(frame));
      m.opaque_id = id_at(frame, count_id_at);
      return m;
    }
    case MISSION_REQUEST::MSG_ID: return read(unpack<MISSION_REQUEST>(frame));
    case MISSION_REQUEST_INT::MSG_ID: return read(unpack<MISSION_REQUEST_INT>(frame));
    case MISSION_REQUEST_LIST::MSG_ID: return read(unpack<MISSION_REQUEST_LIST>(frame));
    case MISSION_REQUEST_PARTIAL_LIST::MSG_ID: return read(unpack<MISSION_REQUEST_PARTIAL_LIST>(frame));
    case MISSION_WRITE_PARTIAL_LIST::MSG_ID: return read(unpack<MISSION_WRITE_PARTIAL_LIST>(frame));
    case MISSION_ACK::MSG_ID: {
      auto m = read(unpack<MISSION_ACK>(frame));
      m.opaque_id = id_at(frame, ack_id_at);
      return m;
    }
    case MISSION_CLEAR_ALL::MSG_ID: return read(unpack<MISSION_CLEAR_ALL>(frame));
    case MISSION_SET_CURRENT::MSG_ID: return read(unpack<MISSION_SET_CURRENT>(frame));
    case MISSION_CURRENT::MSG_ID: {
      auto m = read(unpack<MISSION_CURRENT>(frame));
      m.mission_id = id_at(frame, current_ids_at);
      m.fence_id = id_at(frame, current_ids_at + id_size);
      m.rally_id = id_at(frame, current_ids_at + 2 * id_size);
      return m;
    }
    case MISSION_ITEM_REACHED::MSG_ID: return read(unpack<MISSION_ITEM_REACHED>(frame));
    default: return std::nullopt;
  }
}

void write(MissionItem const& m, Frame& frame) {
  if (m.form == ItemForm::integer) {
    auto w = wire_without_place<MISSION_ITEM_INT>(m);
    auto const place = place_to_wire(m.frame, m.command, m.place);
    w.x = place.x;
    w.y = place.y;
    w.z = place.z;
    return pack(w, frame);
  }
  auto w = wire_without_place<MISSION_ITEM>(m);
  w.x = narrow(holds_degrees(m) ? m.place.lat_rad / degree : m.place.x);
  w.y = narrow(holds_degrees(m) ? m.place.lon_rad / degree : m.place.y);
  w.z = narrow(m.place.z_m);
  pack(w, frame);
}

void write(MissionCount const& m, Frame& frame) {
  MISSION_COUNT w{};
  put_target(w, m.target);
  w.count = m.count;
  w.mission_type = static_cast<std::uint8_t>(m.type);
  pack(w, frame);
  put_id(m.opaque_id, frame, count_id_at);
}

void write(MissionRequest const& m, Frame& frame) {
  write_request<MISSION_REQUEST>(m, frame);
}
void write(MissionRequestInt const& m, Frame& frame) {
  write_request<MISSION_REQUEST_INT>(m, frame);
}
void write(MissionRequestList const& m, Frame& frame) {
  write_target_and_type<MISSION_REQUEST_LIST>(m, frame);
}
void write(MissionClearAll const& m, Frame& frame) {
  write_target_and_type<MISSION_CLEAR_ALL>(m, frame);
}

void write(MissionRequestPartialList const& m, Frame& frame) {
  write_partial_list<MISSION_REQUEST_PARTIAL_LIST>(m, frame);
}
void write(MissionWritePartialList const& m, Frame& frame) {
  write_partial_list<MISSION_WRITE_PARTIAL_LIST>(m, frame);
}

void write(MissionAck const& m, Frame& frame) {
  MISSION_ACK w{};
  put_target(w, m.target);
  w.type = static_cast<std::uint8_t>(m.result);
  w.mission_type = static_cast<std::uint8_t>(m.type);
  pack(w, frame);
  put_id(m.opaque_id, frame, ack_id_at);
}

void write(MissionSetCurrent const& m, Frame& frame) {
  MISSION_SET_CURRENT w{};
  put_target(w, m.target);
  w.seq = m.seq;
  pack(w, frame);
}

void write(MissionCurrent const& m, Frame& frame) {
  MISSION_CURRENT w{};
  w.seq = m.seq;
  if (m.total) w.total = *m.total == 0 ? no_items : *m.total;
  w.mission_state = static_cast<std::uint8_t>(m.state);
  w.mission_mode = m.mission_mode;
  pack(w, frame);
  put_id(m.mission_id, frame, current_ids_at);
  put_id(m.fence_id, frame, current_ids_at + id_size);
  put_id(m.rally_id, frame, current_ids_at + 2 * id_size);
}

void write(MissionItemReached const& m, Frame& frame) {
  MISSION_ITEM_REACHED w{};
  w.seq = m.seq;
  pack(w, frame);
}

}  // namespace lapwing::mavlink::internal
