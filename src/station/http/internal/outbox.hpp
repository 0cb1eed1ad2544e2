#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <span>
#include <utility>

#include "station/http/http_server.hpp"

namespace lapwing::station::internal {

/// The messages of one session that wait for the network: first in, first out, their bytes counted by lane.
class Outbox {
 public:
  using Message = HttpServer::Message;
  using Lane = HttpServer::Lane;

  /// All or none: none when the lane holds something and would hold too much with them.
  [[nodiscard]] bool add(std::span<Message const> messages, Lane lane) {
    std::size_t bytes = 0;
    for (auto const& message : messages) bytes += message.content->size();
    auto const before = unsent_bytes(lane.number);
    if (before > 0 && before + bytes > lane.max_unsent_bytes) return false;
    if (bytes > 0) unsent_bytes_[lane.number] = before + bytes;
    for (auto const& message : messages) queue_.push_back({message, lane.number});
    return true;
  }
  [[nodiscard]] bool empty() const { return queue_.empty(); }
  /// The oldest; there is one.
  [[nodiscard]] Message const& front() const { return queue_.front().message; }
  /// The oldest has gone to the network.
  void take_out() {
    auto const unsent = unsent_bytes_.find(queue_.front().lane);
    if (unsent != unsent_bytes_.end()) unsent->second -= queue_.front().message.content->size();
    if (unsent != unsent_bytes_.end() && unsent->second == 0) unsent_bytes_.erase(unsent);
    queue_.pop_front();
  }
  [[nodiscard]] std::size_t unsent_bytes(std::size_t lane) const {
    auto const found = unsent_bytes_.find(lane);
    return found == unsent_bytes_.end() ? 0 : found->second;
  }

 private:
  struct Unsent {
    Message message;
    std::size_t lane = 0;
  };
  std::deque<Unsent> queue_;
  std::map<std::size_t, std::size_t> unsent_bytes_;  ///< those lanes that hold any
};

}  // namespace lapwing::station::internal
