#include "apps/vehicles/plan/dry_run.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include <fmt/format.h>

#include "base/assert.hpp"
#include "host/session/signals.hpp"
#include "host/simulation/simulated_fleet.hpp"
#include "host/simulation/simulation.hpp"

namespace lapwing::apps {

namespace {

/// What still ran: the leaves of the tree, in the words of the script.
void add_running(tasks::TaskView const& view, base::SourceFile const& source, std::vector<std::string>& lines) {
  bool const runs = view.state == tasks::TaskState::running;
  if (!runs) return;
  bool const has_running_child =
      std::ranges::any_of(view.children, [](auto const& child) { return child.state == tasks::TaskState::running; });
  if (has_running_child) {
    for (auto const& child : view.children) add_running(child, source, lines);
    return;
  }
  auto line = view.kind;
  if (view.vehicle) {
    line += fmt::format(" {} (line {}) on vehicle {}", view.label, view.line, view.vehicle->text);
  } else if (view.line > 0) {
    auto const words = source.text(source.line_span(static_cast<std::uint32_t>(view.line)));
    auto const begin = std::min(words.find_first_not_of(" \t"), words.size());
    line += fmt::format(" (line {}: {})", view.line, words.substr(begin));
  }
  if (!view.detail.empty()) line += ": " + view.detail;
  lines.push_back(std::move(line));
}

/// Where it truly is.
dryrun::Sample look_at(robot::Robot const& robot, sim::building::Robot const& truth,
                       geo::Transform<geo::SiteFrame, geo::FloorFrame> const& site_from_floor) {
  dryrun::Sample sample;
  auto const at = site_from_floor * truth.body().pose().position;
  constexpr double moving_m_s = 0.02;
  sample.place_m = geo::Ned{at.y(), at.x(), 0.0};
  sample.moves = std::abs(truth.body().speed_m_s()) > moving_m_s;
  if (!robot.has_been_heard()) return sample;
  auto const& state = robot.state();
  if (state.mode.value) sample.mode = *state.mode.value;
  if (state.power.battery.value) sample.remaining = state.power.battery.value->remaining;
  return sample;
}

}  // namespace

/// The script's words go into the record; its questions are answered from a list.
class DryRun::Voice final : public dolphin::Output {
 public:
  Voice(base::Loop& loop, dryrun::Recorder& recorder, std::vector<std::string> answers)
      : loop_(loop), recorder_(recorder), answers_(answers.begin(), answers.end()) {}

  void write(std::string_view text) override { recorder_.say(loop_.now().time_since_epoch(), text); }
  base::Task<base::Result<std::string>> ask(std::string prompt) override {
    if (answers_.empty()) {
      co_return base::fail(base::ErrorKind::io, fmt::format("there is no answer to '{}': give --answers FILE", prompt));
    }
    auto answer = std::move(answers_.front());
    answers_.pop_front();
    write(fmt::format("{}{}\n", prompt, answer));
    co_return answer;
  }

 private:
  base::Loop& loop_;
  dryrun::Recorder& recorder_;
  std::deque<std::string> answers_;
};

DryRun::DryRun(Options options)
    : options_(std::move(options)),
      loop_(host::pace_for(0.0)),
      log_(hub_, "lapwing"),
      air_(loop_),
      ground_(loop_, log_, {.payload = host::equipped(options_.world, options_.payload)}),
      platform_(ground_.fleet, {.run = {.plausibility = options_.plausibility}, .plan_library = options_.plans},
                log_.named("fleet")),
      live_map_([this] { return loop_.utc_now(); }),
      robots_({loop_, ground_.registry, ground_.authority, live_map_}, log_.named("robots")),
      platforms_(loop_, log_.named("platforms")),
      world_(
          loop_, options_.world, [this] { return base::Result<std::unique_ptr<link::ByteLink>>(air_.connect()); },
          log_.named("sim")),
      recorder_(crew(), {}),
      voice_(std::make_unique<Voice>(loop_, recorder_, options_.answers)),
      host_(loop_, platforms_, *voice_, log_, [this](tasks::TaskEvent const& event) { recorder_.note(event); }) {
  hub_.add_sink([](base::LogRecord const& record) {
    bool const warns = record.source == "plausibility" && record.level != base::LogLevel::debug;
    if (warns) fmt::print(stderr, "warning: {}\n", record.text);
  });
  ground_.connection.add_link(air_.take_server());
  bool const fit = platforms_.add("MAVLink", platform_) && platforms_.add("robots", robots_);
  LAPWING_ASSERT(fit);  // no word of one is a word of the other
}

base::Result<> DryRun::add_robots(std::vector<std::string> const& requests) {
  for (auto const& text : requests) {
    auto const request = host::parse_robot(text);
    if (!request) return std::unexpected(request.error());
    if (!std::holds_alternative<host::SimulatedRobots>(*request))
      return base::fail(base::ErrorKind::invalid_input, fmt::format("--robot {}: a dry run moves nothing real", text),
                        "give the building that it is in: --robot sim:BUILDING.toml");
  }
  if (requests.empty()) return {};
  auto made =
      host::make_robots(loop_, requests, "default", options_.world.home, options_.world.seed, {}, buildings_, log_);
  if (!made) return std::unexpected(made.error());
  auto site = geo::Site::make("default", options_.world.home);
  if (!site) return std::unexpected(site.error());
  live_map_.put_site(*std::move(site));
  for (auto& robot : *made)
    if (auto added = robots_.add(std::move(robot.spec), std::move(robot.body)); !added)
      return std::unexpected(added.error());
  return {};
}

base::Result<> DryRun::power_on() {
  recorder_ = dryrun::Recorder(crew(), {});
  return world_.start();
}

std::expected<void, station::StartFailure> DryRun::fly(std::string name, std::string source) {
  if (auto started = host_.start(std::move(name), std::move(source)); !started) return started;
  host::StopSignals const signals(loop_, [this] { host_.stop("an interrupt"); });
  auto const stall = host_.halt_when_time_stands_still(std::chrono::seconds(10));
  loop_.run_until_done(finish());
  return {};
}

base::Task<> DryRun::finish() {
  base::Scope scope(loop_);
  scope.spawn(sample());
  scope.spawn(cut_off());
  co_await host_.ended();
  ended_ = loop_.now();
}

base::Task<> DryRun::sample() {
  for (auto next = loop_.now();; next += recorder_.period()) {
    co_await loop_.sleep_until(next);
    auto const samples = look();
    recorder_.sample(loop_.now().time_since_epoch(), samples);
  }
}

base::Task<> DryRun::cut_off() {
  co_await loop_.sleep(options_.timeout);
  is_cut_off_ = true;
  auto const trees = host_.task_trees();
  auto const status = host_.status();
  if (!trees.empty()) add_running(trees.back(), base::SourceFile(status.name, status.source), waiting_for_);
  add_standstill();
  host_.halt("still running when --timeout came");
}

/// Why nothing moves any more, when nothing does: a script that waits for charged batteries waits for ever.
void DryRun::add_standstill() {
  if (std::ranges::any_of(robots_.robots(), [](auto const& robot) { return robot->is_driving(); })) return;
  std::string batteries;
  for (auto const& vehicle : world_.vehicles()) {
    if (!vehicle->running() || vehicle->autopilot().armed()) return;
    auto const& options = vehicle->options();
    batteries +=
        fmt::format("{}{} {} at {:.0f} %", batteries.empty() ? "" : ", ", vehicle::to_string(options.kind.family),
                    options.system_id, 100.0 * vehicle->autopilot().battery().remaining());
  }
  if (batteries.empty()) return;
  auto line = fmt::format("every vehicle stands disarmed; batteries: {}", batteries);
  if (!options_.world.battery_swap_after) line += ", and nobody changes them: see --swap-batteries";
  waiting_for_.push_back(std::move(line));
}

std::vector<dryrun::VehicleRecord> DryRun::crew() const {
  std::vector<dryrun::VehicleRecord> vehicles;
  for (auto const& vehicle : world_.vehicles()) {
    auto const& options = vehicle->options();
    dryrun::VehicleRecord record;
    record.id = std::to_string(options.system_id);
    record.name = fmt::format("{} {}", vehicle::to_string(options.kind.family), options.system_id);
    record.family = options.kind.family;
    vehicles.push_back(std::move(record));
  }
  for (auto const& robot : robots_.robots()) {
    dryrun::VehicleRecord record;
    record.id = robot->spec().id;
    record.name = robot->spec().name;
    record.family = vehicle::Family::robot;
    vehicles.push_back(std::move(record));
  }
  return vehicles;
}

std::vector<dryrun::Sample> DryRun::look() const {
  constexpr double moving_m_s = 0.1;
  std::vector<dryrun::Sample> samples;
  for (auto const& vehicle : world_.vehicles()) {
    dryrun::Sample sample;
    sample.place_m = world_.site().ned_from(vehicle->place());
    if (vehicle->running()) {
      auto const& autopilot = vehicle->autopilot();
      bool const flies = plan::flies(vehicle->options().kind.family);
      sample.mode = autopilot.mode().name;
      sample.remaining = autopilot.battery().remaining();
      sample.used_mah = autopilot.battery().used_mah();
      sample.voltage_v = autopilot.battery().voltage_v();
      sample.in_the_air = flies && !autopilot.body().on_ground;
      sample.moves = !flies && autopilot.body().ground_speed_m_s() > moving_m_s;
    }
    samples.push_back(sample);
  }
  for (auto const& simulated : buildings_) {
    for (std::size_t i = 0; i < simulated->building->robot_count(); ++i)
      samples.push_back(
          look_at(*robots_.robot({simulated->robots[i]}), simulated->building->robot(i), simulated->site_from_floor));
  }
  return samples;
}

dryrun::FlightRecord DryRun::record() const {
  LAPWING_ASSERT(host_.outcome().has_value());
  auto record = recorder_.finish(ended_.time_since_epoch());
  auto const& outcome = *host_.outcome();
  for (auto& vehicle : record.vehicles) {
    auto const missions = platform_.missions(vehicle::VehicleId{vehicle.id});
    for (std::size_t i = 0; i < std::min(missions.size(), vehicle.tasks.size()); ++i)
      vehicle.tasks[i].flown = missions[i].flown;
  }
  record.script = host_.status().name;
  record.outcome = is_cut_off_ ? "unfinished" : host::outcome_word(outcome);
  if (outcome.kind != dolphin::Outcome::Kind::done) record.reason = outcome.message;
  record.waiting_for = waiting_for_;
  record.home = options_.world.home;
  record.wind_m_s = options_.world.wind_m_s;
  record.gust_m_s = options_.world.gust_m_s;
  record.seed = options_.world.seed;
  return record;
}

}  // namespace lapwing::apps
