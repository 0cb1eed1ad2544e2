// Writes the tables of docs/reference/map.md that are made of the code, or says that they are out of date.
//
//   map_properties write|check CHECKOUT
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "map/features/feature_json.hpp"
#include "map/features/properties.hpp"
#include "map/features/text_fault.hpp"
#include "map/grid/grid_tiles.hpp"
#include "map/live/live_map.hpp"

namespace {

using namespace lapwing::map;

std::string kind_text(Property const& property) {
  return property.words.empty() ? std::string(name_of(property.kind))
                                : fmt::format("`{}`", fmt::join(property.words, "`, `"));
}

std::string property_tables() {
  std::string text;
  for (auto const layer : all_layers) {
    text += fmt::format("\n### {}\n\n| property | is | what it says |\n|---|---|---|\n", name_of(layer));
    for (auto const& property : properties_of(layer))
      text += fmt::format("| `{}` | {} | {} |\n", property.name, kind_text(property), property.doc);
  }
  return text + "\n";
}

std::string limit_table() {
  std::string text = "| of | at most |\n|---|---|\n";
  auto const line = [&](std::string_view of, std::string const& most) {
    text += fmt::format("| {} | {} |\n", of, most);
  };
  line("a place's distance from the site's anchor, each way", fmt::format("{:.0f} km", farthest_m / 1000.0));
  line("points of a line", fmt::format("{}", most_points));
  line("corners of a polygon, all rings together", fmt::format("{}", most_corners));
  line("an id: of a feature, a site, a floor, a vehicle, a writer, a grid", fmt::format("{} bytes", most_id_bytes));
  line("a name or kind", fmt::format("{} bytes", most_name_bytes));
  line("the text of a point of interest", fmt::format("{} bytes, lines and tabs among them", most_text_bytes));
  line("a track's samples that are kept", fmt::format("{}", most_track_samples));
  line("how far an account is ahead of the station's clock", fmt::format("{} min", farthest_ahead.count()));
  line("removals of a layer that are remembered", fmt::format("{}", most_removals));
  line("tiles of a grid", fmt::format("{} of {} by {} cells", most_grid_tiles, tile_cells, tile_cells));
  line("zooms at which grids are drawn", fmt::format("{} to {}", lowest_zoom, highest_zoom));
  line("GeoJSON that is read at once",
       fmt::format("{} MiB, {} features", most_json_bytes / 1024 / 1024, most_json_features));
  return text;
}

struct Table {
  std::string_view mark;
  std::string text;
};

/// The page with the table between its marks; empty when it lacks them.
std::string with_table(std::string page, Table const& table) {
  auto const mark = fmt::format("<!-- made from {} -->\n", table.mark);
  auto const begin = page.find(mark);
  auto const end = page.find("<!-- end -->", begin);
  if (begin == std::string::npos || end == std::string::npos) return "";
  auto const from = begin + mark.size();
  return page.replace(from, end - from, table.text);
}

}  // namespace

int main(int argc, char** argv) {
  std::string_view const verb = argc == 3 ? argv[1] : "";
  if (verb != "write" && verb != "check") {
    fmt::print(stderr, "usage: map_properties write|check CHECKOUT\n");
    return 2;
  }
  auto const path = std::filesystem::path(argv[2]) / "docs/reference/map.md";
  std::ifstream file(path, std::ios::binary);
  std::string const page{std::istreambuf_iterator<char>(file), {}};
  auto wanted = page;
  for (auto const& table :
       {Table{"src/map/features/properties.cpp", property_tables()}, Table{"the limits in src/map", limit_table()}})
    wanted = with_table(wanted, table);
  if (wanted.empty()) {
    fmt::print(stderr, "{} lacks the marks between which the tables stand.\n", path.string());
    return 1;
  }
  if (wanted == page) return 0;
  if (verb == "check") {
    fmt::print(stderr, "{} is not what the code says: run `map_properties write CHECKOUT`.\n", path.string());
    return 1;
  }
  std::ofstream(path, std::ios::binary) << wanted;
  fmt::print("wrote {}\n", path.string());
  return 0;
}
