#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace lapwing::slam {

/// Sums over points at the shifts of a square window, a stride apart.
class ShiftSums {
 public:
  explicit ShiftSums(int side);

  [[nodiscard]] int side() const { return side_; }
  /// Empties them.
  void clear();
  [[nodiscard]] int at(int column, int row) const {
    auto const k = static_cast<std::size_t>(row) * pitch_ + static_cast<std::size_t>(column);
    return sums_[k] + partial_[k];
  }

 private:
  friend class StridedLevel;
  void carry();

  int side_;
  std::size_t pitch_;
  int uncarried_ = 0;  ///< points in the partial sums
  std::vector<std::uint16_t> partial_;
  std::vector<int> sums_;
};

/// One level of a pyramid, to be asked at many places a stride apart at once: cells a stride apart are neighbours in
/// memory, so that what one point adds to all shifts is added a row at a time (Hinterstoisser et al. 2012, Gradient
/// Response Maps for Real-Time Detection of Texture-Less Objects, "Linearizing the memory for parallelization").
class StridedLevel {
 public:
  static constexpr int stride = 16;

  StridedLevel() = default;
  /// `value(x, y)` is asked from -stride + 1 up to `width` and `height`; elsewhere the level is 0.
  StridedLevel(int width, int height, std::function<std::uint8_t(int x, int y)> const& value);

  /// Adds the value at x + stride * column, y + stride * row to each of the sums.
  void add(int x, int y, ShiftSums& sums) const;

 private:
  int columns_ = 0;
  int rows_ = 0;
  std::size_t pitch_ = 0;
  std::vector<std::uint8_t> cells_;  ///< of each phase of y, of each phase of x, a picture in rows
};

}  // namespace lapwing::slam
