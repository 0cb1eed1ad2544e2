#pragma once

#include <optional>
#include <string>

#include "map/features/feature.hpp"

/// What becomes of several accounts of one thing: a rule a layer, written down in docs/reference/map.md.
///
/// Accounts reach us late, twice and in any order, from writers that do not know of each other. So the rules are made
/// such that the order does not matter: whoever has heard the same accounts has the same map.
namespace lapwing::map {

/// What has been heard of one thing.
struct Known {
  std::optional<Feature> feature = {};  ///< nothing: it is removed, or nobody has told of it yet
  std::optional<Account> removal = {};  ///< the newest one, also while a newer account stands
  friend bool operator==(Known const&, Known const&) = default;
};

/// Why these are no two accounts of one thing ("it shows another image: ..."): a picture does not change, and a track
/// stays in its site.
[[nodiscard]] std::optional<std::string> conflict(Feature const& known, Feature const& told);

/// Whether it says anything new. Preconditions: sound; no conflict.
bool take(Known& known, Feature told);
/// What was told as of then or before does not count any more. Whether that changes anything that is seen.
bool take(Known& known, Account const& removal);

}  // namespace lapwing::map
