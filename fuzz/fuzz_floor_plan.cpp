// Floor plans: any bytes either are refused with a reason or give a picture, and any picture a floor plan or a reason,
// on which every place to start has room.
#include <algorithm>
#include <cstdint>
#include <string_view>

#include "explore/run/starts.hpp"
#include "explore/simulated/world.hpp"
#include "map/ros_files/pgm.hpp"
#include "require.hpp"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace lapwing;
  using fuzz::require;
  auto const picture = map::read_pgm({reinterpret_cast<char const*>(data), size});
  if (!picture) {
    require(!picture.error().message.empty());
    return 0;
  }
  require(picture->values.size() ==
          static_cast<std::size_t>(picture->width) * static_cast<std::size_t>(picture->height));
  map::OccupancyGrid grid(0.1);
  for (std::size_t i = 0; i < picture->values.size(); ++i) {
    auto const x = static_cast<std::int32_t>(i % static_cast<std::size_t>(picture->width));
    auto const y = static_cast<std::int32_t>(i / static_cast<std::size_t>(picture->width));
    grid.set({x, y}, map::Evidence::of_probability((255 - picture->values[i]) / 255.0));
  }
  auto const plan = explore::floor_plan_of(grid);
  if (!plan) {
    require(!plan.error().message.empty());
    return 0;
  }
  explore::Settings const settings;
  auto const starts = explore::possible_starts(*plan, settings);
  if (starts.empty()) return 0;
  auto const world = explore::World::around(*plan, starts[size % starts.size()], settings);
  require(world.has_value() && world->wanted() > 0);
  return 0;
}
