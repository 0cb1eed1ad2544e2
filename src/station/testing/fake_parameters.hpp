#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/async/loop.hpp"
#include "vehicle/parameters.hpp"

namespace lapwing::station::testing {

/// Made-up parameters of vehicle 2, which take their time: WPNAV_SPEED goes up to 2000, RTL_ALT is an integer.
class FakeParameters : public vehicle::VehicleParameters {
 public:
  explicit FakeParameters(base::Loop& loop, base::Duration fetch_time = {}) : loop_(loop), fetch_time_(fetch_time) {
    values_ = {{"RTL_ALT", 1500.0, "int32"}, {"WPNAV_SPEED", 1000.0, "real32"}, {"COMPASS_DEC", 0.1F, "real32"}};
    for (int i = 1; i <= 16; ++i) values_.push_back({fmt::format("SERVO{}_MIN", i), 1100.0, "int16"});
  }

  [[nodiscard]] bool has(vehicle::VehicleId const& id) const override { return id.text == "2"; }
  base::Task<base::Result<vehicle::ParameterList>> all(vehicle::VehicleId id, bool old_ones_do) override {
    if (auto const known = check(id); !known) co_return std::unexpected(known.error());
    auto& progress = progress_[id];
    for (progress = {0, values_.size()}; !old_ones_do && progress.done < progress.total; ++progress.done)
      co_await loop_.sleep(fetch_time_ / static_cast<int>(values_.size()));
    progress_.erase(id);
    co_return vehicle::ParameterList{
        .parameters = values_,
        .taken = loop_.utc_now(),
        .confirmed = old_ones_do ? vehicle::Confirmed::not_at_all : vehicle::Confirmed::by_vehicle};
  }
  std::optional<vehicle::ParameterProgress> progress(vehicle::VehicleId const& id) const override {
    auto const found = progress_.find(id);
    return found == progress_.end() ? std::nullopt : std::optional(found->second);
  }
  base::Task<base::Result<std::string>> file(vehicle::VehicleId id, bool) override {
    if (auto const known = check(id); !known) co_return std::unexpected(known.error());
    co_return std::string("2\t1\tRTL_ALT\t1500\t6\n");
  }
  base::Task<base::Result<vehicle::Parameter>> read(vehicle::VehicleId id, std::string name) override {
    if (auto const known = check(id); !known) co_return std::unexpected(known.error());
    auto const found = std::ranges::find(values_, name, &vehicle::Parameter::name);
    if (found == values_.end())
      co_return base::fail(base::ErrorKind::timed_out,
                           fmt::format("vehicle {} did not answer about parameter {}", id.text, name),
                           "check the name");
    co_return *found;
  }
  base::Task<base::Result<vehicle::ParameterChange>> change(vehicle::VehicleId id, std::string name, double value,
                                                            vehicle::Commander by) override {
    changed_by = by;
    auto const before = co_await read(id, name);
    if (!before) co_return std::unexpected(before.error());
    if (before->type != "real32" && value != static_cast<int>(value))
      co_return base::fail(base::ErrorKind::invalid_input,
                           fmt::format("{} cannot be {}: it is an integer", name, value));
    auto& now = *std::ranges::find(values_, name, &vehicle::Parameter::name);
    now.value = name == "WPNAV_SPEED" ? std::min(value, 2000.0) : value;
    if (now.value != value)
      co_return base::fail(base::ErrorKind::refused,
                           fmt::format("vehicle {} stored {} = {}, not {}", id.text, name, now.value, value),
                           "the vehicle limits it");
    co_return vehicle::ParameterChange{*before, now};
  }

  vehicle::Commander changed_by;
  std::map<std::string, base::Error> refusals;  ///< by vehicle

 private:
  [[nodiscard]] base::Result<> check(vehicle::VehicleId const& id) const {
    if (auto const refusal = refusals.find(id.text); refusal != refusals.end()) return std::unexpected(refusal->second);
    if (id.text == "2") return {};
    return base::fail(base::ErrorKind::not_found, fmt::format("there is no vehicle {}", id.text));
  }

  base::Loop& loop_;
  base::Duration fetch_time_;
  std::vector<vehicle::Parameter> values_;
  std::map<vehicle::VehicleId, vehicle::ParameterProgress> progress_;
};

}  // namespace lapwing::station::testing
