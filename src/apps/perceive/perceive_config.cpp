#include "apps/perceive/perceive_config.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "apps/onboard/bus_config.hpp"
#include "apps/onboard/stream_config.hpp"
#include "base/config.hpp"
#include "video/camera/camera_settings.hpp"

namespace lapwing::apps {

namespace {

namespace fs = std::filesystem;
using base::ConfigReader;
using base::Diagnostics;
using base::config_kinds::invalid_value;

constexpr auto example_of_area = "area = [[43.2587, -79.9204], [43.2587, -79.9200], [43.2584, -79.9200]]";
/// Of what is missing: it has no place of its own.
constexpr base::Span beginning{0, 1};
constexpr double farthest_degrees = 180.0;
constexpr double furthest_latitude = 90.0;
constexpr double s_per_min = 60.0;

std::vector<geo::Wgs84> read_corners(ConfigReader& table, Diagnostics& diagnostics, std::string_view key) {
  std::vector<geo::Wgs84> corners;
  for (auto const& [pair, span] : table.number_lists(key, 2, -farthest_degrees, farthest_degrees)) {
    if (std::abs(pair[0]) > furthest_latitude)
      diagnostics.report(invalid_value, span, fmt::format("{:g} is no latitude", pair[0]),
                         "a corner is [latitude, longitude], in degrees");
    corners.push_back(geo::Wgs84::from_degrees(pair[0], pair[1]));
  }
  return corners;
}

void read_limits(ConfigReader& table, perceive::SurveyOrder& order) {
  constexpr double deepest_m = 50.0;
  if (auto const ground = table.number("ground_m", -deepest_m, deepest_m)) order.ground_m = ground->value;
  if (auto const speed = table.number("speed_m_s", 0.5, 15.0)) order.planner.flight.speed_m_s = speed->value;
  if (auto const coverage = table.number("coverage", 0.1, 1.0)) order.enough_coverage = coverage->value;
  if (auto const minutes = table.number("most_min", 0.5, 600.0)) order.most_s = s_per_min * minutes->value;
  if (auto const lost = table.number("lot_lost_s", 2.0, 3600.0)) order.lot_lost = base::from_seconds(lost->value);
}

void read_survey(ConfigReader& root, fs::path const& beside, Diagnostics& diagnostics,
                 perceive::PerceiveSettings& settings) {
  settings.folder = beside / settings.folder;
  auto table = root.table("survey");
  if (!table) {
    if (!root.has("survey"))
      diagnostics.report(invalid_value, beginning,
                         "a camera is named, but no survey: nothing says what it is to look at",
                         fmt::format("[survey] with {}", example_of_area));
    return;
  }
  auto& order = settings.order;
  order.area = read_corners(*table, diagnostics, "area");
  order.fence = read_corners(*table, diagnostics, "fence");
  // What the drone may fly over is what it is to see, for who names no other.
  if (!table->has("area")) order.area = order.fence;
  if (order.area.empty() && !table->has("area") && !table->has("fence"))
    diagnostics.report(invalid_value, beginning, "the survey has no area", example_of_area);
  read_limits(*table, order);
  if (auto const name = table->text("name")) order.name = name->value;
  if (auto const folder = table->text("folder")) settings.folder = beside / folder->value;
  if (auto const pictures = table->number("pictures_a_s", 0.2, 30.0)) settings.looks_a_s = pictures->value;
  if (auto const minutes = table->number("remembers_min", 0.0, 1440.0))
    settings.remembers = base::from_seconds(s_per_min * minutes->value);
  table->refuse_unknown();
}

/// That a survey can be made of it: tried at the first corner, since it shows only in flight where home is.
void try_survey(perceive::SurveyOrder const& order, Diagnostics& diagnostics) {
  auto const made = perceive::Surveyor::make(order, {.anchor = order.area.front()}, {});
  if (!made) diagnostics.report(invalid_value, beginning, made.error().message, made.error().hint);
}

}  // namespace

PerceiveConfig read_perceive_config(base::SourceFile const& source, base::Diagnostics& diagnostics) {
  auto const tree = base::parse_config(source, diagnostics);
  ConfigReader root(tree, diagnostics);
  PerceiveConfig config;
  auto const beside = fs::path(source.name()).parent_path();
  read_bus(root, config.bus);
  auto& settings = config.perceive;
  if (auto camera = root.table("camera"))
    settings.camera = video::read_camera(*camera, beside);
  else if (!root.has("camera"))
    diagnostics.report(invalid_value, beginning, "there is no camera",
                       "[camera] with kind = \"simulated\" and a world, ...");
  read_survey(root, beside, diagnostics, settings);
  if (auto const stream = read_stream(root, beside)) {
    settings.stream = stream->serve;
    settings.shown_a_s = stream->pictures_a_s;
    config.stream_token_file = stream->token_file;
  }
  auto& order = settings.order;
  order.planner.camera = settings.camera.lens;
  order.planner.tilt_rad = settings.camera.mount.tilt_rad;
  order.camera_yaw_rad = settings.camera.mount.yaw_rad;
  if (!diagnostics.has_errors() && !order.area.empty()) try_survey(order, diagnostics);
  return config;
}

}  // namespace lapwing::apps
