// Any request about the map: paths with names in them, filters, rectangles, times, and bodies that bring sites and
// features. An input is lines: method, target, and the body behind them. Whatever comes is answered, in JSON where it
// says so, and leaves a sound map.
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/async/loop.hpp"
#include "map/live/live_map.hpp"
#include "require.hpp"
#include "station/map/map_face.hpp"
#include "station/testing/grid_demo.hpp"

using namespace lapwing;

namespace {

std::string_view take_line(std::string_view& text) {
  auto const line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(text.size(), line.size() + 1));
  return line;
}

/// Something to find: a site across the antimeridian with a slot, a door and a grid.
void fill(map::LiveMap& map, base::UtcTime at) {
  using namespace station::testing;
  map.put_site(yard(geo::Wgs84::from_degrees(41.0, 179.9999)));
  fuzz::require(map.put(slot("a", 0, 0, at)).has_value() && map.put(door("north/1", 20, 5, at)).has_value());
  std::vector<map::TileKey> const tiles{{0, 0}};
  fuzz::require(map.put_tiles(floor_grid, grid_with(tiles), tiles, {"robot 1", at}).has_value());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  static base::Loop loop;
  std::string_view text(reinterpret_cast<char const*>(data), size);
  auto const method = take_line(text);
  auto request = station::request_for(method, take_line(text));
  if (!request) return 0;
  request->headers = {{"Host", "localhost"}, {"Content-Type", "image/png"}};
  request->body = text;

  map::LiveMap map([] { return loop.utc_now(); });
  fill(map, loop.utc_now());
  station::MapFace face(loop, map, nullptr);
  station::Router router;
  face.add_routes(router);
  auto reply = router.answer(*request);
  auto* const now = std::get_if<station::HttpResponse>(&reply);
  auto const response = now ? *now : loop.run_until_done(std::get<base::Task<station::HttpResponse>>(std::move(reply)));

  fuzz::require(response.status >= 200 && response.status < 508);
  if (response.content_type.contains("json")) fuzz::require(nlohmann::json::accept(response.body));
  for (auto const layer : map::all_layers)
    for (auto const* record : map.changed_since(layer, 0))
      fuzz::require(record->is_removed || !map::feature_fault(record->feature));
  return 0;
}
