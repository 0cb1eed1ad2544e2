// Fence files: any bytes either are refused with a reason or give a fence with sound rings, on which a flight can be
// examined.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "plan/files/plan_file.hpp"
#include "require.hpp"

namespace {

using namespace lapwing::plan;
using lapwing::fuzz::require;

void check_fence(Fence const& fence) {
  require(!fence.zones.empty() && fence.zones.size() <= max_fence_zones);
  for (auto const& zone : fence.zones) {
    require(!zone.polygons.empty());
    for (auto const& polygon : zone.polygons) {
      for (auto const& ring : polygon.rings) {
        require(ring.size() >= 3);
        for (auto const& corner : ring) require(std::isfinite(corner.x()) && std::isfinite(corner.y()));
      }
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string_view const text(reinterpret_cast<char const*>(data), size);
  auto const read = read_plan("fuzz.geojson", text);
  if (!read) {
    require(!read.error().message.empty());
    return 0;
  }
  auto const fence = level(read->plan.fence, lapwing::geo::Wgs84::from_degrees(41.0, -8.0, 90.0));
  if (!fence) {
    require(!fence.error().message.empty());
    return 0;
  }
  check_fence(*fence);
  using std::chrono::seconds;
  Track const flight{
      {seconds(0), {0.0, 0.0, 0.0}}, {seconds(5), {90.0, 10.0, -40.0}}, {seconds(9), {-9.0, 300.0, -5.0}}};
  for (auto const& breach : breaches(flight, *fence)) require(breach.begin <= breach.end && breach.depth_m > 0.0);
  return 0;
}
