#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "link/operator_link/message.hpp"
#include "link/operator_link/wire/framing.hpp"

/// What the frames say, as values; bytes end here.
namespace lapwing::link::operator_link {

inline constexpr std::uint16_t protocol_version = 1;
/// Numbers of messages are less: what is counted on from them cannot overflow.
inline constexpr std::uint64_t number_limit = std::uint64_t{1} << 62U;

/// One lane in a hello: what its sender has to say there, and how far it has heard the other side.
struct LaneState {
  std::uint64_t stream = 0;        ///< numbers begin anew with another one
  std::uint64_t oldest = 1;        ///< the first number that the sender still has
  std::uint64_t heard_stream = 0;  ///< the other side's, as far as it is known; zero: none
  std::uint64_t heard = 0;         ///< the last number that arrived
  friend bool operator==(LaneState const&, LaneState const&) = default;
};

/// How many messages and bytes of a lane may be under way without having been taken: what the far end keeps room for.
struct Window {
  std::uint32_t messages = 256;
  std::uint32_t bytes = 2 * 1024 * 1024;
  friend bool operator==(Window const&, Window const&) = default;
};

struct Hello {
  std::uint16_t version = protocol_version;
  std::uint64_t instance = 0;  ///< another one each time the program starts
  std::array<LaneState, kinds> lanes{};
  Window window{};
  std::chrono::milliseconds silence{};  ///< who is silent for so long is gone
  std::string name;
  std::string token;  ///< of a client
  friend bool operator==(Hello const&, Hello const&) = default;
};

enum class RefusedCode : std::uint16_t { version = 1, token = 2, name = 3, full = 4, malformed = 5 };

struct Refused {
  RefusedCode code = RefusedCode::malformed;
  std::string reason;
  friend bool operator==(Refused const&, Refused const&) = default;
};

struct Data {
  Kind kind = Kind::durable;
  std::uint64_t number = 0;
  std::chrono::milliseconds left{};  ///< of its lifetime when it was sent; zero: no end
  std::chrono::microseconds sent{};  ///< by the sender's clock, whose zero is anything
  std::string key;
  std::string text;
  friend bool operator==(Data const&, Data const&) = default;
};

struct Ack {
  Kind kind = Kind::durable;
  std::uint64_t number = 0;
  friend bool operator==(Ack const&, Ack const&) = default;
};

struct Returned {
  Kind kind = Kind::command;
  std::uint64_t number = 0;
  Outcome why = Outcome::expired;  ///< overtaken or expired
  friend bool operator==(Returned const&, Returned const&) = default;
};

struct Ping {
  std::chrono::microseconds sent{};
  friend bool operator==(Ping const&, Ping const&) = default;
};
struct Pong {
  std::chrono::microseconds sent{};  ///< the ping's
  friend bool operator==(Pong const&, Pong const&) = default;
};
struct Bye {
  std::string reason;
  friend bool operator==(Bye const&, Bye const&) = default;
};

struct Welcome : Hello {
  friend bool operator==(Welcome const&, Welcome const&) = default;
};

using Speech = std::variant<Hello, Welcome, Refused, Data, Ack, Returned, Ping, Pong, Bye>;

/// Appends the frame. Preconditions: texts are no longer than message.hpp allows.
void write(std::vector<std::uint8_t>& to, Speech const& speech);

/// Nothing for a frame of a type that a later version has added. Error (invalid_input): what is wrong with it.
[[nodiscard]] base::Result<std::optional<Speech>> read(Frame const& frame);

}  // namespace lapwing::link::operator_link
