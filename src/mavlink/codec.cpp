#include "mavlink/codec.hpp"

#include "mavlink/internal/codec_parts.hpp"

namespace lapwing::mavlink {

std::optional<Message> decode(Frame const& frame) {
  // The busiest group first.
  if (auto message = internal::read_motion(frame)) return message;
  if (auto message = internal::read_state(frame)) return message;
  if (auto message = internal::read_payload(frame)) return message;
  if (auto message = internal::read_mission(frame)) return message;
  return internal::read_command(frame);
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
