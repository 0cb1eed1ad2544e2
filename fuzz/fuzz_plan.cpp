// Plan files, told by their content: QGroundControl's, GeoJSON, KML, way points.
#include "plan_checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  lapwing::fuzz::check_plan({reinterpret_cast<char const*>(data), size});
  return 0;
}
