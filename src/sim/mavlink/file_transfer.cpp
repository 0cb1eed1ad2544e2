#include "sim/mavlink/file_transfer.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace lapwing::sim {

namespace {

using namespace std::chrono_literals;

// Where things are in the message: the addressee comes first, then the protocol's own packet.
constexpr std::size_t target_system_at = 1;
constexpr std::size_t target_component_at = 2;
constexpr std::size_t sequence_at = 3;
constexpr std::size_t session_at = 5;
constexpr std::size_t opcode_at = 6;
constexpr std::size_t size_at = 7;
constexpr std::size_t asked_opcode_at = 8;
constexpr std::size_t burst_complete_at = 9;
constexpr std::size_t offset_at = 11;
constexpr std::size_t data_at = 15;
constexpr std::size_t most_data = 239;
constexpr std::uint8_t payload_size = 254;

constexpr std::uint32_t file_transfer_protocol = 110;
constexpr std::size_t parts_of_a_burst = 500;
/// A client that has gone holds a file open no longer than this.
constexpr base::Duration session_timeout = 3s;

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
  ack = 128,
  nak = 129,
};

enum Failure : std::uint8_t {
  failed = 1,
  failed_with_errno = 2,
  invalid_session = 4,
  end_of_file = 6,
  unknown_command = 7,
  file_not_found = 10,
};
constexpr std::uint8_t invalid_argument = 22;  // EINVAL

std::uint32_t number_at(mavlink::Frame const& frame, std::size_t at, int bytes) {
  std::uint32_t number = 0;
  for (int i = bytes; i-- > 0;) number = number << 8U | frame.payload[at + static_cast<std::size_t>(i)];
  return number;
}

void put_number(mavlink::Frame& frame, std::size_t at, int bytes, std::uint32_t number) {
  for (int i = 0; i < bytes; ++i, number >>= 8U)
    frame.payload[at + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(number & 0xFFU);
}

/// The error for what cannot be done with files that do not exist or cannot be written.
std::uint8_t error_for(std::uint8_t opcode) {
  switch (opcode) {
    case list_directory:
    case remove_file:
    case remove_directory:
    case file_checksum: return file_not_found;
    case write_file: return invalid_session;
    default: return opcode < read_in_a_burst ? failed : unknown_command;
  }
}

}  // namespace

struct FileTransfer::Packet {
  std::uint8_t opcode = none;
  std::uint8_t session = 0;
  std::uint32_t offset = 0;
  std::size_t size = 0;  ///< asked for, of a request without data
  std::vector<std::uint8_t> data = {};
  bool burst_complete = false;

  static Packet done(Packet const& asked) { return {.opcode = ack, .session = asked.session, .offset = asked.offset}; }
  static Packet refused(Packet const& asked, std::uint8_t why) {
    return {.opcode = nak, .session = asked.session, .offset = asked.offset, .data = {why}};
  }
};

std::vector<mavlink::Frame> FileTransfer::answer(mavlink::Frame const& request, mavlink::Address self,
                                                 base::Duration now) {
  auto const& asked = request.payload;
  bool const is_request = request.message_id == file_transfer_protocol && asked[opcode_at] < ack;
  bool const is_ours = asked[target_system_at] == self.system || asked[target_system_at] == 0;
  if (!is_request || !is_ours) return {};
  auto const size = std::min<std::size_t>(asked[size_at], most_data);
  auto const data = asked.begin() + data_at;
  std::vector<Packet> told;
  perform({.opcode = asked[opcode_at],
           .session = asked[session_at],
           .offset = number_at(request, offset_at, 4),
           .size = size,
           .data = {data, data + static_cast<std::ptrdiff_t>(size)}},
          told, now);
  std::vector<mavlink::Frame> frames;
  auto sequence = number_at(request, sequence_at, 2);
  for (auto const& packet : told) {
    auto& frame = frames.emplace_back();
    frame.source = self;
    frame.message_id = file_transfer_protocol;
    frame.payload_size = payload_size;
    frame.payload[target_system_at] = request.source.system;
    frame.payload[target_component_at] = request.source.component;
    put_number(frame, sequence_at, 2, ++sequence);
    frame.payload[session_at] = packet.session;
    frame.payload[opcode_at] = packet.opcode;
    frame.payload[size_at] = static_cast<std::uint8_t>(packet.data.size());
    frame.payload[asked_opcode_at] = asked[opcode_at];
    frame.payload[burst_complete_at] = packet.burst_complete ? 1 : 0;
    put_number(frame, offset_at, 4, packet.offset);
    std::ranges::copy(packet.data, frame.payload.begin() + data_at);
  }
  return frames;
}

void FileTransfer::perform(Packet const& asked, std::vector<Packet>& told, base::Duration now) {
  if (file_ && now - file_->used > session_timeout) file_.reset();
  switch (asked.opcode) {
    case none: told.push_back(Packet::done(asked)); return;
    case terminate_session:
    case reset_sessions:
      if (asked.opcode == reset_sessions || (file_ && file_->session == asked.session)) file_.reset();
      told.push_back(Packet::done(asked));
      return;
    case open_to_read: return open(asked, told, now);
    case read_file:
    case read_in_a_burst:
      if (file_) file_->used = now;
      return read(asked, told, asked.opcode == read_file ? 1 : parts_of_a_burst);
    default: told.push_back(Packet::refused(asked, error_for(asked.opcode)));
  }
}

void FileTransfer::open(Packet const& asked, std::vector<Packet>& told, base::Duration now) {
  std::string_view const path(reinterpret_cast<char const*>(asked.data.data()), asked.data.size());
  auto const selection = parameters_ ? packed_parameters_named(path.substr(0, path.find('\0'))) : std::nullopt;
  if (!selection) return told.push_back(Packet::refused(asked, file_not_found));
  if (file_) return told.push_back(Packet::refused(asked, failed));
  file_ = Opened{.session = asked.session, .selection = *selection, .content = {}, .used = now};
  // As ArduPilot: the size is a guess until the file has been read; its end is found by reading.
  constexpr std::size_t about_bytes_each = 12;
  auto reply = Packet::done(asked);
  auto size = parameters_->all().size() * about_bytes_each;
  for (int i = 0; i < 4; ++i, size >>= 8U) reply.data.push_back(static_cast<std::uint8_t>(size & 0xFFU));
  told.push_back(std::move(reply));
}

void FileTransfer::read(Packet const& asked, std::vector<Packet>& told, std::size_t most_parts) {
  if (!file_) return told.push_back(Packet::refused(asked, parameters_ ? file_not_found : invalid_session));
  if (file_->session != asked.session) return told.push_back(Packet::refused(asked, invalid_session));
  auto const size = asked.size == 0 ? most_data : asked.size;
  if (file_->read_size == 0) {
    file_->read_size = size;
    file_->content = pack(*parameters_, file_->selection, size);
  }
  if (size != file_->read_size) {
    auto refusal = Packet::refused(asked, failed_with_errno);
    refusal.data.push_back(invalid_argument);
    return told.push_back(std::move(refusal));
  }
  auto const& content = file_->content;
  std::size_t at = asked.offset;
  for (std::size_t part = 0; part < most_parts && at < content.size(); ++part) {
    auto reply = Packet::done(asked);
    reply.offset = static_cast<std::uint32_t>(at);
    auto const begin = content.begin() + static_cast<std::ptrdiff_t>(at);
    reply.data.assign(begin, begin + static_cast<std::ptrdiff_t>(std::min(size, content.size() - at)));
    reply.burst_complete = most_parts > 1 && part + 1 == most_parts;
    at += reply.data.size();
    told.push_back(std::move(reply));
  }
  bool const is_at_end = told.empty() || (most_parts > 1 && at >= content.size());
  if (!is_at_end) return;
  told.push_back(Packet::refused(asked, end_of_file));
  told.back().offset = static_cast<std::uint32_t>(at);
}

}  // namespace lapwing::sim
