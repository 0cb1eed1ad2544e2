#include "mavlink/codec/codec.hpp"

#include "mavlink/codec/internal/fields_command.hpp"
#include "mavlink/codec/internal/fields_mission.hpp"
#include "mavlink/codec/internal/fields_motion.hpp"
#include "mavlink/codec/internal/fields_payload.hpp"
#include "mavlink/codec/internal/fields_state.hpp"

namespace lapwing::mavlink {

namespace {

using internal::Intake;

template <auto const& layout>
using SiOf = std::remove_cvref_t<decltype(layout)>::Si;
template <auto const& layout>
using WireOf = std::remove_cvref_t<decltype(layout)>::Wire;

void constexpr each_layout(auto&& f) {
  internal::StateLayouts::each(f);
  internal::MotionLayouts::each(f);
  internal::PayloadLayouts::each(f);
  internal::CommandLayouts::each(f);
  internal::MissionLayouts::each(f);
}

/// In one piece and in place: most of what a station does is to read.
template <auto const& layout>
[[gnu::flatten]] std::optional<Message> read(Frame const& frame, Intake& in) {
  std::optional<Message> message(std::in_place, std::in_place_type<SiOf<layout>>);
  layout.read(*std::get_if<SiOf<layout>>(&*message), internal::unpack<WireOf<layout>>(frame), in);
  return message;
}

template <auto const& layout>
void write(SiOf<layout> const& m, Frame& frame) {
  WireOf<layout> wire{};
  layout.write(m, wire);
  internal::pack(wire, frame);
}

/// Reading functions by id; the greatest id that we read is 437.
using Reader = std::optional<Message> (*)(Frame const&, Intake&);
auto constexpr readers = [] {
  std::array<Reader, 512> all{};
  each_layout([&all]<auto const & layout>() { all.at(WireOf<layout>::MSG_ID) = read<layout>; });
  return all;
}();

/// Writing functions by the place of the message's kind in `Message`. Of the two forms of a mission item the first.
using Writer = void (*)(Message const&, Frame&);
auto constexpr writers = [] {
  std::array<Writer, std::variant_size_v<Message>> all{};
  each_layout([&all]<auto const & layout>() {
    auto& writer = all[Message(std::in_place_type<SiOf<layout>>).index()];
    if (!writer) writer = [](Message const& m, Frame& frame) { write<layout>(*std::get_if<SiOf<layout>>(&m), frame); };
  });
  return all;
}();
static_assert(std::ranges::find(writers, nullptr) == writers.end(), "a kind of message has no table of fields");

std::optional<Message> decode(Frame const& frame, Intake in) {
  auto const read = frame.message_id < readers.size() ? readers[frame.message_id] : nullptr;
  return read ? read(frame, in) : std::nullopt;
}

}  // namespace

std::optional<Message> decode(Frame const& frame) {
  return decode(frame, Intake(nullptr));
}

std::optional<Message> decode(Frame const& frame, std::vector<ImpossibleField>& impossible) {
  return decode(frame, Intake(&impossible));
}

Frame encode(Message const& message, Address self, std::uint8_t seq) {
  Frame frame;
  frame.source = self;
  frame.seq = seq;
  auto const* item = std::get_if<MissionItem>(&message);
  if (item && item->form == ItemForm::floating)
    write<internal::floating_item>(*item, frame);
  else
    writers[message.index()](message, frame);
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
