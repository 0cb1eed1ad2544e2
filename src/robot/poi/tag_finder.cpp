#include "robot/poi/tag_finder.hpp"

#include <algorithm>
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
constexpr int blank_look = 6;  ///< one is enough where nothing is written: the pieces beside it show it as well
constexpr int sharp_look = 3;  ///< two sharp looks are enough
constexpr int poor_look = 2;   ///< a blurred one, or with a sign cut off, is taken again, twice at most
constexpr double least_confidence = 0.55;  ///< more than a single sight of a kind without a number gives
constexpr double edge_px = 4.0;

geo::Pose<geo::SiteFrame> level(vehicle::SitePose const& pose) {
  return {map::SitePoint(pose.position.x(), pose.position.y()), pose.yaw_rad};
}

std::string tag_id(std::string const& vehicle, std::uint32_t number) {
  return fmt::format("{} tag {}", vehicle, number);
}

std::optional<TagSight> sight_of(Seen const& seen, TagPlace const& place) {
  auto const& sign = seen.what;
  auto const number = sign.text.value_or("");
  auto const kind = sign.kind.value_or("");
  if (number.empty() && kind.empty()) return std::nullopt;
  return TagSight{.place = place, .name = number, .kind = kind, .score = sign.score, .crop = seen.crop};
}

/// The edge of the picture may have taken letters from it.
bool is_cut_off(vision::Box const& box, CameraMount const& mount) {
  return box.x < edge_px || box.y < edge_px || box.x + box.width > mount.width_px - edge_px ||
         box.y + box.height > mount.height_px - edge_px;
}

/// How much of what a piece of wall is to be looked at a look was.
int worth_of(Look const& look, CameraMount const& mount) {
  if (look.found.empty()) return blank_look;
  bool const is_read = std::ranges::all_of(
      look.found, [&](Seen const& seen) { return seen.what.text && !is_cut_off(seen.what.box, mount); });
  return look.is_sharp && is_read ? sharp_look : poor_look;
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
    for (auto const& eye : setup_.eyes.for_tags) {
      // The robot drives on while somebody looks: each picture has the pose of its own moment.
      auto const* const now = registry_.find({setup_.vehicle});
      if (!now || !now->motion.site_pose.value) break;
      if (std::abs(geo::wrap_pi(now->motion.site_pose.value->yaw_rad - pose.yaw_rad)) > most_turn_rad) break;
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
  looks_[*patch] += worth_of(*look, eye.mount);
  auto const* const grid = grid_of(pose);
  if (!grid) co_return;
  for (auto const& seen : look->found) {
    if (seen.what.category != "sign" || is_cut_off(seen.what.box, eye.mount)) continue;
    auto const place = tag_place(*grid, level(pose), eye.mount, seen.what.box);
    auto const sight = place ? sight_of(seen, *place) : std::nullopt;
    if (!sight) continue;
    auto& tag = book_.take(*sight);
    if (tag.confidence() < least_confidence) continue;
    if (setup_.eyes.keep && tag.picture.empty() && !tag.crop.empty()) {
      auto keeping = setup_.eyes.keep(tag.crop);
      auto const kept = co_await std::move(keeping);
      if (kept) tag.picture = *kept;
    }
    write(tag, pose);
  }
}

std::vector<std::string> TagFinder::texts() const {
  std::vector<std::string> texts;
  for (auto const& tag : book_.tags())
    if (tag.confidence() >= least_confidence) texts.push_back(tag.text());
  std::ranges::sort(texts);
  return texts;
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
  map::PointOfInterest const point{.position = tag.position,
                                   .height_m = tag.height_m,
                                   .kind = "name tag",
                                   .name = tag.name(),
                                   .text = tag.text(),
                                   .picture = tag.picture,
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
