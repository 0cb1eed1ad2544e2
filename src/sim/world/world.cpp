#include "sim/world/world.hpp"

#include <set>
#include <string_view>

#include <fmt/core.h>

#include "base/text/spelling.hpp"

namespace lapwing::sim {

namespace {

constexpr int parking_columns = 10;
constexpr double parking_spacing_m = 4.0;

}  // namespace

World::World(base::Loop& loop, WorldOptions options, base::Logger log)
    : World(loop, options, [&loop, url = options.out] { return link::open(loop, url); }, std::move(log)) {}

World::World(base::Loop& loop, WorldOptions options, OpenLink open_link, base::Logger log)
    : loop_(loop),
      options_(std::move(options)),
      open_link_(std::move(open_link)),
      log_(std::move(log)),
      site_(options_.home) {
  int system_id = options_.first_system_id;
  for (auto const& group : options_.vehicles) {
    for (int i = 0; i < group.count; ++i) park(group, system_id++);
  }
}

void World::park(VehicleGroup const& group, int system_id) {
  auto const place = static_cast<int>(vehicles_.size());
  auto const row = place / parking_columns;
  auto const seed = options_.seed * 1000003 + static_cast<std::uint64_t>(system_id);
  Vehicle::Options const options{
      .kind = {group.family, group.firmware},
      .system_id = static_cast<std::uint8_t>(system_id),
      .start = {parking_spacing_m * row, parking_spacing_m * (place % parking_columns), 0.0},
      .heading_rad = options_.heading_rad,
      .altitude_error_m = group.firmware == vehicle::Autopilot::px4 ? 0.0 : options_.altitude_error_m,
      .boot = options_.boot == BootStyle::quick ? quick_boot() : realistic_boot(),
      .battery_capacity_mah = options_.battery_capacity_mah,
      .battery_remaining = group.battery_remaining,
      .battery_swap_after = options_.battery_swap_after,
      .wind_m_s = options_.wind_m_s,
      .gust_m_s = options_.gust_m_s,
      .seed = seed,
      .signing_key =
          options_.keys ? mavlink::key_for(*options_.keys, static_cast<std::uint8_t>(system_id)) : std::nullopt,
  };
  auto impairment = options_.impairment;
  impairment.seed = seed;
  bool const impaired = impairment.loss > 0.0 || impairment.duplication > 0.0 ||
                        impairment.delay > base::Duration::zero() || impairment.jitter > base::Duration::zero();
  auto open = [this, impairment, impaired]() -> base::Result<std::unique_ptr<link::ByteLink>> {
    auto link = open_link_();
    if (!link || !impaired) return link;
    return link::impair(loop_, std::move(*link), impairment);
  };
  auto log = log_.named(fmt::format("{} {}", vehicle::to_string(group.family), system_id));
  vehicles_.push_back(std::make_unique<Vehicle>(loop_, options, site_, std::move(open), std::move(log)));
}

base::Result<> World::start() {
  int const last = options_.first_system_id + static_cast<int>(vehicles_.size()) - 1;
  if (options_.first_system_id < 1 || last > 254) {
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("system ids {} to {} do not exist", options_.first_system_id, last),
                      "MAVLink counts systems from 1 to 254");
  }
  if (auto set = set_parameters(); !set) return set;
  for (auto const& vehicle : vehicles_) {
    if (auto on = vehicle->power_on(); !on) return on;
  }
  return {};
}

base::Result<> World::set_parameters() {
  for (auto const& [name, value] : options_.parameters) {
    bool known = false;
    for (auto const& vehicle : vehicles_) known |= vehicle->parameters().set(name, value);
    if (known) continue;
    std::set<std::string_view> names;
    for (auto const& vehicle : vehicles_) {
      for (auto const& parameter : vehicle->parameters().all()) names.insert(parameter.name);
    }
    std::vector<std::string_view> const candidates(names.begin(), names.end());
    return base::fail(base::ErrorKind::invalid_input, fmt::format("no simulated vehicle has a parameter {}", name),
                      base::did_you_mean(name, candidates));
  }
  return {};
}

Vehicle* World::find(int system_id) {
  for (auto const& vehicle : vehicles_) {
    if (vehicle->options().system_id == system_id) return vehicle.get();
  }
  return nullptr;
}

}  // namespace lapwing::sim
