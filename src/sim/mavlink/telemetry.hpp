#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "base/time.hpp"
#include "mavlink/codec/enums.hpp"
#include "sim/model/kind.hpp"

namespace lapwing::sim {

/// Which messages a vehicle sends by itself, and when. ArduPilot after power-on: HEARTBEAT once a second, nothing else.
class Telemetry {
 public:
  enum class Answer { accepted, unknown_message };

  /// ArduPilot sends what it is asked for; PX4 sends a good deal unasked.
  Telemetry(Kind const& kind, base::Duration first_heartbeat);

  /// SET_MESSAGE_INTERVAL: shorter than 3 ms is taken as 3 ms; negative stops; zero is the default.
  Answer set_interval(mavlink::MessageId id, std::chrono::microseconds interval, base::Duration now);
  /// Nothing when the vehicle does not send it; `known` tells whether it could.
  [[nodiscard]] std::optional<base::Duration> interval(mavlink::MessageId id) const;
  [[nodiscard]] bool knows(mavlink::MessageId id) const;
  /// REQUEST_DATA_STREAM: every message of the stream (0: of all) at that rate, or none.
  void set_stream(int stream, int rate_hz, base::Duration now);

  /// The messages due at `now`; each is then due an interval later.
  [[nodiscard]] std::vector<mavlink::MessageId> take_due(base::Duration now);
  /// When the next of those that come more often than every `step` is due; the others can wait for the step.
  [[nodiscard]] base::Duration next_due_between(base::Duration step) const;

 private:
  struct Entry {
    mavlink::MessageId id;
    base::Duration interval;
    base::Duration due;
  };
  void schedule(mavlink::MessageId id, std::optional<base::Duration> interval, base::Duration now);
  void find_next();

  Kind kind_;
  std::vector<Entry> entries_;
  base::Duration next_due_{};
};

}  // namespace lapwing::sim
