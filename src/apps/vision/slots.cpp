#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/verb.hpp"
#include "apps/vision/detect.hpp"
#include "apps/vision/overhead.hpp"
#include "apps/vision/slot_files.hpp"
#include "vision/lot/occupancy.hpp"
#include "vision/lot/seen_slots.hpp"

namespace lapwing::apps::detect {

namespace {

/// Cars that are less sure say nothing of a slot.
constexpr double least_car = 0.15;

struct SlotOptions {
  CommonOptions common;
  GroundOptions ground;
  std::filesystem::path layout;
  std::filesystem::path truth;
};

vision::Detection told(vision::SeenSlot const& slot, vision::Overhead const& overhead, cv::Size const& picture) {
  vision::Detection detection{.category = "slot", .box = {}, .score = slot.surety};
  auto& corners = detection.corners.emplace();
  cv::Point2d low = slot.corners[0];
  cv::Point2d high = slot.corners[0];
  for (std::size_t k = 0; k < corners.size(); ++k) {
    auto const& corner = slot.corners[k];
    corners[k] = {corner.x, corner.y};
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
  }
  detection.box = {.x = low.x, .y = low.y, .width = high.x - low.x, .height = high.y - low.y};
  detection.occupied_chance = vision::occupied_chance(slot.corners, overhead, picture);
  return detection;
}

/// NAME.json for NAME.jpg.
base::Result<std::optional<std::vector<vision::JudgedSlot>>> known_slots(std::filesystem::path const& folder,
                                                                         std::string const& picture) {
  return slots_of_file(folder / (std::filesystem::path(picture).stem().string() + ".json"));
}

std::vector<vision::JudgedSlot> judged(Found const& found) {
  std::vector<vision::JudgedSlot> slots;
  for (auto const& detection : found.detections) {
    if (!detection.corners) continue;
    auto& slot = slots.emplace_back();
    for (std::size_t k = 0; k < slot.corners.size(); ++k)
      slot.corners[k] = {(*detection.corners)[k].x, (*detection.corners)[k].y};
    slot.occupied = detection.occupied_chance;
  }
  return slots;
}

int judge(SlotOptions const& options, Outcome const& outcome) {
  vision::SlotFigures figures;
  for (auto const& found : outcome.found) {
    auto const truth = known_slots(options.truth, found.picture);
    if (!truth) return host::refuse(truth.error());
    if (*truth && found.metres_a_pixel) add(figures, judged(found), **truth, *found.metres_a_pixel);
  }
  // Beside the JSON of standard output.
  fmt::print(options.common.as_json ? stderr : stdout,
             "slots: {} pictures, {} slots: F1 {:.3f}, precision {:.3f}, recall {:.3f} within 0.5 m; taken or free: {} "
             "told, {:.4f} right, Brier {:.4f}, {} not told\n",
             figures.pictures, figures.there, figures.f1(), figures.precision(), figures.recall(), figures.told,
             figures.accuracy(), figures.brier(), figures.untold);
  return outcome.exit_code;
}

int slots(SlotOptions const& options) {
  auto watcher = GroundWatcher::make(options.ground);
  if (!watcher) return host::refuse(watcher.error());
  std::vector<std::vector<vision::JudgedSlot>> layouts;
  for (auto const& picture : options.common.pictures) {
    if (options.layout.empty()) break;
    auto known = known_slots(options.layout, picture);
    if (!known) return host::refuse(known.error());
    layouts.push_back(known->value_or(std::vector<vision::JudgedSlot>()));
  }
  auto const outcome = carry_out(
      options.common, [&](std::size_t which, cv::Mat const& upright, vision::FlightRecord const& flight) -> Seen {
        auto const ground = watcher->look(upright, flight, least_car, vision::Views::picture);
        Seen seen{.detections = {}, .metres_a_pixel = ground.metres_a_pixel};
        if (!ground.metres_a_pixel) return seen;
        std::vector<vision::SeenSlot> placed;
        if (layouts.empty()) {
          placed = vision::slots_seen(upright, ground.overhead.cars, *ground.metres_a_pixel);
        } else {
          for (auto const& slot : layouts[which]) placed.push_back({.corners = slot.corners});
        }
        for (auto const& slot : placed) seen.detections.push_back(told(slot, ground.overhead, upright.size()));
        return seen;
      });
  return options.truth.empty() ? outcome.exit_code : judge(options, outcome);
}

}  // namespace

void add_slots(CLI::App& detect, int& exit_code) {
  auto const options = std::make_shared<SlotOptions>();
  auto* const part =
      detect.add_subcommand("slots", "Places to park, and whether a vehicle stands there, seen from above");
  add_common_options(*part, options->common);
  add_ground_options(*part, options->ground);
  part->add_option("--layout", options->layout, "Folder with the slots as they are known, NAME.json for each picture")
      ->check(CLI::ExistingDirectory);
  part->add_option("--truth", options->truth, "Folder with what people marked in these pictures: says how good it is")
      ->check(CLI::ExistingDirectory);
  part->callback([options, &exit_code] { exit_code = slots(*options); });
}

}  // namespace lapwing::apps::detect
