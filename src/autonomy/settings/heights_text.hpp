#pragma once

#include <string>
#include <string_view>

#include "autonomy/interface/heights.hpp"
#include "base/error.hpp"

namespace lapwing::autonomy {

/// A file of more is none of ours.
inline constexpr std::size_t longest_settings = 4096;

/// As the drone's file has it: TOML, and a last line with the CRC-32 of all before.
[[nodiscard]] std::string to_text(HoverHeights const& heights);

/// Error (invalid_input): too long, cut off or changed (by the checksum), no such settings, heights that are not sound.
/// `name`: of the file, for the message.
[[nodiscard]] base::Result<HoverHeights> parse_heights(std::string const& name, std::string_view text);

}  // namespace lapwing::autonomy
