#include "link/pipe_link.hpp"

#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace lapwing::link {

/// What the server and the clients are ends of: both directions of every client.
struct internal::PipeBus {
  explicit PipeBus(base::Loop& on) : loop(on) {}

  base::Loop& loop;
  ByteLink::Receive server;
  std::map<Peer, ByteLink::Receive> clients;
  std::uint64_t next_key = 1;
  bool is_cut = false;
};

namespace {

using internal::PipeBus;

Peer constexpr server_peer{0};

using Chunk = std::vector<std::uint8_t>;

class End : public ByteLink {
 public:
  [[nodiscard]] LinkState state() const override { return LinkState::open; }
  [[nodiscard]] std::string last_error() const override { return {}; }
  [[nodiscard]] LinkCounters counters() const override { return *counters_; }

 protected:
  void count_sent(Bytes bytes) {
    ++counters_->chunks_sent;
    counters_->bytes_sent += bytes.size();
  }
  bool count_failure() {
    ++counters_->send_failures;
    return false;
  }
  /// `receive`, counting.
  [[nodiscard]] Receive counting(Receive receive) const {
    return [this, counters = counters_, receive = std::move(receive)](Peer peer, Bytes bytes) {
      ++counters->chunks_received;
      counters->bytes_received += bytes.size();
      receive(peer, bytes);
      tell_drained();
    };
  }

 private:
  std::shared_ptr<LinkCounters> counters_ =
      std::make_shared<LinkCounters>();  // outlives the end in chunks on their way
};

class ServerEnd final : public End {
 public:
  explicit ServerEnd(std::shared_ptr<PipeBus> bus) : bus_(std::move(bus)) {}
  ~ServerEnd() override { bus_->server = nullptr; }
  ServerEnd(ServerEnd const&) = delete;
  ServerEnd& operator=(ServerEnd const&) = delete;

  [[nodiscard]] std::string name() const override { return "pipe"; }
  [[nodiscard]] std::string peer_name(Peer peer) const override { return fmt::format("client {}", peer.key); }
  void start(Receive receive) override { bus_->server = counting(std::move(receive)); }
  bool send(Peer peer, Bytes bytes, Urgency) override {
    if (!bus_->clients.contains(peer)) return count_failure();
    count_sent(bytes);
    bus_->loop.post([weak = std::weak_ptr(bus_), peer, chunk = Chunk(bytes.begin(), bytes.end())] {
      auto const bus = weak.lock();
      if (!bus || bus->is_cut) return;
      auto const client = bus->clients.find(peer);
      if (client != bus->clients.end() && client->second) client->second(server_peer, chunk);
    });
    return true;
  }
  [[nodiscard]] std::vector<Peer> standing_peers() const override { return {}; }

 private:
  std::shared_ptr<PipeBus> bus_;
};

class ClientEnd final : public End {
 public:
  explicit ClientEnd(std::shared_ptr<PipeBus> bus) : bus_(std::move(bus)), self_{bus_->next_key++} {
    bus_->clients[self_] = nullptr;
  }
  ~ClientEnd() override { bus_->clients.erase(self_); }
  ClientEnd(ClientEnd const&) = delete;
  ClientEnd& operator=(ClientEnd const&) = delete;

  [[nodiscard]] std::string name() const override { return fmt::format("pipe client {}", self_.key); }
  [[nodiscard]] std::string peer_name(Peer) const override { return "server"; }
  void start(Receive receive) override { bus_->clients[self_] = counting(std::move(receive)); }
  bool send(Peer peer, Bytes bytes, Urgency) override {
    if (peer != server_peer) return count_failure();
    count_sent(bytes);
    bus_->loop.post([weak = std::weak_ptr(bus_), from = self_, chunk = Chunk(bytes.begin(), bytes.end())] {
      auto const bus = weak.lock();
      if (bus && bus->server && !bus->is_cut) bus->server(from, chunk);
    });
    return true;
  }
  [[nodiscard]] std::vector<Peer> standing_peers() const override { return {server_peer}; }

 private:
  std::shared_ptr<PipeBus> bus_;
  Peer self_;
};

}  // namespace

PipeHub::PipeHub(base::Loop& loop) : bus_(std::make_shared<PipeBus>(loop)) {}
PipeHub::~PipeHub() = default;

std::unique_ptr<ByteLink> PipeHub::take_server() {
  return std::make_unique<ServerEnd>(bus_);
}
std::unique_ptr<ByteLink> PipeHub::connect() {
  return std::make_unique<ClientEnd>(bus_);
}

void PipeHub::cut(bool is_cut) {
  bus_->is_cut = is_cut;
}

Pipe make_pipe(base::Loop& loop) {
  PipeHub hub(loop);
  auto server = hub.take_server();
  return {std::move(server), hub.connect()};
}

}  // namespace lapwing::link
