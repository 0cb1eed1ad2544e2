#include <algorithm>
#include <charconv>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "apps/vehicles/param/param_jobs.hpp"
#include "apps/verb.hpp"
#include "base/files/replace_file.hpp"
#include "host/files/files.hpp"
#include "host/links/find_vehicles.hpp"
#include "host/links/link_session.hpp"
#include "parameters/parameter_file.hpp"

namespace lapwing::apps {

namespace {

using parameters::Parameter;
using parameters::Wanted;

struct ParamArguments {
  std::vector<std::string> links;
  std::vector<std::string> vehicles;
  double wait_s = 10.0;
  bool json = false;
  bool cached = false;
  bool everything = false;
  bool only_tell = false;
  std::string signing_key;
  std::string file;
  std::vector<std::string> names;  ///< names, patterns or NAME=VALUE, by the verb
  std::vector<std::string> sides;  ///< of a comparison: vehicles and files
  std::string from;
  std::vector<std::string> to;
};

/// What all of `param` need: the vehicles, and the parameters of each network.
struct ParamGround : host::LinkSession {
  explicit ParamGround(host::SigningSetup signing) : host::LinkSession(std::move(signing), "param") {}

  base::Result<> open_with_parameters(std::vector<std::string> const& urls) {
    if (auto opened = open(urls); !opened) return opened;
    for (auto& [name, network] : ground.networks) services.try_emplace(name, network, host::parameter_cache(), log);
    return {};
  }
  [[nodiscard]] ParamVehicle with_service(fleet::MavlinkVehicle const& craft) {
    return {.craft = &craft, .service = &services.at(craft.network)};
  }

  std::map<std::string, parameters::ParameterService> services;  ///< by network
};

using Job = std::function<base::Task<int>(ParamGround&, ParamArguments const&)>;

/// Else it is a file's name.
bool is_vehicle(std::string const& text) {
  return mavlink::parse_system_name(text).has_value();
}

/// Runs `job` on the vehicles' links to its end, or to an interrupt.
int run_job(ParamArguments const& arguments, Job const& job) {
  auto signing = host::read_signing(arguments.signing_key);
  if (!signing) return host::refuse(signing.error());
  ParamGround ground(*std::move(signing));
  // Two files are compared without anybody else.
  bool const needs_no_vehicle = arguments.sides.size() == 2 && std::ranges::none_of(arguments.sides, is_vehicle);
  if (!needs_no_vehicle)
    if (auto opened = ground.open_with_parameters(arguments.links); !opened) return host::refuse(opened.error());
  return ground.run(job(ground, arguments));
}

void print(std::string const& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

using Vehicles = std::vector<ParamVehicle>;

/// Those of these names; without one those that are heard.
base::Task<base::Result<Vehicles>> wanted_vehicles(ParamGround& ground, double wait_s, std::vector<std::string> texts) {
  auto const names = host::parse_vehicles(texts);
  if (!names) co_return std::unexpected(names.error());
  auto wanted = *names;
  auto const found = co_await host::find_vehicles(ground.ground, std::move(wanted), base::from_seconds(wait_s));
  if (!found) co_return std::unexpected(found.error());
  Vehicles vehicles;
  for (auto const* craft : *found) vehicles.push_back(ground.with_service(*craft));
  co_return vehicles;
}

/// For verbs that concern one vehicle.
base::Task<base::Result<ParamVehicle>> the_vehicle(ParamGround& ground, ParamArguments const& of) {
  auto const names = host::parse_vehicles(of.vehicles);
  if (!names) co_return std::unexpected(names.error());
  auto wanted = *names;
  auto const found = co_await host::find_vehicle(ground.ground, std::move(wanted), base::from_seconds(of.wait_s));
  if (!found) co_return std::unexpected(found.error());
  co_return ground.with_service(**found);
}

/// For verbs that change something: nothing is changed on vehicles that nobody named.
base::Task<base::Result<Vehicles>> named_vehicles(ParamGround& ground, ParamArguments const& of) {
  if (!of.vehicles.empty()) {
    auto names = of.vehicles;
    co_return co_await wanted_vehicles(ground, of.wait_s, std::move(names));
  }
  auto const one = co_await the_vehicle(ground, of);
  if (!one) co_return std::unexpected(one.error());
  co_return Vehicles{*one};
}

base::Task<int> list(ParamGround& ground, ParamArguments const& of) {
  auto names = of.vehicles;
  auto const vehicles = co_await wanted_vehicles(ground, of.wait_s, std::move(names));
  if (!vehicles) co_return host::refuse(vehicles.error());
  auto const wanted = of.cached ? Wanted::cached_too : Wanted::confirmed;
  std::vector<std::string> const patterns = of.names;
  auto const listings = co_await list_parameters(ground.loop, *vehicles, wanted, patterns);
  if (!listings) co_return host::refuse(listings.error());
  print(of.json ? listing_json(*listings) : listing_text(*listings));
  co_return host::exit_done;
}

base::Task<int> get(ParamGround& ground, ParamArguments const& of) {
  auto wanted = of.vehicles;
  auto const vehicles = co_await wanted_vehicles(ground, of.wait_s, std::move(wanted));
  if (!vehicles) co_return host::refuse(vehicles.error());
  std::vector<ParamListing> listings;
  bool is_whole = true;
  for (auto const vehicle : *vehicles) {
    std::vector<std::string> const names = of.names;
    listings.push_back(co_await read_parameters(vehicle, names));
    listings.back().taken = ground.loop.utc_now();
    for (auto const& error : listings.back().errors) fmt::print(stderr, "lapwing: {}\n", error);
    is_whole = is_whole && listings.back().errors.empty();
  }
  print(of.json ? listing_json(listings) : listing_text(listings));
  co_return is_whole ? host::exit_done : host::exit_failed;
}

base::Result<std::vector<Parameter>> assignments(std::vector<std::string> const& texts) {
  std::vector<Parameter> values;
  for (auto const& text : texts) {
    auto const equals = text.find('=');
    Parameter value{.name = text.substr(0, equals)};
    auto const* begin = text.data() + std::min(equals, text.size() - 1) + 1;
    auto const* end = text.data() + text.size();
    auto const [stopped, error] = std::from_chars(begin, end, value.value);
    if (equals == std::string::npos || equals == 0 || error != std::errc() || stopped != end)
      return base::fail(base::ErrorKind::invalid_input, fmt::format("'{}' sets no parameter", text),
                        "write NAME=VALUE, e.g. RTL_ALT=3000");
    values.push_back(std::move(value));
  }
  return values;
}

/// The same values on every vehicle, one vehicle after the other; then the report.
base::Task<int> apply(ParamGround& ground, ParamArguments const& of, Vehicles vehicles, std::vector<Parameter> values,
                      ApplyOptions options) {
  std::vector<ParamChanges> all;
  bool is_good = true;
  for (auto const vehicle : vehicles) {
    auto const changes = co_await apply_parameters(ground.loop, vehicle, values, options);
    if (!changes) co_return host::refuse(changes.error());
    is_good = is_good && changes->failed.empty();
    all.push_back(*changes);
  }
  print(of.json ? changes_json(all) : changes_text(all));
  co_return is_good ? host::exit_done : host::exit_failed;
}

base::Task<int> set(ParamGround& ground, ParamArguments const& of) {
  auto const values = assignments(of.names);
  if (!values) co_return host::refuse(values.error());
  auto const vehicles = co_await named_vehicles(ground, of);
  if (!vehicles) co_return host::refuse(vehicles.error());
  // Who names a parameter means it.
  co_return co_await apply(ground, of, *vehicles, *values, ApplyOptions{.leave_out_own = false});
}

base::Result<std::vector<Parameter>> read_file(std::string const& path) {
  auto const text = host::read_script(path);
  if (!text) return std::unexpected(text.error());
  auto file = parameters::read_parameter_file(path, *text);
  if (!file) return std::unexpected(file.error());
  if (file->of_other_components > 0)
    fmt::print(stderr, "{}: {} parameters of other components than the autopilot are left out\n", path,
               file->of_other_components);
  return std::move(file->parameters);
}

std::vector<Parameter> chosen(std::vector<Parameter> const& from, std::vector<std::string> const& patterns) {
  std::vector<Parameter> fitting;
  std::ranges::copy_if(from, std::back_inserter(fitting),
                       [&](Parameter const& value) { return parameters::fits_any(value.name, patterns); });
  return fitting;
}

base::Task<int> load(ParamGround& ground, ParamArguments const& of) {
  auto const all = read_file(of.file);
  if (!all) co_return host::refuse(all.error());
  auto const vehicles = co_await named_vehicles(ground, of);
  if (!vehicles) co_return host::refuse(vehicles.error());
  auto const values = chosen(*all, of.names);
  co_return co_await apply(ground, of, *vehicles, values,
                           ApplyOptions{.leave_out_own = !of.everything, .only_tell = of.only_tell});
}

parameters::FileHeader header_for(fleet::MavlinkVehicle const& craft, ParamListing const& listing) {
  parameters::FileHeader header{.system_id = craft.address.system, .version = listing.firmware};
  if (craft.state.autopilot == vehicle::Autopilot::ardupilot) header.stack = "ArduPilot";
  if (craft.state.autopilot == vehicle::Autopilot::px4) header.stack = "PX4";
  header.vehicle = to_string(craft.state.family);
  return header;
}

base::Task<int> save(ParamGround& ground, ParamArguments const& of) {
  auto const vehicle = co_await the_vehicle(ground, of);
  if (!vehicle) co_return host::refuse(vehicle.error());
  Vehicles const which{*vehicle};
  std::vector<std::string> const patterns = of.names;
  auto const listings = co_await list_parameters(ground.loop, which, Wanted::confirmed, patterns);
  if (!listings) co_return host::refuse(listings.error());
  auto const& listing = listings->front();
  bool const is_plain = of.file.ends_with(".param") || of.file.ends_with(".parm");
  auto const text = is_plain
                        ? parameters::mission_planner_text(listing.parameters)
                        : parameters::qgroundcontrol_text(listing.parameters, header_for(*vehicle->craft, listing));
  if (auto const written = base::replace_file(of.file, text); !written) co_return host::refuse(written.error());
  fmt::print(stderr, "{} parameters of vehicle {} written to {}\n", listing.parameters.size(),
             vehicle->craft->id().text, of.file);
  co_return host::exit_done;
}

std::string title(std::string const& text) {
  return is_vehicle(text) ? "vehicle " + text : text;
}

/// The chosen parameters of a vehicle or file; what belongs to one vehicle only when it is asked for.
base::Task<base::Result<std::vector<Parameter>>> side(ParamGround& ground, ParamArguments const& of, std::string text) {
  std::vector<Parameter> all;
  if (is_vehicle(text)) {
    std::vector<std::string> names{text};
    auto const vehicles = co_await wanted_vehicles(ground, of.wait_s, std::move(names));
    if (!vehicles) co_return std::unexpected(vehicles.error());
    std::vector<std::string> const patterns;
    auto const listings = co_await list_parameters(ground.loop, *vehicles, Wanted::confirmed, patterns);
    if (!listings) co_return std::unexpected(listings.error());
    all = listings->front().parameters;
  } else {
    auto const file = read_file(text);
    if (!file) co_return std::unexpected(file.error());
    all = *file;
  }
  all = chosen(all, of.names);
  if (!of.everything)
    std::erase_if(all, [](auto const& value) { return parameters::belongs_to_one_vehicle(value.name); });
  co_return all;
}

base::Task<int> compare(ParamGround& ground, ParamArguments const& of) {
  auto sides = of.sides;
  auto search = of;
  std::ranges::copy_if(sides, std::back_inserter(search.vehicles), is_vehicle);
  if (sides.size() == 1) {
    auto const one = co_await the_vehicle(ground, search);
    if (!one) co_return host::refuse(one.error());
    sides.insert(sides.begin(), one->craft->id().text);
  } else if (!search.vehicles.empty()) {
    auto names = search.vehicles;
    auto const found = co_await wanted_vehicles(ground, of.wait_s, std::move(names));
    if (!found) co_return host::refuse(found.error());
  }
  std::vector<std::vector<Parameter>> both;
  for (auto const& text : sides) {
    auto const all = co_await side(ground, of, text);
    if (!all) co_return host::refuse(all.error());
    both.push_back(*all);
  }
  auto const found = parameters::differences(both[0], both[1]);
  print(of.json ? differences_json(title(sides[0]), title(sides[1]), found)
                : differences_text(title(sides[0]), title(sides[1]), found));
  co_return found.empty() ? host::exit_done : host::exit_failed;
}

base::Task<int> copy(ParamGround& ground, ParamArguments const& of) {
  std::vector<std::string> names{of.from};
  names.insert(names.end(), of.to.begin(), of.to.end());
  auto const vehicles = co_await wanted_vehicles(ground, of.wait_s, std::move(names));
  if (!vehicles) co_return host::refuse(vehicles.error());
  Vehicles const source{vehicles->front()};
  Vehicles const targets(vehicles->begin() + 1, vehicles->end());
  std::vector<std::string> const patterns = of.names;
  auto const listings = co_await list_parameters(ground.loop, source, Wanted::confirmed, patterns);
  if (!listings) co_return host::refuse(listings.error());
  std::vector<Parameter> const values = listings->front().parameters;
  co_return co_await apply(ground, of, targets, values,
                           ApplyOptions{.leave_out_own = !of.everything, .only_tell = of.only_tell});
}

// ---- options

using Arguments = std::shared_ptr<ParamArguments>;

CLI::App* add_verb(CLI::App& param, Arguments const& arguments, int& exit_code, std::string const& name,
                   std::string const& help, Job job) {
  auto* verb = param.add_subcommand(name, help);
  verb->add_option("--link", arguments->links,
                   "Where vehicles are (may be repeated); default " + std::string(host::default_link))
      ->allow_extra_args(false);
  verb->add_option("--wait", arguments->wait_s, "Seconds to wait for vehicles")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  verb->add_flag("--json", arguments->json, "Write JSON");
  verb->add_option("--signing-key", arguments->signing_key, host::signing_key_help);
  verb->callback([arguments, job = std::move(job), &exit_code] { exit_code = run_job(*arguments, job); });
  return verb;
}

void add_vehicle(CLI::App& verb, Arguments const& arguments) {
  verb.add_option("--vehicle", arguments->vehicles,
                  fmt::format("{} (may be repeated); default: those that are heard", host::vehicle_help))
      ->allow_extra_args(false);
}

constexpr auto all_help = "Also what belongs to one vehicle: system id, calibration, counters";
constexpr auto pattern_help = "Only names that fit, e.g. 'WPNAV_*' (* any letters, ? one)";

void add_readers(CLI::App& param, Arguments const& arguments, int& exit_code) {
  auto* verb = add_verb(param, arguments, exit_code, "list", "All parameters of vehicles", list);
  verb->add_option("pattern", arguments->names, pattern_help);
  verb->add_flag("--cached", arguments->cached,
                 "Values of an earlier list do, marked with its time; nothing is asked of the vehicle if there is one");
  add_vehicle(*verb, arguments);
  verb = add_verb(param, arguments, exit_code, "get", "Some parameters, asked of the vehicle one by one", get);
  verb->add_option("name", arguments->names, "Names")->required();
  add_vehicle(*verb, arguments);
  verb = add_verb(param, arguments, exit_code, "save", "Write a vehicle's parameters to a file", save);
  verb->add_option("file", arguments->file, "QGroundControl's format; Mission Planner's for .param and .parm")
      ->required();
  verb->add_option("pattern", arguments->names, pattern_help);
  add_vehicle(*verb, arguments);
  verb = add_verb(param, arguments, exit_code, "compare",
                  "Differences of two vehicles, a vehicle and a file, or two files", compare);
  verb->add_option("side", arguments->sides, "Vehicles (7, north/7) or files; one alone is compared with the vehicle")
      ->required()
      ->expected(1, 2);
  verb->add_option("--only", arguments->names, pattern_help)->allow_extra_args(false);
  verb->add_flag("--all", arguments->everything, all_help);
  add_vehicle(*verb, arguments);
}

void add_writers(CLI::App& param, Arguments const& arguments, int& exit_code) {
  auto* verb = add_verb(param, arguments, exit_code, "set", "Set parameters and make sure that they were stored", set);
  verb->add_option("assignment", arguments->names, "NAME=VALUE, several if you like")->required();
  add_vehicle(*verb, arguments);
  verb = add_verb(param, arguments, exit_code, "load", "Set what a file says and the vehicle does not have yet", load);
  verb->add_option("file", arguments->file,
                   "QGroundControl's .params, or Mission Planner's or MAVProxy's .param or .parm")
      ->required();
  add_vehicle(*verb, arguments);
  auto* copying = add_verb(param, arguments, exit_code, "copy", "Set on vehicles what another one has", copy);
  copying->add_option("from", arguments->from, "The vehicle to read: 7, or north/7")->required();
  copying->add_option("to", arguments->to, "The vehicles to set")->required();
  for (auto* writer : {verb, copying}) {
    writer->add_option("--only", arguments->names, pattern_help)->allow_extra_args(false);
    writer->add_flag("--all", arguments->everything, all_help);
    writer->add_flag("--dry-run", arguments->only_tell, "Change nothing; tell what would be");
  }
}

}  // namespace

void add_param(CLI::App& program, int& exit_code) {
  auto const arguments = std::make_shared<ParamArguments>();
  auto* param = begin_verb(program, "param");
  param->require_subcommand(1);
  add_readers(*param, arguments, exit_code);
  add_writers(*param, arguments, exit_code);
}

}  // namespace lapwing::apps
