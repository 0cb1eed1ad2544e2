#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "link/byte_link.hpp"

namespace lapwing::link::testing {

/// One chunk as a link was given it.
struct Noted {
  std::vector<std::uint8_t> bytes;
  Urgency urgency = Urgency::prompt;
};

/// A link to one far end, whom it knows from the start; keeps what is sent, for tests to look at.
class NotingLink final : public ByteLink {
 public:
  explicit NotingLink(std::shared_ptr<std::vector<Noted>> notes) : notes_(std::move(notes)) {}

  [[nodiscard]] std::string name() const override { return "noting"; }
  [[nodiscard]] std::string peer_name(Peer) const override { return "far end"; }
  void start(Receive) override {}
  bool send(Peer, Bytes bytes, Urgency urgency) override {
    notes_->push_back({{bytes.begin(), bytes.end()}, urgency});
    return true;
  }
  [[nodiscard]] std::vector<Peer> standing_peers() const override { return {Peer{}}; }
  [[nodiscard]] LinkState state() const override { return LinkState::open; }
  [[nodiscard]] std::string last_error() const override { return {}; }
  [[nodiscard]] LinkCounters counters() const override { return {}; }

 private:
  std::shared_ptr<std::vector<Noted>> notes_;
};

}  // namespace lapwing::link::testing
