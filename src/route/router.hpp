#pragma once

#include <memory>
#include <vector>

#include "base/async/loop.hpp"
#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"
#include "base/error.hpp"
#include "base/log.hpp"
#include "route/duplicates.hpp"
#include "route/endpoint.hpp"
#include "route/routing_table.hpp"

namespace lapwing::route {

namespace internal {
class Channel;
struct Endpoint;
}  // namespace internal

/// Passes MAVLink packets between links by the protocol's rules (https://mavlink.io/en/guide/routing.html), byte for
/// byte as they came: what is for all goes to all other endpoints, what is for one system or component goes where that
/// was heard, nothing goes back where it came from. Unknown messages are for all.
///
/// Every far end of a link that has many (udp in, tcp in) is a channel of its own, with its own rate limit. No memory
/// is asked for on the way of a packet.
class Router {
 public:
  struct Options {
    bool drops_duplicates = true;
    /// A far end of a datagram link that sent no MAVLink for so long is gone.
    base::Duration silent_after = std::chrono::seconds(60);
    /// On one endpoint. When another comes, the one that was silent for longest goes.
    std::size_t max_far_ends = 256;
  };

  Router(base::Loop& loop, Options options, base::Logger log);
  Router(Router const&) = delete;
  Router& operator=(Router const&) = delete;
  ~Router();

  /// Opens the links of all endpoints, or none. Errors: of `link::open`.
  [[nodiscard]] base::Result<> open(std::vector<EndpointOptions> endpoints);
  /// An endpoint whose link is there already. Starts it.
  void add(EndpointOptions options, std::unique_ptr<link::ByteLink> link);

  [[nodiscard]] std::vector<EndpointStatus> status() const;
  /// Systems that were heard.
  [[nodiscard]] std::size_t systems() const { return table_.systems(); }

 private:
  using Channel = internal::Channel;
  using Endpoint = internal::Endpoint;

  void receive(Endpoint& endpoint, link::Peer peer, link::Bytes bytes);
  void take(Channel& from, mavlink::FrameView const& frame, base::TimePoint now);
  void send_to_all(Channel const& from, mavlink::FrameView const& frame, base::TimePoint now);
  [[nodiscard]] bool send_to_one(Channel const& from, mavlink::FrameView const& frame, base::TimePoint now);
  void flush();

  [[nodiscard]] Channel* find(Endpoint& endpoint, link::Peer peer) const;
  [[nodiscard]] Channel* meet(Endpoint& endpoint, link::Peer peer, link::Bytes bytes);
  Channel& add_channel(Endpoint& endpoint, link::Peer peer, bool is_standing);
  void make_room(Endpoint& endpoint);
  void remove(Channel& channel, std::string_view why);
  void look_around(Endpoint& endpoint);
  base::Task<> keep_looking_around();
  base::Task<> keep_releasing();

  base::Loop& loop_;
  Options options_;
  base::Logger log_;
  std::vector<std::unique_ptr<Endpoint>> endpoints_;
  std::vector<std::unique_ptr<Channel>> channels_;  ///< by id; null: free
  std::vector<Channel*> active_;
  RoutingTable table_;
  Duplicates duplicates_;
  base::Notifier release_is_due_;  ///< earlier than was known
  base::TimePoint next_release_ = base::TimePoint::max();
  base::Scope scope_;
};

/// Of a serial line nothing is known of how fast it takes bytes but its baud rate: without limits of its own it gets
/// what the line can carry, so that frames wait where old telemetry can still be left out.
void limit_serial_line(EndpointOptions& options);

}  // namespace lapwing::route
