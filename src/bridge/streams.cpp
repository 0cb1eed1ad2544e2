#include "bridge/streams.hpp"

#include <array>

#include "mavlink/exchange/message_interval.hpp"

namespace lapwing::bridge {

using namespace std::chrono_literals;
using mavlink::MessageId;

namespace {

struct Wanted {
  MessageId id;
  base::Duration interval;
};
/// What decisions are made by ten times a second, what changes slowly less often.
constexpr std::array wanted{
    Wanted{MessageId::attitude, 100ms},           Wanted{MessageId::global_position_int, 100ms},
    Wanted{MessageId::local_position_ned, 100ms}, Wanted{MessageId::sys_status, 500ms},
    Wanted{MessageId::gps_raw_int, 500ms},        Wanted{MessageId::gps_global_origin, 2s},
    Wanted{MessageId::home_position, 2s},
};

/// One that is late or lost is not asked for.
constexpr int missed = 3;

}  // namespace

Streams::Streams(mavlink::Connection& connection, FlightController const& flight)
    : connection_(connection), flight_(flight), scope_(connection.loop()) {
  scope_.spawn(keep());
}

base::Task<> Streams::keep() {
  auto& loop = connection_.loop();
  mavlink::CommandOptions const once{.tries = 1, .ack_timeout = 300ms};
  for (;;) {
    for (auto const& [id, interval] : wanted) {
      auto const found = heard_.find(id);
      bool const comes = found != heard_.end() && loop.now() - found->second <= interval * missed;
      if (comes || !flight_.is_connected(loop.now())) continue;
      auto asking = mavlink::set_message_interval(connection_, flight_.address, id, interval, once);
      (void)co_await asking;  // whether it helped shows by itself
    }
    co_await loop.sleep(500ms);
  }
}

}  // namespace lapwing::bridge
