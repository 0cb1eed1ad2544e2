#include "parameters/service.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include <fmt/format.h>

#include "mavlink/connection/inbox.hpp"
#include "mavlink/exchange/command.hpp"
#include "mavlink/wire/modes.hpp"

namespace lapwing::parameters {

using base::ErrorKind;
using base::fail;
using namespace std::chrono_literals;

namespace {

/// A vehicle asks again for a mission item that got lost after a second or so.
constexpr base::Duration mission_pause = 2s;

/// After that whoever speaks under a system id may be another vehicle.
constexpr base::Duration longest_silence = 5s;

template <class Bytes>
std::string hexadecimal(Bytes const& bytes) {
  std::string text;
  for (unsigned const byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

bool is_zero(auto const& bytes) {
  return std::ranges::all_of(bytes, [](auto byte) { return byte == 0; });
}

Identity identity_of(mavlink::AutopilotVersion const& version, mavlink::MavAutopilot autopilot) {
  Identity identity;
  if (!is_zero(version.uid2)) {
    identity.uid = hexadecimal(version.uid2);
  } else if (version.uid != 0) {
    identity.uid = fmt::format("{:016x}", version.uid);
  }
  identity.firmware = version.flight_sw_version;
  identity.custom_version = hexadecimal(version.flight_custom_version);
  // PX4 of before the two flags says so by its name only.
  bool const tells = (version.capabilities & mavlink::capability_flag::param_encode_c_cast) != 0;
  bool const bytewise = (version.capabilities & mavlink::capability_flag::param_encode_bytewise) != 0;
  if (bytewise || (!tells && autopilot == mavlink::MavAutopilot::px4))
    identity.encoding = mavlink::ParamEncoding::bytewise;
  return identity;
}

}  // namespace

/// Goes before lists on its link while it lives.
class ParameterService::Single {
 public:
  explicit Single(LinkUse& link) : link_(link) { ++link_.singles; }
  Single(Single const&) = delete;
  Single& operator=(Single const&) = delete;
  ~Single() { --link_.singles; }

 private:
  LinkUse& link_;
};

/// Is the only list of its link while it lives.
class ParameterService::List {
 public:
  List(LinkUse& link, Vehicle& vehicle, base::Notifier& ended) : link_(link), vehicle_(vehicle), ended_(ended) {
    link_.has_list = vehicle_.is_listing = true;
  }
  List(List const&) = delete;
  List& operator=(List const&) = delete;
  ~List() {
    link_.has_list = vehicle_.is_listing = false;
    ended_.notify_all();
  }

 private:
  LinkUse& link_;
  Vehicle& vehicle_;
  base::Notifier& ended_;
};

ParameterService::ParameterService(mavlink::Connection& connection, Cache cache, base::Logger log)
    : connection_(connection),
      cache_(std::move(cache)),
      log_(std::move(log)),
      list_ended_(connection.loop()),
      subscription_(connection.subscribe([this](mavlink::Received const& received) { receive(received); })) {}

ParameterService::~ParameterService() {
  for (auto& [system_id, vehicle] : vehicles_) keep(vehicle);
}

void ParameterService::receive(mavlink::Received const& received) {
  note_mission(received);
  if (received.source.component != mavlink::autopilot_component) return;
  if (auto const* heartbeat = std::get_if<mavlink::Heartbeat>(&received.message)) {
    if (mavlink::family_of(heartbeat->type) == vehicle::Family::unknown) return;
    auto& vehicle = vehicles_[received.source.system];
    bool const was_away = received.at - vehicle.heard > longest_silence;
    if (was_away || heartbeat->autopilot != vehicle.info.autopilot) vehicle.may_be_another = true;
    vehicle.heard = received.at;
    vehicle.info = {received.source, heartbeat->type, heartbeat->autopilot};
    vehicle.link = received.from.link;
  } else if (auto const* value = std::get_if<mavlink::ParamValue>(&received.message)) {
    if (auto const found = vehicles_.find(received.source.system); found != vehicles_.end())
      correct_cache(found->second, *value);
  }
}

/// Whoever uploads or downloads: the vehicle's part of it is heard here.
void ParameterService::note_mission(mavlink::Received const& received) {
  auto const& message = received.message;
  bool const goes_on = std::holds_alternative<mavlink::MissionRequest>(message) ||
                       std::holds_alternative<mavlink::MissionRequestInt>(message) ||
                       std::holds_alternative<mavlink::MissionItem>(message);
  if (goes_on) links_[received.from.link].mission_until = received.at + mission_pause;
  if (std::holds_alternative<mavlink::MissionAck>(message)) links_[received.from.link].mission_until = received.at;
}

void ParameterService::correct_cache(Vehicle& vehicle, mavlink::ParamValue const& value) {
  if (!vehicle.cached || vehicle.is_listing || value.name == mavlink::hash_param) return;
  auto& cached = *vehicle.cached;
  if (value.count != 0 && value.count != cached.parameters.size()) {
    vehicle.cached.reset();
    return;
  }
  auto const known = std::ranges::find(cached.parameters, value.name, &Parameter::name);
  auto const now = mavlink::decode_param(value, vehicle.identity->encoding);
  if (known == cached.parameters.end() || mavlink::same_value(*known, now)) return;
  *known = now;
  cached.hash.reset();
  vehicle.cache_changed = true;
}

void ParameterService::keep(Vehicle& vehicle) {
  if (!std::exchange(vehicle.cache_changed, false) || !vehicle.cached) return;
  if (auto const stored = cache_.store(*vehicle.identity, *vehicle.cached); !stored) log_.warn(stored.error().message);
}

std::vector<ParameterService::VehicleInfo> ParameterService::vehicles() const {
  std::vector<VehicleInfo> all;
  for (auto const& [system_id, vehicle] : vehicles_) all.push_back(vehicle.info);
  return all;
}

base::Result<ParameterService::Vehicle*> ParameterService::find(std::uint8_t system_id) {
  auto const found = vehicles_.find(system_id);
  if (found == vehicles_.end())
    return fail(ErrorKind::lost, fmt::format("vehicle {} has not been heard", system_id),
                "check that it is switched on and sends to this station");
  return &found->second;
}

mavlink::ParamOptions ParameterService::options_for(Vehicle const& vehicle) const {
  return {.encoding = vehicle.identity->encoding};
}

/// Asks once, and again after a silence; a vehicle that does not answer is known by its heartbeat alone, and not
/// cached.
base::Task<> ParameterService::identify(Vehicle& vehicle) {
  if (vehicle.identity && !vehicle.may_be_another) co_return;
  auto const& info = vehicle.info;
  mavlink::Inbox versions(
      connection_, info.address,
      mavlink::wanting<mavlink::AutopilotVersion>([](mavlink::AutopilotVersion const&) { return true; }));
  auto const request = mavlink::request_message(mavlink::MessageId::autopilot_version);
  std::optional<mavlink::AutopilotVersion> version;
  for (int attempt = 0; attempt < 5 && !version; ++attempt) {
    mavlink::Message const message = mavlink::CommandLong{.command = request.id, .params = request.params};
    if (!connection_.send(info.address, message)) break;
    auto const got = co_await versions.next(connection_.loop().now() + 500ms);
    if (got) version = std::get<mavlink::AutopilotVersion>(*got);
  }
  if (vehicle.identity && !vehicle.may_be_another) co_return;  // another task was quicker
  vehicle.may_be_another = false;
  auto const identity = identity_of(version.value_or(mavlink::AutopilotVersion{}), info.autopilot);
  if (vehicle.identity == identity && !identity.uid.empty()) co_return;
  keep(vehicle);
  vehicle.identity = identity;
  vehicle.cached = cache_.find(*vehicle.identity);
}

base::Task<base::Result<Parameter>> ParameterService::read(std::uint8_t system_id, std::string name) {
  auto const vehicle = find(system_id);
  if (!vehicle) co_return std::unexpected(vehicle.error());
  Single const single(links_[(*vehicle)->link]);
  co_await identify(**vehicle);
  auto const options = options_for(**vehicle);
  auto result = co_await mavlink::read_param(connection_, (*vehicle)->info.address, name, options);
  keep(**vehicle);
  co_return result;
}

base::Task<base::Result<mavlink::ParamChange>> ParameterService::change(std::uint8_t system_id, std::string name,
                                                                        double value) {
  auto const vehicle = find(system_id);
  if (!vehicle) co_return std::unexpected(vehicle.error());
  Single const single(links_[(*vehicle)->link]);
  co_await identify(**vehicle);
  auto const options = options_for(**vehicle);
  auto result = co_await mavlink::set_param(connection_, (*vehicle)->info.address, name, value, options);
  keep(**vehicle);
  co_return result;
}

base::Task<bool> ParameterService::hash_is(Vehicle& vehicle, std::uint32_t hash) {
  mavlink::ParamOptions options = options_for(vehicle);
  options.tries = 4;
  std::string const name = mavlink::hash_param;
  auto const told = co_await mavlink::read_param(connection_, vehicle.info.address, name, options);
  co_return told && told->value == static_cast<double>(hash);
}

base::Task<base::Result<Snapshot>> ParameterService::all(std::uint8_t system_id, Wanted wanted,
                                                         mavlink::ParamProgress progress) {
  auto const found = find(system_id);
  if (!found) co_return std::unexpected(found.error());
  auto& vehicle = **found;
  co_await identify(vehicle);
  if (vehicle.cached && wanted == Wanted::cached_too)
    co_return Snapshot{vehicle.cached->parameters, vehicle.cached->taken, Confirmed::not_at_all, *vehicle.identity};
  if (vehicle.cached && vehicle.cached->hash) {
    auto const hash = *vehicle.cached->hash;
    if (co_await hash_is(vehicle, hash) && vehicle.cached && vehicle.cached->hash == hash)
      co_return Snapshot{vehicle.cached->parameters, vehicle.cached->taken, Confirmed::by_hash, *vehicle.identity};
  }
  auto& link = links_[vehicle.link];
  while (link.has_list) co_await list_ended_.wait();
  List const list(link, vehicle, list_ended_);
  mavlink::ParamListOptions options{.encoding = vehicle.identity->encoding};
  options.may_send = [&link, &loop = connection_.loop()] {
    return link.singles == 0 && loop.now() >= link.mission_until;
  };
  auto got = co_await mavlink::download_params(connection_, vehicle.info.address, options, progress);
  if (!got) co_return std::unexpected(got.error());
  auto const now = connection_.loop().utc_now();
  vehicle.cached = CachedParameters{.parameters = got->parameters, .taken = now, .hash = got->hash};
  vehicle.cache_changed = true;
  keep(vehicle);
  co_return Snapshot{std::move(got->parameters), now, Confirmed::by_vehicle, *vehicle.identity};
}

std::string firmware_text(std::uint32_t version) {
  return fmt::format("{}.{}.{}", version >> 24U, version >> 16U & 0xFFU, version >> 8U & 0xFFU);
}

}  // namespace lapwing::parameters
