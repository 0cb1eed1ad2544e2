#include "host/simulation/world_place.hpp"

#include <cmath>

#include "host/files/config_file.hpp"

namespace lapwing::host {

geo::Wgs84 read_world_place(base::SourceFile const& source, base::Diagnostics& diagnostics) {
  constexpr double most_altitude_m = 9'000.0;
  auto const table = base::parse_config(source, diagnostics);
  if (diagnostics.has_errors()) return {};
  base::ConfigReader reader(table, diagnostics);
  auto const anchor = reader.numbers("anchor", 3, -most_altitude_m, most_altitude_m);
  if (diagnostics.has_errors()) return {};
  auto const wrong = [&](base::Span const& span, char const* what) {
    diagnostics.report(base::config_kinds::invalid_value, span, what,
                       {"anchor = [latitude, longitude, altitude], in degrees and metres"});
    return geo::Wgs84{};
  };
  if (!anchor) return wrong({0, 1}, "a world needs a place on Earth");
  auto const& at = anchor->value;
  if (std::abs(at[0]) > 90.0 || std::abs(at[1]) > 180.0) return wrong(anchor->span, "the anchor is no place on Earth");
  return geo::Wgs84::from_degrees(at[0], at[1], at[2]);
}

base::Result<geo::Wgs84> world_place(std::string const& path) {
  return load_config(path, read_world_place, "docs/reference/car-park-worlds.md");
}

}  // namespace lapwing::host
