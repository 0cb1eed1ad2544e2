#include "formats/picture_geotiff.hpp"

#include <fmt/format.h>

#include <cpl_string.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "formats/internal/gdal.hpp"
#include "formats/internal/grid_cells.hpp"

namespace lapwing::formats {

namespace {

using base::ErrorKind;
using base::fail;

/// An image in memory: red, green, blue, a plane after the other.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> planes;

  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  [[nodiscard]] double at(int plane, int x, int y) const {
    return planes[static_cast<std::size_t>(plane) * count() +
                  static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

/// The same bytes as a file of GDAL's, for as long as this lives.
class MemoryFile {
 public:
  explicit MemoryFile(std::string const& bytes)
      : name_(fmt::format("/vsimem/picture-{}", static_cast<void const*>(this))), bytes_(bytes) {
    VSIFCloseL(VSIFileFromMemBuffer(name_.c_str(), reinterpret_cast<GByte*>(bytes_.data()), bytes_.size(), FALSE));
  }
  ~MemoryFile() { VSIUnlink(name_.c_str()); }
  MemoryFile(MemoryFile const&) = delete;
  MemoryFile& operator=(MemoryFile const&) = delete;
  [[nodiscard]] char const* name() const { return name_.c_str(); }

 private:
  std::string name_;
  std::string bytes_;
};

bool read_planes(GDALDataset& data, Image& image) {
  image.planes.resize(image.count() * 3);
  for (int plane = 0; plane < 3; ++plane) {
    auto* band = data.GetRasterBand(data.GetRasterCount() >= 3 ? plane + 1 : 1);
    auto* into = image.planes.data() + static_cast<std::size_t>(plane) * image.count();
    if (band->RasterIO(GF_Read, 0, 0, image.width, image.height, into, image.width, image.height, GDT_Byte, 0, 0,
                       nullptr) != CE_None)
      return false;
  }
  return true;
}

base::Result<Image> decoded(std::string const& bytes) {
  Image image;
  bool is_too_large = false;
  MemoryFile const file(bytes);
  auto const done = internal::with_gdal("the picture cannot be decoded", [&] {
    std::array const drivers = {"JPEG", "PNG", "WEBP", "GTiff", static_cast<char const*>(nullptr)};
    GDALDatasetUniquePtr const data(
        GDALDataset::Open(file.name(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers.data(), nullptr, nullptr));
    if (!data || data->GetRasterCount() < 1) return false;
    image.width = data->GetRasterXSize();
    image.height = data->GetRasterYSize();
    is_too_large = std::int64_t{image.width} * image.height > internal::most_cells;
    return is_too_large || read_planes(*data, image);
  });
  if (!done) return fail(ErrorKind::invalid_input, done.error().message);
  if (is_too_large) return fail(ErrorKind::invalid_input, "the picture has more than 400 million pixels");
  return image;
}

/// From the plane of the site to the picture's pixels: the projective map that takes four points to four others.
/// (Hartley & Zisserman, Multiple View Geometry, 2nd ed., section 4.1, inhomogeneous solution.) Coordinates are taken
/// from the first corner on, which keeps the equations well conditioned.
Eigen::Matrix3d homography(std::array<Eigen::Vector2d, 4> const& ground, std::array<Eigen::Vector2d, 4> const& pixels) {
  Eigen::Matrix<double, 8, 8> equations = Eigen::Matrix<double, 8, 8>::Zero();
  Eigen::Matrix<double, 8, 1> values;
  for (Eigen::Index i = 0; i < 4; ++i) {
    auto const& from = ground[static_cast<std::size_t>(i)];
    auto const& to = pixels[static_cast<std::size_t>(i)];
    equations.row(2 * i) << from.x(), from.y(), 1.0, 0.0, 0.0, 0.0, -to.x() * from.x(), -to.x() * from.y();
    equations.row(2 * i + 1) << 0.0, 0.0, 0.0, from.x(), from.y(), 1.0, -to.y() * from.x(), -to.y() * from.y();
    values.segment<2>(2 * i) = to;
  }
  Eigen::Matrix<double, 8, 1> const h = equations.colPivHouseholderQr().solve(values);
  Eigen::Matrix3d map;
  map << h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), 1.0;
  // What is before the camera shall have a positive third coordinate, also where the horizon lies between the origin
  // and the footprint.
  Eigen::Vector2d const middle = (ground[0] + ground[1] + ground[2] + ground[3]) / 4.0;
  return (map * middle.homogeneous()).z() < 0.0 ? Eigen::Matrix3d(-map) : map;
}

/// What is drawn, where it begins, and how large its pixels are.
struct Drawing {
  map::SitePoint upper_left;
  double pixel_m = 0.0;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> planes;  ///< red, green, blue, opacity
};

double bilinear(Image const& image, int plane, double x, double y) {
  int const left = std::clamp(static_cast<int>(std::floor(x)), 0, image.width - 1);
  int const top = std::clamp(static_cast<int>(std::floor(y)), 0, image.height - 1);
  int const right = std::min(left + 1, image.width - 1);
  int const bottom = std::min(top + 1, image.height - 1);
  double const to_right = std::clamp(x - left, 0.0, 1.0);
  double const down = std::clamp(y - top, 0.0, 1.0);
  double const above = image.at(plane, left, top) * (1.0 - to_right) + image.at(plane, right, top) * to_right;
  double const below = image.at(plane, left, bottom) * (1.0 - to_right) + image.at(plane, right, bottom) * to_right;
  return above * (1.0 - down) + below * down;
}

void draw(Image const& image, Eigen::Matrix3d const& pixel_from_ground, Drawing& drawing) {
  auto const count = static_cast<std::size_t>(drawing.width) * static_cast<std::size_t>(drawing.height);
  drawing.planes.assign(count * 4, 0);
  for (int row = 0; row < drawing.height; ++row) {
    for (int column = 0; column < drawing.width; ++column) {
      Eigen::Vector3d const ground((column + 0.5) * drawing.pixel_m, -(row + 0.5) * drawing.pixel_m, 1.0);
      Eigen::Vector3d const seen = pixel_from_ground * ground;
      if (seen.z() <= 0.0) continue;
      double const x = seen.x() / seen.z();
      double const y = seen.y() / seen.z();
      if (x < 0.0 || y < 0.0 || x > image.width || y > image.height) continue;
      auto const at =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(drawing.width) + static_cast<std::size_t>(column);
      for (int plane = 0; plane < 3; ++plane)
        drawing.planes[static_cast<std::size_t>(plane) * count + at] =
            static_cast<std::uint8_t>(std::lround(bilinear(image, plane, x - 0.5, y - 0.5)));
      drawing.planes[3 * count + at] = 255;
    }
  }
}

base::Result<Drawing> drawn(map::Picture const& picture, Image const& image) {
  map::SitePolygon const ground{{picture.footprint}};
  auto const box = geo::bounds(ground);
  Drawing drawing;
  drawing.upper_left = {box.least.x(), box.most.y()};
  drawing.pixel_m = std::sqrt(geo::area_m2(ground) / static_cast<double>(image.count()));
  if (!(drawing.pixel_m > 1e-4)) return fail(ErrorKind::invalid_input, "the footprint of the picture has no area");
  double const width = std::ceil((box.most.x() - box.least.x()) / drawing.pixel_m);
  double const height = std::ceil((box.most.y() - box.least.y()) / drawing.pixel_m);
  if (width * height > static_cast<double>(internal::most_cells))
    return fail(ErrorKind::invalid_input, "the footprint of the picture is too long and thin to be drawn");
  drawing.width = static_cast<int>(width);
  drawing.height = static_cast<int>(height);
  std::array<Eigen::Vector2d, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = picture.footprint[i].v - drawing.upper_left.v;
  double const right = image.width;
  double const bottom = image.height;
  draw(image, homography(corners, {{{0.0, 0.0}, {right, 0.0}, {right, bottom}, {0.0, bottom}}}), drawing);
  return drawing;
}

}  // namespace

base::Result<> write_picture_geotiff(map::Picture const& picture, std::string const& bytes, geo::Site const& site,
                                     std::filesystem::path const& path) {
  auto const image = decoded(bytes);
  if (!image) return std::unexpected(image.error());
  auto drawing = drawn(picture, *image);
  if (!drawing) return std::unexpected(drawing.error());
  return internal::with_gdal(fmt::format("{} cannot be written", path.string()), [&] {
    auto* manager = GetGDALDriverManager();
    GDALDatasetUniquePtr const whole(
        manager->GetDriverByName("MEM")->Create("", drawing->width, drawing->height, 4, GDT_Byte, nullptr));
    if (!whole) return false;
    std::array<double, 6> affine = {drawing->upper_left.x(), drawing->pixel_m, 0.0, drawing->upper_left.y(), 0.0,
                                    -drawing->pixel_m};
    auto const plane = internal::plane_of(site);
    whole->SetGeoTransform(affine.data());
    whole->SetSpatialRef(&plane);
    constexpr std::array meanings = {GCI_RedBand, GCI_GreenBand, GCI_BlueBand, GCI_AlphaBand};
    for (int band = 0; band < 4; ++band)
      whole->GetRasterBand(band + 1)->SetColorInterpretation(meanings[static_cast<std::size_t>(band)]);
    if (whole->RasterIO(GF_Write, 0, 0, drawing->width, drawing->height, drawing->planes.data(), drawing->width,
                        drawing->height, GDT_Byte, 4, nullptr, 0, 0, 0, nullptr) != CE_None)
      return false;
    CPLStringList options;
    options.SetNameValue("COMPRESS", "DEFLATE");
    GDALDatasetUniquePtr const file(manager->GetDriverByName("COG")->CreateCopy(path.c_str(), whole.get(), false,
                                                                                options.List(), nullptr, nullptr));
    return file != nullptr;
  });
}

}  // namespace lapwing::formats
