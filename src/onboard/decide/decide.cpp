#include "onboard/decide/decide.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "autonomy/operator/report_text.hpp"
#include "autonomy/settings/heights_file.hpp"
#include "base/text/utc_text.hpp"
#include "base/wall_clock.hpp"

namespace lapwing::onboard {

using namespace std::chrono_literals;
using autonomy::State;

namespace {

constexpr base::Duration frame = 50ms;
constexpr double in_the_air_m = 2.0;
constexpr base::Duration leaving_patience = 8s;
constexpr auto diagnostics_file = "malfunction.txt";

template <class T>
bool is_a(autonomy::Command const& command) {
  return std::holds_alternative<T>(command);
}

/// What others fly is theirs.
bool is_safe(autonomy::Memory const& memory, autonomy::Told const& told) {
  auto const& flight = told.flight;
  if (!flight || !flight->is_armed || memory.is_flown_by_hand) return true;
  if (memory.state == State::idle) return !memory.disarms_until && !memory.is_killed;
  bool const comes_down = flight->mode == autonomy::return_home || flight->mode == autonomy::land_here;
  return autonomy::descents.has(memory.state) && comes_down;
}

}  // namespace

base::Result<std::unique_ptr<Decide>> Decide::open(base::Loop& loop, bus::Bus& bus, DecideSettings settings,
                                                   base::Logger log) {
  std::unique_ptr<Decide> decide(new Decide(loop, settings, std::move(log)));
  if (auto const opened = decide->open_parts(bus, std::move(settings)); !opened) return std::unexpected(opened.error());
  return decide;
}

Decide::Decide(base::Loop& loop, DecideSettings const& settings, base::Logger log)
    : loop_(loop), log_(std::move(log)), folder_name_(settings.state_folder), scope_(loop) {}

base::Result<> Decide::open_parts(bus::Bus& bus, DecideSettings settings) {
  auto folder = autonomy::open_folder(settings.state_folder);
  if (!folder) return std::unexpected(folder.error());
  auto const loaded = autonomy::load_heights(**folder);
  if (!loaded.warning.empty()) {
    log_.warn(loaded.warning);
    to_tell_.push_back(loaded.warning);
  }
  folder_.emplace(loop_, *std::move(folder));
  auto flight = FlightListener::open(loop_, bus);
  if (!flight) return std::unexpected(flight.error());
  flight_ = *std::move(flight);
  auto hand = FlightHand::open(bus, flight_->heard(), log_);
  if (!hand) return std::unexpected(hand.error());
  hand_ = *std::move(hand);
  auto processes = SurveyProcesses::open(loop_, bus, flight_->heard(), settings.relies_on);
  if (!processes) return std::unexpected(processes.error());
  processes_ = *std::move(processes);
  auto desk = OperatorDesk::open(loop_, std::move(settings.desk), log_);
  if (!desk) return std::unexpected(desk.error());
  desk_ = *std::move(desk);
  machine_.emplace(std::move(settings.machine), loaded.heights);
  log_.info(fmt::format("operators connect to port {}; hover heights {:g}, {:g} and {:g} m", desk_->port(),
                        loaded.heights.min_m, loaded.heights.desired_m, loaded.heights.max_m));
  scope_.spawn(decide());
  return {};
}

base::Task<> Decide::decide() {
  for (auto next = loop_.now();; next = std::max(next + frame, loop_.now())) {
    co_await loop_.sleep_until(next);
    lateness_.add(loop_.now() - next);
    step();
  }
}

autonomy::Told Decide::tell() {
  autonomy::Told told{.link = desk_->link(), .flight = flight_->heard().told(loop_.now()), .commands = due_commands()};
  if (told.flight) learn_drain(*told.flight);
  processes_->tell(told);
  if (auto const wanted = command_to_leave()) {
    told.commands.push_back(*wanted);
    has_been_told_to_come_down_ = true;
  }
  return told;
}

void Decide::learn_drain(autonomy::FlightController& flight) {
  bool const is_flying = flight.is_armed && flight.relative_alt_m && *flight.relative_alt_m > in_the_air_m;
  flight.drain = drain_.add(flight.battery, is_flying, loop_.now());
}

std::vector<autonomy::Command> Decide::due_commands() {
  for (auto& command : desk_->take_commands()) held_.push_back(std::move(command));
  bool const is_urgent = std::ranges::any_of(held_, is_a<autonomy::command::Kill>);
  if (is_urgent) return std::exchange(held_, {});
  if (machine_->memory().state == State::configure) return {};
  auto const configures = std::ranges::find_if(held_, is_a<autonomy::command::Configure>);
  auto const end = configures == held_.end() ? configures : configures + 1;
  std::vector<autonomy::Command> due(held_.begin(), end);
  held_.erase(held_.begin(), end);
  return due;
}

void Decide::step() {
  auto const told = tell();
  auto const said = machine_->step(told, loop_.now());
  carry_out(said, told);
  keep(said);
  if (done_) leave_if_safe(told);
}

void Decide::carry_out(autonomy::Said const& said, autonomy::Told const& told) {
  for (auto const& request : said.requests) hand_->ask(request);
  processes_->hear(said);
  processes_->hear(machine_->memory().heights);
  if (logged_state_ != said.state) log_.info(fmt::format("state {}", autonomy::to_string(said.state)));
  logged_state_ = said.state;
  for (auto const& words : said.error_log) to_tell_.push_back(words);
  for (auto& words : flight_->take_warnings()) to_tell_.push_back(std::move(words));
  for (auto& words : processes_->take_reports()) to_tell_.push_back(std::move(words));
  for (auto const& words : std::exchange(to_tell_, {})) {
    log_.warn(words);
    desk_->tell(words);
  }
  if (auto const slots = processes_->take_slots()) {
    auto text = autonomy::slots_message(*slots);
    if (text)
      desk_->slots(*std::move(text));
    else
      log_.warn(text.error().message);
  }
  if (said.sends_heartbeat) desk_->heartbeat(said, told, processes_->map());
}

// ---- what is kept

void Decide::keep(autonomy::Said const& said) {
  if (said.to_save) scope_.spawn(save_heights(*said.to_save));
  if (said.diagnostics) scope_.spawn(save_diagnostics(*said.diagnostics));
}

base::Task<> Decide::save_heights(autonomy::HoverHeights heights) {
  auto saving = folder_->run([heights](autonomy::Folder& folder) { return autonomy::save_heights(folder, heights); });
  auto const saved = co_await saving;
  if (!saved) to_tell_.push_back(fmt::format("the heights are not kept over boots: {}", saved.error().message));
}

base::Task<> Decide::save_diagnostics(std::string text) {
  auto content = fmt::format("at: {}\n{}", base::utc_text(base::wall_now()), text);
  auto saving = folder_->run([content = std::move(content)](autonomy::Folder& folder) {
    auto written = folder.write_through(diagnostics_file, content);
    return written ? folder.sync_names() : written;
  });
  auto const saved = co_await saving;
  auto const name = (folder_name_ / diagnostics_file).string();
  if (saved)
    log_.info(fmt::format("diagnostics are in {}", name));
  else
    to_tell_.push_back(fmt::format("diagnostics are not written: {}", saved.error().message));
}

// ---- the end

void Decide::leave(std::function<void()> done) {
  if (done_) return;
  done_ = std::move(done);
  leaves_until_ = loop_.now() + leaving_patience;
}

/// As an operator would bring it to rest.
std::optional<autonomy::Command> Decide::command_to_leave() const {
  auto const& memory = machine_->memory();
  if (!done_ || has_been_told_to_come_down_ || memory.is_flown_by_hand) return std::nullopt;
  auto const state = memory.state;
  bool const may_fly = state == State::takeoff || autonomy::flight_states.has(state);
  if (may_fly) return autonomy::command::Land{};
  if (state == State::arm) return autonomy::command::Disarm{};
  return std::nullopt;
}

void Decide::leave_if_safe(autonomy::Told const& told) {
  bool const safe = is_safe(machine_->memory(), told);
  if (!safe && loop_.now() < leaves_until_) return;
  if (!safe) log_.error("the drone was not seen to come down or to be disarmed before this program ended");
  if (safe && told.flight && told.flight->is_armed) log_.info(fmt::format("left in mode {}", told.flight->mode));
  log_.info(to_string(lateness_));
  loop_.post(std::exchange(done_, {}));
}

}  // namespace lapwing::onboard
