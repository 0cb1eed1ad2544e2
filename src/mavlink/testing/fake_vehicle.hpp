#pragma once

#include <functional>
#include <memory>
#include <set>
#include <vector>

#include "base/async/loop.hpp"
#include "link/impaired_link.hpp"
#include "link/pipe_link.hpp"
#include "mavlink/connection/connection.hpp"

/// What the tests of the exchanges share: a ground station and a scripted vehicle on an in-memory link, in simulated
/// time.
namespace lapwing::mavlink::testing {

using namespace std::chrono_literals;

inline base::Task<void> pass(base::Loop& loop, base::Duration time) {
  co_await loop.sleep(time);
}

/// A vehicle that answers by script: `on(message)` is called for everything that reaches it.
class FakeVehicle {
 public:
  FakeVehicle(base::Loop& loop, std::unique_ptr<link::ByteLink> link, Address self = {1, autopilot_component})
      : connection(loop, {.self = self, .heartbeat = heartbeat}, {}),
        subscription_(connection.subscribe([this](Received const& received) {
          if (auto const target = target_of(received.message); target && !addresses(*target, connection.self())) return;
          heard.push_back(received.message);
          if (on) on(received.message);
        })) {
    connection.add_link(std::move(link));
  }

  static Heartbeat heartbeat() {
    return {.type = MavType::quadrotor, .autopilot = MavAutopilot::ardupilotmega, .system_status = MavState::standby};
  }
  void answer(Message message) { (void)connection.send({255, 190}, std::move(message)); }
  template <class M>
  std::vector<M> all() const {
    std::vector<M> found;
    for (auto const& message : heard)
      if (auto const* m = std::get_if<M>(&message)) found.push_back(*m);
    return found;
  }

  std::function<void(Message const&)> on;
  std::vector<Message> heard;
  Connection connection;

 private:
  Subscription subscription_;
};

/// A ground station that already knows vehicle 1.
struct Bench {
  // Without TIMESYNC: which packet a seed loses must not depend on it.
  explicit Bench(link::Impairment impairment = {}, base::Duration timesync_period = {})
      : ground(loop, {.timesync_period = timesync_period}, {}) {
    ground.add_link(hub.take_server());
    vehicle = std::make_unique<FakeVehicle>(loop, link::impair(loop, hub.connect(), impairment));
    loop.run_until_done(heard_vehicle());
  }
  base::Task<void> heard_vehicle() {
    while (!ground.whereabouts(1)) co_await loop.sleep(100ms);
  }
  void run_for(base::Duration time) { loop.run_until_done(pass(loop, time)); }

  base::Loop loop{base::Loop::Pace{.unpaced = true}};
  link::PipeHub hub{loop};
  Connection ground;
  std::unique_ptr<FakeVehicle> vehicle;
  static constexpr Address target{1, autopilot_component};
};

}  // namespace lapwing::mavlink::testing
