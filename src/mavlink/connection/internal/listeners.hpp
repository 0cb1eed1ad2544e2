#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "mavlink/connection/connection.hpp"

namespace lapwing::mavlink::internal {

/// Who hears which system's messages, in the order in which they subscribed. Kept by system, for a station has several
/// listeners a vehicle and each of them wants one vehicle's messages alone.
class Listeners {
 public:
  using Handler = Subscription::Handler;

  /// Hears every system, if none is given.
  void add(std::optional<std::uint8_t> system_id, std::weak_ptr<Handler> handler) {
    auto& list = system_id ? of_system_.at(*system_id) : of_all_;
    if (telling_ == 0) std::erase_if(list, [](Listener const& l) { return l.handler.expired(); });
    list.push_back({next_++, std::move(handler)});
  }

  /// Nobody ever subscribed.
  [[nodiscard]] bool is_empty() const { return next_ == 0; }

  void tell(Received const& received) {
    ++telling_;
    auto const& own = of_system_.at(received.source.system);
    std::size_t of_all = 0;
    std::size_t of_own = 0;
    // By index: a handler may subscribe, which lengthens a list.
    while (of_all < of_all_.size() || of_own < own.size()) {
      bool const is_own = order(own, of_own) < order(of_all_, of_all);
      auto const handler = is_own ? own[of_own++].handler.lock() : of_all_[of_all++].handler.lock();
      if (handler) (*handler)(received);
    }
    --telling_;
  }

 private:
  struct Listener {
    std::uint64_t order;
    std::weak_ptr<Handler> handler;
  };
  using List = std::vector<Listener>;

  static std::uint64_t order(List const& list, std::size_t index) {
    return index < list.size() ? list[index].order : std::numeric_limits<std::uint64_t>::max();
  }

  List of_all_;
  std::array<List, 256> of_system_;
  std::uint64_t next_ = 0;
  int telling_ = 0;  ///< depth: a handler may cause another message to be told
};

}  // namespace lapwing::mavlink::internal
