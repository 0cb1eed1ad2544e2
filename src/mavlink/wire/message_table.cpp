// The only place that includes the whole dialect: it costs about a second of compile time.
#include <algorithm>
#include <array>
#include <cstring>

#include <ardupilotmega/ardupilotmega.hpp>
#include <development/mavlink_msg_available_modes.hpp>
#include <development/mavlink_msg_available_modes_monitor.hpp>
#include <development/mavlink_msg_current_mode.hpp>

#include "mavlink/wire/frame.hpp"

namespace lapwing::mavlink {

namespace {

auto constexpr& entries = ::mavlink::ardupilotmega::MESSAGE_ENTRIES;

struct InstanceRow {
  std::uint32_t id;
  std::uint8_t offset;  ///< in the payload
  std::uint8_t size;
};
InstanceRow constexpr instances[] = {
#include <tables/dialect_instances.inc>
};

MessageTraits constexpr traits_of(::mavlink::mavlink_msg_entry_t const& entry) {
  MessageTraits traits{entry.msgid, entry.crc_extra, entry.min_msg_len, entry.max_msg_len};
  if ((entry.flags & MAV_MSG_ENTRY_FLAG_HAVE_TARGET_SYSTEM) != 0) traits.target_system_at = entry.target_system_ofs;
  if ((entry.flags & MAV_MSG_ENTRY_FLAG_HAVE_TARGET_COMPONENT) != 0)
    traits.target_component_at = entry.target_component_ofs;
  for (auto const& instance : instances) {
    if (instance.id != entry.msgid) continue;
    traits.instance_at = instance.offset;
    traits.instance_size = instance.size;
  }
  return traits;
}

template <class Wire>
MessageTraits constexpr untargeted{Wire::MSG_ID, Wire::CRC_EXTRA, Wire::MIN_LENGTH, Wire::LENGTH};

/// Messages of the development dialect that ArduPilot and PX4 send already.
namespace development = ::mavlink::development::msg;
auto constexpr early = std::to_array<MessageTraits>({
    untargeted<development::AVAILABLE_MODES>,
    untargeted<development::CURRENT_MODE>,
    untargeted<development::AVAILABLE_MODES_MONITOR>,
});

auto constexpr make_table() {
  std::array<MessageTraits, entries.size() + early.size()> table{};
  auto const rest = std::ranges::transform(entries, table.begin(), traits_of);
  std::ranges::copy(early, rest.out);
  std::ranges::sort(table, {}, &MessageTraits::id);
  return table;
}

auto constexpr table = make_table();
static_assert(std::ranges::is_sorted(table, {}, &MessageTraits::id));

/// Ids below this, nearly all that vehicles send, are found without a search: place in `table` plus one, 0 for none.
std::size_t constexpr direct_ids = 512;
auto constexpr make_direct() {
  std::array<std::uint16_t, direct_ids> places{};
  for (std::size_t i = 0; i < table.size() && table[i].id < direct_ids; ++i)
    places[table[i].id] = static_cast<std::uint16_t>(i + 1);
  return places;
}
auto constexpr direct = make_direct();

}  // namespace

MessageTraits const* find_traits(std::uint32_t message_id) {
  if (message_id < direct_ids) return direct[message_id] == 0 ? nullptr : &table[direct[message_id] - 1U];
  auto const found = std::ranges::lower_bound(table, message_id, {}, &MessageTraits::id);
  return found != table.end() && found->id == message_id ? &*found : nullptr;
}

}  // namespace lapwing::mavlink

namespace mavlink {

// The generated headers declare it and leave it to their user. Nothing here calls the C parser that would.
mavlink_msg_entry_t const* mavlink_get_msg_entry(std::uint32_t message_id) {
  auto const& all = ardupilotmega::MESSAGE_ENTRIES;
  auto const found = std::ranges::lower_bound(all, message_id, {}, &mavlink_msg_entry_t::msgid);
  return found != all.end() && found->msgid == message_id ? &*found : nullptr;
}

}  // namespace mavlink
