// Telemetry logs: any bytes come to an end, each of them is a part of an entry or counted as skipped.
#include <cstdint>
#include <sstream>
#include <string>

#include "mavlink/wire/tlog.hpp"
#include "require.hpp"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::istringstream in(std::string(reinterpret_cast<char const*>(data), size));
  lapwing::mavlink::TlogReader reader(in);
  std::size_t used = 0;
  while (auto const entry = reader.next()) used += 8 + entry->packet.size();
  lapwing::fuzz::require(used + reader.skipped_bytes() == size);
  return 0;
}
