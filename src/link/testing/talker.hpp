#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/async/notifier.hpp"
#include "link/byte_link.hpp"

/// What the tests of the links share.
namespace lapwing::link::testing {

using namespace std::chrono_literals;

inline std::vector<std::uint8_t> bytes(std::string_view text) {
  return {text.begin(), text.end()};
}

/// One end with what it has heard.
class Talker {
 public:
  Talker(base::Loop& loop, std::unique_ptr<ByteLink> link) : arrived_(loop), link_(std::move(link)) {
    link_->start([this](Peer peer, Bytes data) {
      heard_ += std::string(data.begin(), data.end());
      ++chunks_;
      from_ = peer;
      arrived_.notify_all();
    });
  }
  base::Task<bool> hears(std::string text) {
    return arrived_.wait_for([this, text] { return heard_.contains(text); }, 5s);
  }
  bool say(std::string_view text, Peer peer) { return link_->send(peer, bytes(text)); }
  bool say(std::string_view text) {
    auto const peers = link_->standing_peers();
    return !peers.empty() && say(text, peers.front());
  }
  bool answer(std::string_view text) { return say(text, from_); }

  ByteLink& link() { return *link_; }
  Peer from() const { return from_; }
  std::string const& heard() const { return heard_; }
  int chunks() const { return chunks_; }

 private:
  base::Notifier arrived_;
  std::unique_ptr<ByteLink> link_;
  std::string heard_;
  Peer from_;
  int chunks_ = 0;
};

inline std::unique_ptr<ByteLink> opened(base::Loop& loop, std::string const& url) {
  auto link = open(loop, parse_url(url).value());
  EXPECT_TRUE(link) << link.error().message;
  return std::move(*link);
}

inline std::uint32_t port_of(ByteLink const& link) {
  return parse_url(link.name()).value().port_or_baud;
}

inline base::Task<bool> until_standing(base::Loop& loop, ByteLink& link, bool wanted) {
  for (int i = 0; i < 500; ++i) {
    if (link.standing_peers().empty() != wanted) co_return true;
    co_await loop.sleep(10ms);
  }
  co_return false;
}

inline base::Task<void> pass(base::Loop& loop, base::Duration time) {
  co_await loop.sleep(time);
}

}  // namespace lapwing::link::testing
