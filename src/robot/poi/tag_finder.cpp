#include "robot/poi/tag_finder.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

namespace lapwing::robot {

using namespace std::chrono_literals;

namespace {

constexpr base::Duration look_period = 300ms;
constexpr double nearest_m = 0.6;       ///< nearer, a tag is out of the picture
constexpr double farthest_m = 3.0;      ///< farther, its letters are too small
constexpr double most_slant_rad = 1.0;  ///< more, and its letters are too narrow
constexpr double most_turn_rad = 0.1;   ///< in a period: more, and pictures are smeared
constexpr double patch_m = 0.4;
constexpr int looks_a_patch = 6;
constexpr int sharp_look = 3;    ///< two sharp looks are enough
constexpr int blurred_look = 2;  ///< a blurred one is taken again, twice at most
constexpr double least_confidence = 0.5;

geo::Pose<geo::SiteFrame> level(vehicle::SitePose const& pose) {
  return {map::SitePoint(pose.position.x(), pose.position.y()), pose.yaw_rad};
}

std::string tag_id(std::string const& vehicle, std::uint32_t number) {
  return fmt::format("{} tag {}", vehicle, number);
}

std::optional<TagSight> sight_of(vision::Detection const& sign, TagPlace const& place) {
  auto const number = sign.text.value_or("");
  auto const kind = sign.kind.value_or("");
  if (number.empty() && kind.empty()) return std::nullopt;
  auto const all = number.empty() || kind.empty() ? number + kind : fmt::format("{} {}", number, kind);
  return TagSight{.place = place, .name = number, .text = all, .score = sign.score};
}

}  // namespace

TagFinder::TagFinder(base::Loop& loop, vehicle::Registry const& registry, map::LiveMap& live_map, Setup setup,
                     base::Logger log)
    : loop_(loop),
      registry_(registry),
      live_map_(live_map),
      setup_(std::move(setup)),
      log_(std::move(log)),
      scope_(loop) {
  forget();
  scope_.spawn(keep_looking());
}

base::Task<> TagFinder::keep_looking() {
  std::optional<double> yaw_rad;
  for (;;) {
    co_await loop_.sleep(look_period);
    auto const* const state = registry_.find({setup_.vehicle});
    if (!state || !state->motion.site_pose.value) continue;
    auto const pose = *state->motion.site_pose.value;
    bool const turns = !yaw_rad || std::abs(geo::wrap_pi(pose.yaw_rad - *yaw_rad)) > most_turn_rad;
    yaw_rad = pose.yaw_rad;
    if (turns) continue;
    for (auto const& eye : setup_.eyes) {
      // The robot drives on while somebody looks: each picture has the pose of its own moment.
      auto const* const now = registry_.find({setup_.vehicle});
      if (!now || !now->motion.site_pose.value) break;
      auto looking = look_with(eye, *now->motion.site_pose.value);
      co_await std::move(looking);
    }
  }
}

base::Task<> TagFinder::look_with(Eye const& eye, vehicle::SitePose pose) {
  auto const patch = patch_before(eye, pose);
  if (!patch || looks_[*patch] >= looks_a_patch) co_return;
  auto looking = eye.look();
  auto const look = co_await std::move(looking);
  if (!look) co_return;
  ++pictures_;
  looks_[*patch] += look->is_sharp ? sharp_look : blurred_look;
  auto const* const grid = grid_of(pose);
  if (!grid) co_return;
  for (auto const& sign : look->found) {
    if (sign.category != "sign") continue;
    auto const place = tag_place(*grid, level(pose), eye.mount, sign.box);
    if (!place) continue;
    if (auto const sight = sight_of(sign, *place)) write(book_.take(*sight), pose);
  }
}

std::optional<TagFinder::Patch> TagFinder::patch_before(Eye const& eye, vehicle::SitePose const& pose) const {
  auto const* const grid = grid_of(pose);
  if (!grid) return std::nullopt;
  auto const wall = wall_seen(*grid, level(pose), eye.mount, eye.mount.yaw_rad);
  if (!wall || wall->range_m < nearest_m || wall->range_m > farthest_m) return std::nullopt;
  double const straight_rad = wall->facing_rad + std::numbers::pi;
  if (std::abs(geo::wrap_pi(pose.yaw_rad + eye.mount.yaw_rad - straight_rad)) > most_slant_rad) return std::nullopt;
  return Patch{static_cast<int>(std::floor(wall->position.x() / patch_m)),
               static_cast<int>(std::floor(wall->position.y() / patch_m)),
               static_cast<int>(std::lround(wall->facing_rad / (std::numbers::pi / 2.0)))};
}

map::OccupancyGrid const* TagFinder::grid_of(vehicle::SitePose const& pose) const {
  auto const found = live_map_.grids().find({.site = pose.site, .floor = pose.floor, .name = setup_.grid});
  return found == live_map_.grids().end() ? nullptr : &found->second.grid;
}

void TagFinder::write(TagBook::Entry const& tag, vehicle::SitePose const& pose) {
  if (tag.confidence() < least_confidence) return;
  map::PointOfInterest const point{.position = tag.position,
                                   .height_m = tag.height_m,
                                   .kind = "name tag",
                                   .name = tag.name(),
                                   .text = tag.text(),
                                   .picture = {},
                                   .facing_rad = tag.facing_rad,
                                   .confidence = tag.confidence(),
                                   .covariance_m2 = tag.covariance_m2};
  auto const written = live_map_.put({.id = tag_id(setup_.vehicle, tag.number),
                                      .site = pose.site,
                                      .floor = pose.floor,
                                      .account = {.writer = setup_.vehicle, .at = loop_.utc_now()},
                                      .content = point});
  if (!written) log_.warn(fmt::format("the name tag {} is not shown: {}", point.name, written.error().message));
}

void TagFinder::forget() {
  auto const layer = map::LayerKind::points_of_interest;
  auto const prefix = setup_.vehicle + " tag ";
  std::vector<std::string> ids;
  auto const all = std::numeric_limits<std::size_t>::max();
  for (auto const* record : live_map_.changed_since(layer, 0, all))
    if (!record->is_removed && record->feature.id.starts_with(prefix)) ids.push_back(record->feature.id);
  for (auto const& id : ids) (void)live_map_.remove(layer, id, {.writer = setup_.vehicle, .at = loop_.utc_now()});
}

}  // namespace lapwing::robot
