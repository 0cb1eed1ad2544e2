#include "plan/files/plan_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "plan/files/internal/plan_reader.hpp"

namespace lapwing::plan {

using base::ErrorKind;
using base::fail;
using base::Result;

namespace internal {

std::unexpected<base::Error> wrong(std::string_view where, std::string_view what, std::string_view hint) {
  return fail(ErrorKind::invalid_input, fmt::format("{}: {}", where, what), std::string(hint));
}

Result<geo::Wgs84> to_place(double lat_deg, double lon_deg, double alt_m) {
  auto const refuse = [](std::string text) { return fail(ErrorKind::invalid_input, std::move(text)); };
  if (!(std::abs(lat_deg) <= 90.0)) return refuse(fmt::format("latitude {} is beyond 90 degrees", lat_deg));
  if (!(std::abs(lon_deg) <= 180.0)) return refuse(fmt::format("longitude {} is beyond 180 degrees", lon_deg));
  constexpr double beyond_the_sky_m = 1e6;
  if (!(std::abs(alt_m) < beyond_the_sky_m)) return refuse(fmt::format("height {} m is no height to fly at", alt_m));
  return geo::Wgs84::from_degrees(lat_deg, lon_deg, alt_m);
}

namespace {

bool is_whole(double value, double most) {
  return value >= 0.0 && value <= most && value == std::floor(value);
}

/// As a float of the wire; what no float can hold becomes infinite, which is refused.
Result<std::array<float, 4>> to_params(std::array<double, 7> const& values) {
  std::array<float, 4> params{};
  for (std::size_t i = 0; i < params.size(); ++i) {
    bool const fits = std::isnan(values[i]) || std::abs(values[i]) <= std::numeric_limits<float>::max();
    if (!fits) return fail(ErrorKind::invalid_input, fmt::format("parameter {} is too large: {}", i + 1, values[i]));
    params[i] = static_cast<float>(values[i]);
  }
  return params;
}

double or_zero(double value) {
  return std::isnan(value) ? 0.0 : value;
}

/// Parameters 5 to 7 of a command that goes nowhere; the wire has 32 bits for the first two.
mavlink::ItemPlace to_plain_place(std::array<double, 7> const& values) {
  constexpr double most = 2e9;
  return {.x = std::clamp(or_zero(values[4]), -most, most),
          .y = std::clamp(or_zero(values[5]), -most, most),
          .z_m = std::clamp(or_zero(values[6]), -most, most)};
}

}  // namespace

bool is_placed(mavlink::MissionItem const& item) {
  return mavlink::has_place(item.command) && item.frame != mavlink::MavFrame::mission;
}

bool is_radius(double radius_m) {
  constexpr auto smallest_m = static_cast<double>(0.01F);  // as vehicles keep it
  return radius_m >= smallest_m && radius_m <= max_fence_distance_m;
}

double file_degrees(double degrees) {
  constexpr double scale = 1e9;
  return std::round(degrees * scale) / scale + 0.0;  // no negative zero
}

std::optional<double> number_in(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  auto const [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

FileItem from_item(mavlink::MissionItem const& item) {
  FileItem to{.command = static_cast<double>(item.command),
              .frame = static_cast<double>(item.frame),
              .params = {},
              .autocontinue = item.autocontinue};
  // The shortest decimal that is the same float: 0.1, not 0.10000000149.
  for (std::size_t i = 0; i < item.params.size(); ++i)
    to.params[i] = number_in(fmt::format("{}", item.params[i])).value_or(std::nan(""));
  auto const place = position_of(item);
  to.params[4] = is_placed(item) ? file_degrees(place.lat_deg()) : item.place.x;
  to.params[5] = is_placed(item) ? file_degrees(place.lon_deg()) : item.place.y;
  to.params[6] = item.place.z_m;
  return to;
}

Result<FileItem> way_point_at(double lat_deg, double lon_deg, std::optional<double> alt_m, mavlink::MavFrame frame,
                              PlanReadOptions const& options) {
  if (!alt_m && !options.altitude_m)
    return fail(ErrorKind::invalid_input, "this place has no height to fly at",
                "say one: --altitude METRES above home");
  FileItem item{.command = static_cast<double>(mavlink::MavCmd::nav_waypoint),
                .frame = static_cast<double>(alt_m ? frame : mavlink::MavFrame::global_relative_alt)};
  item.params[3] = std::nan("");
  item.params[4] = lat_deg;
  item.params[5] = lon_deg;
  item.params[6] = alt_m ? *alt_m : *options.altitude_m;
  return item;
}

Result<> FenceBudget::take_zone(std::string_view where) {
  if (++zones > max_fence_zones) return wrong(where, fmt::format("more than {} zones", max_fence_zones));
  return {};
}

Result<> FenceBudget::take_corners(std::string_view where, std::size_t count) {
  corners += count;
  if (corners > max_fence_corners) return wrong(where, fmt::format("more than {} corners", max_fence_corners));
  return {};
}

Result<mavlink::MissionItem> to_item(FileItem const& from) {
  if (!is_whole(from.command, 65535.0))
    return fail(ErrorKind::invalid_input, fmt::format("{} is no command", from.command));
  mavlink::MissionItem item;
  item.command = static_cast<mavlink::MavCmd>(static_cast<int>(from.command));
  if (!mavlink::is_listed(item.command))
    return fail(ErrorKind::invalid_input, fmt::format("command {} is not known here", from.command));
  auto const frame = is_whole(from.frame, 255.0) ? static_cast<mavlink::MavFrame>(static_cast<int>(from.frame))
                                                 : mavlink::MavFrame::local_ned;
  bool const is_placed = mavlink::has_place(item.command) && frame != mavlink::MavFrame::mission;
  if (is_placed && !mavlink::is_global(frame))
    return fail(ErrorKind::invalid_input, fmt::format("frame {} is not supported", from.frame),
                "use heights above sea level (0), home (3) or terrain (10)");
  item.frame = frame;
  auto params = to_params(from.params);
  if (!params) return std::unexpected(std::move(params.error()));
  item.params = *params;
  if (item.command == mavlink::MavCmd::do_jump &&
      !(is_whole(from.params[0], 65535.0) && is_whole(from.params[1] + 1.0, 65535.0)))
    return fail(ErrorKind::invalid_input, "a jump needs the number of an item, and how many times (-1 for ever)");
  item.autocontinue = from.autocontinue;
  item.place = to_plain_place(from.params);
  if (!is_placed) return item;
  auto const place = to_place(or_zero(from.params[4]), or_zero(from.params[5]), from.params[6]);
  if (!place) return std::unexpected(place.error());
  item.place = {.lat_rad = place->lat_rad, .lon_rad = place->lon_rad, .z_m = place->alt_m};
  return item;
}

}  // namespace internal

std::string plan_name(std::string_view file) {
  auto const slash = file.find_last_of('/');
  if (slash != std::string_view::npos) file.remove_prefix(slash + 1);
  auto const dot = file.find_last_of('.');
  return std::string(dot == std::string_view::npos || dot == 0 ? file : file.substr(0, dot));
}

Result<PlanFormat> format_of(std::string_view file) {
  using enum PlanFormat;
  constexpr std::array<std::pair<std::string_view, PlanFormat>, 7> endings{{{".plan", qgc_plan},
                                                                            {".waypoints", way_points},
                                                                            {".txt", way_points},
                                                                            {".kml", kml},
                                                                            {".kmz", kmz},
                                                                            {".geojson", geojson},
                                                                            {".json", geojson}}};
  for (auto const& [ending, format] : endings)
    if (file.ends_with(ending)) return format;
  return fail(ErrorKind::invalid_input, fmt::format("{}: the ending is that of no plan file", file),
              "endings are .plan, .waypoints, .kml, .kmz and .geojson");
}

Result<PlanFile> read_plan(std::string_view file, std::string_view text, PlanReadOptions const& options) {
  if (text.size() > max_plan_bytes)
    return internal::wrong(
        file, fmt::format("{} MB is too large for a plan (limit {} MB)", text.size() >> 20, max_plan_bytes >> 20));
  std::string unzipped;
  if (text.starts_with("PK\x03\x04")) {
    auto kml = internal::unzip_kml(file, text);
    if (!kml) return std::unexpected(kml.error());
    unzipped = *std::move(kml);
    text = unzipped;
  }
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  auto const first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return internal::wrong(file, "the file is empty");
  Result<PlanFile> read;
  if (text.substr(first).starts_with("QGC WPL"))
    read = internal::read_way_points(file, text);
  else if (text[first] == '<')
    read = internal::read_kml(file, text, options);
  else
    read = internal::read_json_plan(file, text, options);
  if (!read) return read;
  // One place is home's, and a count of 65536 would be told as 0.
  if (read->plan.mission.items.size() >= max_mission_items)
    return internal::wrong(file, "more items than a mission can hold");
  read->plan.mission.name = plan_name(file);
  return read;
}

Result<Mission> mission_to_fly(std::string_view file, Plan const& plan) {
  if (std::ranges::any_of(plan.patterns, [](auto const& pattern) { return pattern.count == 0; }))
    return internal::wrong(file, "a complex item of the plan (a structure scan?) holds no items to fly",
                           "save the mission as way points (\"QGC WPL 110\"), or draw this part with a survey");
  if (plan.mission.items.empty()) return internal::wrong(file, "the plan has no items");
  return plan.mission;
}

Result<WrittenPlan> write_plan(Plan const& plan, PlanFormat format) {
  using enum PlanFormat;
  auto reduced = reduce(plan, format);
  auto const& left = reduced.plan;
  bool const is_empty = left.mission.items.empty() && left.patterns.empty() && left.fence.empty() && left.rally.empty();
  if (is_empty && !reduced.lost.empty())
    return fail(ErrorKind::invalid_input, fmt::format("nothing of the plan can be written: {}", reduced.lost.front()));
  WrittenPlan written{.text = {}, .lost = std::move(reduced.lost)};
  if (format == qgc_plan) written.text = internal::write_qgc_plan(left);
  if (format == way_points) written.text = internal::write_way_points(left);
  if (format == geojson) written.text = internal::write_geojson(left);
  if (format == kml || format == kmz) written.text = internal::write_kml(left);
  if (format == kmz) {
    auto zipped = internal::zip_kml(written.text);
    if (!zipped) return std::unexpected(zipped.error());
    written.text = *std::move(zipped);
  }
  return written;
}

}  // namespace lapwing::plan
