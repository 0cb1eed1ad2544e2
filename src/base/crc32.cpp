#include "base/crc32.hpp"

#include <zlib.h>

namespace lapwing::base {

std::uint32_t crc32(std::string_view bytes) {
  return static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<Bytef const*>(bytes.data()), bytes.size()));
}

}  // namespace lapwing::base
