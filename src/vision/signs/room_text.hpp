#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "vision/signs/reader.hpp"

namespace lapwing::vision {

/// What a line of a sign says of the room behind the door. Numbers in capitals, with '-' or '.' where the sign has one.
struct RoomText {
  std::optional<std::string> number{};  ///< "16-188", "A113", "2.004"
  std::optional<std::string> kind{};    ///< "women", "office", "stairs", ...
};

/// Of one reading. Letters that look like digits count as such between digits.
[[nodiscard]] RoomText room_text(std::string_view line);

/// A building and a room that a sign keeps apart ("E25" and "143"), as one number; nothing when they are none.
[[nodiscard]] std::optional<std::string> joined_number(std::string const& building, std::string const& room);

/// The number that most of the readings of one line say, each counted by its confidence; and how sure that is, 0 to 1.
/// Of a letter and a digit ("A1") at least 0.6, or it is none.
struct Vote {
  std::string number;
  double confidence = 0.0;
};
[[nodiscard]] std::optional<Vote> vote_on_number(std::span<Reading const> readings);

}  // namespace lapwing::vision
