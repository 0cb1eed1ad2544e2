#include "apps/vehicles/param/param_report.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/text/json.hpp"

namespace lapwing::apps {

namespace {

using nlohmann::ordered_json;
using parameters::Confirmed;
using parameters::Parameter;

std::string utc_text(base::UtcTime time) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                     fmt::gmtime(std::chrono::time_point_cast<std::chrono::seconds>(time).time_since_epoch().count()));
}

std::string written(ordered_json const& json) {
  return base::to_text(json, 2) + "\n";
}

/// As the vehicle holds it: 0.1, not the double that is nearest to that float.
ordered_json number(Parameter const& parameter) {
  if (mavlink::is_integer(parameter.type)) return parameter.value;
  return base::json_number<ordered_json>(base::shortest(static_cast<float>(parameter.value)));
}

ordered_json to_json(Parameter const& parameter) {
  return {{"name", parameter.name}, {"value", number(parameter)}, {"type", to_string(parameter.type)}};
}

ordered_json json_of(mavlink::SystemName const& vehicle) {
  ordered_json json{{"id", vehicle.system_id}};
  if (!vehicle.network.empty()) json["network"] = vehicle.network;
  return json;
}

std::string text_or_dash(std::optional<Parameter> const& parameter) {
  return parameter ? value_text(*parameter) : "-";
}

}  // namespace

std::string listing_text(std::vector<ParamListing> const& listings) {
  std::string text;
  for (auto const& listing : listings) {
    if (listings.size() > 1) text += fmt::format("# vehicle {}\n", to_string(listing.vehicle));
    if (listing.confirmed == Confirmed::not_at_all)
      text += fmt::format("# as of {}; not confirmed by the vehicle since\n", utc_text(listing.taken));
    for (auto const& parameter : listing.parameters)
      text += fmt::format("{:<16}  {:>14}  {}\n", parameter.name, value_text(parameter), to_string(parameter.type));
  }
  return text;
}

std::string listing_json(std::vector<ParamListing> const& listings) {
  auto vehicles = ordered_json::array();
  for (auto const& listing : listings) {
    auto all = ordered_json::array();
    for (auto const& parameter : listing.parameters) all.push_back(to_json(parameter));
    auto vehicle = json_of(listing.vehicle);
    if (!listing.firmware.empty()) vehicle["firmware"] = listing.firmware;
    vehicle["confirmed"] = to_string(listing.confirmed);
    vehicle["taken"] = utc_text(listing.taken);
    vehicle["parameters"] = std::move(all);
    vehicle["errors"] = listing.errors;
    vehicles.push_back(std::move(vehicle));
  }
  return written({{"vehicles", std::move(vehicles)}});
}

std::string changes_text(std::vector<ParamChanges> const& changes) {
  std::string text;
  for (auto const& of : changes) {
    for (auto const& [before, after] : of.changed)
      text += fmt::format("vehicle {}: {} = {} (was {})\n", to_string(of.vehicle), after.name, value_text(after),
                          value_text(before));
    for (auto const& [name, message] : of.failed)
      text += fmt::format("vehicle {}: {} NOT set: {}\n", to_string(of.vehicle), name, message);
    if (!of.skipped.empty())
      text += fmt::format("vehicle {}: left out, they belong to one vehicle: {}\n", to_string(of.vehicle),
                          fmt::join(of.skipped, " "));
    text += fmt::format("vehicle {}: {} set, {} as they were, {} left out, {} failed\n", to_string(of.vehicle),
                        of.changed.size(), of.unchanged, of.skipped.size(), of.failed.size());
  }
  return text;
}

std::string changes_json(std::vector<ParamChanges> const& changes) {
  auto vehicles = ordered_json::array();
  for (auto const& of : changes) {
    auto changed = ordered_json::array();
    for (auto const& [before, after] : of.changed)
      changed.push_back({{"name", after.name}, {"before", number(before)}, {"after", number(after)}});
    auto failed = ordered_json::array();
    for (auto const& [name, message] : of.failed) failed.push_back({{"name", name}, {"message", message}});
    auto vehicle = json_of(of.vehicle);
    vehicle["changed"] = std::move(changed);
    vehicle["unchanged"] = of.unchanged;
    vehicle["skipped"] = of.skipped;
    vehicle["failed"] = std::move(failed);
    vehicles.push_back(std::move(vehicle));
  }
  return written({{"vehicles", std::move(vehicles)}});
}

std::string differences_text(std::string const& first, std::string const& second,
                             std::vector<parameters::Difference> const& differences) {
  if (differences.empty()) return fmt::format("{} and {} have the same parameters\n", first, second);
  std::string text = fmt::format("{:<16}  {:>16}  {:>16}\n", "", first, second);
  for (auto const& [name, a, b] : differences)
    text += fmt::format("{:<16}  {:>16}  {:>16}\n", name, text_or_dash(a), text_or_dash(b));
  return text;
}

std::string differences_json(std::string const& first, std::string const& second,
                             std::vector<parameters::Difference> const& differences) {
  auto all = ordered_json::array();
  for (auto const& [name, a, b] : differences)
    all.push_back({{"name", name},
                   {"first", a ? number(*a) : ordered_json(nullptr)},
                   {"second", b ? number(*b) : ordered_json(nullptr)}});
  return written({{"first", first}, {"second", second}, {"differences", std::move(all)}});
}

}  // namespace lapwing::apps
