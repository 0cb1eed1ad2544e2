#pragma once

#include "mavlink/codec/internal/fields.hpp"
#include "mavlink/codec/internal/item_place.hpp"

/// Missions, fences and rally points.
namespace lapwing::mavlink::internal {

// Numbers that came to the standard later than to the generated dialect stand behind what it knows. A frame's payload
// is zero behind its end. Each hides the dialect's LENGTH with its own.

template <class Known>
struct WithOpaqueId final : Known {
  // NOLINTNEXTLINE(*-naming)
  static constexpr std::size_t LENGTH = Known::LENGTH + sizeof(std::uint32_t);
  std::uint32_t opaque_id = 0;

  void serialize(::mavlink::MsgMap& map) const override {
    Known::serialize(map);
    map << opaque_id;
  }
  void deserialize(::mavlink::MsgMap& map) override {
    Known::deserialize(map);
    map >> opaque_id;
  }
};

struct MissionCurrentWithIds final : dialect::MISSION_CURRENT {
  // NOLINTNEXTLINE(*-naming)
  static constexpr std::size_t LENGTH = dialect::MISSION_CURRENT::LENGTH + 3 * sizeof(std::uint32_t);
  std::uint32_t mission_id = 0;
  std::uint32_t fence_id = 0;
  std::uint32_t rally_points_id = 0;

  void serialize(::mavlink::MsgMap& map) const override {
    dialect::MISSION_CURRENT::serialize(map);
    map << mission_id;
    map << fence_id;
    map << rally_points_id;
  }
  void deserialize(::mavlink::MsgMap& map) override {
    dialect::MISSION_CURRENT::deserialize(map);
    map >> mission_id;
    map >> fence_id;
    map >> rally_points_id;
  }
};

template <ItemForm form>
inline constexpr auto item_form =
    Both{[](MissionItem& m, auto const&, Intake&) { m.form = form; }, [](MissionItem const&, auto&) {}};

template <class W, ItemForm form, class M = MissionItem>
inline constexpr auto mission_item = layout<M, W>(std::tuple{
    field<&M::seq, &W::seq>(),
    field<&M::frame, &W::frame>(),
    field<&M::command, &W::command>(),
    list<&M::params, &W::param1, &W::param2, &W::param3, &W::param4>,
    item_place,
    field<&M::current, &W::current>(),
    field<&M::autocontinue, &W::autocontinue>(),
    field<&M::type, &W::mission_type>(),
    item_form<form>,
});
inline constexpr auto& integer_item = mission_item<dialect::MISSION_ITEM_INT, ItemForm::integer>;
inline constexpr auto& floating_item = mission_item<dialect::MISSION_ITEM, ItemForm::floating>;

template <class M = MissionCount, class W = WithOpaqueId<dialect::MISSION_COUNT>>
inline constexpr auto mission_count = layout<M, W>(std::tuple{
    field<&M::count, &W::count>(),
    field<&M::type, &W::mission_type>(),
    field<&M::opaque_id, &W::opaque_id>(),
});

template <class M, class W>
inline constexpr auto mission_request = layout<M, W>(std::tuple{
    field<&M::seq, &W::seq>(),
    field<&M::type, &W::mission_type>(),
});

/// MISSION_REQUEST_LIST, MISSION_CLEAR_ALL.
template <class M, class W>
inline constexpr auto mission_of_type = layout<M, W>(std::tuple{field<&M::type, &W::mission_type>()});

template <class M, class W>
inline constexpr auto mission_partial_list = layout<M, W>(std::tuple{
    field<&M::start, &W::start_index>(),
    field<&M::end, &W::end_index>(),
    field<&M::type, &W::mission_type>(),
});

template <class M = MissionAck, class W = WithOpaqueId<dialect::MISSION_ACK>>
inline constexpr auto mission_ack = layout<M, W>(std::tuple{
    field<&M::result, &W::type>(),
    field<&M::type, &W::mission_type>(),
    field<&M::opaque_id, &W::opaque_id>(),
});

template <class M = MissionSetCurrent, class W = dialect::MISSION_SET_CURRENT>
inline constexpr auto mission_set_current = layout<M, W>(std::tuple{field<&M::seq, &W::seq>()});

/// 0 is an autopilot that does not report it, the greatest number an empty mission.
struct ItemTotal {
  using Total = std::optional<std::uint16_t>;
  static void read(Total& si, std::uint16_t wire, std::string_view, Intake&) {
    if (wire != 0) si = wire == unknown16 ? 0 : wire;
  }
  static void write(std::uint16_t& wire, Total si) {
    if (si) wire = *si == 0 ? unknown16 : *si;
  }
};

template <class M = MissionCurrent, class W = MissionCurrentWithIds>
inline constexpr auto mission_current = layout<M, W>(std::tuple{
    field<&M::seq, &W::seq>(),
    field<&M::total, &W::total>(ItemTotal{}),
    field<&M::state, &W::mission_state>(),
    field<&M::mission_mode, &W::mission_mode>(),
    field<&M::mission_id, &W::mission_id>(),
    field<&M::fence_id, &W::fence_id>(),
    field<&M::rally_id, &W::rally_points_id>(),
});

template <class M = MissionItemReached, class W = dialect::MISSION_ITEM_REACHED>
inline constexpr auto mission_item_reached = layout<M, W>(std::tuple{field<&M::seq, &W::seq>()});

using MissionLayouts =
    Layouts<integer_item, floating_item, mission_count<>, mission_request<MissionRequest, dialect::MISSION_REQUEST>,
            mission_request<MissionRequestInt, dialect::MISSION_REQUEST_INT>,
            mission_of_type<MissionRequestList, dialect::MISSION_REQUEST_LIST>,
            mission_of_type<MissionClearAll, dialect::MISSION_CLEAR_ALL>,
            mission_partial_list<MissionRequestPartialList, dialect::MISSION_REQUEST_PARTIAL_LIST>,
            mission_partial_list<MissionWritePartialList, dialect::MISSION_WRITE_PARTIAL_LIST>, mission_ack<>,
            mission_set_current<>, mission_current<>, mission_item_reached<>>;

}  // namespace lapwing::mavlink::internal
