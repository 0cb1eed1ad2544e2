#include "video/world/car_park_parts.hpp"

#include <charconv>
#include <numbers>

#include <fmt/format.h>

namespace lapwing::video {

using base::ConfigReader;
using base::Placed;
using base::config_kinds::invalid_value;

void WorldParts::missing(base::Span span, std::string_view what, std::string_view key) {
  wrong(invalid_value, span, fmt::format("{} needs {}", what, key));
}

void WorldParts::number(ConfigReader& reader, std::string_view key, double low, double high, double& into) {
  if (auto const number = reader.number(key, low, high)) into = number->value;
}

void WorldParts::angle(ConfigReader& reader, std::string_view key, double low_deg, double high_deg, double& into_rad) {
  if (auto const number = reader.number(key, low_deg, high_deg)) into_rad = number->value * std::numbers::pi / 180.0;
}

void WorldParts::whole(ConfigReader& reader, std::string_view key, int low, int high, int& into) {
  if (auto const number = reader.integer(key, low, high)) into = static_cast<int>(number->value);
}

std::optional<Spot> WorldParts::spot(Placed<ConfigReader>& part, std::string_view what) {
  auto const at = part.value.numbers("at", 2, -most_far_m, most_far_m);
  if (at) return Spot(at->value[0], at->value[1]);
  if (!part.value.has("at")) missing(part.span, what, "a place: at = [x, y]");
  return std::nullopt;
}

std::vector<Spot> WorldParts::spots(Placed<ConfigReader>& part, std::string_view key, std::string_view what,
                                    std::size_t fewest) {
  std::vector<Spot> spots;
  for (auto const& pair : part.value.number_lists(key, 2, -most_far_m, most_far_m))
    spots.emplace_back(pair.value[0], pair.value[1]);
  if (spots.size() < fewest) {
    missing(part.span, what, fmt::format("{} places at least: {} = [[x, y], ...]", fewest, key));
    spots.clear();
  } else if (spots.size() > most_corners) {
    wrong(car_park_kinds::too_large, part.span, fmt::format("{} has more than {} places", what, most_corners));
    spots.clear();
  }
  return spots;
}

std::optional<std::vector<Spot>> WorldParts::corners(Placed<ConfigReader>& part, std::string_view what) {
  auto found = spots(part, "corners", what, 3);
  if (found.empty()) return std::nullopt;
  if (auto const fault = geo::polygon_fault(geo::Polygon<geo::SiteFrame>{{found}})) {
    wrong(invalid_value, part.span, fmt::format("{} is no area: {}", what, *fault));
    return std::nullopt;
  }
  return found;
}

void WorldParts::colour(ConfigReader& reader, std::string_view key, Colour& into) {
  auto const text = reader.text(key);
  if (!text) return;
  std::uint32_t rgb = 0;
  std::string_view const word = text->value;
  if (word.size() != 7 || word.front() != '#' ||
      std::from_chars(word.data() + 1, word.data() + word.size(), rgb, 16).ptr != word.data() + word.size()) {
    wrong(invalid_value, text->span, fmt::format("{} must be a colour", key), "as in \"#e6e6e0\": red, green and blue");
    return;
  }
  auto const part = [rgb](unsigned shift) { return static_cast<double>((rgb >> shift) & 0xffU) / 255.0; };
  into = {part(16), part(8), part(0)};
}

std::string WorldParts::name(ConfigReader& reader, std::string_view key, std::string otherwise) {
  constexpr std::size_t most_letters = 100;
  auto text = reader.text(key);
  if (!text) return otherwise;
  if (text->value.empty() || text->value.size() > most_letters)
    wrong(invalid_value, text->span, fmt::format("{} must have 1 to {} letters", key, most_letters));
  return std::move(text->value);
}

void WorldParts::numbers_of_slots(ConfigReader& reader, std::string_view key, std::set<int>& into) {
  for (auto const& number : reader.integers(key, 0, 2 * static_cast<std::int64_t>(most_slots)))
    into.insert(static_cast<int>(number.value));
}

}  // namespace lapwing::video
