#include "mavlink/connection/connection_link.hpp"

#include <algorithm>
#include <utility>

namespace lapwing::mavlink {

namespace {

/// Keys of UDP peers have 48 bits, those of others are small: the rest takes the link's number.
unsigned constexpr link_shift = 48;

link::Peer joined(PeerRef ref) {
  return {static_cast<std::uint64_t>(ref.link) << link_shift | ref.peer.key};
}

PeerRef parted(link::Peer peer) {
  return {static_cast<std::size_t>(peer.key >> link_shift), {peer.key & ((std::uint64_t{1} << link_shift) - 1)}};
}

class ConnectionLink final : public link::ByteLink {
 public:
  explicit ConnectionLink(Connection& connection) : connection_(connection) {}
  ~ConnectionLink() override { connection_.set_forward_hook({}); }
  ConnectionLink(ConnectionLink const&) = delete;
  ConnectionLink& operator=(ConnectionLink const&) = delete;

  [[nodiscard]] std::string name() const override { return "the station's links"; }
  [[nodiscard]] std::string peer_name(link::Peer peer) const override {
    auto const [number, far_end] = parted(peer);
    return number < connection_.links().size() ? connection_.links()[number]->peer_name(far_end) : "";
  }
  [[nodiscard]] link::LinkState state() const override { return link::LinkState::open; }
  [[nodiscard]] std::string last_error() const override { return {}; }
  [[nodiscard]] link::LinkCounters counters() const override { return counters_; }
  [[nodiscard]] std::vector<link::Peer> standing_peers() const override {
    std::vector<link::Peer> peers;
    for (std::size_t number = 0; number < connection_.links().size(); ++number) {
      for (auto const peer : connection_.links()[number]->standing_peers()) peers.push_back(joined({number, peer}));
    }
    return peers;
  }

  void start(Receive receive) override {
    connection_.set_forward_hook([this, receive = std::move(receive)](PeerRef from, Frame const& frame) {
      auto const packet = serialize_as_received(frame);
      ++counters_.chunks_received;
      counters_.bytes_received += packet.bytes().size();
      receive(joined(from), packet.bytes());
      tell_drained();
    });
  }

  bool send(link::Peer peer, link::Bytes bytes, link::Urgency) override {
    if (!connection_.pass_on(parted(peer), bytes)) {
      ++counters_.send_failures;
      return false;
    }
    ++counters_.chunks_sent;
    counters_.bytes_sent += bytes.size();
    return true;
  }

 private:
  Connection& connection_;
  link::LinkCounters counters_;
};

}  // namespace

std::unique_ptr<link::ByteLink> as_link(Connection& connection) {
  return std::make_unique<ConnectionLink>(connection);
}

}  // namespace lapwing::mavlink
