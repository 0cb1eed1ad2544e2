// Pictures: any bytes either are refused with a reason or become a picture within the limits, whose boxes stay in it
// when they are turned. The sides of a door are looked for wherever a box lies. What a drone wrote into the file, if it
// is one, makes sense or is not there.
#include <cmath>
#include <cstdint>
#include <span>

#include "../require.hpp"
#include "vision/doors/classic.hpp"
#include "vision/doors/door_shape.hpp"
#include "vision/image/flight.hpp"
#include "vision/image/image.hpp"

namespace {

void look_for_sides(cv::Mat const& upright, lapwing::vision::Box const& box) {
  auto const shape = lapwing::vision::door_shape(upright, box);
  lapwing::fuzz::require(shape.support >= 0.0 && shape.support <= 1.0);
  for (auto const& corner : shape.corners) lapwing::fuzz::require(std::isfinite(corner.x) && std::isfinite(corner.y));
}

void read_flight(std::span<std::byte const> file) {
  using lapwing::fuzz::require;
  auto const flight = lapwing::vision::read_flight(file);
  cv::Size const size(4000, 3000);
  auto const metres = lapwing::vision::metres_a_pixel(flight, size);
  if (!metres) return;
  require(std::isfinite(*metres) && *metres > 0.0);
  auto const place = lapwing::vision::place_of({0.0, 0.0}, size, flight, *metres);
  require(!place || (std::isfinite(place->lat_rad) && std::isfinite(place->lon_rad)));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using lapwing::fuzz::require;
  read_flight(std::as_bytes(std::span(data, size)));
  auto const image = lapwing::vision::decode_image(std::as_bytes(std::span(data, size)));
  if (!image) {
    require(!image.error().message.empty());
    return 0;
  }
  auto const upright = image->upright();
  require(!upright.empty() && upright.total() == image->stored.total() &&
          upright.total() <= lapwing::vision::max_pixels);
  double const width = upright.cols;
  double const height = upright.rows;
  look_for_sides(upright, {.x = 0.0, .y = 0.0, .width = width, .height = height});
  look_for_sides(upright, {.x = 0.4 * width, .y = 0.2 * height, .width = 0.6 * width, .height = 0.7 * height});
  for (auto const& door : lapwing::vision::doors_by_colour(upright)) {
    look_for_sides(upright, door.box);
    auto const box = image->to_stored(door.box);
    constexpr double rounding = 1e-6;
    require(box.x >= -rounding && box.y >= -rounding && box.x + box.width <= image->stored.cols + rounding &&
            box.y + box.height <= image->stored.rows + rounding);
  }
  return 0;
}
