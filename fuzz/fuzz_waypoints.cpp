// Lists of way points; the heading is given.
#include <string>

#include "plan_checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string_view const lines(reinterpret_cast<char const*>(data), size);
  lapwing::fuzz::check_plan("QGC WPL 110\n" + std::string(lines));
  return 0;
}
