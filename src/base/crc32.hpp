#pragma once

#include <cstdint>
#include <string_view>

namespace lapwing::base {

/// CRC-32 as zlib, PNG and Ethernet have it (ITU-T V.42): tells what was cut off or changed by accident.
[[nodiscard]] std::uint32_t crc32(std::string_view bytes);

}  // namespace lapwing::base
