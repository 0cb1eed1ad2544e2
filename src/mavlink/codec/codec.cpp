#include "mavlink/codec/codec.hpp"

#include "mavlink/codec/internal/codec_parts.hpp"
#include "mavlink/wire/intake.hpp"

namespace lapwing::mavlink {

namespace {

std::optional<Message> decode(Frame const& frame, internal::Intake in) {
  // The busiest group first, and without a copy on the way.
  if (internal::is_motion(frame.message_id)) return internal::read_motion(frame, in);
  if (auto message = internal::read_state(frame, in)) return message;
  if (auto message = internal::read_payload(frame, in)) return message;
  if (auto message = internal::read_mission(frame)) return message;
  return internal::read_command(frame, in);
}

}  // namespace

std::optional<Message> decode(Frame const& frame) {
  return decode(frame, internal::Intake(nullptr));
}

std::optional<Message> decode(Frame const& frame, std::vector<ImpossibleField>& impossible) {
  return decode(frame, internal::Intake(&impossible));
}

Frame encode(Message const& message, Address self, std::uint8_t seq) {
  Frame frame;
  frame.source = self;
  frame.seq = seq;
  std::visit([&frame](auto const& m) { internal::write(m, frame); }, message);
  return frame;
}

std::optional<Address> target_of(Message const& message) {
  return std::visit(
      [](auto const& m) -> std::optional<Address> {
        if constexpr (requires { m.target; }) return m.target;
        if constexpr (requires { m.target_system; }) return Address{m.target_system, 0};
        return std::nullopt;
      },
      message);
}

void set_target(Message& message, Address target) {
  std::visit(
      [target](auto& m) {
        if constexpr (requires { m.target; }) m.target = target;
        if constexpr (requires { m.target_system; }) m.target_system = target.system;
      },
      message);
}

}  // namespace lapwing::mavlink
