#include "base/flood_gate.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace lapwing::base {

void FloodGate::refill(UtcTime now) {
  if (now > filled_) {
    auto const elapsed_s = std::chrono::duration<double>(now - filled_).count();
    room_ = std::min(limits_.burst, room_ + elapsed_s * limits_.per_s);
  }
  filled_ = now;  // a clock that is set back is believed, and gives nothing
  if (room_ >= limits_.per_s) is_shut_ = false;
}

bool FloodGate::admit(UtcTime now, double lines) {
  refill(now);
  if (!is_shut_ && room_ > 0.0) {
    room_ -= lines;
    return true;
  }
  is_shut_ = true;
  left_out_ += lines;
  return false;
}

bool FloodGate::has_calmed(UtcTime now) {
  if (left_out_ == 0.0) return false;
  refill(now);
  return !is_shut_;
}

std::uint64_t FloodGate::take_left_out() {
  return static_cast<std::uint64_t>(std::exchange(left_out_, 0.0));
}

std::string left_out_text(std::uint64_t lines) {
  auto digits = fmt::format("{}", lines);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), ",");
  return fmt::format("{} line{} left out", digits, lines == 1 ? "" : "s");
}

namespace {

class Gates {
 public:
  explicit Gates(LogHub::Sink sink) : sink_(std::move(sink)) {}

  void take(LogRecord const& record) {
    if (record.level != LogLevel::error && !gates_[record.source].admit(record.utc)) {
      has_left_out_ = true;
      return;
    }
    if (has_left_out_) tell_what_was_left_out(record.utc);
    sink_(record);
  }

 private:
  void tell_what_was_left_out(UtcTime now) {
    has_left_out_ = false;
    for (auto& [source, gate] : gates_) {
      if (gate.has_calmed(now))
        sink_({LogLevel::warn, now, source, left_out_text(gate.take_left_out())});
      else
        has_left_out_ = has_left_out_ || gate.is_shut();
    }
  }

  LogHub::Sink sink_;
  std::map<std::string, FloodGate> gates_;  ///< by source
  bool has_left_out_ = false;
};

}  // namespace

LogHub::Sink without_floods(LogHub::Sink sink) {
  // Shared, since a function must be copyable.
  return [gates = std::make_shared<Gates>(std::move(sink))](LogRecord const& record) { gates->take(record); };
}

}  // namespace lapwing::base
