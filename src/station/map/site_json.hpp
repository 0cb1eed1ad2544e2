#pragma once

#include <string>
#include <string_view>

#include "base/error.hpp"
#include "geo/site.hpp"
#include "map/live/live_map.hpp"

namespace lapwing::station {

/// All sites with their floors, as a `sites` message and the body of `GET /api/v1/sites`.
[[nodiscard]] std::string sites_message(map::LiveMap const& map);
/// One of them.
[[nodiscard]] std::string site_body(geo::Site const& site);
/// From the body of `PUT /api/v1/sites/{id}`. Error: invalid_input.
[[nodiscard]] base::Result<geo::Site> parse_site(std::string const& id, std::string_view body);

/// Of one map, and floors of one site: more is a program that has lost its way.
inline constexpr std::size_t most_sites = 1'000;
inline constexpr std::size_t most_floors = 200;

}  // namespace lapwing::station
