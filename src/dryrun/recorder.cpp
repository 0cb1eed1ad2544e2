#include "dryrun/recorder.hpp"

#include <algorithm>
#include <utility>

#include "base/assert.hpp"

namespace lapwing::dryrun {

using base::Duration;
using End = TaskSpan::End;
using Kind = tasks::TaskEvent::Kind;

namespace {

End ending_of(Kind kind) {
  if (kind == Kind::done) return End::done;
  return kind == Kind::error ? End::failed : End::stopped;
}

/// Keeps the first of each two.
template <class T>
void drop_every_second(std::vector<T>& values) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); i += 2) values[kept++] = values[i];
  values.resize(kept);
}

}  // namespace

std::string_view to_string(End end) {
  switch (end) {
    case End::running: return "running";
    case End::done: return "done";
    case End::failed: return "failed";
    case End::stopped: return "stopped";
  }
  return "failed";
}

Recorder::Recorder(std::vector<VehicleRecord> vehicles, Options options)
    : options_(options), period_(options.period), vehicles_(std::move(vehicles)) {}

void Recorder::sample(Duration now, std::span<Sample const> samples) {
  LAPWING_ASSERT(samples.size() == vehicles_.size(), samples.size(), vehicles_.size());
  LAPWING_ASSERT(last_.empty() || vehicles_.empty() || now > vehicles_.front().track.back().time, now);
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    auto& vehicle = vehicles_[i];
    auto const& sample = samples[i];
    float used_wh = 0.0F;
    if (!last_.empty()) {
      auto const& before = last_[i];
      double const mean_v = 0.5 * (before.voltage_v + sample.voltage_v);
      double const drawn_mah = std::max(0.0, sample.used_mah - before.used_mah);  // less: its pack was changed
      used_wh = vehicle.charge.back().used_wh + static_cast<float>(drawn_mah * 1e-3 * mean_v);
      bool const on_its_way = sample.in_the_air || sample.moves;
      if (on_its_way) vehicle.under_way += now - vehicle.track.back().time;
    }
    if (vehicle.modes.empty() || vehicle.modes.back().mode != sample.mode)
      if (vehicle.modes.size() < options_.max_tasks) vehicle.modes.push_back({now, std::string(sample.mode)});
    vehicle.track.push_back({now, sample.place_m});
    vehicle.charge.push_back({static_cast<float>(sample.remaining), used_wh});
    vehicle.ends_in_the_air = sample.in_the_air;
  }
  last_.assign(samples.begin(), samples.end());
  bool const is_full = !vehicles_.empty() && vehicles_.front().track.size() * vehicles_.size() >= options_.max_points;
  if (is_full) thin_out();
}

void Recorder::thin_out() {
  period_ *= 2;
  for (auto& vehicle : vehicles_) {
    // The newest point stays: energy is counted on from it.
    auto const newest = std::pair(vehicle.track.back(), vehicle.charge.back());
    drop_every_second(vehicle.track);
    drop_every_second(vehicle.charge);
    if (vehicle.track.back().time == newest.first.time) continue;
    vehicle.track.push_back(newest.first);
    vehicle.charge.push_back(newest.second);
  }
}

void Recorder::note(tasks::TaskEvent const& event) {
  if (!event.vehicle || event.kind == Kind::alloc) return;
  auto const vehicle = std::ranges::find(vehicles_, event.vehicle->text, &VehicleRecord::id);
  if (vehicle == vehicles_.end()) return;
  auto const now = event.time.time_since_epoch();
  auto& tasks = vehicle->tasks;
  if (event.kind == Kind::start) {
    if (tasks.size() >= options_.max_tasks) {
      ++vehicle->tasks_left_out;
      return;
    }
    tasks.push_back({.name = event.task, .begin = now, .end = now, .reason = {}, .task = event.subject, .flown = {}});
    return;
  }
  auto const open = std::find_if(tasks.rbegin(), tasks.rend(), [&](TaskSpan const& span) {
    return span.ending == End::running && span.name == event.task;
  });
  if (open == tasks.rend()) return;
  open->end = now;
  open->ending = ending_of(event.kind);
  open->reason = event.detail;
}

void Recorder::say(Duration now, std::string_view text) {
  line_ += text;
  for (std::size_t end; (end = line_.find('\n')) != std::string::npos; line_.erase(0, end + 1))
    if (remarks_.size() < options_.max_remarks) remarks_.push_back({now, line_.substr(0, end)});
}

FlightRecord Recorder::finish(Duration now) const {
  FlightRecord record;
  record.duration = now;
  record.sample_period = period_;
  record.vehicles = vehicles_;
  record.remarks = remarks_;
  if (!line_.empty()) record.remarks.push_back({now, line_});
  for (auto& vehicle : record.vehicles)
    for (auto& span : vehicle.tasks)
      if (span.ending == End::running) span.end = now;
  return record;
}

}  // namespace lapwing::dryrun
