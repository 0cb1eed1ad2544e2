#include "vision/image/internal/exif.hpp"

namespace lapwing::vision::internal {

namespace {

constexpr std::size_t entry_bytes = 12;
constexpr std::uint32_t kind_byte = 1;
constexpr std::uint32_t kind_text = 2;
constexpr std::uint32_t kind_short = 3;
constexpr std::uint32_t kind_fraction = 5;

}  // namespace

std::optional<Exif> Exif::of_segment(Bytes app1) {
  if (!says(app1, 0, std::string_view("Exif\0\0", 6))) return std::nullopt;
  auto const tiff = app1.subspan(6);
  return Exif(tiff, says(tiff, 0, "II"));
}

std::uint32_t Exif::number(std::size_t at, std::size_t length) const {
  return is_little_ ? little_endian(tiff_, at, length) : big_endian(tiff_, at, length);
}

std::optional<std::size_t> Exif::entry(std::size_t directory, std::uint32_t tag) const {
  std::size_t const entries = number(directory, 2);
  for (std::size_t k = 0; k < entries; ++k) {
    std::size_t const at = directory + 2 + k * entry_bytes;
    if (at + entry_bytes > tiff_.size()) break;
    if (number(at, 2) == tag) return at;
  }
  return std::nullopt;
}

std::optional<std::size_t> Exif::directory_at(std::uint32_t tag) const {
  auto const at = entry(directory(), tag);
  if (!at) return std::nullopt;
  return number(*at + 8, 4);
}

std::optional<std::uint32_t> Exif::value(std::size_t directory, std::uint32_t tag) const {
  auto const at = entry(directory, tag);
  if (!at) return std::nullopt;
  auto const kind = number(*at + 2, 2);
  if (kind == kind_byte || kind == kind_text) return number(*at + 8, 1);
  return number(*at + 8, kind == kind_short ? 2 : 4);
}

std::optional<double> Exif::fraction(std::size_t directory, std::uint32_t tag, std::size_t k) const {
  auto const at = entry(directory, tag);
  if (!at || number(*at + 2, 2) != kind_fraction || k >= number(*at + 4, 4)) return std::nullopt;
  std::size_t const where = std::size_t{number(*at + 8, 4)} + 8 * k;
  auto const under = number(where + 4, 4);
  if (where + 8 > tiff_.size() || under == 0) return std::nullopt;
  return static_cast<double>(number(where, 4)) / under;
}

}  // namespace lapwing::vision::internal
