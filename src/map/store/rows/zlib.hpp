#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lapwing::map::rows {

/// A zlib stream (RFC 1950); quickly rather than as small as can be: it is made while others wait to be written.
[[nodiscard]] std::string deflated(std::string_view bytes);
/// Nothing for what is no whole stream, or has more than `most` bytes in it.
[[nodiscard]] std::optional<std::string> inflated(std::string_view stream, std::size_t most);

}  // namespace lapwing::map::rows
