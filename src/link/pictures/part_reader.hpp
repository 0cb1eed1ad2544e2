#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "link/pictures/picture.hpp"

namespace lapwing::link::pictures {

/// Reads a stream of pictures out of the bytes of one HTTP answer. Pure: knows no socket.
class PartReader {
 public:
  static constexpr std::size_t largest_head = 4096;
  static constexpr std::size_t largest_picture = std::size_t{8} * 1024 * 1024;

  /// The newest picture that these bytes complete; older ones are worth nothing then. Errors: refused: the answer is
  /// another one than pictures, in its own words; invalid_input: these are no parts with a length and a time. After an
  /// error nothing more is read.
  [[nodiscard]] base::Result<std::optional<Picture>> take(std::string_view bytes);

 private:
  enum class Awaits : std::uint8_t { answer, part, picture, nothing };

  /// Whether there was enough for a step.
  [[nodiscard]] base::Result<bool> step(std::optional<Picture>& newest);
  [[nodiscard]] base::Result<> read_answer(std::string_view head);
  [[nodiscard]] base::Result<> read_part(std::string_view head);

  Awaits awaits_ = Awaits::answer;
  std::string buffer_;
  std::size_t length_ = 0;
  base::UtcTime taken_{};
};

}  // namespace lapwing::link::pictures
