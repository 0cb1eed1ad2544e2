#pragma once

#include <optional>

#include "vision/image/internal/bytes.hpp"

namespace lapwing::vision::internal {

/// The TIFF directories that a JPEG's APP1 segment holds. Outside bytes: what makes no sense is as if it were not
/// there.
class Exif {
 public:
  /// None if the segment holds something else.
  [[nodiscard]] static std::optional<Exif> of_segment(Bytes app1);

  /// Where the first directory is, and those that it points to.
  [[nodiscard]] std::size_t directory() const { return number(4, 4); }
  [[nodiscard]] std::optional<std::size_t> directory_at(std::uint32_t tag) const;
  /// A whole number or a letter.
  [[nodiscard]] std::optional<std::uint32_t> value(std::size_t directory, std::uint32_t tag) const;
  /// The k-th of fractions; none if it is divided by nothing.
  [[nodiscard]] std::optional<double> fraction(std::size_t directory, std::uint32_t tag, std::size_t k = 0) const;

 private:
  Exif(Bytes tiff, bool is_little) : tiff_(tiff), is_little_(is_little) {}
  [[nodiscard]] std::uint32_t number(std::size_t at, std::size_t length) const;
  [[nodiscard]] std::optional<std::size_t> entry(std::size_t directory, std::uint32_t tag) const;

  Bytes tiff_;
  bool is_little_;
};

}  // namespace lapwing::vision::internal
