// Archives of map tiles: any bytes either are refused with a reason or answer for every tile within their own limits.
#include <cstdint>
#include <string>

#include "map/basemaps/pmtiles.hpp"
#include "require.hpp"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string bytes(reinterpret_cast<char const*>(data), size);
  auto const archive = lapwing::map::open_pmtiles([&bytes](std::uint64_t offset, std::size_t length) {
    return offset < bytes.size() ? bytes.substr(offset, length) : std::string();
  });
  if (!archive) return 0;
  for (std::uint32_t zoom = 0; zoom < 4; ++zoom) {
    for (std::uint32_t at = 0; at < (1U << zoom); ++at) {
      auto const tile = (*archive)->tile({zoom, at, at});
      lapwing::fuzz::require(!tile || !*tile || (*tile)->size() <= size);
    }
  }
  return 0;
}
