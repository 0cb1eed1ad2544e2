#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "link/byte_link.hpp"

namespace lapwing::mavlink::testing {

/// Both ways of a link that can stall: what is sent meanwhile arrives late, in order, as with TCP over a radio.
class StalledWay {
 public:
  void begin() { is_stalled_ = true; }
  void end() {
    is_stalled_ = false;
    auto const kept = std::exchange(kept_, {});
    for (auto const& deliver : kept) deliver();
  }
  void pass(std::function<void()> deliver) {
    if (is_stalled_) return kept_.push_back(std::move(deliver));
    deliver();
  }

 private:
  bool is_stalled_ = false;
  std::deque<std::function<void()>> kept_;
};

class StallingLink final : public link::ByteLink {
 public:
  StallingLink(std::unique_ptr<link::ByteLink> inner, std::shared_ptr<StalledWay> way)
      : inner_(std::move(inner)), way_(std::move(way)) {}

  [[nodiscard]] std::string name() const override { return inner_->name(); }
  [[nodiscard]] std::string peer_name(link::Peer peer) const override { return inner_->peer_name(peer); }
  void start(Receive receive) override {
    inner_->start([way = way_, receive = std::move(receive)](link::Peer peer, link::Bytes bytes) {
      way->pass([receive, peer, copy = std::vector(bytes.begin(), bytes.end())] { receive(peer, copy); });
    });
  }
  bool send(link::Peer peer, link::Bytes bytes, link::Urgency) override {
    way_->pass([this, peer, copy = std::vector(bytes.begin(), bytes.end())] { (void)inner_->send(peer, copy); });
    return true;
  }
  [[nodiscard]] std::vector<link::Peer> standing_peers() const override { return inner_->standing_peers(); }
  [[nodiscard]] link::LinkState state() const override { return inner_->state(); }
  [[nodiscard]] std::string last_error() const override { return inner_->last_error(); }
  [[nodiscard]] link::LinkCounters counters() const override { return inner_->counters(); }

 private:
  std::unique_ptr<link::ByteLink> inner_;
  std::shared_ptr<StalledWay> way_;
};

[[nodiscard]] inline std::unique_ptr<link::ByteLink> stall(std::unique_ptr<link::ByteLink> inner,
                                                           std::shared_ptr<StalledWay> way) {
  return std::make_unique<StallingLink>(std::move(inner), std::move(way));
}

}  // namespace lapwing::mavlink::testing
