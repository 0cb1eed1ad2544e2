#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/vehicles/mission/plan_summary.hpp"
#include "apps/vehicles/mission/vehicle_plans.hpp"
#include "apps/verb.hpp"
#include "base/files/replace_file.hpp"
#include "fleet/plausibility/own_fence.hpp"
#include "fleet/plausibility/situation.hpp"
#include "host/files/files.hpp"
#include "host/links/find_vehicles.hpp"
#include "host/links/link_session.hpp"
#include "host/plausibility/options.hpp"
#include "host/session/progress.hpp"
#include "host/simulation/simulation.hpp"
#include "mavlink/exchange/command.hpp"
#include "plan/plausibility/judge.hpp"
#include "sim/model/vehicle_spec.hpp"

namespace lapwing::apps {

namespace {

using base::Result;
using base::Task;

struct MissionOptions {
  std::string file;
  std::string out;
  std::vector<std::string> links;
  std::string simulated;
  std::string home;
  std::string signing_key;
  std::vector<std::string> vehicle;  ///< one at most
  std::string type = "all";
  std::optional<double> altitude_m;
  host::PlausibilityArguments plausibility;
  double wait_s = 10.0;
  bool json = false;
  bool is_armed_allowed = false;
  bool is_strict = false;

  [[nodiscard]] plan::PlanReadOptions reading() const { return {.altitude_m = altitude_m}; }
};

void say(std::string_view text) {
  fmt::print(stderr, "lapwing: {}\n", text);
}

/// What a person is told when a file is read or written.
void tell(std::string_view file, std::string_view what, std::vector<std::string> const& lines) {
  for (auto const& line : lines) fmt::print(stderr, "{}: {}: {}\n", file, what, line);
}

Result<plan::Plan> read_plan_file(MissionOptions const& options) {
  auto const text = host::read_script(options.file);
  if (!text) return std::unexpected(text.error());
  auto read = plan::read_plan(options.file, *text, options.reading());
  if (!read) return std::unexpected(read.error());
  tell(options.file, "note", read->notes);
  return std::move(read->plan);
}

/// Prints what is lost on the way.
Result<> write_plan_file(MissionOptions const& options, plan::Plan const& plan) {
  auto const format = plan::format_of(options.out);
  if (!format) return std::unexpected(format.error());
  auto const written = plan::write_plan(plan, *format);
  if (!written) return std::unexpected(written.error());
  tell(options.out, "lost", written->lost);
  if (options.is_strict && !written->lost.empty())
    return base::fail(base::ErrorKind::refused,
                      fmt::format("{} was not written: something would be lost", options.out));
  return base::replace_file(options.out, written->text);
}

// ---- with a vehicle

/// One exchange with one vehicle.
struct Exchange {
  Exchange(MissionOptions const& chosen, host::SigningSetup signing)
      : options(chosen), session(std::move(signing), "mission", host::pace_for(chosen.simulated.empty() ? 1.0 : 0.0)) {}

  MissionOptions const& options;
  host::LinkSession session;
  std::unique_ptr<sim::World> world;
  std::string phase;
  std::optional<host::Progress> progress;  ///< of the phase
  fleet::MavlinkVehicle const* craft = nullptr;
  plan::Plan plan;  ///< to upload, or what was downloaded
  plan::plausibility::Settings plausibility;
  std::vector<ListReport> reports;
};

Result<> open(Exchange& exchange) {
  auto const& options = exchange.options;
  if (options.simulated.empty()) return exchange.session.open(options.links);
  if (auto opened = exchange.session.ground.open(options.links); !opened) return opened;
  sim::WorldOptions world;
  auto const vehicles = sim::parse_vehicles(options.simulated);
  if (!vehicles) return std::unexpected(vehicles.error());
  world.vehicles = *vehicles;
  if (auto placed = host::place(world, options.home, exchange.plan.mission.planned_home); !placed) return placed;
  auto started = host::start_simulation(exchange.session.ground, std::move(world), {});
  if (!started) return std::unexpected(started.error());
  exchange.world = *std::move(started);
  return {};
}

/// What one of the verbs does once the vehicle is there.
using Action = Task<Result<>> (*)(Exchange&);

Task<Result<>> find_and(Exchange& exchange, Action action, std::vector<mavlink::SystemName> wanted) {
  auto const patience = base::from_seconds(exchange.options.wait_s);
  auto const found = co_await host::find_vehicle(exchange.session.ground, std::move(wanted), patience);
  if (!found) co_return std::unexpected(found.error());
  exchange.craft = *found;
  co_return co_await action(exchange);
}

Task<int> work(Exchange& exchange, Action action, std::vector<mavlink::SystemName> wanted) {
  auto const done = co_await find_and(exchange, action, std::move(wanted));
  exchange.progress.reset();
  co_return done ? int{host::exit_done} : host::refuse(done.error());
}

/// An upload that is broken off must not leave half a plan.
Task<> clean_up(Exchange& exchange) {
  exchange.progress.reset();
  if (!exchange.craft || exchange.reports.empty()) co_return;
  auto& report = exchange.reports.back();
  if (report.replacement.left != mavlink::PlanLeft::unknown) co_return;
  say("interrupted: putting back what the vehicle held (Ctrl-C again leaves it as it is)");
  auto const& craft = *exchange.craft;
  mavlink::ReplaceOptions const options{.autopilot = craft.heard->mav_autopilot};
  co_await mavlink::undo_replacement(craft.connection, craft.address, report.type, options, report.replacement);
  report.error = "interrupted";
  say(fmt::format("{}: {}", to_string(report.type), to_string(report.replacement.left)));
}

int run_exchange(Exchange& exchange, Action action) {
  auto const& options = exchange.options;
  if (auto const types = parse_types(options.type); !types) return host::refuse(types.error());
  auto vehicle = host::parse_vehicles(options.vehicle);
  if (!vehicle) return host::refuse(vehicle.error());
  if (auto const opened = open(exchange); !opened) return host::refuse(opened.error());
  int const code = exchange.session.run(work(exchange, action, *std::move(vehicle)), clean_up(exchange));
  if (options.json) fmt::print("{}\n", to_json(exchange.craft, exchange.reports, exchange.plan));
  if (code == host::exit_done && !options.json)
    for (auto const& report : exchange.reports) fmt::print("{}", to_text(*exchange.craft, report));
  return code;
}

ShowProgress show_on(Exchange& exchange) {
  return [&exchange](std::string_view phase, std::size_t done, std::size_t total) {
    if (!exchange.progress || exchange.phase != phase) exchange.progress.emplace(exchange.phase = phase, "items");
    exchange.progress->show(done, total, exchange.session.loop.now());
  };
}

/// What a vehicle flies is not changed under it without being asked for.
Result<> may_change(Exchange const& exchange) {
  if (!exchange.craft->heard->is_armed || exchange.options.is_armed_allowed) return {};
  return base::fail(base::ErrorKind::refused,
                    fmt::format("vehicle {} is armed: its plans are not changed", exchange.craft->id().text),
                    "--armed does it all the same");
}

/// Many vehicles tell nothing regularly before a ground station asks for it.
Task<bool> learn_place(fleet::MavlinkVehicle& craft) {
  constexpr base::Duration patience = std::chrono::seconds(2);
  constexpr mavlink::CommandOptions quickly{.tries = 2, .ack_timeout = std::chrono::milliseconds(500)};
  std::function<bool()> const is_known = [&craft] {
    return craft.state.motion.position.known() && craft.state.motion.home.known();
  };
  for (auto const message : {mavlink::MessageId::global_position_int, mavlink::MessageId::home_position}) {
    if (is_known()) break;
    auto const command = mavlink::request_message(message);
    (void)co_await mavlink::run_command(craft.connection, craft.address, command, quickly);
  }
  auto until_known = is_known;
  (void)co_await craft.changed.wait_for(std::move(until_known), patience);
  co_return craft.state.motion.position.known();
}

/// Whether the mission makes sense where the vehicle is. Its ground and home are waited for, since a plan of another
/// place is known by nothing else; a vehicle that knows no place is given the benefit of the doubt.
Task<Result<>> heed_upload(Exchange& exchange, std::vector<mavlink::MissionType> const& types) {
  auto const is_uploaded = [&types](mavlink::MissionType type) {
    return std::ranges::find(types, type) != types.end();
  };
  if (!is_uploaded(mavlink::MissionType::mission) || exchange.plan.mission.items.empty()) co_return Result<>{};
  auto& craft = *exchange.session.ground.fleet.find(exchange.craft->id());
  if (!co_await learn_place(craft))
    say(fmt::format("{} has not told where it is: nobody knows whether this plan is for here", craft.state.name));
  if (auto const learned = co_await fleet::learn_fence(craft, fleet::thorough); !learned)
    say(fmt::format("{} has not told its own fence ({}): nobody knows whether this plan leaves it", craft.state.name,
                    learned.error().message));
  auto situation = fleet::situation_of(craft, {});
  situation.position = craft.state.motion.position.value;  // good enough for a plan, before it is for a flight
  if (is_uploaded(mavlink::MissionType::fence) && !exchange.plan.fence.empty()) {
    situation.fence = exchange.plan.fence;
    if (situation.own_fence) situation.own_fence->areas = {};  // those that it holds are replaced
  }
  auto const findings = judge(exchange.plan.mission, situation, exchange.plausibility);
  for (auto const& finding : findings) {
    if (finding.allowed_because)
      say(fmt::format("allowed: {}: {}", *finding.allowed_because, to_text(finding)));
    else if (!finding.refuses())
      say(fmt::format("warning: {}", to_text(finding)));
  }
  auto const* refused = refusal(findings);
  if (!refused) co_return Result<>{};
  co_return base::fail(base::ErrorKind::invalid_input, fmt::format("{}: {}", exchange.options.file, to_text(*refused)),
                       fmt::format("if it is meant: --allow {}=REASON", to_string(refused->rule)));
}

Task<Result<>> upload_action(Exchange& exchange) {
  if (auto may = may_change(exchange); !may) co_return may;
  auto const types = *parse_types(exchange.options.type);
  auto uploads = uploads_for(exchange.options.file, exchange.plan, types, *exchange.craft);
  if (!uploads) co_return std::unexpected(uploads.error());
  tell(exchange.options.file, "lost", uploads->lost);
  if (auto heeded = co_await heed_upload(exchange, types); !heeded) co_return heeded;
  auto show = show_on(exchange);
  co_return co_await upload_lists(*exchange.craft, std::move(uploads->lists), std::move(show), exchange.reports);
}

Task<Result<>> download_action(Exchange& exchange) {
  auto types = *parse_types(exchange.options.type);
  auto show = show_on(exchange);
  co_return co_await download_lists(*exchange.craft, std::move(types), std::move(show), exchange.plan,
                                    exchange.reports);
}

Task<Result<>> clear_action(Exchange& exchange) {
  if (auto may = may_change(exchange); !may) co_return may;
  auto types = *parse_types(exchange.options.type);
  co_return co_await clear_lists(*exchange.craft, std::move(types), exchange.reports);
}

// ---- the verbs

int upload(MissionOptions const& options) {
  auto plan = read_plan_file(options);
  if (!plan) return host::refuse(plan.error());
  auto signing = host::read_signing(options.signing_key);
  if (!signing) return host::refuse(signing.error());
  auto plausibility = host::plausibility_of(options.plausibility);
  if (!plausibility) return host::refuse(plausibility.error());
  Exchange exchange(options, *std::move(signing));
  exchange.plan = *std::move(plan);
  exchange.plausibility = *std::move(plausibility);
  return run_exchange(exchange, upload_action);
}

int download(MissionOptions const& options) {
  if (!options.out.empty()) {
    if (auto const format = plan::format_of(options.out); !format) return host::refuse(format.error());
  }
  auto signing = host::read_signing(options.signing_key);
  if (!signing) return host::refuse(signing.error());
  Exchange exchange(options, *std::move(signing));
  if (int const code = run_exchange(exchange, download_action); code != host::exit_done) return code;
  if (options.out.empty()) {
    if (!options.json) fmt::print("{}", to_text(exchange.plan));
    return host::exit_done;
  }
  auto const written = write_plan_file(options, exchange.plan);
  return written ? int{host::exit_done} : host::refuse(written.error());
}

int clear(MissionOptions const& options) {
  auto signing = host::read_signing(options.signing_key);
  if (!signing) return host::refuse(signing.error());
  Exchange exchange(options, *std::move(signing));
  return run_exchange(exchange, clear_action);
}

int convert(MissionOptions const& options) {
  auto const plan = read_plan_file(options);
  if (!plan) return host::refuse(plan.error());
  auto const written = write_plan_file(options, *plan);
  if (written) return host::exit_done;
  if (written.error().kind != base::ErrorKind::refused) return host::refuse(written.error());
  host::print_error(written.error());
  return host::exit_failed;
}

int show(MissionOptions const& options) {
  auto const plan = read_plan_file(options);
  if (!plan) return host::refuse(plan.error());
  fmt::print("{}", options.json ? to_json(nullptr, {}, *plan) + "\n" : to_text(*plan));
  return host::exit_done;
}

void add_vehicle_options(CLI::App& verb, MissionOptions& options) {
  verb.add_option("--link", options.links,
                  "Where the vehicle is, e.g. udpin://0.0.0.0:14550 (may be repeated); default " +
                      std::string(host::default_link))
      ->allow_extra_args(false);
  auto* simulated = verb.add_option("--sim", options.simulated, "A simulated vehicle instead, e.g. copter:1");
  verb.add_option("--signing-key", options.signing_key, host::signing_key_help)->excludes(simulated);
  verb.add_option("--home", options.home, "Where simulated vehicles stand: LAT,LON,ALT[,HEADING]");
  verb.add_option("--vehicle", options.vehicle, fmt::format("{}; not needed where there is one", host::vehicle_help))
      ->expected(1);
  verb.add_option("--wait", options.wait_s, "Seconds to wait for the vehicle")
      ->check(CLI::Range(0.1, 600.0))
      ->capture_default_str();
  verb.add_flag("--json", options.json, "What was done, as JSON on standard output");
}

void add_type(CLI::App& verb, MissionOptions& options, bool is_required) {
  auto* option = verb.add_option("--type", options.type, "mission, fence, rally or all")
                     ->check(CLI::IsMember({"mission", "fence", "rally", "all"}));
  if (is_required)
    option->required();
  else
    option->capture_default_str();
}

void add_altitude(CLI::App& verb, MissionOptions& options) {
  verb.add_option("--altitude", options.altitude_m,
                  "Height above home, in metres, of places for which the file says none")
      ->check(CLI::Range(-500.0, 50'000.0));
}

constexpr auto armed_help = "Also when the vehicle is armed: it may be flying the plan that is changed";

using Verb = int (*)(MissionOptions const&);

CLI::App* add_verb(CLI::App& group, char const* name, char const* help, Verb verb, int& exit_code,
                   std::shared_ptr<MissionOptions> const& options) {
  auto* added = group.add_subcommand(name, help);
  added->callback([options, verb, &exit_code] { exit_code = verb(*options); });
  return added;
}

}  // namespace

void add_mission(CLI::App& program, int& exit_code) {
  auto* group = begin_verb(program, "mission");
  group->require_subcommand(1);
  auto const with_file = [](CLI::App& verb, MissionOptions& options) {
    verb.add_option("file", options.file, "Plan file: .plan, .waypoints, .kml, .kmz or .geojson")->required();
    add_altitude(verb, options);
  };

  auto options = std::make_shared<MissionOptions>();
  auto* verb = add_verb(*group, "upload", "Put a plan on a vehicle, read it back, restore the old one if that fails",
                        upload, exit_code, options);
  with_file(*verb, *options);
  add_vehicle_options(*verb, *options);
  add_type(*verb, *options, false);
  verb->add_flag("--armed", options->is_armed_allowed, armed_help);
  host::add_plausibility_options(*verb, options->plausibility);

  options = std::make_shared<MissionOptions>();
  verb = add_verb(*group, "download", "Fetch what a vehicle holds, and show it or write it to a file", download,
                  exit_code, options);
  verb->add_option("--out", options->out, "Plan file; its ending names the format");
  verb->add_flag("--strict", options->is_strict, "Write nothing if the format cannot hold all");
  add_vehicle_options(*verb, *options);
  add_type(*verb, *options, false);

  options = std::make_shared<MissionOptions>();
  verb = add_verb(*group, "clear", "Delete what a vehicle holds", clear, exit_code, options);
  add_vehicle_options(*verb, *options);
  add_type(*verb, *options, true);
  verb->add_flag("--armed", options->is_armed_allowed, armed_help);

  options = std::make_shared<MissionOptions>();
  verb = add_verb(*group, "convert", "Write a plan file in another format, and say what that cannot hold", convert,
                  exit_code, options);
  with_file(*verb, *options);
  verb->add_option("out", options->out, "Plan file; its ending names the format")->required();
  verb->add_flag("--strict", options->is_strict, "Write nothing if something would be lost; exit code 1");

  options = std::make_shared<MissionOptions>();
  verb = add_verb(*group, "show", "What is in a plan file", show, exit_code, options);
  with_file(*verb, *options);
  verb->add_flag("--json", options->json, "As JSON");
}

}  // namespace lapwing::apps
