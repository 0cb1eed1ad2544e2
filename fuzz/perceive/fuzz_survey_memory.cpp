// The map that a process finds of the one before it: whatever is in the file, it is read or refused with a reason; what
// was read is drawn as a map, and written and read again as itself. Who damages a file by chance does not mend its
// checksum, so that it is put behind what comes.
#include <cstdint>
#include <string>

#include "perceive/memory/kept_sights.hpp"
#include "perceive/memory/survey_memory.hpp"
#include "require.hpp"

using namespace lapwing;
using namespace lapwing::perceive;

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  auto const site = geo::Site::make("lot", geo::Wgs84::from_degrees(43.2585, -79.9201, 100.0)).value();
  std::string const text(reinterpret_cast<char const*>(data), size);
  if (auto const bare = read_memory(text, site); !bare) fuzz::require(!bare.error().message.empty());
  auto const memory = read_memory(with_checksum(text), site);
  if (!memory) {
    fuzz::require(!memory.error().message.empty());
    return 0;
  }
  KeptSights kept;
  for (auto const& sight : memory->sights) kept.add(sight, true);
  auto const again = read_memory(memory_text(*memory, site, kept.lines()), site);
  fuzz::require(again && again->sights.size() == kept.size() && again->slots.size() == memory->slots.size() &&
                again->at == memory->at && again->lives == memory->lives);
  return 0;
}
