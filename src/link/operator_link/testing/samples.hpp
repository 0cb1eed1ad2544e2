#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "link/operator_link/wire/protocol.hpp"

namespace lapwing::link::operator_link::testing {

[[nodiscard]] inline std::vector<std::uint8_t> bytes(std::string_view text) {
  return {text.begin(), text.end()};
}

[[nodiscard]] inline Hello sample_hello() {
  Hello hello;
  hello.instance = 0x1122334455667788;
  hello.lanes = {LaneState{7, 3, 9, 12}, LaneState{8, 1, 0, 0}, LaneState{10, 2, 11, 4}};
  hello.window = {.messages = 5, .bytes = 600};
  hello.silence = std::chrono::milliseconds(3000);
  hello.name = "drone-1";
  hello.token = "secret";
  return hello;
}

/// One of each type.
[[nodiscard]] inline std::vector<Speech> one_of_each() {
  using std::chrono::microseconds;
  using std::chrono::milliseconds;
  return {sample_hello(),
          Welcome{sample_hello()},
          Refused{RefusedCode::token, "no token"},
          Data{Kind::command, 17, milliseconds(1500), microseconds(123456789), "move", "{\"Type\":\"Arm\"}"},
          Data{Kind::durable, 1, milliseconds(0), microseconds(0), "", ""},
          Ack{Kind::latest, 99},
          Returned{Kind::command, 4, Outcome::overtaken},
          Ping{microseconds(5)},
          Pong{microseconds(6)},
          Bye{"closed"}};
}

}  // namespace lapwing::link::operator_link::testing
