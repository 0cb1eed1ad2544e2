#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "link/operator_link/client.hpp"
#include "link/operator_link/server.hpp"
#include "link/operator_link/testing/memory_network.hpp"

namespace lapwing::link::operator_link::testing {

/// A drone that serves and a station that connects, over a network in memory, in simulated time.
class Delivery : public ::testing::Test {
 public:
  void serve(Server::Options options = {}) {
    options.end.name = "drone";
    options.end.seed = ++starts;
    auto opened = Server::open(loop, network.listener(), std::move(options),
                               {.arrived = {}, .event = [this](Event event) { note("drone", event); }});
    ASSERT_TRUE(opened) << opened.error().message;
    server = *std::move(opened);
  }
  void connect(Client::Options options = {}) {
    if (options.end.name.empty()) options.end.name = "station";
    options.end.seed = 100 + ++starts;
    auto opened = Client::open(loop, network.dialler(), std::move(options),
                               {.arrived = {}, .event = [this](Event event) { note("station", event); }});
    ASSERT_TRUE(opened) << opened.error().message;
    client = *std::move(opened);
  }
  void note(std::string_view who, Event const& event) {
    events.push_back(fmt::format("{} {}: {}", who, to_string(event.kind), event.text));
  }
  [[nodiscard]] bool was_told(std::string_view of) const {
    return std::ranges::any_of(events, [&](auto const& event) { return event.starts_with(of); });
  }
  void wait(base::Duration time) { loop.run_until_done(sleep(time)); }
  base::Task<int> sleep(base::Duration time) {
    co_await loop.sleep(time);
    co_return 0;
  }
  PeerSession& at_station() const { return client->session(); }
  PeerSession& at_drone() const { return *server->find("station"); }
  using Texts = std::vector<std::string>;
  static constexpr std::size_t much_said = 200;
  /// Every other time, until much was said.
  static void say_something(PeerSession& by, Texts& said, std::mt19937_64& random) {
    if (said.size() >= much_said || random() % 2 != 0) return;
    said.push_back(fmt::format("{} {}", said.size(), std::string(random() % 300, 'x')));
    EXPECT_TRUE(by.send(durable(said.back())));
  }
  static std::vector<std::string> take_all(PeerSession& session) {
    std::vector<std::string> texts;
    while (auto message = session.take()) texts.push_back(message->text);
    return texts;
  }
  static Message durable(std::string text) { return {.kind = Kind::durable, .text = std::move(text)}; }
  static Message command(std::string text, std::string key = {}, base::Duration lifetime = {}) {
    return {.kind = Kind::command, .text = std::move(text), .key = std::move(key), .lifetime = lifetime};
  }
  static Message latest(std::string text, std::string key) {
    return {.kind = Kind::latest, .text = std::move(text), .key = std::move(key)};
  }

  base::Loop loop{{.unpaced = true}};
  MemoryNetwork network{loop, 1};
  std::vector<std::string> events;
  std::uint64_t starts = 0;
  std::unique_ptr<Server> server;
  std::unique_ptr<Client> client;
};

}  // namespace lapwing::link::operator_link::testing
