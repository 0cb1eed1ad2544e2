#include "map/live/merge.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "map/features/properties.hpp"
#include "map/live/internal/track_union.hpp"

namespace lapwing::map {

namespace {

/// A later account that has nothing to say of these leaves them as they were.
std::span<std::string_view const> lasting_properties(LayerKind layer) {
  static constexpr std::array<std::string_view, 1> slots = {"name"};
  static constexpr std::array<std::string_view, 3> points_of_interest = {"name", "picture", "text"};
  static constexpr std::array<std::string_view, 1> pictures = {"thumbnail"};
  switch (layer) {
    case LayerKind::slots: return slots;
    case LayerKind::points_of_interest: return points_of_interest;
    case LayerKind::pictures: return pictures;
    case LayerKind::walls:
    case LayerKind::tracks:
    case LayerKind::areas: return {};
  }
  std::unreachable();
}

/// A property with whoever told it.
struct Told {
  PropertyValue value;
  Account account;
};

bool is_nothing(PropertyValue const& value) {
  return std::holds_alternative<std::monostate>(value);
}

Told told_of(Feature const& feature, std::string_view property) {
  auto const held = std::ranges::find(feature.held_over, property, &HeldOver::property);
  return {property_named(layer_of(feature.content), property)->get(feature.content),
          held == feature.held_over.end() ? feature.account : held->account};
}

void put_property(Content& content, std::string_view property, PropertyValue const& value) {
  // What the property itself has told it also takes.
  (void)property_named(layer_of(content), property)->set(content, value);
}

/// When and by whom the state of a slot was seen: all of it is one thing, of one look.
auto look_at(auto& slot) {
  return std::tie(slot.seen_at, slot.seen_by, slot.state, slot.taken_probability);
}

bool says_a_state(Slot const& slot) {
  return slot.state != SlotState::unknown || slot.taken_probability.has_value();
}

void forget_look(Slot& slot) {
  look_at(slot) = std::tuple(std::nullopt, "", SlotState::unknown, std::nullopt);
}

/// What is one account's alone, without that of which others may know more.
Content core_of(Feature const& feature) {
  auto core = feature.content;
  for (auto const property : lasting_properties(layer_of(core))) put_property(core, property, {});
  if (auto* slot = std::get_if<Slot>(&core)) forget_look(*slot);
  if (auto* track = std::get_if<Track>(&core)) *track = {.vehicle = track->vehicle};
  return core;
}

std::vector<double> numbers_of(Content const& content) {
  std::vector<double> numbers;
  auto const put = [&](SitePoint const& point) { numbers.insert(numbers.end(), {point.x(), point.y()}); };
  auto const geometry = geometry_of(content);
  if (auto const* point = std::get_if<SitePoint>(&geometry)) put(*point);
  if (auto const* line = std::get_if<LineString>(&geometry)) std::ranges::for_each(line->points, put);
  if (auto const* polygon = std::get_if<SitePolygon>(&geometry)) {
    for (auto const& ring : polygon->rings) {
      numbers.push_back(static_cast<double>(ring.size()));
      std::ranges::for_each(ring, put);
    }
  }
  return numbers;
}

/// Some order of all features, for two that one writer tells as of one moment: which of them is kept must not depend on
/// which came first.
bool comes_before(Feature const& a, Feature const& b) {
  auto const core_a = core_of(a);
  auto const core_b = core_of(b);
  if (auto const by_place = std::tie(a.site, a.floor) <=> std::tie(b.site, b.floor); by_place != 0) return by_place < 0;
  for (auto const& property : properties_of(layer_of(core_a)))
    if (auto const by_value = property.get(core_a) <=> property.get(core_b); by_value != 0) return by_value < 0;
  return numbers_of(core_a) < numbers_of(core_b);
}

/// What both know of the lasting properties: for each the newest that says anything.
void keep_lasting(Feature& merged, Feature const& a, Feature const& b) {
  merged.held_over.clear();
  for (auto const property : lasting_properties(layer_of(merged.content))) {
    auto of_a = told_of(a, property);
    auto of_b = told_of(b, property);
    bool const takes_b = is_nothing(of_a.value) || (!is_nothing(of_b.value) && std::tie(of_a.account, of_a.value) <
                                                                                   std::tie(of_b.account, of_b.value));
    auto& taken = takes_b ? of_b : of_a;
    put_property(merged.content, property, taken.value);
    if (!is_nothing(taken.value) && taken.account != merged.account)
      merged.held_over.push_back({std::string(property), std::move(taken.account)});
  }
}

/// As both tell it. Precondition: of one layer.
Feature united(Feature const& a, Feature const& b) {
  bool const takes_b = a.account == b.account ? comes_before(a, b) : a.account < b.account;
  Feature merged = takes_b ? b : a;
  keep_lasting(merged, a, b);
  if (auto* slot = std::get_if<Slot>(&merged.content)) {
    auto const& of_a = std::get<Slot>(a.content);
    auto const& of_b = std::get<Slot>(b.content);
    auto const& seen_last = look_at(of_a) < look_at(of_b) ? of_b : of_a;
    look_at(*slot) = look_at(seen_last);
  }
  if (auto* track = std::get_if<Track>(&merged.content))
    internal::take_samples(*track, std::get<Track>((takes_b ? a : b).content));
  return merged;
}

/// As it is kept from the start, so that a single account and one that was merged look alike.
void normalize(Feature& feature) {
  if (auto* slot = std::get_if<Slot>(&feature.content); slot && !slot->seen_at) {
    if (says_a_state(*slot))
      slot->seen_at = feature.account.at;
    else
      slot->seen_by.clear();
  }
  if (auto* track = std::get_if<Track>(&feature.content)) internal::thin(*track);
  std::erase_if(feature.held_over, [&](HeldOver const& held) {
    auto const lasting = lasting_properties(layer_of(feature.content));
    return std::ranges::find(lasting, held.property) == lasting.end() || held.account == feature.account ||
           is_nothing(told_of(feature, held.property).value);
  });
  std::ranges::sort(feature.held_over, {}, &HeldOver::property);
}

/// Takes away what was told as of the removal or before; whether anything is left. Precondition: the account is newer.
bool keep_since(Feature& feature, Account const& removal) {
  std::erase_if(feature.held_over, [&](HeldOver const& held) {
    if (held.account > removal) return false;
    put_property(feature.content, held.property, {});
    return true;
  });
  if (auto* slot = std::get_if<Slot>(&feature.content); slot && slot->seen_at && *slot->seen_at <= removal.at)
    forget_look(*slot);
  auto* track = std::get_if<Track>(&feature.content);
  if (!track) return true;
  std::erase_if(track->samples, [&](Track::Sample const& sample) { return sample.at <= removal.at; });
  return track->samples.size() >= 2;
}

}  // namespace

std::optional<std::string> conflict(Feature const& known, Feature const& told) {
  auto const* before = std::get_if<Picture>(&known.content);
  auto const* after = std::get_if<Picture>(&told.content);
  if (before && after && before->image != after->image)
    return "another image is known by this id: a picture does not change; give the new one an id of its own";
  if (std::holds_alternative<Track>(known.content) && known.site != told.site)
    return fmt::format("the track lies in the site {}: a track stays in its site; give the new one an id of its own",
                       known.site);
  return std::nullopt;
}

bool take(Known& known, Feature told) {
  if (known.removal && told.account <= *known.removal) return false;
  normalize(told);
  if (known.removal && !keep_since(told, *known.removal)) return false;
  if (!known.feature) {
    known.feature = std::move(told);
    return true;
  }
  auto merged = united(*known.feature, told);
  if (merged == *known.feature) return false;
  known.feature = std::move(merged);
  return true;
}

bool take(Known& known, Account const& removal) {
  if (known.removal && removal <= *known.removal) return false;
  known.removal = removal;
  if (!known.feature) return false;
  auto left = *known.feature;
  bool const stands = left.account > removal && keep_since(left, removal);
  bool const changes = !stands || left != *known.feature;
  known.feature = stands ? std::optional(std::move(left)) : std::nullopt;
  return changes;
}

}  // namespace lapwing::map
