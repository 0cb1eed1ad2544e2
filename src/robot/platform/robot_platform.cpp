#include "robot/platform/robot_platform.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/text/utc_text.hpp"
#include "robot/poi/named_place.hpp"
#include "robot/poi/placed_picture.hpp"
#include "robot/words/vocabulary.hpp"
#include "tasks/failed_run.hpp"

namespace lapwing::robot {

using base::ErrorKind;
using base::fail;
using tasks::RunState;
using tasks::VehicleInfo;
using vehicle::VehicleId;

namespace {

/// A drive as scripts see it.
class DriveRun final : public tasks::TaskRun {
 public:
  DriveRun(Robot& robot, std::shared_ptr<DriveRecord const> record) : robot_(robot), record_(std::move(record)) {}

  [[nodiscard]] RunState state() const override {
    switch (record_->outcome) {
      case DriveRecord::Outcome::running: return RunState::in_progress;
      case DriveRecord::Outcome::done: return RunState::done;
      case DriveRecord::Outcome::failed:
      case DriveRecord::Outcome::stopped: return RunState::failed;
    }
    return RunState::failed;
  }
  [[nodiscard]] std::string error() const override { return record_->error; }
  [[nodiscard]] bool vehicle_failed() const override { return record_->robot_failed; }
  [[nodiscard]] std::string progress() const override {
    if (!robot_.survey()) return record_->progress;
    return fmt::format("{}, {:.0f} % seen", record_->progress, 100.0 * robot_.survey()->coverage);
  }
  void stop() override {
    // A later drive of the same robot is not this run's to stop.
    if (record_->outcome == DriveRecord::Outcome::running) robot_.end_drive("the script has stopped it", false);
  }

 private:
  Robot& robot_;
  std::shared_ptr<DriveRecord const> record_;
};

}  // namespace

namespace {

/// Without a number what the ids of all its walls begin with.
std::string wall_id(RobotSpec const& spec, std::optional<std::uint32_t> number) {
  auto const prefix = spec.id + " wall ";
  return number ? prefix + std::to_string(*number) : prefix;
}

base::Task<std::optional<Viewpoint>> nowhere() {
  co_return std::nullopt;
}

base::Task<bool> nothing() {
  co_return false;
}

}  // namespace

RobotPlatform::RobotPlatform(Surroundings around, base::Logger log)
    : around_(around),
      log_(std::move(log)),
      vocabulary_(robot::vocabulary()),
      vehicles_changed_(around_.loop),
      settled_(around_.loop),
      scope_(around_.loop) {
  around_.authority.add_on_loss([this](VehicleId const& id, vehicle::Commander const& to) {
    if (auto* const lost = robot(id)) lost->end_drive(fmt::format("{} took {} over", to, lost->spec().name), true);
  });
  scope_.spawn(pass_on_membership());
}

base::Result<Robot*> RobotPlatform::add(RobotSpec spec, std::unique_ptr<Body> body) {
  if (robot({spec.id}))
    return fail(ErrorKind::invalid_input, fmt::format("there are two robots called {}", spec.id),
                "give one of them another id");
  auto const* const site = around_.live_map.site(spec.site);
  if (!site) return fail(ErrorKind::invalid_input, fmt::format("{}: the map has no site {}", spec.id, spec.site));
  if (!spec.floor.empty() && !site->floor(spec.floor))
    return fail(ErrorKind::invalid_input,
                fmt::format("{}: the site {} has no floor {}", spec.id, spec.site, spec.floor));
  Robot::Surroundings around{
      .loop = around_.loop,
      .registry = around_.registry,
      .find_place = [this, spec](std::string const& name) { return find_place(spec, name); },
      .photograph = [this, id = spec.id] { return photograph({id}); },
      .on_site = [this, id = spec.site](geo::Wgs84 place) -> std::optional<geo::Point<geo::SiteFrame>> {
        auto const* const at = around_.live_map.site(id);
        if (!at) return std::nullopt;
        auto const point = at->point_of(place);
        return geo::Point<geo::SiteFrame>(point.x(), point.y());
      },
      .on_globe = [this, id = spec.site](geo::Point<geo::SiteFrame> point) -> std::optional<geo::Wgs84> {
        auto const* const at = around_.live_map.site(id);
        if (!at) return std::nullopt;
        return at->place_of(geo::Point3<geo::SiteFrame>(point.x(), point.y(), 0.0));
      },
      .on_map = [this, spec](map::OccupancyGrid const& grid,
                             std::vector<map::TileKey> const& changed) { write(spec, grid, changed); },
      .on_walls = [this, spec](WallBook::Changes const& changes) { write_walls(spec, changes); },
      .on_moved = [this, id = spec.id](MapMove const& moved) { move_what_it_saw({id}, moved); },
      .communication = [this]() -> std::optional<std::uint16_t> {
        if (!communication_) return std::nullopt;
        return communication_();
      },
      .points_of_interest = [this, id = spec.id] { return trouble_of_eyes({id}); },
      .second_looks = second_looks_of({spec.id}),
      .companions = [this, spec] { return companions_of(spec); },
      .others = [this, spec] { return others_of(spec); },
      .is_map_kept = [this] { return !is_map_kept_ || is_map_kept_(); },
      .log = log_};
  forget_walls(spec);
  robots_.push_back(std::make_unique<Robot>(std::move(spec), std::move(body), std::move(around)));
  scope_.spawn(pass_on(*robots_.back()));
  return robots_.back().get();
}

Robot* RobotPlatform::robot(VehicleId const& id) const {
  auto const found = std::ranges::find(robots_, id, [](auto const& robot) { return robot->id(); });
  return found == robots_.end() ? nullptr : found->get();
}

void RobotPlatform::open_eyes(Robot const& robot, Eyes eyes) {
  auto const& spec = robot.spec();
  auto& sight = sights_[robot.id()];
  sight.tags.reset();
  sight.eyes = std::move(eyes);
  TagFinder::Setup setup{
      .vehicle = spec.id, .grid = spec.name, .eyes = sight.eyes, .clear_ways = [&robot] { return robot.clear_way(); }};
  sight.tags = std::make_unique<TagFinder>(around_.loop, around_.registry, around_.live_map, std::move(setup), log_);
}

std::optional<std::uint16_t> RobotPlatform::trouble_of_eyes(VehicleId const& id) const {
  auto const found = sights_.find(id);
  if (found == sights_.end() || !found->second.eyes.trouble) return std::nullopt;
  return found->second.eyes.trouble();
}

std::vector<RobotPlatform::Beside> RobotPlatform::beside(RobotSpec const& spec) const {
  constexpr double one_place_m = 0.2;
  auto const pose_of = [](geo::Pose<geo::SiteFrame> const& start) {
    return slam::Pose2{start.position.x(), start.position.y(), start.yaw_rad};
  };
  std::vector<Beside> found;
  for (auto const& robot : robots_) {
    auto const& other = robot->spec();
    bool const is_beside = other.id != spec.id && other.site == spec.site && other.floor == spec.floor;
    // Nobody has said where the two begin: neither knows where the other's map lies.
    if (!is_beside || geo::distance_m(other.start.position, spec.start.position) < one_place_m) continue;
    found.push_back({robot.get(), slam::between(pose_of(spec.start), pose_of(other.start))});
  }
  return found;
}

std::vector<Companion> RobotPlatform::companions_of(RobotSpec const& spec) const {
  std::vector<Companion> companions;
  for (auto const& [robot, origin] : beside(spec)) {
    auto companion = robot->as_companion();
    if (!companion) continue;
    companion->origin = origin;
    companions.push_back(*std::move(companion));
  }
  return companions;
}

std::vector<OtherRobot> RobotPlatform::others_of(RobotSpec const& spec) const {
  std::vector<OtherRobot> others;
  for (auto const& [robot, origin] : beside(spec))
    if (auto const pose = robot->pose())
      others.push_back({.at = slam::place(origin * *pose), .radius_m = robot->radius_m()});
  return others;
}

Robot::SecondLooks RobotPlatform::second_looks_of(VehicleId const& id) {
  auto const finder = [this, id]() -> TagFinder* {
    auto const found = sights_.find(id);
    return found == sights_.end() ? nullptr : found->second.tags.get();
  };
  return {.next = [finder](WallChoice which) { return finder() ? finder()->next_view(which) : nowhere(); },
          .is_any_left = [finder](WallChoice which) { return finder() ? finder()->is_any_left(which) : nothing(); },
          .has_looked = [finder] { return !finder() || finder()->has_looked(); },
          .unread = [finder] { return finder() ? finder()->unread() : std::size_t{0}; }};
}

TagFinder const* RobotPlatform::tags_of(VehicleId const& id) const {
  auto const found = sights_.find(id);
  return found == sights_.end() ? nullptr : found->second.tags.get();
}

void RobotPlatform::move_what_it_saw(VehicleId const& id, MapMove const& moved) {
  auto const found = sights_.find(id);
  if (found == sights_.end()) return;
  auto& sight = found->second;
  if (sight.tags) sight.tags->move(moved);
  move_pictures(around_.live_map, sight.photographs, moved, {.writer = id.text, .at = around_.loop.utc_now()});
}

base::Task<base::Result<std::string>> RobotPlatform::photograph(VehicleId id) {
  auto const sight = sights_.find(id);
  if (sight == sights_.end() || !sight->second.eyes.photographer)
    co_return std::string("nobody looks through its camera here");
  auto const& eyes = sight->second.eyes;
  auto const pose = around_.registry.find(id)->motion.site_pose.value;
  if (!pose) co_return fail(ErrorKind::not_found, "it does not know where it is");
  auto const taken_at = around_.loop.utc_now();
  auto taking = eyes.photographer->take();
  auto const photograph = co_await std::move(taking);
  if (!photograph) co_return std::unexpected(photograph.error());
  if (eyes.write_file) {
    auto name = fmt::format("{}_{}.jpg", id.text, base::to_iso8601(taken_at));
    auto writing = eyes.write_file(std::move(name), photograph->jpeg);
    auto const path = co_await std::move(writing);
    co_return path ? fmt::format("it is in {}", *path) : fmt::format("it is not kept: {}", path.error().message);
  }
  auto picture = placed_picture(eyes.photographer->mount, *pose);
  picture.width_px = photograph->width_px;
  picture.height_px = photograph->height_px;
  picture.taken_at = taken_at;
  picture.vehicle = id.text;
  for (auto [file, hash] :
       {std::pair(&photograph->jpeg, &picture.image), std::pair(&photograph->thumbnail, &picture.thumbnail)}) {
    auto keeping = eyes.keep(*file);
    auto const kept = co_await std::move(keeping);
    if (!kept) co_return fmt::format("it is not kept: {}", kept.error().message);
    *hash = *kept;
  }
  auto const on_map = fmt::format("{} picture {}", id.text, base::to_iso8601(taken_at));
  auto const put = around_.live_map.put({.id = on_map,
                                         .site = pose->site,
                                         .floor = pose->floor,
                                         .account = {.writer = id.text, .at = around_.loop.utc_now()},
                                         .content = std::move(picture)});
  if (!put) co_return fmt::format("it is not shown: {}", put.error().message);
  sight->second.photographs.push_back(on_map);
  co_return std::string();
}

base::Task<> RobotPlatform::pass_on(Robot& robot) {
  for (;;) {
    co_await robot.changed().wait();
    settled_.notify_all();
  }
}

base::Task<> RobotPlatform::pass_on_membership() {
  for (;;) {
    co_await around_.registry.membership_changed().wait();
    vehicles_changed_.notify_all();
  }
}

base::Result<std::shared_ptr<tasks::PlatformTask const>> RobotPlatform::named_task(std::string_view name) const {
  return fail(ErrorKind::not_found, fmt::format("there is no plan called '{}'", name));
}

VehicleInfo RobotPlatform::info_of(Robot const& robot) const {
  auto const& state = robot.state();
  VehicleInfo info;
  info.id = state.id;
  info.type = "UGV";
  info.payload = state.payload.names;
  info.connected = robot.is_connected();
  info.position = state.motion.position.value;
  if (state.power.battery.value) info.battery = state.power.battery.value->remaining;
  info.connection_timeout = robot.connection_timeout;
  info.mode = state.mode.value.value_or("");
  if (robot.survey()) info.coverage = robot.survey()->coverage;
  if (auto const* const tags = tags_of(robot.id())) info.doors = tags->texts().size();
  return info;
}

std::vector<VehicleInfo> RobotPlatform::vehicles() const {
  std::vector<VehicleInfo> infos;
  for (auto const& robot : robots_)
    if (robot->has_been_heard()) infos.push_back(info_of(*robot));
  return infos;
}

std::optional<VehicleInfo> RobotPlatform::find(VehicleId const& id) const {
  auto const* const found = robot(id);
  if (!found || !found->has_been_heard()) return std::nullopt;
  return info_of(*found);
}

void RobotPlatform::set_connection_timeout(VehicleId const& id, base::Duration timeout) {
  if (auto* const found = robot(id)) found->connection_timeout = timeout;
}

std::optional<std::string> RobotPlatform::unsuited(tasks::PlatformTask const& task, VehicleInfo const& vehicle) const {
  if (!dynamic_cast<DriveTask const*>(&task)) return fmt::format("{} is no drive", task.name());
  return task.unsuited(vehicle);
}

std::unique_ptr<tasks::TaskRun> RobotPlatform::start(std::shared_ptr<tasks::PlatformTask const> task,
                                                     VehicleId const& id) {
  auto* const found = robot(id);
  if (!found) return std::make_unique<tasks::FailedRun>(fmt::format("no robot {}", id.text));
  auto const* const drive = dynamic_cast<DriveTask const*>(task.get());
  auto const& name = found->spec().name;
  if (!drive)
    return std::make_unique<tasks::FailedRun>(fmt::format("'{}' is no drive: {} cannot do it", task->name(), name));
  if (!found->is_connected()) return std::make_unique<tasks::FailedRun>(fmt::format("{} is lost", name), true);
  if (auto claimed = around_.authority.claim(id, vehicle::script_commander); !claimed)
    return std::make_unique<tasks::FailedRun>(claimed.error().message);
  if (found->needs_restart())
    return std::make_unique<tasks::FailedRun>(fmt::format("{} is stopped: let it go again first", name), true);
  return std::make_unique<DriveRun>(*found, found->start(drive->name(), drive->steps()));
}

base::Task<void> RobotPlatform::settle() {
  auto awaited = unsettled();
  while (!unsettled().empty()) co_await settled_.wait();
  for (auto const& robot : robots_) {
    if (robot->is_driving()) continue;
    (void)around_.authority.yield(robot->id(), vehicle::script_commander);
    if (!robot->is_connected() && std::ranges::find(awaited, robot->spec().name) != awaited.end())
      log_.error(fmt::format("{} was lost before it was seen to stand; its own watchdog stops what hears nothing",
                             robot->spec().name));
  }
}

std::vector<std::string> RobotPlatform::unsettled() const {
  std::vector<std::string> names;
  for (auto const& robot : robots_)
    if (robot->is_connected() && !robot->is_driving() && !robot->stands()) names.push_back(robot->spec().name);
  return names;
}

void RobotPlatform::end_drives(std::string const& reason) {
  for (auto const& robot : robots_) robot->end_drive(reason, false);
}

base::Result<geo::Point<geo::SiteFrame>> RobotPlatform::find_place(RobotSpec const& spec,
                                                                   std::string const& name) const {
  auto const layer = map::LayerKind::points_of_interest;
  std::vector<map::PointOfInterest const*> points;
  for (auto const* record : around_.live_map.within(layer, spec.site, std::nullopt, around_.live_map.size(layer)))
    if (record->feature.floor == spec.floor) points.push_back(&std::get<map::PointOfInterest>(record->feature.content));
  return place_called(name, points);
}

void RobotPlatform::write(RobotSpec const& spec, map::OccupancyGrid const& grid,
                          std::vector<map::TileKey> const& changed) {
  auto const written = around_.live_map.put_tiles({.site = spec.site, .floor = spec.floor, .name = spec.name}, grid,
                                                  changed, {.writer = spec.id, .at = around_.loop.utc_now()});
  if (!written) log_.warn(fmt::format("the map of {} is not shown: {}", spec.name, written.error().message));
}

void RobotPlatform::write_walls(RobotSpec const& spec, WallBook::Changes const& changes) {
  map::Account const account{.writer = spec.id, .at = around_.loop.utc_now()};
  geo::Transform<geo::SiteFrame, map::GridFrame> const site_from_map{spec.start.position, spec.start.yaw_rad};
  std::vector<map::Feature> walls;
  for (auto const& [number, line] : changes.put)
    walls.push_back({.id = wall_id(spec, number),
                     .site = spec.site,
                     .floor = spec.floor,
                     .account = account,
                     .content = map::Wall{.line = {{site_from_map * line.from, site_from_map * line.to}}}});
  if (auto const put = around_.live_map.put_all(std::move(walls)); !put)
    log_.warn(fmt::format("walls that {} has found are not shown: {}", spec.name, put.error().message));
  for (auto const number : changes.removed)
    (void)around_.live_map.remove(map::LayerKind::walls, wall_id(spec, number), account);
}

void RobotPlatform::forget_walls(RobotSpec const& spec) {
  auto const layer = map::LayerKind::walls;
  auto const prefix = wall_id(spec, {});
  std::vector<std::string> ids;
  for (auto const* record : around_.live_map.within(layer, spec.site, std::nullopt, around_.live_map.size(layer)))
    if (record->feature.id.starts_with(prefix)) ids.push_back(record->feature.id);
  for (auto const& id : ids)
    (void)around_.live_map.remove(layer, id, {.writer = spec.id, .at = around_.loop.utc_now()});
}

}  // namespace lapwing::robot
