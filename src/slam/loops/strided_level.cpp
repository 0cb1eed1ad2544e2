#include "slam/loops/strided_level.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace lapwing::slam {
namespace {

/// Cells that are added together. A row has as many zeros behind its end, so that the last of them need no care.
constexpr int lanes = 16;
/// Before 16 bits run over.
constexpr int most_uncarried = 65'535 / 255;

/// Quotient and remainder of what may be negative.
struct Split {
  int whole;
  int phase;
};
Split split(int value) {
  constexpr int stride = StridedLevel::stride;
  auto const phase = ((value % stride) + stride) % stride;
  return {(value - phase) / stride, phase};
}

}  // namespace

ShiftSums::ShiftSums(int side)
    : side_(side),
      pitch_(static_cast<std::size_t>(side + lanes)),
      partial_(pitch_ * static_cast<std::size_t>(side)),
      sums_(partial_.size()) {}

void ShiftSums::clear() {
  uncarried_ = 0;
  std::ranges::fill(partial_, std::uint16_t{0});
  std::ranges::fill(sums_, 0);
}

void ShiftSums::carry() {
  for (std::size_t k = 0; k < sums_.size(); ++k) sums_[k] += partial_[k];
  std::ranges::fill(partial_, std::uint16_t{0});
  uncarried_ = 0;
}

StridedLevel::StridedLevel(int width, int height, std::function<std::uint8_t(int x, int y)> const& value)
    : columns_((width + 2 * stride - 2) / stride),
      rows_((height + 2 * stride - 2) / stride),
      pitch_(static_cast<std::size_t>(columns_ + lanes)),
      cells_(pitch_ * static_cast<std::size_t>(rows_) * stride * stride) {
  auto row = cells_.begin();
  for (int phase_y = 0; phase_y < stride; ++phase_y)
    for (int phase_x = 0; phase_x < stride; ++phase_x)
      for (int j = 0; j < rows_; ++j, row += static_cast<std::ptrdiff_t>(pitch_))
        for (int i = 0; i < columns_; ++i)
          row[i] = value(i * stride + phase_x - stride + 1, j * stride + phase_y - stride + 1);
}

void StridedLevel::add(int x, int y, ShiftSums& sums) const {
  if (++sums.uncarried_ > most_uncarried) {
    sums.carry();
    sums.uncarried_ = 1;
  }
  auto const [column, phase_x] = split(x + stride - 1);
  auto const [row, phase_y] = split(y + stride - 1);
  auto const first = std::max(0, -column);
  auto const end = std::min(sums.side_, columns_ - column);
  auto const* picture = cells_.data() + pitch_ * static_cast<std::size_t>((phase_y * stride + phase_x) * rows_);
  for (int j = std::max(0, -row); j < std::min(sums.side_, rows_ - row); ++j) {
    auto const* from = picture + static_cast<std::ptrdiff_t>(pitch_) * (row + j) + column;
    auto* to = sums.partial_.data() + sums.pitch_ * static_cast<std::size_t>(j);
    for (int i = first; i < end; i += lanes) {
      std::array<std::uint8_t, lanes> values;  // a copy, which the compiler knows not to be one of the sums
      std::memcpy(values.data(), from + i, lanes);
      for (std::size_t k = 0; k < lanes; ++k) to[i + k] = static_cast<std::uint16_t>(to[i + k] + values[k]);
    }
  }
}

}  // namespace lapwing::slam
