#include "sim/building/picture/camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/assert.hpp"
#include "sim/building/picture/lens.hpp"
#include "sim/building/picture/visibility.hpp"

namespace lapwing::sim::building {

namespace {

/// Edges are looked at with so many parts of a pixel each way.
constexpr int parts = 2;

class Painter {
 public:
  Painter(std::vector<Surface> const& fixed, std::vector<Surface> const& moving, CameraPose const& pose,
          CameraSettings const& settings)
      : fixed_(fixed), moving_(moving), view_(view_of(pose, settings, parts)), seen_(view_) {
    std::uint32_t number = 0;
    for (auto const* list : {&fixed, &moving}) {
      for (auto const& surface : *list) seen_.draw(surface, number++);
    }
  }

  [[nodiscard]] LightField paint() const {
    LightField field{.width = view_.width / parts, .height = view_.height / parts, .light = {}};
    field.light.reserve(static_cast<std::size_t>(field.width) * static_cast<std::size_t>(field.height));
    for (int y = 0; y < field.height; ++y) {
      for (int x = 0; x < field.width; ++x) field.light.push_back(pixel(x * parts, y * parts));
    }
    return field;
  }

 private:
  [[nodiscard]] Surface const& surface(std::uint32_t number) const {
    return number < fixed_.size() ? fixed_[number] : moving_[number - fixed_.size()];
  }
  /// Of the light that comes along a ray, where a pixel is `wide` parts wide.
  [[nodiscard]] Light look(std::uint32_t number, double x, double y, double wide) const {
    constexpr float sky = 0.75F;
    if (number == Visibility::nothing) return {sky, sky, sky};
    auto const& one = surface(number);
    auto const ray = view_.ray(x, y);
    double const aslant = one.normal.dot(ray);
    double const along = one.normal.dot(one.corners[0] - view_.at) / aslant;
    // A pixel's width on the surface, longer the more aslant it is met; the mean of both ways, so that letters seen
    // from the side lose their upright strokes no sooner than a lens makes them.
    double const across_m = along * wide / view_.focal_px;
    double const tilt = std::max(std::abs(aslant) / ray.norm(), 0.05);
    return shade(one, view_.at + along * ray, across_m / std::sqrt(tilt));
  }
  [[nodiscard]] Light pixel(int x, int y) const {
    std::array const numbers{seen_.at(x, y), seen_.at(x + 1, y), seen_.at(x, y + 1), seen_.at(x + 1, y + 1)};
    if (std::ranges::count(numbers, numbers[0]) == parts * parts) return look(numbers[0], x + 1.0, y + 1.0, parts);
    Light sum = Light::Zero();
    for (int i = 0; i < parts * parts; ++i) {
      int const row = i / parts;
      sum += look(numbers[static_cast<std::size_t>(i)], x + i % parts + 0.5, y + row + 0.5, 1.0);
    }
    return sum / static_cast<float>(parts * parts);
  }

  std::vector<Surface> const& fixed_;
  std::vector<Surface> const& moving_;
  View view_;
  Visibility seen_;
};

}  // namespace

double CameraSettings::focal_px() const {
  return width / 2.0 / std::tan(view_rad / 2.0);
}

CameraPose camera_on(Pose const& body, CameraSettings const& settings) {
  double const cos = std::cos(body.yaw_rad);
  double const sin = std::sin(body.yaw_rad);
  return {.at = {body.position.x() + settings.x_m * cos - settings.y_m * sin,
                 body.position.y() + settings.x_m * sin + settings.y_m * cos, settings.up_m},
          .yaw_rad = geo::wrap_pi(body.yaw_rad + settings.yaw_rad),
          .pitch_rad = settings.pitch_rad};
}

std::optional<Eigen::Vector2d> pixel_of(Eigen::Vector3d const& point, CameraPose const& pose,
                                        CameraSettings const& settings) {
  auto const view = view_of(pose, settings, 1);
  Eigen::Vector3d const to = point - view.at;
  double const far_m = to.dot(view.forward);
  if (far_m <= 0.0) return std::nullopt;
  return Eigen::Vector2d(view.width / 2.0 + view.focal_px * to.dot(view.right) / far_m,
                         view.height / 2.0 + view.focal_px * to.dot(view.down) / far_m);
}

Picture develop(Shot const& shot) {
  constexpr double most_pixels = 64e6;
  auto const& settings = shot.settings;
  LAPWING_ASSERT(settings.width > 0 && settings.height > 0 && 1.0 * settings.width * settings.height <= most_pixels);
  auto field = Painter(*shot.fixed, shot.moving, shot.pose, settings).paint();
  defocus(field, settings.defocus_px);
  smear(field, shot.turn_rad_s * settings.exposure_s * settings.focal_px());
  return expose(field, settings, shot.noise);
}

}  // namespace lapwing::sim::building
