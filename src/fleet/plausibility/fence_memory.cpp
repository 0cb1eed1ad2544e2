#include "fleet/plausibility/fence_memory.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "mavlink/exchange/param.hpp"
#include "plan/performance.hpp"

namespace lapwing::fleet {

using plan::plausibility::VehicleFence;
using vehicle::Autopilot;
using vehicle::Family;

namespace {

constexpr std::array<std::string_view, 5> ardupilot_needed{"FENCE_ENABLE", "FENCE_TYPE", "FENCE_RADIUS", "FENCE_ACTION",
                                                           "FENCE_ALT_MAX"};
constexpr std::array<std::string_view, 5> ardupilot_optional{"FENCE_MARGIN", "FENCE_AUTOENABLE", "FENCE_OPTIONS",
                                                             "FENCE_TOTAL", "FENCE_ALT_MIN"};
constexpr std::array<std::string_view, 3> px4_needed{"GF_ACTION", "GF_MAX_HOR_DIST", "GF_MAX_VER_DIST"};

/// Bits of FENCE_TYPE.
constexpr unsigned watches_highest = 1;
constexpr unsigned watches_circle = 2;
constexpr unsigned watches_areas = 4;
constexpr unsigned watches_lowest = 8;
constexpr unsigned any_inclusion = 2;  // of FENCE_OPTIONS

bool is_of_a_fence(std::string_view name) {
  auto const is_in = [name](auto const& names) { return std::ranges::find(names, name) != names.end(); };
  return is_in(ardupilot_needed) || is_in(ardupilot_optional) || is_in(px4_needed);
}

}  // namespace

FenceNames fence_names(Autopilot autopilot, Family family) {
  if (autopilot == Autopilot::px4) return {.needed = px4_needed, .optional = {}};
  if (autopilot != Autopilot::ardupilot) return {};
  FenceNames names{.needed = ardupilot_needed, .optional = ardupilot_optional};
  // Heights stand last: rovers and boats have none.
  if (plan::flies(family)) return names;
  return {.needed = names.needed.first(names.needed.size() - 1),
          .optional = names.optional.first(names.optional.size() - 1)};
}

void FenceMemory::forget() {
  bool const still = is_being_read;
  *this = {};
  is_being_read = still;
}

void FenceMemory::note(mavlink::Message const& message, Autopilot autopilot, base::TimePoint now) {
  if (auto const* heard = std::get_if<mavlink::ParamValue>(&message)) {
    note_value(*heard, autopilot, now);
  } else if (auto const* error = std::get_if<mavlink::ParamError>(&message)) {
    if (is_of_a_fence(error->name)) set_untold(error->name);
  } else if (auto const* ack = std::get_if<mavlink::MissionAck>(&message)) {
    bool const is_ours = ack->type == mavlink::MissionType::fence || ack->type == mavlink::MissionType::all;
    if (is_ours) areas_.reset();
  } else if (auto const* current = std::get_if<mavlink::MissionCurrent>(&message);
             current && current->fence_id != 0 && std::exchange(fence_id_, current->fence_id) != current->fence_id) {
    areas_.reset();
  }
}

void FenceMemory::note_value(mavlink::ParamValue const& heard, Autopilot autopilot, base::TimePoint now) {
  if (!is_of_a_fence(heard.name)) return;
  auto const encoding = autopilot == Autopilot::px4 ? mavlink::ParamEncoding::bytewise : mavlink::ParamEncoding::c_cast;
  double const told = mavlink::decode_param(heard, encoding).value;
  auto const before = value(heard.name);
  if (heard.name == "FENCE_TOTAL" && before && *before != told) areas_.reset();
  values_.insert_or_assign(heard.name, Value{told, now});
  untold_.erase(heard.name);
}

std::optional<double> FenceMemory::value(std::string_view name) const {
  auto const found = values_.find(name);
  return found == values_.end() ? std::nullopt : std::optional(found->second.value);
}

std::optional<double> FenceMemory::positive(std::string_view name) const {
  auto const told = value(name);
  return told && *told > 0.0 ? told : std::nullopt;
}

bool FenceMemory::has_heard(std::string_view name, base::TimePoint since) const {
  auto const found = values_.find(name);
  return found != values_.end() && found->second.heard >= since;
}

bool FenceMemory::is_off(Autopilot autopilot, base::TimePoint since) const {
  if (is_on(autopilot)) return false;
  if (autopilot == Autopilot::px4) return has_heard("GF_ACTION", since);
  return has_heard("FENCE_ENABLE", since) && (has_heard("FENCE_AUTOENABLE", since) || is_untold("FENCE_AUTOENABLE"));
}

bool FenceMemory::is_on(Autopilot autopilot) const {
  if (autopilot == Autopilot::px4) return value("GF_ACTION").value_or(0.0) != 0.0;
  // One that switches itself on does so on the way up.
  return value("FENCE_ENABLE").value_or(0.0) != 0.0 || value("FENCE_AUTOENABLE").value_or(0.0) != 0.0;
}

bool FenceMemory::wants_areas(Autopilot autopilot) const {
  if (!is_on(autopilot)) return false;
  return autopilot == Autopilot::px4 || (static_cast<unsigned>(value("FENCE_TYPE").value_or(0.0)) & watches_areas) != 0;
}

void FenceMemory::set_areas(plan::GeoFence areas, base::TimePoint now) {
  areas_ = std::move(areas);
  areas_heard_ = now;
}

std::optional<VehicleFence> FenceMemory::known(Autopilot autopilot, Family family) const {
  if (!is_on(autopilot)) return std::nullopt;
  VehicleFence fence;
  if (areas_ && wants_areas(autopilot)) fence.areas = *areas_;
  if (autopilot == Autopilot::px4) {
    constexpr double warns = 1.0;
    fence.radius_m = positive("GF_MAX_HOR_DIST");
    fence.highest_m = positive("GF_MAX_VER_DIST");
    fence.one_inclusion_will_do = true;
    fence.only_tells = value("GF_ACTION") == warns;
    return fence;
  }
  auto const type = static_cast<unsigned>(value("FENCE_TYPE").value_or(0.0));
  auto const options = static_cast<unsigned>(value("FENCE_OPTIONS").value_or(0.0));
  if ((type & watches_circle) != 0) fence.radius_m = positive("FENCE_RADIUS");
  if (plan::flies(family) && (type & watches_highest) != 0) fence.highest_m = positive("FENCE_ALT_MAX");
  if (plan::flies(family) && (type & watches_lowest) != 0) fence.lowest_m = value("FENCE_ALT_MIN");
  fence.margin_m = positive("FENCE_MARGIN").value_or(0.0);
  fence.one_inclusion_will_do = (options & any_inclusion) != 0;
  fence.only_tells = value("FENCE_ACTION") == 0.0;
  return fence;
}

}  // namespace lapwing::fleet
