#include "sim/building/picture/lens.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lapwing::sim::building {

namespace {

/// Weights of a pixel and those to each side of it; their sum, both sides counted, is 1.
using Weights = std::vector<float>;

/// Red, green and blue of pixels that lie side by side, which all become the same sum of their neighbours: worked out
/// many at a time.
using Line = Eigen::Map<Eigen::ArrayXf const>;

constexpr Eigen::Index channels = 3;

/// The weighted sum of a line and of those so many to each side of it, which `at` gives.
template <class At>
void blur_line(Weights const& weights, Eigen::Map<Eigen::ArrayXf> into, At const& at) {
  into = weights[0] * at(0);
  for (int off = 1; off < static_cast<int>(weights.size()); ++off)
    into += weights[static_cast<std::size_t>(off)] * (at(-off) + at(off));
}

/// Beyond an edge is what is on it.
void blur_rows(LightField& field, Weights const& weights) {
  auto const reach = static_cast<std::ptrdiff_t>(weights.size()) - 1;
  std::vector<Light> wider(static_cast<std::size_t>(field.width + 2 * reach));
  for (int y = 0; y < field.height; ++y) {
    auto const row = field.light.begin() + static_cast<std::ptrdiff_t>(y) * field.width;
    std::fill_n(wider.begin(), reach, row[0]);
    std::copy_n(row, field.width, wider.begin() + reach);
    std::fill_n(wider.end() - reach, reach, row[field.width - 1]);
    blur_line(weights, {row->data(), channels * field.width}, [&](int off) {
      return Line(wider[static_cast<std::size_t>(reach + off)].data(), channels * field.width);
    });
  }
}

void blur_columns(LightField& field, Weights const& weights) {
  auto const before = field.light;
  auto const row = [&](int y) {
    return static_cast<std::size_t>(std::clamp(y, 0, field.height - 1)) * static_cast<std::size_t>(field.width);
  };
  for (int y = 0; y < field.height; ++y)
    blur_line(weights, {field.light[row(y)].data(), channels * field.width},
              [&](int off) { return Line(before[row(y + off)].data(), channels * field.width); });
}

/// Standard deviations of noise to draw from: four a draw of 64 bits, where working each out would cost more than the
/// rest of a picture. Exactly of mean 0 and deviation 1.
class NoiseTable {
 public:
  static constexpr std::size_t size = std::size_t{1} << 14U;

  explicit NoiseTable(Noise& noise) {
    double sum = 0.0;
    double squares = 0.0;
    for (auto& value : values_) {
      value = static_cast<float>(noise.gaussian());
      sum += value;
      squares += static_cast<double>(value) * value;
    }
    auto const mean = static_cast<float>(sum / size);
    auto const deviation = static_cast<float>(std::sqrt(squares / size - static_cast<double>(mean) * mean));
    for (auto& value : values_) value = (value - mean) / deviation;
  }
  [[nodiscard]] float next(Noise& noise) {
    if (left_ == 0) {
      bits_ = noise.bits();
      left_ = 4;
    }
    --left_;
    float const value = values_[bits_ & (size - 1)];
    bits_ >>= 16U;
    return value;
  }

 private:
  std::array<float, size> values_{};
  std::uint64_t bits_ = 0;
  int left_ = 0;
};

}  // namespace

void defocus(LightField& field, double deviation_px) {
  constexpr double least_px = 0.2;
  if (deviation_px < least_px) return;
  auto const reach = static_cast<int>(std::ceil(3.0 * deviation_px));
  Weights weights;
  double sum = 0.0;
  for (int i = 0; i <= reach; ++i) {
    weights.push_back(static_cast<float>(std::exp(-i * i / (2.0 * deviation_px * deviation_px))));
    sum += (i == 0 ? 1.0 : 2.0) * weights.back();
  }
  for (auto& weight : weights) weight /= static_cast<float>(sum);
  blur_rows(field, weights);
  blur_columns(field, weights);
}

void smear(LightField& field, double length_px) {
  double const length = std::min(std::abs(length_px), 0.5 * field.width);
  if (length < 0.5) return;
  double const half = (length + 1.0) / 2.0;
  Weights weights;
  for (int i = 0; i < half; ++i)
    weights.push_back(static_cast<float>(std::clamp(half - i + (i == 0 ? 0.0 : 0.5), 0.0, 1.0)));
  float sum = weights[0];
  for (std::size_t i = 1; i < weights.size(); ++i) sum += 2.0F * weights[i];
  for (auto& weight : weights) weight /= sum;
  blur_rows(field, weights);
}

Picture expose(LightField const& field, CameraSettings const& settings, Noise noise) {
  Picture picture{.width = field.width, .height = field.height, .rgb = {}};
  picture.rgb.resize(3 * field.light.size());
  NoiseTable table(noise);
  double const corner_square = (field.width * 1.0 * field.width + field.height * 1.0 * field.height) / 4.0;
  auto const deviation = static_cast<float>(255.0 * settings.noise);
  std::size_t at = 0;
  for (int y = 0; y < field.height; ++y) {
    double const off_y = y + 0.5 - field.height / 2.0;
    for (int x = 0; x < field.width; ++x) {
      double const off_x = x + 0.5 - field.width / 2.0;
      double const out = (off_x * off_x + off_y * off_y) / corner_square;
      auto const passes = static_cast<float>(255.0 * settings.light * (1.0 + (settings.corner_light - 1.0) * out));
      auto const& light = field.light[at / 3];
      for (int channel = 0; channel < 3; ++channel, ++at) {
        float const value = passes * light[channel] + deviation * table.next(noise);
        picture.rgb[at] = static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
      }
    }
  }
  return picture;
}

}  // namespace lapwing::sim::building
