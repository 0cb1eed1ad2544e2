#pragma once

#include <compare>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/time.hpp"
#include "map/features/contents.hpp"
#include "map/features/layer_kind.hpp"

namespace lapwing::map {

/// Whose account something is, and of when. Writers are many and their clocks differ: what each layer makes of two
/// accounts of one thing is its merge rule (`map/live/merge.hpp`).
struct Account {
  std::string writer = {};  ///< vehicle id, "operator 2", "import plan.kml"
  base::UtcTime at = {};    ///< when it was so, not when it was heard of

  friend bool operator==(Account const&, Account const&) = default;
  /// The later one is greater; of one time, that of the greater writer, so that all agree on an order.
  friend std::strong_ordering operator<=>(Account const& a, Account const& b) {
    if (auto const by_time = a.at <=> b.at; by_time != 0) return by_time;
    return a.writer <=> b.writer;
  }
};

/// From 1990 to 2200: outside of that a clock was never set, or a number was no time.
[[nodiscard]] bool is_sane(base::UtcTime time);

/// That a property is older than the rest: a later account had nothing to say of it, as a camera that finds a door
/// again but cannot read its label this time.
struct HeldOver {
  std::string property;
  Account account;
  friend bool operator==(HeldOver const&, HeldOver const&) = default;
};

/// One thing on the map, by whom it was put there.
struct Feature {
  std::string id = {};     ///< unique in its layer
  std::string site = {};   ///< its site's id
  std::string floor = {};  ///< its floor's id; empty: the site's ground
  Account account = {};
  Content content = {};
  std::vector<HeldOver> held_over = {};  ///< by the names of the properties
  friend bool operator==(Feature const&, Feature const&) = default;
};

[[nodiscard]] LayerKind layer_of(Content const& content);
/// Where it lies: of a picture the footprint where there is one, else the place that it was taken from.
[[nodiscard]] Geometry geometry_of(Content const& content);
/// Why it is none ("taken_probability is 1.3, not from 0 to 1"); nothing for a sound one. Whatever outsiders give is
/// asked this before it is written.
[[nodiscard]] std::optional<std::string> feature_fault(Feature const& feature);

}  // namespace lapwing::map
