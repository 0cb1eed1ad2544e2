// A car park as people write it: whatever the text, the answer is a car park within the limits or a message, and what
// is one can be drawn and looked at. And tables of poses beside pictures.
#include <cstdint>
#include <string>

#include "../require.hpp"
#include "video/camera/pose_table.hpp"
#include "video/scene/scene.hpp"
#include "video/world/car_park_file.hpp"

namespace {

using namespace lapwing;
using namespace lapwing::video;
using lapwing::fuzz::require;

void read_table(std::string const& text) {
  auto const pictures = pictures_of_table(text);
  if (!pictures) {
    require(!pictures.error().message.empty());
    return;
  }
  require(pictures->size() <= most_pictures);
  for (auto const& picture : *pictures) {
    require(!picture.file.contains('/'));
    if (picture.site_from_camera) require(picture.site_from_camera->origin().is_finite());
  }
}

void look_at(CarPark park) {
  // As coarse as can be: the drawing of millions of pixels finds nothing that that of thousands does not.
  constexpr double coarsest_m = 0.5;
  park.pixel_m = coarsest_m;
  Scene const scene(std::move(park), {});
  auto const lens = geo::pinhole(32, 24, 1.2);
  auto const rays = rays_of(lens);
  for (double const tilt : {0.0, 1.0}) {
    geo::GroundView const view{.lens = lens,
                               .site_from_camera = geo::camera_at(geo::Point3<geo::SiteFrame>(0, 0, 20), 1.0, tilt)};
    auto const now = occupation_at(scene.park(), base::UtcTime(std::chrono::hours(12)));
    require(now.taken.size() == scene.park().slots.size());
    for (auto const& vehicle : now.vehicles) require(vehicle.at.is_finite());
    require(scene.seen(view, rays, now).size() == cv::Size(32, 24));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string const text(reinterpret_cast<char const*>(data), size);
  read_table(text);
  auto const park = car_park_of("fuzz", text);
  if (park) {
    require(park->slots.size() <= most_slots && park->trees.size() <= most_parts);
    look_at(*park);
  } else {
    require(!park.error().message.empty());
  }
  return 0;
}
