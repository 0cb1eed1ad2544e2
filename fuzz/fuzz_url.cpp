// Any text as the URL of a link: what is read can be written and read again.
#include <cstdint>
#include <string>

#include "link/url.hpp"
#include "require.hpp"

using namespace lapwing;

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string const text(data, data + size);
  auto const url = link::parse_url(text);
  if (!url) {
    fuzz::require(!url.error().message.empty() && !url.error().hint.empty());
    return 0;
  }
  auto const again = link::parse_url(link::to_string(*url));
  fuzz::require(again && *again == *url);
  return 0;
}
