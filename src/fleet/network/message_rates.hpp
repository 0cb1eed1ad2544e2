#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/time.hpp"
#include "mavlink/codec/enums.hpp"

namespace lapwing::fleet {

/// A message that a vehicle shall send, and how often at least.
struct WantedMessage {
  mavlink::MessageId id{};
  base::Duration interval{};
  bool may_wait =
      false;  ///< for people: a slow link carries less of it, and a vehicle that lacks it is not asked for long
};

/// A rate that we changed.
struct ChangedRate {
  mavlink::MessageId id{};
  base::Duration set{};
  std::optional<base::Duration> before{};  ///< nothing: it was not sent
};

/// Decides which messages to ask a vehicle for: only those that do not come by themselves, often enough.
///
/// Other ground stations may have set the rates; what already arrives is left alone. Lost requests and reboots show as
/// missing messages and are asked for again; a vehicle that says no is left in peace for a while. Remembers what was
/// changed, so that it can be given back. No clock inside: pass the time.
class MessageRates {
 public:
  MessageRates(std::span<WantedMessage const> wanted, base::TimePoint now);

  /// One more, from now on; again the same changes nothing.
  void want(WantedMessage const& message, base::TimePoint now);
  /// Call for every message from the vehicle.
  void arrived(mavlink::MessageId id);
  /// What to ask for now; each is then left alone until there was time to see whether it helped.
  [[nodiscard]] std::vector<WantedMessage> due(base::TimePoint now);
  /// The vehicle will not send it: do not ask again soon.
  void denied(mavlink::MessageId id, base::TimePoint now);
  /// The vehicle sends it as often as wanted or oftener, so that it is the link which loses it: asking would lower a
  /// rate that somebody else may need.
  void leave_alone(mavlink::MessageId id, base::TimePoint now);
  /// The vehicle restarted and has forgotten every rate: look anew.
  void restart(base::TimePoint now);
  /// What may wait is wanted `factor` times less often than in the beginning. What we have set otherwise is due at
  /// once.
  void set_telemetry_rate(int factor, base::TimePoint now);

  /// The vehicle took the rate. `before` as it told; the outer nothing: it did not tell, and then nobody can give it
  /// back.
  void changed(WantedMessage const& message, std::optional<std::optional<base::Duration>> before);
  [[nodiscard]] bool is_ours(mavlink::MessageId id) const;
  /// Those of which is known what they were before.
  [[nodiscard]] std::vector<ChangedRate> changes() const;

 private:
  struct Watched {
    WantedMessage wanted;                                      ///< telemetry_rate included
    base::Duration usual{};                                    ///< the interval without telemetry_rate
    int count = 0;                                             ///< arrivals since `since`
    base::TimePoint since{};                                   ///< begin of the present look
    base::TimePoint look_until{};                              ///< when it ends
    int asked = 0;                                             ///< requests in a row that did not help
    std::optional<base::Duration> set = {};                    ///< by us
    std::optional<std::optional<base::Duration>> before = {};  ///< we changed it
  };
  void look(Watched& watched, base::TimePoint now, base::Duration time) const;
  Watched* find(mavlink::MessageId id);

  int telemetry_rate_ = 1;
  std::vector<Watched> watched_;
};

}  // namespace lapwing::fleet
