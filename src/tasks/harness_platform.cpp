#include "tasks/harness_platform.hpp"
#include "vehicle/connection_timeout.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace lapwing::tasks {
namespace {

using base::Duration;
using base::ErrorKind;
using base::fail;

/// `X:d` of the conformance cases.
class TimedTask final : public PlatformTask {
 public:
  TimedTask(std::string name, Duration length) : name_(std::move(name)), length_(length) {}
  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::optional<std::string> unsuited(VehicleInfo const&) const override { return std::nullopt; }
  [[nodiscard]] std::optional<geo::Wgs84> reference_position() const override { return std::nullopt; }
  [[nodiscard]] Duration length() const { return length_; }
  [[nodiscard]] bool fails() const { return name_ == "fail"; }

 private:
  std::string name_;
  Duration length_;
};

/// Ends when its time has come, if ever, with an error if it has one.
class TimedRun final : public TaskRun {
 public:
  TimedRun(base::Loop& loop, std::optional<Duration> length, std::string error, bool vehicle_failed = false)
      : loop_(loop), started_(loop.now()), length_(length), error_(std::move(error)), vehicle_failed_(vehicle_failed) {}
  [[nodiscard]] RunState state() const override {
    if (!length_ || loop_.now() - started_ < *length_) return RunState::in_progress;
    return error_.empty() ? RunState::done : RunState::failed;
  }
  [[nodiscard]] std::string error() const override { return error_; }
  [[nodiscard]] bool vehicle_failed() const override { return vehicle_failed_; }
  [[nodiscard]] std::string progress() const override {
    auto const passed_s = base::to_seconds(loop_.now() - started_);
    if (!length_) return fmt::format("{:.1f} s", passed_s);
    return fmt::format("{:.1f}/{:.1f} s", passed_s, base::to_seconds(*length_));
  }
  void stop() override {}

 private:
  base::Loop& loop_;
  base::TimePoint started_;
  std::optional<Duration> length_;
  std::string error_;
  bool vehicle_failed_;
};

std::vector<VehicleInfo> conformance_vehicles() {
  auto const vehicle = [](std::string id, std::string type, std::vector<std::string> payload, double lat_deg) {
    return VehicleInfo{.id = {std::move(id)},
                       .type = std::move(type),
                       .payload = std::move(payload),
                       .position = geo::Wgs84::from_degrees(lat_deg, -8.0),
                       .battery = 1.0,
                       .connection_timeout = vehicle::default_connection_timeout,
                       .mode = "HOLD",
                       .relative_alt_m = 0.0};
  };
  return {vehicle("a1", "UAV", {"Camera", "Sidescan"}, 41.0), vehicle("a2", "UAV", {"Camera"}, 41.01),
          vehicle("u1", "UUV", {"Sidescan", "Multibeam"}, 41.0), vehicle("u2", "UUV", {}, 42.0)};
}

}  // namespace

HarnessPlatform::HarnessPlatform(base::Loop& loop, Vocabulary vocabulary)
    : loop_(loop), changed_(loop), vehicles_(conformance_vehicles()), vocabulary_(std::move(vocabulary)) {}

base::Result<std::shared_ptr<PlatformTask const>> HarnessPlatform::named_task(std::string_view name) const {
  auto const colon = name.rfind(':');
  double seconds = -1.0;
  if (colon != std::string_view::npos) {
    auto const* const end = name.data() + name.size();
    auto const [stop, error] = std::from_chars(name.data() + colon + 1, end, seconds);
    if (error != std::errc() || stop != end) seconds = -1.0;
  }
  double constexpr longest_s = 1e9;  // what a base::Duration holds with room to spare
  if (!(seconds >= 0.0 && seconds <= longest_s)) {
    return fail(ErrorKind::not_found, fmt::format("there is no plan called '{}'", name),
                "plans of the test platform are written 'NAME:SECONDS', as in task('A:0.3')");
  }
  return std::make_shared<TimedTask const>(std::string(name.substr(0, colon)), base::from_seconds(seconds));
}

std::optional<VehicleInfo> HarnessPlatform::find(VehicleId const& id) const {
  auto const found = std::ranges::find(vehicles_, id, &VehicleInfo::id);
  if (found == vehicles_.end()) return std::nullopt;
  return *found;
}

void HarnessPlatform::set_connection_timeout(VehicleId const& id, base::Duration timeout) {
  auto const found = std::ranges::find(vehicles_, id, &VehicleInfo::id);
  if (found != vehicles_.end()) found->connection_timeout = timeout;
}

std::optional<std::string> HarnessPlatform::unsuited(PlatformTask const& task, VehicleInfo const& vehicle) const {
  if (auto const length = length_of(task, vehicle); !length) return length.error().message;
  return task.unsuited(vehicle);
}

std::unique_ptr<TaskRun> HarnessPlatform::start(std::shared_ptr<PlatformTask const> task, VehicleId const& id) {
  auto const vehicle = find(id);
  if (!vehicle || !vehicle->connected) {
    return std::make_unique<TimedRun>(loop_, Duration::zero(), fmt::format("vehicle {} is lost", id.text), true);
  }
  auto const* const timed = dynamic_cast<TimedTask const*>(task.get());
  if (timed && timed->fails()) return std::make_unique<TimedRun>(loop_, timed->length(), "boom");
  auto const length = length_of(*task, *vehicle);
  if (!length) return std::make_unique<TimedRun>(loop_, Duration::zero(), length.error().message);
  return std::make_unique<TimedRun>(loop_, *length, "");
}

base::Result<std::optional<Duration>> HarnessPlatform::length_of(PlatformTask const& task,
                                                                 VehicleInfo const& /*vehicle*/) const {
  if (auto const* const timed = dynamic_cast<TimedTask const*>(&task)) return timed->length();
  return fail(ErrorKind::refused, fmt::format("{} is a task of another platform", task.name()));
}

base::Task<void> HarnessPlatform::settle() {
  co_return;
}

void HarnessPlatform::set_vehicle(VehicleInfo vehicle) {
  auto const found = std::ranges::find(vehicles_, vehicle.id, &VehicleInfo::id);
  if (found == vehicles_.end()) {
    vehicles_.push_back(std::move(vehicle));
  } else {
    *found = std::move(vehicle);
  }
  changed_.notify_all();
}

}  // namespace lapwing::tasks
