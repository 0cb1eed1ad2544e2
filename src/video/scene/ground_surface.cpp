#include "video/scene/ground_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "video/scene/vehicle_solid.hpp"

namespace lapwing::video {

namespace {

constexpr int grain_side = 1024;
constexpr int drawn_shift = 4;
constexpr double drawn_parts = 1 << drawn_shift;
enum Subject : std::uint64_t { for_clouds = 301, for_grain, for_patches, for_cracks, for_stains };

/// How a kind of ground looks: BGR of 255, and how much clouds and grain change it.
struct Material {
  std::array<double, 3> bgr;
  double cloudy = 0.0;
  double grainy = 0.0;
};

constexpr std::array<Material, 5> materials = {{
    {{60, 96, 84}, 0.18, 0.12},      // grass
    {{108, 105, 103}, 0.075, 0.06},  // asphalt
    {{150, 156, 158}, 0.07, 0.035},  // concrete
    {{118, 132, 141}, 0.14, 0.13},   // gravel
    {{165, 170, 172}, 0.05, 0.03},   // kerb
}};
constexpr std::uint8_t kerb = 4;

/// One patch's pixels differ from the next one's: laid in another year.
struct Tone {
  Material material;
  double light = 1.0;
};

std::vector<cv::Point> drawn(std::vector<cv::Point2d> const& corners) {
  std::vector<cv::Point> points;
  for (auto const& corner : corners)  // the middle of a pixel is a whole number for OpenCV
    points.emplace_back(static_cast<int>(std::lround((corner.x - 0.5) * drawn_parts)),
                        static_cast<int>(std::lround((corner.y - 0.5) * drawn_parts)));
  return points;
}

std::vector<cv::Point2d> pixels_of(std::vector<Spot> const& places, RasterFrame const& frame) {
  std::vector<cv::Point2d> pixels;
  for (auto const& place : places) pixels.push_back(frame.pixel(place));
  return pixels;
}

/// Which of the tones each pixel has, and the tones: the first is grass, then two a patch, itself and its kerb.
struct Tones {
  cv::Mat number;  // 16 bits
  std::vector<Tone> list;
};

Tones tones_of(CarPark const& park, RasterFrame const& frame) {
  Tones tones{.number = cv::Mat::zeros(frame.size, CV_16U), .list = {{materials[0], 1.0}}};
  Dice dice(park.seed, for_patches);
  for (auto const& patch : park.patches) {
    auto const number = static_cast<double>(tones.list.size());
    auto const corners = drawn(pixels_of(patch.corners, frame));
    cv::fillPoly(tones.number, corners, number, cv::LINE_8, drawn_shift);
    constexpr double kerb_m = 0.15;
    if (patch.has_kerb)
      cv::polylines(tones.number, corners, true, number + 1.0,
                    std::max(1, static_cast<int>(std::lround(kerb_m / frame.pixel_m))), cv::LINE_8, drawn_shift);
    tones.list.push_back({materials[static_cast<std::size_t>(patch.ground)], 1.0 + 0.06 * dice.gaussian()});
    tones.list.push_back({materials[kerb], 1.0});
  }
  return tones;
}

/// Darkens a round place, most in its middle.
void stain(cv::Mat& ground, cv::Point2d const& middle, double radius_px, double depth) {
  cv::Rect const around(static_cast<int>(middle.x - radius_px), static_cast<int>(middle.y - radius_px),
                        static_cast<int>(2.0 * radius_px) + 1, static_cast<int>(2.0 * radius_px) + 1);
  auto const box = around & cv::Rect({}, ground.size());
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x) {
      double const out = std::hypot(x - middle.x, y - middle.y) / radius_px;
      if (out < 1.0) ground.at<cv::Vec3b>(y, x) *= 1.0 - depth * (1.0 - out * out);
    }
}

/// Cracks run over asphalt, and stop where it ends.
void draw_cracks(cv::Mat& ground, CarPark const& park, RasterFrame const& frame, Tones const& tones) {
  Dice dice(park.seed, for_cracks);
  constexpr double one_on_m2 = 150.0;
  double const area_m2 = static_cast<double>(frame.size.area()) * frame.pixel_m * frame.pixel_m;
  auto const count = std::min(4000, static_cast<int>(park.wear * area_m2 / one_on_m2));
  for (int i = 0; i < count; ++i) {
    cv::Point2d at(dice.uniform(0.0, frame.size.width), dice.uniform(0.0, frame.size.height));
    double heading = dice.uniform(0.0, 2.0 * std::numbers::pi);
    int const steps = 3 + static_cast<int>(dice.bits() % 14);
    double const dark = dice.uniform(0.45, 0.75);
    for (int k = 0; k < steps; ++k) {
      heading += 0.5 * dice.gaussian();
      cv::Point2d const next = at + cv::Point2d(std::cos(heading), std::sin(heading)) * (0.5 / frame.pixel_m);
      cv::Point const pixel = next;
      if (!cv::Rect({}, frame.size).contains(pixel)) break;
      auto const& tone = tones.list[tones.number.at<std::uint16_t>(pixel)];
      if (tone.material.bgr != materials[static_cast<std::size_t>(Ground::asphalt)].bgr) break;
      auto const colour = ground.at<cv::Vec3b>(pixel) * dark;
      cv::line(ground, cv::Point(at), pixel, cv::Scalar(colour[0], colour[1], colour[2]), 1, cv::LINE_AA);
      at = next;
    }
  }
}

/// Engines drip where they stand.
void draw_stains(cv::Mat& ground, CarPark const& park, RasterFrame const& frame) {
  for (std::size_t i = 0; i < park.slots.size(); ++i) {
    Dice dice(park.seed, for_stains, i);
    if (!dice.happens(0.3 + 0.5 * park.wear)) continue;
    auto const& corners = park.slots[i].outline;
    auto const in = dice.uniform(0.55, 0.8);
    auto const middle =
        corners[0] + (corners[1] - corners[0]) * dice.uniform(0.4, 0.6) + (corners[3] - corners[0]) * in;
    stain(ground, frame.pixel(middle), dice.uniform(0.25, 0.8) / frame.pixel_m, park.wear * dice.uniform(0.15, 0.6));
  }
}

/// How much of the paint is left, pixel by pixel.
struct Wear {
  double depth;
  cv::Mat const& clouds;
  cv::Mat const& grain;

  [[nodiscard]] double left_at(int row, int column) const {
    double const cloudy = (clouds.at<std::uint8_t>(row, column) - 128.0) / 40.0;
    double const grainy = static_cast<double>(grain.at<float>(row % grain_side, column % grain_side));
    return std::clamp(1.0 - depth * (0.8 + 0.5 * cloudy + 0.35 * grainy), 0.0, 1.0);
  }
};

void mix(cv::Vec3b& pixel, cv::Scalar const& colour, double share) {
  for (int channel = 0; channel < 3; ++channel)
    pixel[channel] = cv::saturate_cast<std::uint8_t>(pixel[channel] + share * (colour[channel] - pixel[channel]));
}

/// A straight piece of a line, by its four corners in the ground's pixels.
void paint_piece(cv::Mat& ground, std::vector<cv::Point2d> corners, cv::Scalar const& colour, Wear const& wear) {
  std::vector<cv::Point2f> const rough(corners.begin(), corners.end());
  auto const box = (cv::boundingRect(rough) + cv::Size(4, 4) - cv::Point(2, 2)) & cv::Rect({}, ground.size());
  if (box.empty()) return;
  cv::Mat mask = cv::Mat::zeros(box.size(), CV_8U);
  for (auto& corner : corners) corner -= cv::Point2d(box.tl());
  fill_mask(mask, corners);
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x)
      if (auto const covered = mask.at<std::uint8_t>(y, x); covered != 0)
        mix(ground.at<cv::Vec3b>(y + box.y, x + box.x), colour, wear.left_at(y + box.y, x + box.x) * covered / 255.0);
}

}  // namespace

cv::Scalar mean_grass() {
  return {materials[0].bgr[0], materials[0].bgr[1], materials[0].bgr[2]};
}

void fill_mask(cv::Mat& mask, std::vector<cv::Point2d> const& corners, double value) {
  cv::fillPoly(mask, drawn(corners), value, cv::LINE_AA, drawn_shift);
}

cv::Mat clouds(cv::Size size, double pixel_m, std::uint64_t seed) {
  // Drawn in pixels of half a metre, and made large once.
  constexpr double coarse_m = 0.5;
  cv::Size const coarse(std::max(2, static_cast<int>(size.width * pixel_m / coarse_m)),
                        std::max(2, static_cast<int>(size.height * pixel_m / coarse_m)));
  cv::Mat sum(coarse, CV_32F, cv::Scalar(128.0));
  cv::RNG rng(Dice(seed, for_clouds).bits());
  for (double const cell_m : {1.0, 4.0, 16.0}) {
    cv::Size const cells(std::max(2, static_cast<int>(coarse.width * coarse_m / cell_m)),
                         std::max(2, static_cast<int>(coarse.height * coarse_m / cell_m)));
    cv::Mat noise(cells, CV_32F);
    constexpr double spread = 26.0;
    rng.fill(noise, cv::RNG::NORMAL, 0.0, spread);
    cv::resize(noise, noise, coarse, 0.0, 0.0, cv::INTER_CUBIC);
    sum += noise;
  }
  cv::Mat out;
  sum.convertTo(out, CV_8U);
  cv::resize(out, out, size, 0.0, 0.0, cv::INTER_LINEAR);
  return out;
}

cv::Mat grain(std::uint64_t seed) {
  cv::Mat fine(grain_side, grain_side, CV_32F);
  cv::RNG rng(Dice(seed, for_grain).bits());
  rng.fill(fine, cv::RNG::NORMAL, 0.0, 1.0);
  cv::Mat soft;
  cv::GaussianBlur(fine, soft, {}, 1.2);
  constexpr double of_soft = 2.4;
  return 0.7 * fine + of_soft * soft;
}

cv::Mat draw_surface(CarPark const& park, RasterFrame const& frame, cv::Mat const& clouds, cv::Mat const& grain) {
  auto const tones = tones_of(park, frame);
  cv::Mat ground(frame.size, CV_8UC3);
  for (int y = 0; y < frame.size.height; ++y) {
    auto const* const number = tones.number.ptr<std::uint16_t>(y);
    auto const* const cloud = clouds.ptr<std::uint8_t>(y);
    auto const* const fine = grain.ptr<float>(y % grain_side);
    auto* const out = ground.ptr<cv::Vec3b>(y);
    for (int x = 0; x < frame.size.width; ++x) {
      auto const& tone = tones.list[number[x]];
      double const cloudy = (cloud[x] - 128.0) / 40.0;
      double const light = tone.light * (1.0 + tone.material.cloudy * cloudy +
                                         tone.material.grainy * static_cast<double>(fine[x % grain_side]));
      for (int channel = 0; channel < 3; ++channel)
        out[x][channel] = cv::saturate_cast<std::uint8_t>(tone.material.bgr[static_cast<std::size_t>(channel)] * light);
    }
  }
  draw_cracks(ground, park, frame, tones);
  draw_stains(ground, park, frame);
  return ground;
}

void draw_paint(cv::Mat& ground, CarPark const& park, RasterFrame const& frame, cv::Mat const& clouds,
                cv::Mat const& grain) {
  Wear const wear{park.wear, clouds, grain};
  for (auto const& stripe : park.stripes) {
    auto const colour = bgr(stripe.colour, 1.0);
    for (std::size_t i = 1; i < stripe.points.size(); ++i) {
      auto const& from = stripe.points[i - 1];
      auto const& to = stripe.points[i];
      auto const way = to - from;
      if (way.length() <= 0.0) continue;
      auto const aside = geo::Vector<geo::SiteFrame>(-way.y(), way.x()) * (0.5 * stripe.width_m / way.length());
      paint_piece(ground, pixels_of({from + aside, to + aside, to - aside, from - aside}, frame), colour, wear);
    }
  }
}

}  // namespace lapwing::video
