#include "fleet/network/telemetry_rate.hpp"

#include <algorithm>

namespace lapwing::fleet {

namespace {

constexpr base::Duration look_time = std::chrono::seconds(10);
constexpr double full_buffer = 0.3;
constexpr double much_loss = 0.2;
constexpr double little_loss = 0.1;
constexpr double roomy_buffer = 0.6;
constexpr int looks_to_trust = 3;
constexpr int most = 4;
constexpr double fewest_messages = 20.0;  // a loss of few is chance

}  // namespace

int TelemetryRate::update(std::uint64_t received, std::uint64_t lost, std::optional<double> buffer_free,
                          base::TimePoint now) {
  bool const is_first = !look_until_;
  if (!is_first && now < *look_until_) return factor_;
  // Counters of a source that moved to another link begin anew.
  auto const came = static_cast<double>(received - std::min(received_, received));
  auto const missed = static_cast<double>(lost - std::min(lost_, lost));
  received_ = received;
  lost_ = lost;
  look_until_ = now + look_time;
  if (is_first) return factor_;

  double const loss = came + missed < fewest_messages ? 0.0 : missed / (came + missed);
  if (loss > much_loss || buffer_free.value_or(1.0) < full_buffer) {
    good_looks_ = 0;
    factor_ = std::min(most, factor_ * 2);
  } else if (loss < little_loss && buffer_free.value_or(1.0) > roomy_buffer && factor_ > 1) {
    if (++good_looks_ < looks_to_trust) return factor_;
    good_looks_ = 0;
    factor_ /= 2;
  } else {
    good_looks_ = 0;
  }
  return factor_;
}

}  // namespace lapwing::fleet
