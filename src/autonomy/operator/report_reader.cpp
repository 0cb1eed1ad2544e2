#include "autonomy/operator/report_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "autonomy/interface/state.hpp"
#include "base/text/json.hpp"
#include "base/text/printable.hpp"

namespace lapwing::autonomy {

namespace {

using Json = nlohmann::json;

std::unexpected<base::Error> wrong(std::string message) {
  return base::fail(base::ErrorKind::invalid_input, std::move(message));
}

std::optional<double> number(Json const& object, char const* key, double least, double most) {
  auto const found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  auto const value = found->get<double>();
  return value >= least && value <= most ? std::optional(value) : std::nullopt;
}

std::string words(Json const& object, char const* key) {
  auto const found = object.find(key);
  if (found == object.end() || !found->is_string()) return {};
  return base::printable(found->get<std::string>().substr(0, longest_report_text));
}

std::string user_error(Json const& object) {
  auto const code = number(object, "User Error", 1, 255);
  if (!code) return {};
  auto const error = static_cast<UserError>(static_cast<std::uint8_t>(*code));
  constexpr std::array known{UserError::desired_location_out_of_bounds, UserError::no_lot_detected,
                             UserError::height_params_invalid};
  if (std::ranges::find(known, error) == known.end()) return fmt::format("error {:.0f}", *code);
  return std::string(to_string(error));
}

bool is_percent(Json const& cell) {
  return cell.is_number_integer() && cell.get<std::int64_t>() >= -1 && cell.get<std::int64_t>() <= 100;
}

base::Result<OccupancyMap> occupancy_map(Json const& object) {
  constexpr double far_m = 100'000.0;
  auto const columns = number(object, "Columns", 1, most_map_cells);
  auto const rows = number(object, "Rows", 1, most_map_cells);
  auto const resolution_m = number(object, "Resolution", 0.01, 100.0);
  auto const x_m = number(object, "Origin X", -far_m, far_m);
  auto const y_m = number(object, "Origin Y", -far_m, far_m);
  auto const cells = object.find("Cells");
  bool const is_whole = columns && rows && resolution_m && x_m && y_m && cells != object.end() && cells->is_array();
  if (!is_whole) return wrong("an occupancy map without Columns, Rows, Resolution, Origin X, Origin Y or Cells");
  if (cells->size() > most_map_cells || static_cast<double>(cells->size()) != std::floor(*columns) * std::floor(*rows))
    return wrong(fmt::format("an occupancy map of {} x {} with {} cells", *columns, *rows, cells->size()));
  if (!std::ranges::all_of(*cells, is_percent)) return wrong("a cell of an occupancy map is not from -1 to 100");
  return OccupancyMap{.columns = static_cast<std::uint32_t>(*columns),
                      .rows = static_cast<std::uint32_t>(*rows),
                      .resolution_m = *resolution_m,
                      .origin = {*x_m, *y_m},
                      .cells = cells->get<std::vector<std::int8_t>>()};
}

base::Result<Report> heartbeat(Json const& object) {
  constexpr double far_m = 1e6;
  report::Heartbeat heartbeat{.state = words(object, "State"),
                              .mode = words(object, "Ardupilot State"),
                              .height_m = number(object, "Relative Altitude", -far_m, far_m),
                              .is_armed = object.value("Armed", Json(false)) == Json(true),
                              .battery = number(object, "Battery Percentage", 0.0, 1.0),
                              .user_error = user_error(object),
                              .is_healthy = number(object, "Health Status", 0, 255).value_or(1) == 0,
                              .health_reason = words(object, "Health Reason")};
  auto const lat_deg = number(object, "Latitude", -90.0, 90.0);
  auto const lon_deg = number(object, "Longitude", -180.0, 180.0);
  if (lat_deg && lon_deg) heartbeat.position = geo::Wgs84::from_degrees(*lat_deg, *lon_deg);
  auto const x_m = number(object, "Local Position X", -far_m, far_m);
  auto const y_m = number(object, "Local Position Y", -far_m, far_m);
  if (x_m && y_m) heartbeat.local = geo::Point<ArmingFrame>(*x_m, *y_m);
  if (auto const map = object.find("Occupancy Map"); map != object.end() && map->is_object()) {
    auto read = occupancy_map(*map);
    if (!read) return std::unexpected(read.error());
    heartbeat.map = *std::move(read);
  }
  return heartbeat;
}

/// From 1 on, and as exact as every reader of JSON has it.
std::optional<std::uint64_t> revision(Json const& object, char const* key) {
  constexpr std::uint64_t most = std::uint64_t{1} << 53U;
  auto const found = object.find(key);
  if (found == object.end() || !found->is_number_unsigned()) return std::nullopt;
  auto const value = found->get<std::uint64_t>();
  return value >= 1 && value <= most ? std::optional(value) : std::nullopt;
}

base::Result<Report> map(Json const& object) {
  auto const number_of_it = revision(object, "Revision");
  if (!number_of_it) return wrong("a map without its Revision");
  auto whole = occupancy_map(object);
  if (!whole) return std::unexpected(whole.error());
  return report::Map{.revision = *number_of_it, .map = *std::move(whole)};
}

/// The number of its first cell, and what that one and those behind it are now.
std::optional<report::MapChanges::Run> run(Json const& cells) {
  if (!cells.is_array() || cells.size() < 2 || cells.size() > most_map_cells + 1) return std::nullopt;
  auto const& first = cells[0];
  if (!first.is_number_unsigned() || first.get<std::uint64_t>() > most_map_cells) return std::nullopt;
  report::MapChanges::Run run{.first = first.get<std::uint32_t>(), .cells = {}};
  for (auto const& cell : cells | std::views::drop(1)) {
    if (!is_percent(cell)) return std::nullopt;
    run.cells.push_back(cell.get<std::int8_t>());
  }
  return run;
}

base::Result<Report> map_changes(Json const& object) {
  auto const number_of_it = revision(object, "Revision");
  auto const since = revision(object, "Since");
  auto const changes = object.find("Changes");
  if (!number_of_it || !since || changes == object.end() || !changes->is_array())
    return wrong("changes of a map without Revision, Since or Changes");
  report::MapChanges read{.revision = *number_of_it, .since = *since, .runs = {}};
  std::size_t next = 0;
  for (auto const& one : *changes) {
    auto cells = run(one);
    if (!cells || cells->first < next || cells->first + cells->cells.size() > most_map_cells)
      return wrong("changes of a map that are no runs of cells, one behind the other");
    next = cells->first + cells->cells.size();
    read.runs.push_back(*std::move(cells));
  }
  return read;
}

std::optional<vehicle::SlotCounts> slot_counts(Json const& survey) {
  constexpr double most = 1e6;
  auto const all = number(survey, "slots", 0, most);
  auto const free = number(survey, "free", 0, most);
  auto const taken = number(survey, "taken", 0, most);
  if (!all || !free || !taken || *free + *taken > *all) return std::nullopt;
  return vehicle::SlotCounts{.free = static_cast<std::size_t>(*free),
                             .taken = static_cast<std::size_t>(*taken),
                             .unknown = static_cast<std::size_t>(*all - *free - *taken)};
}

std::optional<report::Survey> survey(Json const& features) {
  auto const found = features.find("survey");
  if (found == features.end() || !found->is_object()) return std::nullopt;
  auto const coverage = number(*found, "coverage", 0.0, 1.0);
  if (!coverage) return std::nullopt;
  return report::Survey{.coverage = *coverage,
                        .begun = words(*found, "begun"),
                        .is_over = found->value("is_over", Json(false)) == Json(true),
                        .ending = words(*found, "ending"),
                        .slots = slot_counts(*found)};
}

base::Result<Report> slots(Json const& object) {
  auto const features = object.find("Features");
  if (features == object.end() || !features->is_object()) return wrong("slots without Features");
  return report::Slots{.features = base::to_text(*features), .survey = survey(*features)};
}

}  // namespace

base::Result<Report> parse_report(std::string_view text) {
  auto const object = Json::parse(text, nullptr, false);
  if (!object.is_object()) return wrong("a drone's message is no JSON object");
  auto const type = object.find("Type");
  if (type == object.end() || !type->is_string()) return wrong("a drone's message has no Type that is a text");
  auto const& name = type->get_ref<std::string const&>();
  if (name == "Heartbeat") return heartbeat(object);
  if (name == "ErrorLog") return report::ErrorLog{words(object, "Message")};
  if (name == "Slots") return slots(object);
  if (name == "Map") return map(object);
  if (name == "Map Changes") return map_changes(object);
  return wrong(fmt::format("a drone's message of the unknown type '{}'", base::printable(name.substr(0, 40))));
}

}  // namespace lapwing::autonomy
