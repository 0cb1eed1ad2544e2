#include "autonomy/operator/report_text.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "autonomy/operator/map_text.hpp"
#include "base/text/json.hpp"
#include "base/text/printable.hpp"

namespace lapwing::autonomy {

namespace {

using Json = nlohmann::ordered_json;

Json number(std::optional<double> const& value) {
  return value ? base::json_number<Json>(*value) : Json(nullptr);
}

/// No more than that, and no character cut in two (UTF-8: bytes that go on begin with 10).
std::string_view shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0U) == 0x80U) --most;
  return text.substr(0, most);
}

}  // namespace

base::Result<std::string> heartbeat_text(Said const& said, Told const& told, std::optional<OccupancyMap> const& map) {
  if (map && !is_sound(*map))
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("an occupancy map of {} x {} with {} cells, of at most {}", map->columns, map->rows,
                                  map->cells.size(), most_map_cells));
  auto const flight = told.flight.value_or(FlightController{});
  auto const& position = flight.position;
  Json heartbeat{{"Type", "Heartbeat"},
                 {"State", to_string(said.state)},
                 {"Ardupilot State", told.flight ? Json(flight.mode) : Json(nullptr)},
                 {"Occupancy Map", map ? map_json(*map) : Json(nullptr)},
                 {"Relative Altitude", number(flight.relative_alt_m)},
                 {"Armed", flight.is_armed},
                 {"Latitude", position ? base::json_number<Json>(position->lat_deg()) : Json(nullptr)},
                 {"Longitude", position ? base::json_number<Json>(position->lon_deg()) : Json(nullptr)},
                 {"Local Position X", flight.local ? base::json_number<Json>(flight.local->x()) : Json(nullptr)},
                 {"Local Position Y", flight.local ? base::json_number<Json>(flight.local->y()) : Json(nullptr)},
                 {"Battery Percentage", number(flight.battery)},
                 {"User Error", static_cast<int>(said.user_error)},
                 {"Health Status", said.health.is_healthy ? 0 : 1},
                 {"Health Reason", said.health.reason}};
  return base::to_text(heartbeat);
}

base::Result<std::string> slots_message(std::string_view collection) {
  if (collection.size() > longest_slots)
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("{} bytes of slots are too many for one message", collection.size()));
  if (!nlohmann::json::parse(collection, nullptr, false).is_object())
    return base::fail(base::ErrorKind::invalid_input, "slots that are no JSON object");
  return fmt::format(R"({{"Type":"Slots","Features":{}}})", collection);
}

std::string error_log_text(std::string_view message) {
  auto const words = base::printable(std::string(shortened(message, longest_error_log)));
  return base::to_text(Json{{"Type", "ErrorLog"}, {"Message", words}});
}

std::string error_log_text(base::Error const& error) {
  return error_log_text(error.hint.empty() ? error.message : fmt::format("{}: {}", error.message, error.hint));
}

}  // namespace lapwing::autonomy
