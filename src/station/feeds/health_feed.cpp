#include "station/feeds/health_feed.hpp"

#include <utility>

#include <fmt/format.h>

#include "station/messages/health_messages.hpp"

namespace lapwing::station {

namespace {

constexpr base::Duration ages_period = std::chrono::seconds(1);

std::string what_matters(std::vector<vehicle::ModulesOfVehicle> const& vehicles) {
  std::string text;
  for (auto const& vehicle : vehicles) {
    text += fmt::format("{} {} {} {}\n", vehicle.vehicle.text, vehicle.may_move, vehicle.needs_restart, vehicle.who);
    for (auto const& module : vehicle.modules)
      text +=
          fmt::format("{} {} {}\n", module.short_name, to_string(module.state), module.error ? module.error->code : 0);
  }
  return text;
}

}  // namespace

std::uint64_t HealthFeed::refresh(base::TimePoint now) {
  auto matters = what_matters(modules_.modules(now));
  bool const is_due = revision_ == 0 || now - told_at_ >= ages_period;
  if (!is_due && matters == matters_) return revision_;
  matters_ = std::move(matters);
  told_at_ = now;
  return ++revision_;
}

/// With their ages as they are now.
News HealthFeed::since(std::uint64_t, base::TimePoint now, std::size_t) const {
  return {.is_whole = true, .frames = {{.content = health_message(modules_.modules(now)), .revision = revision_}}};
}

}  // namespace lapwing::station
