#include "slam/readers/log_builder.hpp"

#include <algorithm>

namespace lapwing::slam {
namespace {

void find_no_return(Sensor& sensor, int number, std::vector<Scan> const& scans) {
  constexpr float same = 0.995F;
  constexpr double often = 0.0005;  // of all readings; a real wall is seldom the farthest thing so often
  float largest = 0.0F;
  std::size_t count = 0;
  for (auto const& scan : scans) {
    if (scan.sensor != number) continue;
    for (auto const range : scan.ranges_m) {
      if (!(range < sensor.no_return_m)) continue;
      largest = std::max(largest, range);
      ++count;
    }
  }
  std::size_t at_largest = 0;
  for (auto const& scan : scans)
    if (scan.sensor == number)
      at_largest += static_cast<std::size_t>(std::ranges::count_if(
          scan.ranges_m, [&](float range) { return range < sensor.no_return_m && range >= same * largest; }));
  constexpr std::size_t again_and_again = 20;
  if (at_largest >= again_and_again && static_cast<double>(at_largest) > often * static_cast<double>(count))
    sensor.no_return_m = same * largest;
}

/// Whether the stamps say when scans were taken. Logs that were corrected afterwards often have one for all, or so few
/// digits that most are equal.
bool tell_time(std::vector<Scan> const& scans) {
  std::size_t equal = 0;
  for (std::size_t i = 1; i < scans.size(); ++i) equal += scans[i].time == scans[i - 1].time ? 1 : 0;
  return 2 * equal <= scans.size();
}

void number(std::vector<Scan>& scans) {
  constexpr double scans_per_s = 10.0;
  for (std::size_t i = 0; i < scans.size(); ++i) scans[i].time = LogTime(static_cast<double>(i) / scans_per_s);
}

/// Recordings of several processes are out of order by moments; where stamps go back by more, a clock has begun anew,
/// and what follows was taken after what stands before it.
void go_on_where_clocks_begin_anew(std::vector<Scan>& scans) {
  constexpr LogTime out_of_order(60.0);
  constexpr LogTime pause(0.1);
  LogTime shift(0.0);
  auto last = scans.empty() ? LogTime(0.0) : scans.front().time;
  for (auto& scan : scans) {
    if (scan.time + shift < last - out_of_order) shift = last + pause - scan.time;
    scan.time += shift;
    last = scan.time;
  }
}

}  // namespace

std::optional<int> LogBuilder::sensor(Sensor const& sensor) {
  auto const found = std::ranges::find(log_.sensors, sensor);
  if (found != log_.sensors.end()) return static_cast<int>(found - log_.sensors.begin());
  if (log_.sensors.size() == most_sensors) return std::nullopt;
  log_.sensors.push_back(sensor);
  return static_cast<int>(log_.sensors.size()) - 1;
}

bool LogBuilder::add(Scan scan) {
  readings_ += scan.ranges_m.size();
  if (readings_ > most_readings) return false;
  log_.scans.push_back(std::move(scan));
  return true;
}

ScanLog LogBuilder::finish() && {
  log_.has_times = tell_time(log_.scans);
  log_.has_times ? go_on_where_clocks_begin_anew(log_.scans) : number(log_.scans);
  // What has one time stays in the order of the file.
  std::ranges::stable_sort(log_.scans, {}, &Scan::time);
  for (int s = 0; s < static_cast<int>(log_.sensors.size()); ++s) find_no_return(log_.sensors[s], s, log_.scans);
  log_.has_odometry =
      std::ranges::any_of(log_.scans, [&](Scan const& scan) { return scan.odometry != log_.scans.front().odometry; });
  return std::move(log_);
}

}  // namespace lapwing::slam
