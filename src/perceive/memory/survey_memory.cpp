#include "perceive/memory/survey_memory.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "base/crc32.hpp"
#include "base/text/json.hpp"
#include "base/text/utc_text.hpp"
#include "explore/lot/slots/picture_shift.hpp"
#include "map/features/feature_json.hpp"
#include "perceive/memory/kept_sights.hpp"
#include "perceive/memory/sight_json.hpp"

namespace lapwing::perceive {

using base::ErrorKind;
using geo::Json;

namespace {

constexpr auto format = "lapwing survey";
constexpr int version = 1;
constexpr double farthest_m = 2'000.0;
constexpr int most_lives = 1'000'000;
constexpr double most_pictures = 1e12;
constexpr std::size_t longest_ending = 1'000;

std::string checksum_of(std::string_view content) {
  return fmt::format("{{\"crc32\":\"{:08x}\"}}\n", base::crc32(content));
}

std::unexpected<base::Error> unreadable(std::string why) {
  return base::fail(ErrorKind::invalid_input, std::move(why));
}

/// What stands before the checksum, when that is right.
std::optional<std::string_view> checked(std::string_view text) {
  constexpr std::size_t checksum_size = sizeof("{\"crc32\":\"01234567\"}");
  if (text.size() < checksum_size) return std::nullopt;
  auto const content = text.substr(0, text.size() - checksum_size);
  if (text.substr(content.size()) != checksum_of(content)) return std::nullopt;
  return content;
}

/// The first line of what is left, without its end.
std::string_view take_line(std::string_view& rest) {
  auto const end = rest.find('\n');
  auto const line = rest.substr(0, end);
  rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  return line;
}

Json parsed(std::string_view line) {
  return Json::parse(line, nullptr, false);
}

std::optional<double> number_at(Json const& json, char const* key, double least, double most) {
  auto const found = json.find(key);
  if (found == json.end() || !found->is_number()) return std::nullopt;
  auto const number = found->get<double>();
  return number >= least && number <= most ? std::optional(number) : std::nullopt;
}

std::optional<base::UtcTime> time_at(Json const& json, char const* key) {
  auto const found = json.find(key);
  return found == json.end() || !found->is_string() ? std::nullopt : base::utc_from_text(found->get<std::string>());
}

std::optional<geo::Wgs84> anchor_in(Json const& json) {
  constexpr double pole_deg = 90.0;
  constexpr double turn_deg = 180.0;
  constexpr double highest_m = 10'000.0;
  auto const found = json.find("anchor");
  if (found == json.end() || !found->is_object()) return std::nullopt;
  auto const lat = number_at(*found, "lat_deg", -pole_deg, pole_deg);
  auto const lon = number_at(*found, "lon_deg", -turn_deg, turn_deg);
  auto const alt = number_at(*found, "alt_m", -highest_m, highest_m);
  if (!lat || !lon || !alt) return std::nullopt;
  return geo::Wgs84::from_degrees(*lat, *lon, *alt);
}

/// Fine enough for two frames of one place to agree to the millimetre.
Json json_of(geo::Wgs84 const& place) {
  constexpr int degree_decimals = 9;
  constexpr int metre_decimals = 3;
  return {{"lat_deg", geo::rounded(place.lat_deg(), degree_decimals)},
          {"lon_deg", geo::rounded(place.lon_deg(), degree_decimals)},
          {"alt_m", geo::rounded(place.alt_m, metre_decimals)}};
}

/// How far the frame that the sights were given in lies from the site's, where that is near enough.
base::Result<geo::Vector3<geo::SiteFrame>> shift_of(Json const& head, geo::Site const& site) {
  auto const anchor = anchor_in(head);
  if (!anchor) return unreadable("it does not say where it is");
  auto const origin = site.point_of(*anchor);
  if (!(origin.v.norm() <= farthest_m))
    return unreadable(fmt::format("it is of a place {:.0f} m from here", origin.v.norm()));
  return geo::Vector3<geo::SiteFrame>(origin.x(), origin.y(), origin.z());
}

void move(explore::LotSight& sight, geo::Vector3<geo::SiteFrame> const& shift) {
  sight = explore::shifted(std::move(sight), {.v = {shift.x(), shift.y(), 0.0, 0.0}});
  auto const& from = sight.view.site_from_camera;
  geo::Vector3<geo::SiteFrame> const up(0.0, 0.0, shift.z());
  sight.view.site_from_camera = geo::CameraPlace(from.origin() + up, from.rotation());
  sight.view.ground_up_m += shift.z();
}

base::Result<SurveyMemory> read_head(Json const& head) {
  if (!head.is_object() || head.value("format", Json()) != format) return unreadable("it is no survey of Lapwing's");
  auto const written = number_at(head, "version", 1, most_pictures);
  if (written != version)
    return unreadable(fmt::format("it is of version {:g}, and this program reads {}", written.value_or(0.0), version));
  auto const at = time_at(head, "at");
  auto const lives = number_at(head, "lives", 1, most_lives);
  auto const pictures = number_at(head, "pictures", 0, most_pictures);
  if (!at || !lives || !pictures) return unreadable("its first line is not whole");
  SurveyMemory memory{.at = *at,
                      .lives = static_cast<int>(*lives),
                      .begun = time_at(head, "begun"),
                      .explores = head.value("explores", Json()) == true,
                      .pictures = static_cast<std::size_t>(*pictures)};
  if (auto const ending = head.find("ending"); ending != head.end() && ending->is_string())
    memory.ending = ending->get<std::string>().substr(0, longest_ending);
  return memory;
}

base::Result<> read_slots(std::string_view line, geo::Site const& site, SurveyMemory& memory) {
  auto const find_site = [&site](std::string_view) { return &site; };
  auto slots = map::read_features(line, map::LayerKind::slots, find_site, {.site = site.id()});
  if (!slots) return unreadable(fmt::format("its slots: {}", slots.error().message));
  memory.slots = *std::move(slots);
  for (auto& slot : memory.slots) slot.site = site.id();
  return {};
}

base::Result<> read_sights(std::string_view lines, geo::Vector3<geo::SiteFrame> const& shift, SurveyMemory& memory) {
  while (!lines.empty()) {
    if (memory.sights.size() >= KeptSights::most) return unreadable("it has more sights than are ever kept");
    auto sight = read_sight(parsed(take_line(lines)));
    if (!sight) return std::unexpected(sight.error());
    move(*sight, shift);
    memory.sights.push_back(*std::move(sight));
  }
  return {};
}

}  // namespace

std::string memory_text(SurveyMemory const& memory, geo::Site const& site, std::string_view sight_lines) {
  Json const head{{"format", format},
                  {"version", version},
                  {"at", base::utc_text(memory.at)},
                  {"anchor", json_of(site.anchor())},
                  {"lives", memory.lives},
                  {"begun", memory.begun ? Json(base::utc_text(*memory.begun)) : Json()},
                  {"explores", memory.explores},
                  {"ending", memory.ending},
                  {"pictures", memory.pictures}};
  auto features = Json::array();
  for (auto const& slot : memory.slots) features.push_back(map::feature_json(slot, site));
  Json const slots{{"type", "FeatureCollection"}, {"features", std::move(features)}};
  return with_checksum(fmt::format("{}\n{}\n{}", base::to_text(head), base::to_text(slots), sight_lines));
}

std::string with_checksum(std::string content) {
  content += checksum_of(content);
  return content;
}

base::Result<SurveyMemory> read_memory(std::string_view text, geo::Site const& site) {
  if (text.size() > longest_memory) return unreadable("it is too long for a survey");
  auto const content = checked(text);
  if (!content) return unreadable("it is cut off, was changed, or is something else: its checksum is wrong");
  auto rest = *content;
  auto const head = parsed(take_line(rest));
  auto memory = read_head(head);
  if (!memory) return memory;
  auto const shift = shift_of(head, site);
  if (!shift) return std::unexpected(shift.error());
  if (auto const read = read_slots(take_line(rest), site, *memory); !read) return std::unexpected(read.error());
  if (auto const read = read_sights(rest, *shift, *memory); !read) return std::unexpected(read.error());
  return memory;
}

}  // namespace lapwing::perceive
