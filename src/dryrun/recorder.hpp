#pragma once

#include <chrono>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dryrun/flight_record.hpp"
#include "tasks/task_view.hpp"

namespace lapwing::dryrun {

/// The true state of one vehicle at one moment.
struct Sample {
  geo::Ned place_m;
  std::string_view mode;
  double remaining = 1.0;  ///< of the battery, 0..1
  double used_mah = 0.0;
  double voltage_v = 0.0;
  bool in_the_air = false;
  bool moves = false;
};

/// Gathers what vehicles do into a record. Passive: whoever has the vehicles calls `sample` every `period()`.
///
/// Memory is bounded: when the points are too many every second one is dropped and the period doubles.
class Recorder {
 public:
  struct Options {
    base::Duration period = std::chrono::milliseconds(200);
    std::size_t max_points = 1'000'000;  ///< of all vehicles together
    std::size_t max_tasks = 2'000;       ///< of a vehicle; the first ones are kept
    std::size_t max_remarks = 1'000;
  };
  /// `vehicles` have their names and nothing else.
  Recorder(std::vector<VehicleRecord> vehicles, Options options);

  [[nodiscard]] base::Duration period() const { return period_; }
  /// One sample of each vehicle, in the order of the constructor. Precondition: `now` is later than the last time.
  void sample(base::Duration now, std::span<Sample const> vehicles);
  void note(tasks::TaskEvent const& event);
  void say(base::Duration now, std::string_view text);

  /// What was gathered; tasks that still run end at `now`.
  [[nodiscard]] FlightRecord finish(base::Duration now) const;

 private:
  void thin_out();

  Options options_;
  base::Duration period_;
  std::vector<VehicleRecord> vehicles_;
  std::vector<Sample> last_;
  std::vector<Remark> remarks_;
  std::string line_;  ///< said, but not ended yet
};

}  // namespace lapwing::dryrun
