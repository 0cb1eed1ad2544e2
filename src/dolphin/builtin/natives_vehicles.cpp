#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>

#include "dolphin/builtin/internal/native_lists.hpp"
#include "dolphin/builtin/internal/pick_filter.hpp"
#include "dolphin/machine/fiber.hpp"
#include "dolphin/machine/runtime.hpp"
#include "dolphin/names/foreign_words.hpp"
#include "dolphin/names/row_parameters.hpp"
#include "dolphin/value/platform_arguments.hpp"
#include "dolphin/value/text.hpp"

/// Vehicles (language spec, 3.1).
namespace lapwing::dolphin::internal {
namespace {

using tasks::VehicleId;
using tasks::VehicleInfo;

// ---- pick

std::string as_log_text(PickFilter const& filter) {
  std::string payload;
  for (auto const& name : filter.payload) payload += (payload.empty() ? "" : "+") + name;
  return fmt::format("id={},type={},payload={},area={}", filter.id.value_or("<null>"), filter.type.value_or("<null>"),
                     payload.empty() ? "<null>" : payload, filter.region ? to_text(*filter.region) : "<null>");
}

void log_available(Runtime const& runtime) {
  std::vector<VehicleInfo> available;
  for (auto& info : runtime.platform.vehicles()) {
    bool const is_free = std::ranges::find(runtime.picked, info.id) == runtime.picked.end();
    if (is_free && info.connected) available.push_back(std::move(info));
  }
  runtime.log.info(fmt::format("Available nodes: {}", available.size()));
  for (auto const& info : available) runtime.log.info(fmt::format("  id={} type={}", info.id.text, info.type));
}

/// With what the script's author may have meant by a type that no vehicle has.
std::string unmet(PickFilter const& filter) {
  auto const meant = filter.type ? vehicle_type_meant(*filter.type) : std::string_view();
  return fmt::format("Could not find required vehicles!{}",
                     meant.empty() ? "" : fmt::format(" Perhaps type '{}' was meant.", meant));
}

/// The first `count` free vehicles that match, in the platform's order; nothing when there are fewer.
std::optional<std::vector<VehicleId>> chosen(Runtime const& runtime, PickFilter const& filter) {
  std::vector<VehicleId> ids;
  for (auto const& info : runtime.platform.vehicles()) {
    bool const is_free = std::ranges::find(runtime.picked, info.id) == runtime.picked.end();
    if (ids.size() < filter.count && is_free && info.connected && objections(filter, info).empty())
      ids.push_back(info.id);
  }
  if (ids.size() < filter.count) return std::nullopt;
  return ids;
}

std::vector<std::string> why_not(Runtime const& runtime, PickFilter const& filter) {
  return why_not_picked(filter, runtime.platform.vehicles(), runtime.picked);
}

/// Says what `pick` waits for: after three seconds, and then every ten.
class PickWords {
 public:
  PickWords(Runtime const& runtime, PickFilter const& filter, base::TimePoint deadline)
      : runtime_(runtime), filter_(filter), begun_(runtime.loop.now()), deadline_(deadline) {}

  [[nodiscard]] base::TimePoint due() const { return next_; }

  void tell_if_due() {
    auto const now = runtime_.loop.now();
    if (now < next_) return;
    next_ += std::chrono::seconds(10);
    runtime_.log.info(fmt::format("pick waits for {}, {:.0f} of {:.0f} s: {}", pick_text(filter_),
                                  base::to_seconds(now - begun_), base::to_seconds(deadline_ - begun_),
                                  fmt::join(why_not(runtime_, filter_), "; ")));
  }

 private:
  Runtime const& runtime_;
  PickFilter const& filter_;
  base::TimePoint begun_;
  base::TimePoint deadline_;
  base::TimePoint next_ = begun_ + std::chrono::seconds(3);
};

base::Task<Checked<Value>> pick(Runtime& runtime, Fiber& /*fiber*/, std::vector<Value> arguments) {
  // Arrivals wake us; a vehicle that flies into a region, or learns its position, is seen within this time.
  constexpr base::Duration look_again = std::chrono::seconds(1);
  auto const* fields = arguments[0].as<Map>();
  if (!fields) co_return fault("pick takes a block: pick { type 'UAV' }", "IllegalArgumentException");
  auto const filter = pick_filter(*fields);
  auto const deadline = std::max(runtime.loop.now() + filter.timeout, runtime.platform.all_heard_by());
  log_available(runtime);
  runtime.log.info(fmt::format("Matching requirement: {} count={}", as_log_text(filter), filter.count));
  PickWords words(runtime, filter, deadline);
  auto ids = chosen(runtime, filter);
  while (!ids && runtime.loop.now() < deadline) {
    auto const next = std::min({deadline, runtime.loop.now() + look_again, words.due()});
    co_await runtime.platform.vehicles_changed().wait_until(next);
    ids = chosen(runtime, filter);
    if (!ids) words.tell_if_due();
  }
  if (!ids) {
    runtime.log.info("Requirements were not met!");
    for (auto const& line : why_not(runtime, filter)) runtime.log.info("  " + line);
    co_return halting(unmet(filter), "VehicleError");
  }
  for (auto const& id : *ids) {
    runtime.log.info("Requirement met by node " + id.text);
    runtime.picked.push_back(id);
    runtime.platform.set_connection_timeout(id, runtime.connection_timeout);
  }
  Value const set(runtime.heap.make<Vehicles>(std::move(*ids)));
  runtime.log.info("Selected nodes: " + to_text(set));
  co_return set;
}

// ---- other instructions for vehicles

std::optional<std::vector<VehicleId>> members(Value const& value) {
  if (auto const* set = value.as<Vehicles>()) return set->ids;
  if (auto const* one = value.as<Vehicle>()) return std::vector{one->value};
  return std::nullopt;
}

std::unexpected<Fault> no_vehicles(std::string_view what, Value const& given) {
  return fault(fmt::format("{} takes a vehicle set, not {}", what, kind_name(given)), "IllegalArgumentException");
}

Checked<Value> release(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  auto const ids = members(arguments[0]);
  if (!ids) return no_vehicles("release", arguments[0]);
  for (auto const& id : *ids) {
    if (runtime.execution) runtime.execution->withdraw(id);
    if (std::erase(runtime.picked, id) == 0)
      runtime.log.warn(fmt::format("release: vehicle {} was not picked", id.text));
  }
  runtime.platform.vehicles_changed().notify_all();  // another fiber may be waiting to pick these
  return Value();
}

Checked<VehicleInfo> single_vehicle(Runtime& runtime, Value const& value, std::string_view what) {
  auto const ids = members(value);
  if (!ids) return no_vehicles(what, value);
  if (ids->size() != 1) return halting("Set must represent a single vehicle!");
  auto info = runtime.platform.find(ids->front());
  if (!info) return fault(fmt::format("vehicle {} is not known any more", ids->front().text), "IllegalStateException");
  return *info;
}

/// At once, which is what guards get: an unknown place is near no other and in no area.
Checked<Value> position(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  auto const info = single_vehicle(runtime, arguments[0], "position");
  if (!info) return std::unexpected(info.error());
  constexpr auto unknown = std::numeric_limits<double>::quiet_NaN();
  return Value(runtime.heap.make<Position>(info->position.value_or(geo::Wgs84{unknown, unknown, unknown})));
}

/// The same once the vehicle has had its connection timeout to report where it is.
base::Task<Checked<Value>> position_when_reported(Runtime& runtime, Fiber& fiber, std::vector<Value> arguments) {
  auto info = single_vehicle(runtime, arguments[0], "position");
  if (!info) co_return std::unexpected(info.error());
  auto const deadline = runtime.loop.now() + info->connection_timeout;
  while (info && !info->position && runtime.loop.now() < deadline) {
    co_await runtime.loop.sleep(runtime.tick);
    info = single_vehicle(runtime, arguments[0], "position");
  }
  if (info && !info->position)
    co_return fault(fmt::format("the position of vehicle {} is not known", info->id.text), "IllegalStateException");
  co_return position(runtime, fiber, arguments);
}

/// Not known is NaN, with which every comparison is false (REC-21). At once: what guards get.
Checked<Value> battery(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  auto const info = single_vehicle(runtime, arguments[0], "battery");
  if (!info) return std::unexpected(info.error());
  if (info->battery) return Value::real(*info->battery);
  if (runtime.batteries_warned_of.insert(info->id).second) {
    runtime.log.warn(
        fmt::format("the battery of vehicle {} is not known: comparisons with it are false", info->id.text));
  }
  return Value::real(std::numeric_limits<double>::quiet_NaN());
}

/// The same once the vehicle has had its connection timeout, one time, to report for the first time.
base::Task<Checked<Value>> battery_when_reported(Runtime& runtime, Fiber& fiber, std::vector<Value> arguments) {
  auto info = single_vehicle(runtime, arguments[0], "battery");
  if (info && runtime.batteries_waited_for.insert(info->id).second) {
    auto const deadline = runtime.loop.now() + info->connection_timeout;
    while (info && info->battery_is_awaited && runtime.loop.now() < deadline) {
      co_await runtime.loop.sleep(runtime.tick);
      info = single_vehicle(runtime, arguments[0], "battery");
    }
  }
  co_return battery(runtime, fiber, arguments);
}

/// Above the vehicle's home, not above the ground below it (REC-45).
Checked<Value> relative_height(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  auto const info = single_vehicle(runtime, arguments[0], "relativeHeight");
  if (!info) return std::unexpected(info.error());
  return Value::real(info->relative_alt_m.value_or(std::numeric_limits<double>::quiet_NaN()));
}

/// What a robot has seen of its floor, or a survey drone of its car park; of whoever maps nothing it is not known.
Checked<Value> coverage(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  auto const info = single_vehicle(runtime, arguments[0], "coverage");
  if (!info) return std::unexpected(info.error());
  return Value::real(info->coverage.value_or(std::numeric_limits<double>::quiet_NaN()));
}

/// Of the places to park that a survey drone has found; none before the first.
Checked<Value> slots_of(Runtime& runtime, Value const& vehicle, std::string_view what,
                        std::size_t vehicle::SlotCounts::* count) {
  auto const info = single_vehicle(runtime, vehicle, what);
  if (!info) return std::unexpected(info.error());
  return Value::integer(info->slots ? static_cast<std::int64_t>((*info->slots).*count) : 0);
}

Checked<Value> free_slots(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  return slots_of(runtime, arguments[0], "freeSlots", &vehicle::SlotCounts::free);
}

Checked<Value> taken_slots(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  return slots_of(runtime, arguments[0], "takenSlots", &vehicle::SlotCounts::taken);
}

/// By the signs that it has read; of whoever reads none there are none.
Checked<Value> found_doors(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  auto const info = single_vehicle(runtime, arguments[0], "foundDoors");
  if (!info) return std::unexpected(info.error());
  return Value::integer(static_cast<std::int64_t>(info->doors));
}

Checked<Value> mode(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  auto const info = single_vehicle(runtime, arguments[0], "mode");
  if (!info) return std::unexpected(info.error());
  return Value(runtime.heap.make<Text>(info->mode));
}

Checked<Value> connected(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  auto const info = single_vehicle(runtime, arguments[0], "connected");
  if (!info) return std::unexpected(info.error());
  return Value::boolean(info->connected);
}

Checked<base::Duration> valid_timeout(Value const& value) {
  bool const is_valid = value.is_number() && value.number() >= 5.0 && value.number() <= 3600.0;
  if (!is_valid)
    return fault(fmt::format("Invalid timeout value {}: 5 to 3600 seconds", to_text(value)),
                 "IllegalArgumentException");
  return base::from_seconds(value.number());
}

/// For vehicles picked from now on and those picked already (REC-5).
Checked<Value> set_connection_timeout(Runtime& runtime, Fiber& /*fiber*/, Arguments arguments) {
  auto const timeout = valid_timeout(arguments[0]);
  if (!timeout) return std::unexpected(timeout.error());
  runtime.connection_timeout = *timeout;
  for (auto const& id : runtime.picked) runtime.platform.set_connection_timeout(id, *timeout);
  return Value();
}

Checked<Value> set_connection_timeouts(Runtime& runtime, Fiber& /*fiber*/, Arguments parts) {
  for (std::size_t i = 0; i < parts.size(); i += 3) {
    auto const timeout = valid_timeout(parts[i + 2]);
    if (!timeout) return std::unexpected(timeout.error());
    auto const ids = members(parts[i + 1]);
    if (!ids) return halting(fmt::format("'{}' does not identify a vehicle set", to_text(parts[i])));
    for (auto const& id : *ids) runtime.platform.set_connection_timeout(id, *timeout);
  }
  return Value();
}

/// `name: value` of an instruction.
Checked<std::vector<tasks::NamedValue>> named_values(std::string_view instruction, Map const* given) {
  std::vector<tasks::NamedValue> values;
  if (!given) return values;
  for (auto const& [name, value] : given->items()) {
    auto converted = named_value(value);
    if (!converted)
      return fault(fmt::format("{}: {} takes a number or a text, not {}", instruction, to_text(name), kind_name(value)),
                   "IllegalArgumentException");
    values.push_back({to_text(name), *std::move(converted)});
  }
  return values;
}

/// An instruction of the platform's: its name, then its named values if it has any, the vehicles, and the rest.
Checked<Value> vehicle_instruction(Runtime& runtime, Fiber& /*fiber*/, Arguments given) {
  auto const name = to_text(given[0]);
  auto const& known = runtime.platform.vocabulary().instructions;
  auto const spec = std::ranges::find(known, name, &tasks::VehicleInstruction::name);
  if (spec == known.end())
    return fault(fmt::format("this platform cannot carry out {}", name), "MissingMethodException");
  auto const* named = given[1].as<Map>();
  auto const rest = given.subspan(named ? 2 : 1);
  auto const ids = rest.empty() ? std::nullopt : members(rest[0]);
  auto const arguments = ids ? fitted(spec->parameters, rest.subspan(1)) : std::nullopt;
  if (!arguments || (named && !spec->takes_values))
    return fault(fmt::format("{} {}", name, spec->usage), "IllegalArgumentException");
  if (auto const wrong = wrong_value(spec->parameters, *arguments))
    return fault(fmt::format("{}: {}", name, *wrong), "IllegalArgumentException");
  auto const values = named_values(name, named);
  if (!values) return std::unexpected(values.error());
  for (auto const& id : *ids) {
    if (std::ranges::find(runtime.picked, id) == runtime.picked.end())
      return fault(fmt::format("{}: vehicle {} is not picked", name, id.text), "IllegalStateException");
  }
  for (auto const& id : *ids) {
    auto const done = runtime.platform.perform({.name = name, .arguments = *arguments, .values = *values}, id);
    if (done) continue;
    auto const& [kind, text, hint] = done.error();
    return fault(fmt::format("{} to {}: {}{}{}", name, id.text, text, hint.empty() ? "" : ": ", hint),
                 "IllegalArgumentException");
  }
  return Value();
}

}  // namespace

std::vector<InstructionSpec> vehicle_words() {
  using namespace rows;
  return {
      {.name = "pick",
       .signatures = {takes({plain("fields", closure)})},
       .result = vehicles,
       .doc = "Takes vehicles that are connected, free, and fit the fields, waiting for them up to `timeout`. They "
              "stay picked until `release` or the end of the script. When there are not enough, none is taken and a "
              "VehicleError is thrown, which halts the script unless it is caught.",
       .block = BlockKind::pick,
       .example = "v = pick { type 'UAV'; count 2; timeout 30.seconds }",
       .start = pick},
      {.name = "release",
       .signatures = {takes({plain("vehicles", vehicles)})},
       .doc = "Stops what runs on the vehicles and gives them back; they may be picked again.",
       .example = "v = pick {}\nrelease v",
       .call = release},
      {.name = "position",
       .signatures = {takes({plain("vehicle", vehicles)})},
       .result = place,
       .doc = "Where the one vehicle of the set is. Waits for the first report, except in guards, up to the connection "
              "timeout. Unknown in a guard: every comparison with it is false.",
       .example = "v = pick {}\nmessage position(v).distanceTo(location(41.178, -8.598))",
       .call = position,
       .start = position_when_reported},
      {.name = "battery",
       .signatures = {takes({plain("vehicle", vehicles)})},
       .result = number,
       .doc = "What is left in the battery of the one vehicle of the set, 0 to 1. Waits for the first report, except "
              "in guards, up to the connection timeout. Unknown: NaN, and every comparison is false.",
       .dimension = Dimension::ratio,
       .example = "v = pick {}\nexecute waitFor { battery(v) >= 90.percent } then idle(1)",
       .call = battery,
       .start = battery_when_reported},
      {.name = "relativeHeight",
       .signatures = {takes({plain("vehicle", vehicles)})},
       .result = number,
       .doc = "Metres of the one vehicle of the set above its home. Unknown: NaN, and every comparison is false.",
       .dimension = Dimension::length,
       .call = relative_height},
      {.name = "coverage",
       .signatures = {takes({plain("vehicle", vehicles)})},
       .result = number,
       .doc = "What the one vehicle of the set has seen of what it maps, 0 to 1: a robot of its floor, as far as there "
              "seems to be one, a survey drone of its car park. Unknown: NaN, and every comparison is false.",
       .dimension = Dimension::ratio,
       .example = "v = pick {}\nexecute waitFor { coverage(v) >= 90.percent } then idle(1)",
       .call = coverage},
      {.name = "freeSlots",
       .signatures = {takes({plain("vehicle", vehicles)})},
       .result = number,
       .doc = "How many free places to park the one vehicle of the set, a survey drone, has found.",
       .example = "v = pick {}\nexecute waitFor { freeSlots(v) >= 10 } then idle(1)",
       .call = free_slots},
      {.name = "takenSlots",
       .signatures = {takes({plain("vehicle", vehicles)})},
       .result = number,
       .doc = "How many places to park with a car on them the one vehicle of the set, a survey drone, has found.",
       .call = taken_slots},
      {.name = "foundDoors",
       .signatures = {takes({plain("vehicle", vehicles)})},
       .result = number,
       .doc = "How many doors the one vehicle of the set, a robot with cameras, has found by the signs beside them.",
       .example = "v = pick {}\nexecute waitFor { foundDoors(v) >= 4 } then idle(1)",
       .call = found_doors},
      {.name = "mode",
       .signatures = {takes({plain("vehicle", vehicles)})},
       .result = text,
       .doc = "The flight mode of the one vehicle of the set, as its autopilot calls it: 'AUTO'.",
       .call = mode},
      {.name = "connected",
       .signatures = {takes({plain("vehicle", vehicles)})},
       .result = Kind::boolean,
       .doc = "Whether the one vehicle of the set has been heard within its connection timeout.",
       .call = connected},
      {.name = "setConnectionTimeout",
       .signatures = {takes({seconds("timeout")})},
       .doc = "After how long a silence a vehicle counts as lost, 5 s to 1 h: for all picked ones and later picks, or "
              "`v1: 30.seconds` for some. 20 s until it is set.",
       .named = NamedArguments::vehicles,
       .example = "v = pick {}\nsetConnectionTimeout 60.seconds\nsetConnectionTimeout v: 2.minutes",
       .call = set_connection_timeout},
  };
}

std::vector<InstructionSpec> vehicle_helpers() {
  return {
      {.name = "setConnectionTimeout keyed", .call = set_connection_timeouts},
      {.name = "vehicle instruction", .call = vehicle_instruction},
  };
}

}  // namespace lapwing::dolphin::internal
