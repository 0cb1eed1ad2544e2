#include "robot/platform/robot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/async/pool.hpp"
#include "robot/watch/codes.hpp"

namespace lapwing::robot {

using namespace std::chrono_literals;
using Outcome = DriveRecord::Outcome;

namespace {

constexpr std::size_t most_waiting_scans = 50;  ///< then the oldest go: seconds that it could not keep up
constexpr base::Duration scan_is_old = 1s;      ///< nobody drives by what was seen before
constexpr base::Duration survey_period = 2s;
constexpr base::Duration walls_period = 5s;
constexpr base::Duration meet_period = 1s;
constexpr base::Duration write_period = 500ms;
constexpr base::Duration left_out_lately = 5s;
constexpr base::Duration eyes_silent_after = 10s;  ///< the seed's override ends then
constexpr base::Duration eyes_asked_every = 100ms;
constexpr base::Duration between_pieces = 10ms;  ///< of an alignment
/// What looking again may cost, of what exploring did: at most so much of the way, and so much at any rate.
constexpr double looks_of_way = 0.3;
constexpr double likely_looks_of_way = 1.0;
constexpr double looks_at_least_m = 30.0;

geo::Transform<geo::SiteFrame, map::GridFrame> place_of(RobotSpec const& spec) {
  return {spec.start.position, spec.start.yaw_rad};
}

MappingOptions mapping_options(RobotSpec const& spec) {
  auto options = spec.mapping;
  options.site_from_map = place_of(spec);
  return options;
}

std::string mode_for(Errand const& errand) {
  if (std::holds_alternative<ExploreErrand>(errand)) return "EXPLORE";
  if (std::holds_alternative<DriveErrand>(errand)) return "DRIVE";
  if (std::holds_alternative<LookErrand>(errand)) return "LOOK";
  if (std::holds_alternative<ReturnErrand>(errand)) return "RETURN";
  return "HOLD";
}

}  // namespace

std::string_view to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::running: return "running";
    case Outcome::done: return "done";
    case Outcome::failed: return "failed";
    case Outcome::stopped: return "stopped";
  }
  return "";
}

Robot::Robot(RobotSpec spec, std::unique_ptr<Body> body, Surroundings surroundings)
    : spec_(std::move(spec)),
      body_(std::move(body)),
      around_(std::move(surroundings)),
      site_from_map_(place_of(spec_)),
      map_from_site_(site_from_map_.inverse()),
      health_({.loop = around_.loop,
               .body = *body_,
               .name = spec_.name,
               .log = around_.log,
               .communication = around_.communication,
               .points_of_interest = around_.points_of_interest}),
      scanned_(around_.loop),
      planned_(around_.loop),
      aligning_(around_.loop),
      changed_(around_.loop),
      scope_(around_.loop) {
  body_->listen({.on_reading = [this](Reading const& reading) { take(reading); },
                 .on_scan = [this](slam::Scan const& scan) { take(scan); }});
  scope_.spawn(keep_thinking());
  scope_.spawn(keep_aligning());
  scope_.spawn(watch_link());
}

// ---- what it hears

bool Robot::is_connected() const {
  return last_reading_ && around_.loop.now() - last_reading_->at <= connection_timeout;
}

bool Robot::stands() const {
  constexpr double still_m_s = 0.01;
  if (asked_ != Motion{} || !last_reading_) return false;
  // What was told before it was last asked to move says nothing of whether it stands again.
  bool const is_told_since = !moved_at_ || last_reading_->at > *moved_at_;
  return is_told_since && std::abs(last_reading_->speed_m_s) < still_m_s;
}

void Robot::take(Reading const& reading) {
  if (last_reading_) driven_m_ += slam::distance_m(last_reading_->odometry, reading.odometry);
  bool const is_first = !last_reading_;
  last_reading_ = reading;
  home_charge_.note({.at = reading.at, .charge = reading.battery, .driven_m = driven_m_, .is_under_way = is_driving()});
  health_.sensed(reading.sensors_code);
  health_.set_code(Module::mapping, mapping_code());
  show_reading(reading, is_first);
  steer();
  if (is_first || stands()) changed_.notify_all();
}

void Robot::take(slam::Scan const& scan) {
  scanned_at_ = around_.loop.now();
  room_.take(scan, *body_->sensor());
  if (scans_.size() == most_waiting_scans) {
    scans_.pop_front();
    left_out_at_ = around_.loop.now();
  }
  scans_.push_back(scan);
  scanned_.notify_all();
}

ClearWay Robot::clear_way() const {
  constexpr double beam_m = 0.05;
  if (!last_reading_) return {};
  return [room = room_.seen_from(last_reading_->odometry)](double bearing_rad, double most_m) {
    return room.towards(bearing_rad, beam_m, most_m);
  };
}

slam::Pose2 Robot::pose_now(slam::Pose2 const& odometry) const {
  return here_->pose * slam::between(odometry_here_, odometry);
}

void Robot::steer() {
  bool const sees = scanned_at_ && around_.loop.now() - *scanned_at_ < scan_is_old;
  Motion motion;
  if (sees && here_ && is_driving() && !last_reading_->is_killed) {
    auto const& odometry = last_reading_->odometry;
    motion = follower_.steer(pose_now(odometry), room_.seen_from(odometry));
  }
  asked_ = health_.guard().drive(motion);
  if (asked_ != Motion{}) moved_at_ = around_.loop.now();
}

base::Task<> Robot::watch_link() {
  bool was_connected = false;
  for (;;) {
    co_await around_.loop.sleep(1s);
    bool const is_there = is_connected();
    if (!last_reading_ || is_there == was_connected) continue;
    was_connected = is_there;
    auto& state = around_.registry.edit(id());
    state.links.connection = is_there ? vehicle::Connection::ok : vehicle::Connection::lost;
    around_.registry.touch_membership(id());
    changed_.notify_all();
    if (is_there || !is_driving()) continue;
    record_->robot_failed = true;
    end_drive(fmt::format("{} is lost", spec_.name), true);
  }
}

// ---- what it thinks

/// Its body is known now.
void Robot::begin_to_think() {
  auto planning = spec_.planning;
  planning.id = spec_.id;
  planning.limits = body_->limits();
  follower_ = Follower(planning.limits);
  home_charge_ = HomeCharge(planning.limits.speed_m_s);
  thoughts_ = std::make_unique<Thoughts>(*body_->sensor(), mapping_options(spec_), planning);
  has_thoughts_ = true;
}

base::Task<> Robot::keep_thinking() {
  for (;;) {
    while (scans_.empty()) co_await scanned_.wait();
    if (!has_thoughts_) begin_to_think();
    auto mapping = map_scans();
    auto map = co_await std::move(mapping);
    auto planning = plan(std::move(map));
    auto result = co_await std::move(planning);
    thoughts_ = std::move(result.map.thoughts);
    loops_ = thoughts_->map.loops();
    use(std::move(result));
  }
}

/// Beside thinking, for it takes seconds.
base::Task<> Robot::keep_aligning() {
  for (;;) {
    while (!alignment_) co_await aligning_.wait();
    auto alignment = std::move(alignment_);
    while (!alignment->is_done()) {
      alignment = co_await around_.loop.on_pool(&go_on_aligning, std::move(alignment));
      // A clock that waits for whoever computes would stand still for all of it, and the script be stopped for that.
      co_await around_.loop.sleep(between_pieces);
    }
    aligned_ = alignment->graph().poses;
    is_aligning_ = false;
  }
}

base::Task<MapResult> Robot::map_scans() {
  health_.begin_work(Module::mapping);
  if (spec_.hold_up) co_await spec_.hold_up(Module::mapping);
  MapInput input{.scans = {std::make_move_iterator(scans_.begin()), std::make_move_iterator(scans_.end())},
                 .aligned = std::exchange(aligned_, {})};
  if (around_.others) input.others = around_.others();
  scans_.clear();
  auto result = co_await around_.loop.on_pool(&take_in, std::move(thoughts_), std::move(input));
  is_pose_lost_ = pose_check_.feed(base::to_seconds(around_.loop.now().time_since_epoch()), result.misfit);
  health_.say(Module::mapping, ModuleState::ready, mapping_code());
  co_return result;
}

base::Task<PlanResult> Robot::plan(MapResult map) {
  health_.begin_work(Module::planner);
  if (spec_.hold_up) co_await spec_.hold_up(Module::planner);
  double const now_s = base::to_seconds(around_.loop.now().time_since_epoch());
  PlanInput input{.errand = std::exchange(next_errand_, std::nullopt),
                  .sides = last_reading_ ? last_reading_->sides : explore::SideDistances{},
                  .driven_m = driven_m_,
                  .time_s = now_s};
  input.wants_survey = !survey_ || around_.loop.now() - surveyed_at_ >= survey_period;
  input.wants_walls = around_.loop.now() - walls_at_ >= walls_period;
  bool const is_about_something = !std::holds_alternative<std::monostate>(errand_);
  if (is_about_something && around_.companions && around_.loop.now() - met_at_ >= meet_period) {
    input.companions = around_.companions();
    met_at_ = around_.loop.now();
  }
  input.may_align = !is_aligning_ && aligned_.empty();
  input.aligns_soon = aligns_soon_;
  auto result = co_await around_.loop.on_pool(&plan_on, std::move(map), known_errand_, std::move(input));
  bool const has_failed = result.errand == last_errand_ && result.plan.state == Plan::State::failed;
  // Looks are its eyes' alone, and nobody misses one.
  if (has_failed && !std::holds_alternative<LookErrand>(errand_)) planner_code_ = code::no_way;
  bool const spins = wheel_spin_.feed(now_s, result.map.odometry, result.map.here.pose);
  health_.say(Module::planner, ModuleState::ready, spins ? code::not_moving : planner_code_);
  co_return result;
}

std::uint16_t Robot::mapping_code() const {
  auto const now = around_.loop.now();
  if (is_pose_lost_) return code::pose_lost;
  if (!scanned_at_ || now - *scanned_at_ >= scan_is_old) return code::no_scans;
  if (left_out_at_ && now - *left_out_at_ < left_out_lately) return code::mapping_slow;
  return around_.is_map_kept && !around_.is_map_kept() ? code::map_not_saved : code::none;
}

void Robot::use(PlanResult result) {
  known_errand_ = result.errand;
  here_ = result.map.here;
  odometry_here_ = result.map.odometry;
  if (result.survey) {
    survey_ = std::move(result.survey);
    surveyed_at_ = around_.loop.now();
  }
  if (result.home_m) home_charge_.set_way(*result.home_m);
  if (result.errand == last_errand_) {
    plan_ = std::move(result.plan);
    follower_.take(plan_.way);
    body_->show_way(plan_.way.points);
    planned_.notify_all();
  }
  tell_of_moves(result.map.shifts);
  write_map(result.map);
  if (result.walls) write_walls(*result.walls);
  if (result.alignment) {
    alignment_ = std::move(result.alignment);
    is_aligning_ = true;
    aligns_soon_ = false;
    aligning_.notify_all();
  }
}

void Robot::tell_of_moves(std::vector<MapShift> const& shifts) {
  if (!around_.on_moved) return;
  for (auto const& shift : shifts) {
    around_.on_moved([&](geo::Pose<geo::SiteFrame> const& before) -> geo::Pose<geo::SiteFrame> {
      auto const at = map_from_site_ * before.position;
      auto const now = shift.moved({at.x(), at.y(), before.yaw_rad - site_from_map_.yaw_rad()});
      return {site_from_map_ * geo::Point<map::GridFrame>(now.x, now.y),
              geo::wrap_pi(now.yaw + site_from_map_.yaw_rad())};
    });
  }
}

void Robot::write_map(MapResult& result) {
  if (result.grid) {
    grid_ = std::move(result.grid);
    unwritten_.insert(result.changed.begin(), result.changed.end());
  }
  bool const is_due = !unwritten_.empty() && around_.loop.now() - written_at_ >= write_period;
  if (!is_due) return;
  body_->show_map(*grid_);
  if (around_.on_map) around_.on_map(*grid_, {unwritten_.begin(), unwritten_.end()});
  unwritten_.clear();
  written_at_ = around_.loop.now();
}

void Robot::write_walls(WallBook::Changes const& changes) {
  walls_at_ = around_.loop.now();
  bool const are_any = !changes.put.empty() || !changes.removed.empty();
  if (are_any && around_.on_walls) around_.on_walls(changes);
}

void Robot::give(Errand errand) {
  // What became of an errand stands until there is another.
  if (!std::holds_alternative<std::monostate>(errand)) {
    planner_code_ = code::none;
    wheel_spin_.forget();
  }
  around_.registry.edit(id()).mode.set(mode_for(errand), around_.loop.now());
  around_.registry.touch(id());
  errand_ = errand;
  next_errand_ = NewErrand{.number = ++last_errand_, .errand = std::move(errand)};
  plan_ = {.state = Plan::State::under_way};
  follower_.stop();
  body_->show_way({});
}

// ---- what it does

std::shared_ptr<DriveRecord const> Robot::start(std::string name, std::vector<Step> steps) {
  if (is_driving()) conclude(*record_, Outcome::stopped, "another drive took its place");
  record_ =
      std::make_shared<DriveRecord>(DriveRecord{.name = std::move(name), .steps = static_cast<int>(steps.size())});
  drives_.push_back(record_);
  drive_ = carry_out(record_, std::move(steps));
  drive_.start();
  return record_;
}

base::Task<> Robot::carry_out(std::shared_ptr<DriveRecord> record, std::vector<Step> steps) {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    auto const text = to_text(steps[i]);
    record->progress = steps.size() == 1 ? text : fmt::format("{} ({}/{})", text, i + 1, steps.size());
    auto step = carry_out(steps[i]);
    auto const done = co_await std::move(step);
    if (record->outcome != Outcome::running) co_return;
    if (!done) {
      give({});
      conclude(*record, Outcome::failed, fmt::format("{}: {}", text, done.error().message));
      co_return;
    }
    if (done->empty()) continue;
    record->remark += fmt::format("{}{}: {}", record->remark.empty() ? "" : "; ", text, *done);
  }
  give({});
  conclude(*record, Outcome::done, {});
}

base::Task<base::Result<std::string>> Robot::carry_out(Step step) {
  if (auto const* const wait = std::get_if<WaitStep>(&step)) {
    give({});
    co_await around_.loop.sleep(base::from_seconds(wait->seconds));
    co_return std::string();
  }
  if (std::holds_alternative<PhotographStep>(step)) {
    give({});
    while (!stands()) co_await changed_.wait();
    auto taking = around_.photograph();
    co_return co_await std::move(taking);
  }
  if (auto const* const exploring = std::get_if<ExploreStep>(&step)) {
    auto explored = explore(exploring->strategy);
    co_return co_await std::move(explored);
  }
  if (auto const* const by_name = std::get_if<DriveToNameStep>(&step)) {
    auto const found = around_.find_place(by_name->name);
    if (!found) co_return std::unexpected(found.error());
    constexpr double before_a_door_m = 1.0;  // what has a name stands in a wall or before it
    give(DriveErrand{on_map(*found), before_a_door_m});
  } else if (auto const* const to_place = std::get_if<DriveToPlaceStep>(&step)) {
    auto const point = around_.on_site(to_place->place);
    if (!point) co_return base::fail(base::ErrorKind::not_found, fmt::format("the map has no site {}", spec_.site));
    give(DriveErrand{.to = on_map(*point)});
  } else {
    give(ReturnErrand{});
  }
  auto driven = see_through();
  co_return co_await std::move(driven);
}

bool Robot::is_under_way() const {
  return plan_.state == Plan::State::under_way || plan_.state == Plan::State::idle;
}

base::Task<base::Result<std::string>> Robot::see_through(Reach reach) {
  while (is_under_way() && !(reach == Reach::keeps_way_home && home_charge_.is_due())) co_await planned_.wait();
  if (plan_.state == Plan::State::failed) co_return base::fail(base::ErrorKind::refused, plan_.reason);
  co_return plan_.reason;
}

base::Task<base::Result<std::string>> Robot::explore(std::string strategy) {
  double const began_m = driven_m_;
  give(ExploreErrand{std::move(strategy)});
  auto exploring = see_through(Reach::keeps_way_home);
  auto explored = co_await std::move(exploring);
  aligns_soon_ = true;
  if (is_under_way()) co_return turned_home();
  auto const& looks = around_.second_looks;
  if (!explored || !looks.next) co_return explored;
  double const way_m = driven_m_ - began_m;
  auto looking = look_again(std::max(looks_at_least_m, looks_of_way * way_m),
                            std::max(looks_at_least_m, likely_looks_of_way * way_m));
  co_await std::move(looking);
  auto const say = [&](std::string const& more) { *explored += (explored->empty() ? "" : "; ") + more; };
  auto const unread = looks.unread();
  if (unread > 0) say(fmt::format("{} could not be read", unread == 1 ? "1 sign" : fmt::format("{} signs", unread)));
  auto leaving = walls_left();
  if (auto const left = co_await std::move(leaving); !left.empty()) say(left);
  co_return explored;
}

base::Task<std::string> Robot::walls_left() const {
  auto likely = around_.second_looks.is_any_left(WallChoice::likely);
  if (co_await std::move(likely))
    co_return "doorways are left whose signs no camera may have seen: explore() again goes on";
  auto any = around_.second_looks.is_any_left(WallChoice::any);
  if (co_await std::move(any))
    co_return "walls without a doorway are left that no camera looked at from near: explore() again goes on";
  co_return std::string();
}

std::string Robot::turned_home() const {
  auto const left = survey_ ? what_is_left(*survey_) : std::string();
  return fmt::format("its battery takes it home and little farther{}{}", left.empty() ? "" : ": ", left);
}

base::Task<> Robot::look_again(double any_m, double likely_m) {
  double const began_m = driven_m_;
  for (;;) {
    double const way_m = driven_m_ - began_m;
    if (way_m >= likely_m || home_charge_.is_due()) co_return;
    auto choosing = around_.second_looks.next(way_m >= any_m ? WallChoice::likely : WallChoice::any);
    auto const view = co_await std::move(choosing);
    if (!view) co_return;
    give(LookErrand{.from = on_map(view->from), .at = on_map(view->at), .bearing_rad = view->bearing_rad});
    auto driving = see_through(Reach::keeps_way_home);
    auto const driven = co_await std::move(driving);
    if (is_under_way()) co_return;
    if (!driven) continue;  // there may be another place to see it from
    auto const until = around_.loop.now() + eyes_silent_after;
    while (!around_.second_looks.has_looked() && around_.loop.now() < until)
      co_await around_.loop.sleep(eyes_asked_every);
    if (!around_.second_looks.has_looked()) planner_code_ = code::override_ended;
  }
}

void Robot::conclude(DriveRecord& record, Outcome outcome, std::string error) {
  if (record.outcome != Outcome::running) return;
  record.outcome = outcome;
  record.error = std::move(error);
  auto const& said = record.error.empty() ? record.remark : record.error;
  around_.log.info(
      fmt::format("{}: {} {}{}{}", spec_.name, record.name, to_string(outcome), said.empty() ? "" : ": ", said));
  asked_ = {};
  body_->drive({});
  changed_.notify_all();
}

void Robot::end_drive(std::string const& reason, bool is_failure) {
  if (!is_driving()) return;
  give({});
  conclude(*record_, is_failure ? Outcome::failed : Outcome::stopped, reason);
  drive_ = {};
}

void Robot::kill(std::string const& reason) {
  health_.guard().kill();
  end_drive(reason, true);
}

base::Result<> Robot::restart() {
  return health_.guard().restart();
}

}  // namespace lapwing::robot
