#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "base/time.hpp"
#include "robot/watch/module.hpp"

namespace lapwing::robot::seed_text {

// `Sender_Receiver_TimeStamp_Message`, one a line: how the seed's parts speak with each other. Names are the modules'
// short ones, the time stamp is in milliseconds since the start. In the message `_`, `%`, line ends and other control
// characters are written as `%` and two hexadecimal digits.

std::size_t constexpr longest_line = 1'024;
std::size_t constexpr longest_message = 900;
/// A hundred days; beyond it nobody counts from the start.
std::chrono::milliseconds constexpr latest_stamp{8'640'000'000};

struct Line {
  Module from = Module::sensors;
  Module to = Module::sensors;
  std::chrono::milliseconds stamp{};
  std::string message;  ///< as it was meant, nothing encoded
  friend bool operator==(Line const&, Line const&) = default;
};

/// With its line end. Error (invalid_input): longer than a line may be, or a stamp that cannot be.
[[nodiscard]] base::Result<std::string> write(Line const& line);

/// Without its line end. A `_` that was not encoded stands for itself, as old parts write it. Error (invalid_input):
/// what is wrong, and where.
[[nodiscard]] base::Result<Line> read(std::string_view text);

/// A stream of bytes into lines. What is longer than a line may be is thrown away up to the next line end, and counted.
class LineReader {
 public:
  void feed(std::span<std::uint8_t const> bytes, std::function<void(std::string_view)> const& each);
  [[nodiscard]] std::uint64_t too_long() const { return too_long_; }

 private:
  std::string rest_;
  bool is_too_long_ = false;
  std::uint64_t too_long_ = 0;
};

}  // namespace lapwing::robot::seed_text
