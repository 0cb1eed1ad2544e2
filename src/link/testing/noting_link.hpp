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

/// A link to one far end, whom it knows from the start; keeps what is sent, for tests to look at. `hear` is what the
/// far end says.
class NotingLink final : public ByteLink {
 public:
  explicit NotingLink(std::shared_ptr<std::vector<Noted>> notes) : notes_(std::move(notes)) {}

  [[nodiscard]] std::string name() const override { return "noting"; }
  [[nodiscard]] std::string peer_name(Peer) const override { return "far end"; }
  void start(Receive receive) override { receive_ = std::move(receive); }
  void hear(Bytes bytes) { receive_(Peer{}, bytes); }
  /// From now on it has no room for anything.
  void fill() { is_full_ = true; }
  bool send(Peer, Bytes bytes, Urgency urgency) override {
    if (is_full_) return false;
    notes_->push_back({{bytes.begin(), bytes.end()}, urgency});
    return true;
  }
  [[nodiscard]] std::vector<Peer> standing_peers() const override { return {Peer{}}; }
  [[nodiscard]] LinkState state() const override { return LinkState::open; }
  [[nodiscard]] std::string last_error() const override { return {}; }
  [[nodiscard]] LinkCounters counters() const override { return {}; }

 private:
  std::shared_ptr<std::vector<Noted>> notes_;
  Receive receive_;
  bool is_full_ = false;
};

}  // namespace lapwing::link::testing
