// Key stores: any bytes are refused without any of them being told, or give a ring that reads back as the same.
#include <cstdint>
#include <string_view>

#include "mavlink/signing/key_store.hpp"
#include "require.hpp"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace lapwing::mavlink;
  using lapwing::fuzz::require;
  std::string_view const text(reinterpret_cast<char const*>(data), size);
  auto const ring = parse_key_store("fuzz.keys", text);
  if (!ring) {
    require(!ring.error().message.empty() && ring.error().message.size() < 200);
    return 0;
  }
  auto const again = parse_key_store("again", to_text(*ring));
  require(again.has_value());
  require(*again == *ring);
  return 0;
}
