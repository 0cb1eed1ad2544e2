#include "sim/file_transfer.hpp"

#include <cstddef>

namespace lapwing::sim {

namespace {

// Where things are in the message: the addressee comes first, then the protocol's own packet.
constexpr std::size_t target_system_at = 1;
constexpr std::size_t target_component_at = 2;
constexpr std::size_t packet_at = 3;
constexpr std::size_t sequence_at = packet_at;
constexpr std::size_t session_at = packet_at + 2;
constexpr std::size_t opcode_at = packet_at + 3;
constexpr std::size_t size_at = packet_at + 4;
constexpr std::size_t asked_opcode_at = packet_at + 5;
constexpr std::size_t data_at = packet_at + 12;
constexpr std::uint8_t payload_size = 254;

constexpr std::uint32_t file_transfer_protocol = 110;
constexpr std::uint8_t ack = 128;
constexpr std::uint8_t nak = 129;

enum Opcode : std::uint8_t {
  none = 0,
  terminate_session = 1,
  reset_sessions = 2,
  list_directory = 3,
  open_to_read = 4,
  read_file = 5,
  write_file = 7,
  remove_file = 8,
  remove_directory = 10,
  file_checksum = 14,
  read_in_a_burst = 15,
};

/// The protocol's error for it; nothing where there is nothing to be done anyway.
std::optional<std::uint8_t> error_for(std::uint8_t opcode) {
  constexpr std::uint8_t failed = 1;
  constexpr std::uint8_t invalid_session = 4;
  constexpr std::uint8_t unknown_command = 7;
  constexpr std::uint8_t file_not_found = 10;
  switch (opcode) {
    case none:
    case terminate_session:
    case reset_sessions: return std::nullopt;
    case list_directory:
    case open_to_read:
    case remove_file:
    case remove_directory:
    case file_checksum: return file_not_found;
    case read_file:
    case write_file:
    case read_in_a_burst: return invalid_session;
    default: return opcode < read_in_a_burst ? failed : unknown_command;
  }
}

}  // namespace

std::optional<mavlink::Frame> file_transfer_answer(mavlink::Frame const& request, mavlink::Address self) {
  auto const& asked = request.payload;
  bool const is_request = request.message_id == file_transfer_protocol && asked[opcode_at] < ack;
  bool const is_ours = asked[target_system_at] == self.system || asked[target_system_at] == 0;
  if (!is_request || !is_ours) return std::nullopt;
  mavlink::Frame answer;
  answer.source = self;
  answer.message_id = file_transfer_protocol;
  answer.payload_size = payload_size;
  auto& told = answer.payload;
  told[target_system_at] = request.source.system;
  told[target_component_at] = request.source.component;
  auto const sequence = static_cast<unsigned>(asked[sequence_at] | asked[sequence_at + 1] << 8U) + 1;
  told[sequence_at] = static_cast<std::uint8_t>(sequence & 0xFFU);
  told[sequence_at + 1] = static_cast<std::uint8_t>(sequence >> 8U & 0xFFU);
  told[session_at] = asked[session_at];
  told[asked_opcode_at] = asked[opcode_at];
  auto const error = error_for(asked[opcode_at]);
  told[opcode_at] = error ? nak : ack;
  told[size_at] = error ? 1 : 0;
  told[data_at] = error.value_or(0);
  return answer;
}

}  // namespace lapwing::sim
