#pragma once

#include <span>
#include <vector>

#include "base/time.hpp"
#include "mavlink/enums.hpp"

namespace lapwing::fleet {

/// A message that a vehicle shall send, and how often at least.
struct WantedMessage {
  mavlink::MessageId id{};
  base::Duration interval{};
  bool may_wait = false;  ///< a slow link carries less of it
};

/// Decides which messages to ask a vehicle for: only those that do not come by themselves, often enough.
///
/// Other ground stations may have set the rates; what already arrives is left alone. Lost requests and reboots show as
/// missing messages and are asked for again; a vehicle that says no is left in peace for a while. No clock inside: pass
/// the time.
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
  /// The vehicle restarted and has forgotten every rate: look anew.
  void restart(base::TimePoint now);

 private:
  struct Watched {
    WantedMessage wanted;
    int count = 0;            ///< arrivals since `since`
    base::TimePoint since{};  ///< begin of the present look
    base::TimePoint look_until{};
    int asked = 0;  ///< requests in a row that did not help
  };
  void look(Watched& watched, base::TimePoint now, base::Duration time) const;

  std::vector<Watched> watched_;
};

}  // namespace lapwing::fleet
