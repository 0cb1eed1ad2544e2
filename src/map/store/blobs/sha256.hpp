#pragma once

#include <string>
#include <string_view>

namespace lapwing::map::blobs {

/// In 64 small hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace lapwing::map::blobs
