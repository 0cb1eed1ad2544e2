#include "apps/dry_run.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include <fmt/format.h>

#include "apps/signals.hpp"
#include "apps/simulation.hpp"
#include "apps/stall_watch.hpp"

namespace lapwing::apps {

namespace {

/// A script may compute for some seconds between two moments; one that never lets time pass ends here.
constexpr std::chrono::seconds longest_standstill{10};

/// What still ran, innermost first: the leaves of the tree.
void add_running(tasks::TaskView const& view, std::vector<std::string>& lines) {
  bool const runs = view.state == tasks::TaskState::running;
  if (!runs) return;
  bool const has_running_child =
      std::ranges::any_of(view.children, [](auto const& child) { return child.state == tasks::TaskState::running; });
  if (has_running_child) {
    for (auto const& child : view.children) add_running(child, lines);
    return;
  }
  auto line = view.kind;
  if (!view.label.empty()) line += " " + view.label;
  if (view.line > 0) line += fmt::format(" (line {})", view.line);
  if (view.vehicle) line += fmt::format(" on vehicle {}", view.vehicle->text);
  if (!view.detail.empty()) line += ": " + view.detail;
  lines.push_back(std::move(line));
}

fleet::Fleet::Options equipped(DryRun::Options const& options) {
  fleet::Fleet::Options fleet;
  int system_id = options.world.first_system_id;
  for (auto const& group : options.world.vehicles)
    for (int i = 0; i < group.count; ++i) fleet.payload[system_id++] = options.payload;
  return fleet;
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
      loop_(pace_for(0.0)),
      log_(hub_, "lapwing"),
      air_(loop_),
      ground_(loop_, fleet::OnStop::loiter, log_, equipped(options_), options_.plans),
      world_(
          loop_, options_.world, [this] { return base::Result<std::unique_ptr<link::ByteLink>>(air_.connect()); },
          log_.named("sim")),
      recorder_(crew(), {}),
      voice_(std::make_unique<Voice>(loop_, recorder_, options_.answers)),
      host_(loop_, ground_.platform, *voice_, log_, [this](tasks::TaskEvent const& event) { recorder_.note(event); }) {
  ground_.connection.add_link(air_.take_server());
}

base::Result<> DryRun::power_on() {
  return world_.start();
}

std::expected<void, station::StartFailure> DryRun::fly(std::string name, std::string source) {
  if (auto started = host_.start(std::move(name), std::move(source)); !started) return started;
  StopSignals const signals(loop_, [this] { host_.stop(); });
  StallWatch const stall(loop_, longest_standstill, [this] {
    host_.halt(fmt::format("the script let no time pass for {} s: it waits for nothing and never ends",
                           longest_standstill.count()));
  });
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
  if (!trees.empty()) add_running(trees.back(), waiting_for_);
  host_.halt("still running when --timeout came");
}

std::vector<dryrun::VehicleRecord> DryRun::crew() const {
  std::vector<dryrun::VehicleRecord> vehicles;
  for (auto const& vehicle : world_.vehicles()) {
    auto const& options = vehicle->options();
    dryrun::VehicleRecord record;
    record.id = std::to_string(options.system_id);
    record.name = fmt::format("{} {}", vehicle::to_string(options.family), options.system_id);
    record.family = options.family;
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
      bool const flies = vehicle->options().family != vehicle::Family::rover;
      sample.mode = autopilot.mode().name;
      sample.remaining = autopilot.battery().remaining();
      sample.used_mah = autopilot.battery().used_mah();
      sample.voltage_v = autopilot.battery().voltage_v();
      sample.in_the_air = flies && !autopilot.body().on_ground;
      sample.moves = !flies && autopilot.body().ground_speed_m_s() > moving_m_s;
    }
    samples.push_back(sample);
  }
  return samples;
}

dryrun::FlightRecord DryRun::record() const {
  auto record = recorder_.finish(ended_.time_since_epoch());
  auto const& outcome = *host_.outcome();
  for (auto& vehicle : record.vehicles) {
    auto const missions = ground_.platform.missions(vehicle::VehicleId{vehicle.id});
    for (std::size_t i = 0; i < std::min(missions.size(), vehicle.tasks.size()); ++i)
      vehicle.tasks[i].flown = missions[i].flown;
  }
  record.script = host_.status().name;
  record.outcome = is_cut_off_ ? "unfinished" : outcome_word(outcome);
  if (outcome.kind != dolphin::Outcome::Kind::done) record.reason = outcome.message;
  record.waiting_for = waiting_for_;
  record.home = options_.world.home;
  record.wind_m_s = options_.world.wind_m_s;
  record.seed = options_.world.seed;
  return record;
}

}  // namespace lapwing::apps
