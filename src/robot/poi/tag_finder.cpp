#include "robot/poi/tag_finder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "base/async/pool.hpp"
#include "robot/views/wall_views.hpp"

namespace lapwing::robot {

using namespace std::chrono_literals;

namespace {

constexpr base::Duration look_period = 300ms;

constexpr double most_turn_rad = 0.1;      ///< in a period, or while it looks: more, and pictures are smeared
constexpr double least_confidence = 0.55;  ///< more than a single sight of a kind without a number gives
constexpr double edge_px = 4.0;
constexpr int most_tries = 2;  ///< the seed's
constexpr int looks_a_try = 3;
constexpr double there_m = 0.6;  ///< from where it was to look from
constexpr double straight_rad = 0.15;
constexpr double sign_reaches_m = 0.5;
constexpr double worth_telling_m = 0.02;  ///< that a sign has moved with the map

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

double way_to(WallPoint const& wall, vehicle::SitePose const& pose) {
  return std::atan2(wall.position.y() - pose.position.y(), wall.position.x() - pose.position.x());
}

/// Whether the laser sees past a wall of the map: a door that has been opened since, or the edge of a doorway that the
/// map has where it is not. What is seen that way hangs somewhere behind.
bool is_seen_past(WallPoint const& wall, CameraMount const& mount, vehicle::SitePose const& pose,
                  ClearWay const& clear_way) {
  constexpr double behind_m = 0.4;
  if (!clear_way) return false;
  auto const body = level(pose);
  Eigen::Vector2d const along = (wall.position - camera_place(body, mount)).v.normalized();
  Eigen::Vector2d const there = (wall.position - body.position).v + behind_m * along;
  double const far_m = there.norm();
  return clear_way(geo::wrap_pi(std::atan2(there.y(), there.x()) - body.yaw_rad), far_m) >= far_m;
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

std::optional<vehicle::SitePose> TagFinder::pose_now() const {
  auto const* const state = registry_.find({setup_.vehicle});
  return state ? state->motion.site_pose.value : std::nullopt;
}

base::Task<> TagFinder::keep_looking() {
  std::optional<double> yaw_rad;
  for (;;) {
    co_await loop_.sleep(look_period);
    auto const pose = pose_now();
    if (!pose) continue;
    note_passed(*pose);
    bool const turns = !yaw_rad || std::abs(geo::wrap_pi(pose->yaw_rad - *yaw_rad)) > most_turn_rad;
    yaw_rad = pose->yaw_rad;
    if (turns) continue;
    auto looking = retake_ && is_there(*retake_, *pose) ? look_again() : look_round(pose->yaw_rad);
    co_await std::move(looking);
  }
}

void TagFinder::move(MapMove const& moved) {
  looks_.move(moved);
  for (auto const& joined : book_.move(moved)) take_in(joined);
  auto const pose = pose_now();
  if (!pose) return;
  for (auto const& tag : book_.tags()) {
    auto const found = shown_.find(tag.number);
    if (found != shown_.end() && geo::distance_m(tag.position, found->second) > worth_telling_m) write(tag, *pose);
  }
}

/// What one of them was for the robot is the other's now.
void TagFinder::take_in(TagBook::Joined const& joined) {
  auto const gone = tries_of(joined.gone);
  tries_.erase(joined.gone);
  auto& tries = tries_[joined.into];
  tries.begun = std::max(tries.begun, gone.begun);
  tries.looks += gone.looks;
  tries.sights += gone.sights;
  if (retake_ && retake_->tag == joined.gone) retake_->tag = joined.into;
  if (shown_.erase(joined.gone) == 0) return;
  (void)live_map_.remove(map::LayerKind::points_of_interest, tag_id(setup_.vehicle, joined.gone),
                         {.writer = setup_.vehicle, .at = loop_.utc_now()});
  if (auto const pose = pose_now()) write(*book_.find(joined.into), *pose);
}

void TagFinder::note_passed(vehicle::SitePose const& pose) {
  auto const* const grid = grid_of(pose);
  if (!grid || setup_.eyes.for_tags.empty()) return;
  for (auto const& wall : walls_round(*grid, level(pose))) looks_.pass(wall);
}

/// A look takes a while, in which the robot drives on: the eye that shows most that is worth it comes first, and each
/// picture has the pose of its own moment.
base::Task<> TagFinder::look_round(double yaw_rad) {
  std::vector<Eye const*> left;
  for (auto const& eye : setup_.eyes.for_tags) left.push_back(&eye);
  while (!left.empty()) {
    auto const pose = pose_now();
    if (!pose || std::abs(geo::wrap_pi(pose->yaw_rad - yaw_rad)) > most_turn_rad) co_return;
    auto const* const grid = grid_of(*pose);
    if (!grid) co_return;
    Eye const* best = nullptr;
    double most = 0.0;
    for (auto const* eye : left) {
      double worth = 0.0;
      for (auto const& [wall, clear] : walls_in_picture(*grid, eye->mount, level(*pose)))
        if (looks_.is_due(piece_of(wall), clear)) worth += std::min(clear, LookBook::clear_px_m);
      if (worth <= most) continue;
      best = eye;
      most = worth;
    }
    if (!best) co_return;
    std::erase(left, best);
    auto looking = look_with(*best, *pose);
    co_await std::move(looking);
  }
}

base::Task<> TagFinder::look_again() {
  auto const view = retake_->view;
  auto const pose = *pose_now();
  auto looking = look_with(setup_.eyes.for_tags[view.eye], pose);
  auto const seen = co_await std::move(looking);
  if (!seen || !retake_ || retake_->view.from != view.from) co_return;
  auto const number = retake_->tag;
  if (number > 0) {
    ++tries_[number].looks;
    if (std::ranges::find(*seen, number) != seen->end()) ++tries_[number].sights;
  }
  auto const is_worth_more = [this](std::uint32_t one) {
    auto const* const tag = book_.find(one);
    return tag && wants_a_look(*tag);
  };
  bool const wants_more = (number > 0 && is_worth_more(number)) || std::ranges::any_of(*seen, is_worth_more);
  if (++retake_->looks < looks_a_try && wants_more) co_return;
  // It has come all this way: what the other eyes see from here spares it another one.
  auto rest = look_round(pose.yaw_rad);
  co_await std::move(rest);
  if (!retake_ || retake_->view.from != view.from) co_return;
  retake_.reset();
  if (number == 0) co_return;
  auto showing = show(number, pose);
  co_await std::move(showing);
}

base::Task<std::optional<std::vector<std::uint32_t>>> TagFinder::look_with(Eye const& eye, vehicle::SitePose pose) {
  auto const* const then = grid_of(pose);
  auto const clear_way = setup_.clear_ways ? setup_.clear_ways() : ClearWay();
  auto const views = then ? walls_in_picture(*then, eye.mount, level(pose)) : std::vector<SeenWall>();
  auto looking = eye.look();
  auto const look = co_await std::move(looking);
  if (!look) co_return std::nullopt;
  ++pictures_;
  auto const numbers = note(*look, eye, pose, views, clear_way);
  for (auto const number : numbers) {
    auto showing = show(number, pose);
    co_await std::move(showing);
  }
  co_return numbers;
}

std::vector<std::uint32_t> TagFinder::note(Look const& look, Eye const& eye, vehicle::SitePose const& pose,
                                           std::vector<SeenWall> const& views, ClearWay const& clear_way) {
  auto const after = pose_now();
  bool const has_turned = !after || std::abs(geo::wrap_pi(after->yaw_rad - pose.yaw_rad)) > most_turn_rad;
  std::vector<std::uint32_t> numbers;
  auto const* const grid = grid_of(pose);
  if (!grid) return numbers;
  std::map<WallPiece, std::pair<double, LookBook::Outcome>> shown;
  for (auto const& [wall, clear] : views) shown.emplace(piece_of(wall), std::pair(clear, LookBook::Outcome::blank));
  for (auto const& seen : look.found) {
    if (seen.what.category != "sign") continue;
    auto const place = tag_place(*grid, level(pose), eye.mount, seen.what.box);
    if (!place || is_seen_past(place->wall, eye.mount, pose, clear_way)) continue;
    bool const is_whole = !is_cut_off(seen.what.box, eye.mount);
    // From afar a sign is noticed: where it hangs, and what it says, is told by who comes nearer.
    double const way_rad = way_to(place->wall, pose);
    bool const is_near = is_readable(place->wall, way_rad);
    auto const outcome = !is_whole                                    ? LookBook::Outcome::cut_off
                         : is_near && look.is_sharp && seen.what.text ? LookBook::Outcome::read
                                                                      : LookBook::Outcome::poor;
    for (auto const& [wall, clear] : views)
      if (geo::distance_m(wall.position, place->wall.position) < sign_reaches_m)
        shown[piece_of(wall)] = {clear, outcome};
    auto sight = is_whole && is_near ? sight_of(seen, *place) : std::nullopt;
    if (!sight) continue;
    sight->from = camera_place(level(pose), eye.mount);
    // Small letters are easily taken for others.
    double const clear = clearness(eye.mount, place->wall, way_rad);
    sight->score *= std::min(1.0, clear / LookBook::clear_px_m);
    numbers.push_back(book_.take(*sight).number);
  }
  // A picture that was smeared shows nothing where there is something.
  if (has_turned) std::erase_if(shown, [](auto const& one) { return one.second.second == LookBook::Outcome::blank; });
  for (auto const& [piece, look_at] : shown) looks_.note(piece, look_at.first, look_at.second);
  return numbers;
}

base::Task<> TagFinder::show(std::uint32_t number, vehicle::SitePose pose) {
  auto const* tag = book_.find(number);
  if (!tag || (!is_sure(*tag) && !is_unread(*tag) && !shown_.contains(number))) co_return;
  if (setup_.eyes.keep && tag->picture.empty() && !tag->crop.empty()) {
    auto keeping = setup_.eyes.keep(tag->crop);
    auto const kept = co_await std::move(keeping);
    if (kept) book_.keep_picture(number, *kept);
    tag = book_.find(number);
  }
  if (tag) write(*tag, pose);
}

// ---- what it wants to look at again

TagFinder::Tries TagFinder::tries_of(std::uint32_t number) const {
  auto const found = tries_.find(number);
  return found == tries_.end() ? Tries() : found->second;
}

bool TagFinder::is_sure(Entry const& tag) const {
  return tag.confidence() >= least_confidence;
}

/// A kind of room without a number may be all that is written there: who has looked from before it knows.
bool TagFinder::wants_a_look(Entry const& tag) const {
  if (!is_sure(tag)) return true;
  return tag.names.empty() && tries_of(tag.number).sights == 0;
}

/// It was seen from before it, or could not be got at, and is not read.
bool TagFinder::is_unread(Entry const& tag) const {
  auto const tries = tries_of(tag.number);
  bool const is_over = tries.begun >= most_tries && !(retake_ && retake_->tag == tag.number);
  return !is_sure(tag) && (tries.sights > 0 || (is_over && tries.looks == 0));
}

std::size_t TagFinder::unread() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(book_.tags(), [this](Entry const& tag) { return is_unread(tag); }));
}

std::vector<CameraMount> TagFinder::mounts() const {
  std::vector<CameraMount> mounts;
  for (auto const& eye : setup_.eyes.for_tags) mounts.push_back(eye.mount);
  return mounts;
}

base::Task<std::optional<Viewpoint>> TagFinder::next_view(WallChoice which) {
  retake_.reset();
  auto const pose = pose_now();
  auto const* const grid = pose ? grid_of(*pose) : nullptr;
  if (!grid) co_return std::nullopt;
  map::SitePoint const here(pose->position.x(), pose->position.y());
  retake_ = next_tag(*grid, here);
  if (!retake_) {
    auto looking = nearest_wall(*grid, here, which);
    auto const wall = co_await std::move(looking);
    if (!wall) co_return std::nullopt;
    looks_.give_up(wall->piece);
    retake_ = Retake{.view = wall->view};
  }
  co_return retake_->view;
}

base::Task<bool> TagFinder::is_any_left(WallChoice which) {
  auto const pose = pose_now();
  auto const* const grid = pose ? grid_of(*pose) : nullptr;
  if (!grid) co_return false;
  auto const wanted = wanted_tags();
  if (std::ranges::any_of(wanted, [&](Entry const* tag) { return !views_of(*tag, *grid).empty(); })) co_return true;
  auto looking = nearest_wall(*grid, {pose->position.x(), pose->position.y()}, which);
  auto const wall = co_await std::move(looking);
  co_return wall.has_value();
}

base::Task<std::optional<WallView>> TagFinder::nearest_wall(map::OccupancyGrid grid, map::SitePoint here,
                                                            WallChoice which) {
  auto cameras = mounts();
  co_return co_await loop_.on_pool(
      [](LookBook const& looks, map::OccupancyGrid const& on, std::vector<CameraMount> const& with,
         map::SitePoint const& from, WallChoice of) { return next_wall_view(looks, on, with, from, of); },
      looks_, std::move(grid), std::move(cameras), here, which);
}

std::vector<TagFinder::Entry const*> TagFinder::wanted_tags() const {
  std::vector<Entry const*> wanted;
  for (auto const& tag : book_.tags())
    if (wants_a_look(tag) && tries_of(tag.number).begun < most_tries) wanted.push_back(&tag);
  return wanted;
}

std::vector<Viewpoint> TagFinder::views_of(Entry const& tag, map::OccupancyGrid const& grid) const {
  return viewpoints_for({.position = tag.position, .height_m = tag.height_m, .facing_rad = tag.facing_rad}, grid,
                        mounts());
}

std::optional<TagFinder::Retake> TagFinder::next_tag(map::OccupancyGrid const& grid, map::SitePoint const& here) {
  auto wanted = wanted_tags();
  std::ranges::sort(wanted, {}, [&](Entry const* tag) { return geo::distance_m(tag->position, here); });
  for (auto const* tag : wanted) {
    auto const views = views_of(*tag, grid);
    auto const nth = static_cast<std::size_t>(tries_[tag->number].begun++);
    if (!views.empty()) return Retake{.tag = tag->number, .view = views[std::min(nth, views.size() - 1)]};
  }
  return std::nullopt;
}

bool TagFinder::is_there(Retake const& retake, vehicle::SitePose const& pose) const {
  auto const at = level(pose);
  if (geo::distance_m(at.position, retake.view.from) > there_m) return false;
  double const way_rad = std::atan2(retake.view.at.y() - at.position.y(), retake.view.at.x() - at.position.x());
  return std::abs(geo::wrap_pi(way_rad - at.yaw_rad - retake.view.bearing_rad)) < straight_rad;
}

// ---- what it knows and shows

std::vector<std::string> TagFinder::texts() const {
  std::vector<std::string> texts;
  for (auto const& tag : book_.tags())
    if (is_sure(tag)) texts.push_back(tag.text());
  std::ranges::sort(texts);
  return texts;
}

map::OccupancyGrid const* TagFinder::grid_of(vehicle::SitePose const& pose) const {
  auto const found = live_map_.grids().find({.site = pose.site, .floor = pose.floor, .name = setup_.grid});
  return found == live_map_.grids().end() ? nullptr : &found->second.grid;
}

/// What is not read is a door all the same, with the picture of its sign.
void TagFinder::write(Entry const& tag, vehicle::SitePose const& pose) {
  bool const is_read = is_sure(tag);
  map::PointOfInterest const point{.position = tag.position,
                                   .height_m = tag.height_m,
                                   .kind = is_read ? "name tag" : "door",
                                   .name = is_read ? tag.name() : "",
                                   .text = is_read ? tag.text() : "",
                                   .picture = tag.picture,
                                   .facing_rad = tag.facing_rad,
                                   .confidence = tag.confidence(),
                                   .covariance_m2 = tag.covariance_m2};
  shown_.insert_or_assign(tag.number, tag.position);
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
