#include "host/simulation/world_place.hpp"

#include "geo/anchor.hpp"
#include "host/files/config_file.hpp"

namespace lapwing::host {

geo::Wgs84 read_world_place(base::SourceFile const& source, base::Diagnostics& diagnostics) {
  auto const table = base::parse_config(source, diagnostics);
  base::ConfigReader reader(table, diagnostics);
  if (auto const anchor = geo::read_anchor(reader)) return *anchor;
  if (!diagnostics.has_errors())
    diagnostics.report(base::config_kinds::invalid_value, {0, 1}, "a world needs a place on Earth", {geo::anchor_form});
  return {};
}

base::Result<geo::Wgs84> world_place(std::string const& path) {
  return load_config(path, read_world_place, "docs/reference/car-park-worlds.md");
}

}  // namespace lapwing::host
