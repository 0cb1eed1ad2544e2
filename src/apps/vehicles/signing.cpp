#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/verb.hpp"
#include "host/links/find_vehicles.hpp"
#include "host/links/link_session.hpp"
#include "mavlink/exchange/signing_setup.hpp"
#include "mavlink/signing/key_store.hpp"

namespace lapwing::apps {

namespace {

using base::ErrorKind;
using mavlink::KeyRing;
using mavlink::SystemName;

struct SigningArguments {
  std::string keys;  ///< the key store
  std::string name;
  std::string import;
  std::vector<std::string> links;
  std::vector<std::string> vehicles;
  double wait_s = 10.0;
  double overlap_s = 5.0;
  bool insecure = false;
};

/// Changes of one vehicle's key, each on the disk before it is on the vehicle. Its network is there.
struct KeyChange {
  host::LinkSession& session;
  SigningArguments const& arguments;
  KeyRing ring;  ///< as it is on the disk

  /// The store on the disk, and at once on the links; there the vehicle is heard as it is, signed or not.
  base::Result<> use(SystemName const& vehicle, KeyRing::Use names) {
    vehicles_of(ring, vehicle.network)[vehicle.system_id] = std::move(names);
    return keep(vehicle);
  }
  /// The vehicle has no keys of its own any more.
  base::Result<> forget(SystemName const& vehicle) {
    vehicles_of(ring, vehicle.network).erase(vehicle.system_id);
    return keep(vehicle);
  }
  base::Result<> keep(SystemName const& vehicle) {
    if (auto written = host::write_key_store(arguments.keys, ring); !written) return written;
    listen(vehicle);
    return {};
  }
  void listen(SystemName const& vehicle) {
    auto live = mavlink::ring_of_network(ring, vehicle.network);
    live.unsigned_frames.systems.insert(vehicle.system_id);
    session.ground.networks.at(vehicle.network).set_keys(std::move(live));
  }
  base::Task<base::Result<fleet::MavlinkVehicle*>> wait_for(SystemName const& vehicle) {
    std::vector<SystemName> wanted{vehicle};
    co_return co_await host::find_vehicle(session.ground, std::move(wanted), base::from_seconds(arguments.wait_s));
  }
};

KeyRing::Use use_of(KeyRing const& ring, SystemName const& vehicle) {
  auto const of_network = mavlink::ring_of_network(ring, vehicle.network);
  auto const own = of_network.vehicles.find(vehicle.system_id);
  return own != of_network.vehicles.end() ? own->second : ring.everybody;
}

/// The key is changed in steps of which each leaves vehicle and store able to talk: both keys are known on the disk
/// before the vehicle hears of the new one, and the old one goes when the vehicle has signed with the new one for a
/// while.
base::Task<base::Result<>> change_key(KeyChange& change, SystemName vehicle, std::string name) {
  auto both = use_of(change.ring, vehicle);
  if (std::ranges::find(both, name) == both.end()) both.push_back(name);
  if (auto kept = change.use(vehicle, both); !kept) co_return kept;
  auto const heard = co_await change.wait_for(vehicle);
  if (!heard) co_return std::unexpected(heard.error());
  auto& connection = (*heard)->connection;
  mavlink::Address const target{vehicle.system_id, mavlink::autopilot_component};
  if (auto given = co_await mavlink::give_key(connection, target, name); !given) co_return given;
  std::erase(both, name);
  both.insert(both.begin(), name);
  if (auto kept = change.use(vehicle, both); !kept) co_return kept;
  co_await change.session.loop.sleep(base::from_seconds(change.arguments.overlap_s));
  if (connection.signing()->key_of(target) != name)
    co_return base::fail(ErrorKind::refused, fmt::format("vehicle {} signs with its old key again", to_string(vehicle)),
                         "both keys are kept; was it restarted before it had stored the new one?");
  if (change.ring.everybody == KeyRing::Use{name}) co_return change.forget(vehicle);
  KeyRing::Use const only{name};
  co_return change.use(vehicle, only);
}

base::Task<int> give(KeyChange& change, std::vector<SystemName> vehicles) {
  for (auto const& vehicle : vehicles) {
    SystemName const which = vehicle;
    std::string const name = change.arguments.name;
    if (auto const changed = co_await change_key(change, which, name); !changed)
      co_return host::refuse(changed.error());
    fmt::print("vehicle {} signs with {}\n", to_string(vehicle), name);
  }
  co_return host::exit_done;
}

base::Task<int> take(KeyChange& change, std::vector<SystemName> vehicles) {
  for (auto const& vehicle : vehicles) {
    change.listen(vehicle);
    auto const heard = co_await change.wait_for(vehicle);
    if (!heard) co_return host::refuse(heard.error());
    mavlink::Address const target{vehicle.system_id, mavlink::autopilot_component};
    if (auto done = co_await mavlink::take_key_away((*heard)->connection, target); !done)
      co_return host::refuse(done.error());
    if (auto kept = change.forget(vehicle); !kept) co_return host::refuse(kept.error());
    fmt::print("vehicle {} signs nothing any more; with these keys it is heard only if [unsigned] says so\n",
               to_string(vehicle));
  }
  co_return host::exit_done;
}

/// A key goes over the link as it is: only where nobody else listens.
base::Result<> check_links(SigningArguments const& of) {
  if (of.insecure) return {};
  for (auto const& text : of.links) {
    auto const link = host::parse_network_link(text);
    if (!link) return std::unexpected(link.error());
    if (!mavlink::is_local(to_string(link->url)))
      return base::fail(ErrorKind::invalid_input, fmt::format("whoever listens on {} would learn the key", text),
                        "use a serial line or loopback, or --insecure-setup if nobody can listen there");
  }
  return {};
}

int on_vehicles(SigningArguments const& of, base::Task<int> (*job)(KeyChange&, std::vector<SystemName>)) {
  auto vehicles = host::parse_vehicles(of.vehicles);
  if (!vehicles) return host::refuse(vehicles.error());
  if (auto safe = check_links(of); !safe) return host::refuse(safe.error());
  auto const ring = host::read_key_store(of.keys);
  if (!ring) return host::refuse(ring.error());
  if (!of.name.empty() && !ring->keys.contains(of.name))
    return host::refuse({ErrorKind::not_found, fmt::format("key store {}: there is no key {}", of.keys, of.name),
                         fmt::format("make it: lapwing signing new {} --keys {}", of.name, of.keys)});
  auto signing = host::read_signing(of.keys);
  if (!signing) return host::refuse(signing.error());
  host::LinkSession session(*std::move(signing), "signing");
  if (auto opened = session.open(of.links); !opened) return host::refuse(opened.error());
  for (auto const& vehicle : *vehicles)  // before anything is written
    if (auto const known = session.ground.network(vehicle.network); !known) return host::refuse(known.error());
  KeyChange change{session, of, *ring};
  return session.run(job(change, *std::move(vehicles)));
}

int make_key(SigningArguments const& of) {
  if (!mavlink::is_key_name(of.name))
    return host::refuse({ErrorKind::invalid_input, "a key's name has 1 to 40 letters, digits, - and _", ""});
  KeyRing ring;
  if (std::filesystem::exists(of.keys)) {
    auto known = host::read_key_store(of.keys);
    if (!known) return host::refuse(known.error());
    ring = *std::move(known);
  }
  if (ring.keys.contains(of.name))
    return host::refuse({ErrorKind::invalid_input,
                         fmt::format("key store {}: there is a key {} already", of.keys, of.name),
                         "a key is changed for another by its vehicle: lapwing signing rotate"});
  auto key = host::random_key();
  if (!of.import.empty()) {
    auto const other = host::read_signing(of.import);
    if (!other) return host::refuse(other.error());
    key = mavlink::key_for(*other->ring, 0).value_or(mavlink::SigningKey{});
  }
  if (!key) return host::refuse(key.error());
  if (ring.keys.empty()) ring.everybody = {of.name};
  ring.keys[of.name] = *key;
  if (auto written = host::write_key_store(of.keys, ring); !written) return host::refuse(written.error());
  fmt::print("{}: key {}{}\n", of.keys, of.name, ring.everybody == KeyRing::Use{of.name} ? ", for everybody" : "");
  return host::exit_done;
}

/// With keys of their own, of every network.
std::map<SystemName, KeyRing::Use> all_vehicles(KeyRing const& ring) {
  std::map<SystemName, KeyRing::Use> all;
  for (auto const& [id, use] : ring.vehicles) all[{"", id}] = use;
  for (auto const& [network, vehicles] : ring.networks)
    for (auto const& [id, use] : vehicles) all[{network, id}] = use;
  return all;
}

/// Names only: what signs is nobody's to see.
int show(SigningArguments const& of) {
  auto const ring = host::read_key_store(of.keys);
  if (!ring) return host::refuse(ring.error());
  for (auto const& [name, key] : ring->keys) fmt::print("key {}\n", name);
  if (!ring->everybody.empty()) fmt::print("everybody: {}\n", fmt::join(ring->everybody, ", "));
  for (auto const& [url, use] : ring->links) fmt::print("link {}: {}\n", url, fmt::join(use, ", "));
  for (auto const& [vehicle, use] : all_vehicles(*ring))
    fmt::print("vehicle {}: {}{}\n", to_string(vehicle), fmt::join(use, ", "),
               use.size() > 1 ? " (a change is under way)" : "");
  auto const& allowed = ring->unsigned_frames;
  fmt::print("heard without a signature: {}; systems {}; messages {}; RADIO_STATUS\n",
             allowed.local_links ? "whoever is on this machine or a serial line" : "nobody by the link",
             allowed.systems, allowed.messages);
  return host::exit_done;
}

int drop_key(SigningArguments const& of) {
  auto ring = host::read_key_store(of.keys);
  if (!ring) return host::refuse(ring.error());
  if (ring->keys.erase(of.name) == 0)
    return host::refuse({ErrorKind::not_found, fmt::format("key store {}: there is no key {}", of.keys, of.name), ""});
  auto const is_only = [&](KeyRing::Use& use) { return std::erase(use, of.name) > 0 && use.empty(); };
  for (auto const& [vehicle, use] : all_vehicles(*ring))
    if (is_only(vehicles_of(*ring, vehicle.network)[vehicle.system_id]))
      return host::refuse({ErrorKind::invalid_input,
                           fmt::format("{} is the only key of vehicle {}", of.name, to_string(vehicle)),
                           "change it first: lapwing signing rotate"});
  for (auto& [url, use] : ring->links)
    if (is_only(use))
      return host::refuse({ErrorKind::invalid_input, fmt::format("{} is the only key of link {}", of.name, url),
                           "name another in the file first"});
  (void)is_only(ring->everybody);
  if (auto written = host::write_key_store(of.keys, *ring); !written) return host::refuse(written.error());
  return host::exit_done;
}

// ---- options

using Arguments = std::shared_ptr<SigningArguments>;

CLI::App* add_verb(CLI::App& signing, Arguments const& arguments, std::string const& name, std::string const& help) {
  auto* verb = signing.add_subcommand(name, help);
  verb->add_option("--keys", arguments->keys, "The key store: a file that only its owner may read")->required();
  return verb;
}

CLI::App* add_vehicle_verb(CLI::App& signing, Arguments const& arguments, std::string const& name,
                           std::string const& help) {
  auto* verb = add_verb(signing, arguments, name, help);
  verb->add_option("--vehicle", arguments->vehicles, fmt::format("{} (may be repeated)", host::vehicle_help))
      ->required()
      ->allow_extra_args(false);
  verb->add_option("--link", arguments->links, "Where the vehicles are: a serial line, or loopback")
      ->allow_extra_args(false);
  verb->add_option("--wait", arguments->wait_s, "Seconds to wait for a vehicle")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  verb->add_flag("--insecure-setup", arguments->insecure, "Send keys over a link on which others may listen");
  return verb;
}

}  // namespace

void add_signing(CLI::App& program, int& exit_code) {
  auto const arguments = std::make_shared<SigningArguments>();
  auto* signing = begin_verb(program, "signing");
  signing->require_subcommand(1);
  auto* verb = add_verb(*signing, arguments, "new", "Make a key; the first of a store is for everybody");
  verb->add_option("name", arguments->name, "What to call it")->required();
  verb->add_option("--import", arguments->import, "Take the key or pass phrase of this file instead of a random one");
  verb->callback([arguments, &exit_code] { exit_code = make_key(*arguments); });
  for (auto const* name : {"setup", "rotate"}) {
    bool const is_setup = std::string_view(name) == "setup";
    verb = add_vehicle_verb(*signing, arguments, name,
                            is_setup ? "Give vehicles a key, and make sure that they sign with it"
                                     : "Change vehicles' key for another, both being accepted for a while");
    verb->add_option("--key", arguments->name, "Its name in the store")->required();
    verb->add_option("--overlap", arguments->overlap_s, "Seconds for which the old key is accepted as well")
        ->check(CLI::Range(1.0, 3600.0))
        ->capture_default_str();
    verb->callback([arguments, &exit_code] { exit_code = on_vehicles(*arguments, give); });
  }
  verb = add_vehicle_verb(*signing, arguments, "off", "Make vehicles sign nothing any more");
  verb->callback([arguments, &exit_code] { exit_code = on_vehicles(*arguments, take); });
  verb = add_verb(*signing, arguments, "drop", "Remove a key that no vehicle needs any more");
  verb->add_option("name", arguments->name, "Its name")->required();
  verb->callback([arguments, &exit_code] { exit_code = drop_key(*arguments); });
  verb = add_verb(*signing, arguments, "show", "Names of keys and who uses them; never a key");
  verb->callback([arguments, &exit_code] { exit_code = show(*arguments); });
}

}  // namespace lapwing::apps
