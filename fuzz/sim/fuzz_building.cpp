#include "sim/building/building.hpp"
#include "sim/building/plan/building_file.hpp"

#include "require.hpp"

/// A building as people write it: whatever the text, the answer is a plan or a message, and what is a plan can be
/// built, driven in and looked at.
extern "C" int LLVMFuzzerTestOneInput(unsigned char const* data, std::size_t size) {
  using namespace lapwing;
  using namespace lapwing::sim::building;
  using fuzz::require;
  auto const plan = building_of("fuzz", std::string(reinterpret_cast<char const*>(data), size));
  if (!plan) {
    require(!plan.error().message.empty());
    return 0;
  }
  auto built = Building::make(*plan, {.robots = 1});
  if (!built) {
    require(!built.error().message.empty());
    return 0;
  }
  auto& building = **built;
  building.robot(0).set({.kind = Fault::Kind::halted});
  building.robot(0).drive_wheels(1.0F, 0.8F);
  for (int i = 0; i < 40; ++i) building.step();
  auto const& at = building.robot(0).body().pose().position;
  require(at.is_finite());
  auto camera = building.robot(0).settings().camera;
  camera.width = 16;
  camera.height = 12;
  auto const picture = develop(building.shoot_from(camera_on(building.robot(0).body().pose(), camera), camera));
  require(picture.rgb.size() == std::size_t{3} * 16 * 12);
  require(building.true_doors().size() == plan->doors.size());
  return 0;
}
