#include "autonomy/operator/map_text.hpp"

#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/assert.hpp"
#include "base/text/json.hpp"

namespace lapwing::autonomy {

using Json = nlohmann::ordered_json;

Json map_json(OccupancyMap const& map) {
  return {{"Columns", map.columns},
          {"Rows", map.rows},
          {"Resolution", base::json_number<Json>(map.resolution_m)},
          {"Origin X", base::json_number<Json>(map.origin.x())},
          {"Origin Y", base::json_number<Json>(map.origin.y())},
          {"Cells", map.cells}};
}

base::Result<std::string> map_text(OccupancyMap const& map, std::uint64_t revision) {
  if (!is_sound(map))
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("an occupancy map of {} x {} with {} cells, of at most {}", map.columns, map.rows,
                                  map.cells.size(), most_map_cells));
  Json text{{"Type", "Map"}, {"Revision", revision}};
  text.update(map_json(map));
  return base::to_text(text);
}

std::string map_changes_text(OccupancyMap const& before, std::uint64_t since, OccupancyMap const& now,
                             std::uint64_t revision) {
  LAPWING_ASSERT(is_alike(before, now) && is_sound(before) && is_sound(now));
  // The number of a run's first cell is as long as that of two or three cells; it also keeps the longest text short.
  constexpr std::size_t most_between = 2;
  auto text = fmt::format(R"({{"Type":"Map Changes","Revision":{},"Since":{},"Changes":[)", revision, since);
  std::size_t next = 0;  // behind the last run
  bool is_first = true;
  for (std::size_t cell = 0; cell < now.cells.size(); ++cell) {
    if (now.cells[cell] == before.cells[cell]) continue;
    bool const goes_on = !is_first && cell - next <= most_between;
    if (!goes_on) {
      fmt::format_to(std::back_inserter(text), "{}[{}", is_first ? "" : "],", cell);
      next = cell;
    }
    for (; next <= cell; ++next) fmt::format_to(std::back_inserter(text), ",{}", now.cells[next]);
    is_first = false;
  }
  text += is_first ? "]}" : "]]}";
  return text;
}

}  // namespace lapwing::autonomy
