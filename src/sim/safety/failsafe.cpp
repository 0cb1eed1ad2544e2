#include "sim/safety/failsafe.hpp"

namespace lapwing::sim {

SilenceWatch::Event SilenceWatch::update(base::Duration now, bool enabled, base::Duration patience) {
  if (!enabled || !heard_) {
    active_ = false;
    return Event::none;
  }
  bool const silent = now - *heard_ > patience;
  if (silent == active_) return Event::none;
  active_ = silent;
  return silent ? Event::lost : Event::returned;
}

bool BatteryWatch::lasts(bool below, std::optional<base::Duration>& since, base::Duration now,
                         base::Duration patience) const {
  if (!below) {
    since.reset();
    return false;
  }
  if (!since) since = now;
  return now - *since >= patience;
}

std::optional<BatteryWatch::Level> BatteryWatch::update(base::Duration now, BatteryPack const& pack,
                                                        BatteryLimits const& limits) {
  double const volts = pack.voltage_v();
  double const left_mah = pack.capacity_mah() - pack.used_mah();
  bool const critical =
      lasts(volts < limits.critical_v, critical_since_, now, limits.patience) || left_mah < limits.critical_mah;
  bool const low = lasts(volts < limits.low_v, low_since_, now, limits.patience) || left_mah < limits.low_mah;
  auto const reached = critical ? Level::critical : low ? Level::low : Level::good;
  if (reached <= level_) return std::nullopt;
  level_ = reached;
  return reached;
}

}  // namespace lapwing::sim
