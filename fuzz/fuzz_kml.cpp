// KML, and KMZ archives where the bytes begin like one.
#include <string>

#include "plan_checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string_view const bytes(reinterpret_cast<char const*>(data), size);
  // Most inputs are what is inside the document, so that the fuzzer need not find the frame round it.
  bool const is_whole = bytes.starts_with('<') || bytes.starts_with("PK");
  lapwing::fuzz::check_plan(is_whole ? std::string(bytes)
                                     : "<kml><Document>" + std::string(bytes) + "</Document></kml>");
  return 0;
}
