#include "onboard/decide/lateness.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

namespace lapwing::onboard {
namespace {

constexpr base::Duration step = std::chrono::microseconds(100);

double milliseconds(base::Duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

}  // namespace

void Lateness::add(base::Duration late) {
  late = std::max(late, base::Duration{0});
  ++frames_;
  ++counts_[std::min<std::size_t>(static_cast<std::size_t>(late / step), counts_.size() - 1)];
  most_ = std::max(most_, late);
}

base::Duration Lateness::quantile(double share) const {
  auto const wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(frames_)));
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i + 1 < counts_.size(); ++i) {
    sum += counts_[i];
    if (sum >= wanted) return std::min(most_, static_cast<int>(i + 1) * step);
  }
  return most_;
}

std::string to_string(Lateness const& lateness) {
  return fmt::format("{} frames, late by {:.1f} ms in the middle, {:.1f} ms at the 99th percentile, {:.1f} ms at most",
                     lateness.frames(), milliseconds(lateness.quantile(0.5)), milliseconds(lateness.quantile(0.99)),
                     milliseconds(lateness.most()));
}

}  // namespace lapwing::onboard
