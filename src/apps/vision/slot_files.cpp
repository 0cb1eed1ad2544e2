#include "apps/vision/slot_files.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/vision/detect.hpp"

namespace lapwing::apps::detect {

namespace {

using base::ErrorKind;
using base::fail;
using Json = nlohmann::json;

std::optional<cv::Point2d> point_of(Json const& json) {
  if (!json.is_array() || json.size() != 2 || !json[0].is_number() || !json[1].is_number()) return std::nullopt;
  cv::Point2d const point(json[0].get<double>(), json[1].get<double>());
  constexpr double farthest = 1e6;  // no picture is so large
  if (!(std::abs(point.x) < farthest && std::abs(point.y) < farthest)) return std::nullopt;
  return point;
}

std::optional<vision::JudgedSlot> slot_of(Json const& json) {
  if (!json.is_object()) return std::nullopt;
  auto const corners = json.find("corners");
  if (corners == json.end() || !corners->is_array() || corners->size() != 4) return std::nullopt;
  vision::JudgedSlot slot;
  for (std::size_t k = 0; k < slot.corners.size(); ++k) {
    auto const point = point_of((*corners)[k]);
    if (!point) return std::nullopt;
    slot.corners[k] = *point;
  }
  auto const occupied = json.find("occupied");
  if (occupied != json.end() && occupied->is_boolean()) slot.occupied = occupied->get<bool>() ? 1.0 : 0.0;
  return slot;
}

}  // namespace

base::Result<std::optional<std::vector<vision::JudgedSlot>>> slots_of_file(std::filesystem::path const& file) {
  if (!std::filesystem::exists(file)) return std::optional<std::vector<vision::JudgedSlot>>();
  constexpr bool throws = false;
  auto const json = Json::parse(content_of(file), nullptr, throws);
  if (!json.is_object() || !json.contains("slots") || !json["slots"].is_array())
    return fail(ErrorKind::invalid_input, fmt::format("{}: no slots", file.string()),
                R"({"slots": [{"corners": [[x, y], [x, y], [x, y], [x, y]], "occupied": true}]})");
  std::vector<vision::JudgedSlot> slots;
  for (auto const& entry : json["slots"]) {
    auto const slot = slot_of(entry);
    if (!slot)
      return fail(ErrorKind::invalid_input,
                  fmt::format("{}: slot {}: not four corners", file.string(), slots.size() + 1));
    slots.push_back(*slot);
  }
  return std::optional(std::move(slots));
}

}  // namespace lapwing::apps::detect
