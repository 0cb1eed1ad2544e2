#include "formats/grid_geotiff.hpp"

#include <fmt/format.h>

#include <cpl_string.h>

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "formats/internal/gdal.hpp"
#include "formats/internal/grid_cells.hpp"

namespace lapwing::formats {

namespace {

using base::ErrorKind;
using base::fail;
using map::Cell;
using map::Evidence;
using map::OccupancyGrid;

constexpr double steps_a_nat = 256.0;
constexpr std::int16_t unseen = INT16_MIN;
constexpr std::string_view log_odds_band = "log odds";

std::array<double, 6> pixels_to_plane(OccupancyGrid const& grid, map::CellBox const& box) {
  double const size_m = grid.resolution_m();
  double const turn = grid.site_from_grid().yaw_rad();
  auto const upper_left =
      grid.site_from_grid() *
      geo::Point<map::GridFrame>(box.least.x * size_m, static_cast<double>(box.least.y + box.height) * size_m);
  return {upper_left.x(), size_m * std::cos(turn), size_m * std::sin(turn),
          upper_left.y(), size_m * std::sin(turn), -size_m * std::cos(turn)};
}

bool write_rows(GDALDataset& data, OccupancyGrid const& grid, map::CellBox const& box) {
  auto const width = static_cast<int>(box.width);
  std::vector<std::int16_t> percent(static_cast<std::size_t>(width));
  std::vector<std::int16_t> steps(static_cast<std::size_t>(width));
  for (int row = 0; row < box.height; ++row) {
    for (int x = 0; x < width; ++x) {
      auto const evidence = grid.at({box.least.x + x, static_cast<std::int32_t>(box.least.y + box.height - 1 - row)});
      auto const at = static_cast<std::size_t>(x);
      percent[at] =
          evidence.is_seen() ? static_cast<std::int16_t>(std::lround(evidence.probability() * 100.0)) : unseen;
      steps[at] =
          evidence.is_seen() ? static_cast<std::int16_t>(std::lround(evidence.log_odds() * steps_a_nat)) : unseen;
    }
    for (int band = 1; band <= 2; ++band) {
      auto* values = band == 1 ? percent.data() : steps.data();
      if (data.GetRasterBand(band)->RasterIO(GF_Write, 0, row, width, 1, values, width, 1, GDT_Int16, 0, 0, nullptr) !=
          CE_None)
        return false;
    }
  }
  return true;
}

void describe(GDALDataset& data) {
  auto* percent = data.GetRasterBand(1);
  percent->SetDescription("occupancy");
  percent->SetUnitType("percent");
  auto* log_odds = data.GetRasterBand(2);
  log_odds->SetDescription(std::string(log_odds_band).c_str());
  log_odds->SetScale(1.0 / steps_a_nat);
  data.SetMetadataItem("occupancy", "percent that a cell is taken; -32768: never seen");
  data.SetMetadataItem("log_odds", "of being taken, natural, in steps of 1/256; -32768: never seen");
}

/// How the values of a band are meant.
enum class Meaning { steps, percent, share };

Evidence evidence_of(double value, Meaning meaning, std::optional<double> no_data) {
  if (!std::isfinite(value) || (no_data && value == *no_data)) return {};
  switch (meaning) {
    case Meaning::steps: return value <= unseen ? Evidence() : Evidence::of_log_odds(value / steps_a_nat);
    case Meaning::percent: return value < 0.0 || value > 100.0 ? Evidence() : Evidence::of_probability(value / 100.0);
    case Meaning::share: return value < 0.0 || value > 1.0 ? Evidence() : Evidence::of_probability(value);
  }
  return {};
}

bool is_exact(GDALDataset& data) {
  return data.GetRasterCount() >= 2 && std::string_view(data.GetRasterBand(2)->GetDescription()) == log_odds_band;
}

bool read_cells(GDALDataset& data, OccupancyGrid& grid) {
  auto* band = data.GetRasterBand(is_exact(data) ? 2 : 1);
  bool const is_real = band->GetRasterDataType() == GDT_Float32 || band->GetRasterDataType() == GDT_Float64;
  auto const meaning = is_exact(data) ? Meaning::steps : is_real ? Meaning::share : Meaning::percent;
  int has_no_data = 0;
  double const given = band->GetNoDataValue(&has_no_data);
  auto const no_data = has_no_data != 0 && meaning != Meaning::steps ? std::optional(given) : std::nullopt;
  int const width = data.GetRasterXSize();
  int const height = data.GetRasterYSize();
  std::vector<double> row(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    if (band->RasterIO(GF_Read, 0, y, width, 1, row.data(), width, 1, GDT_Float64, 0, 0, nullptr) != CE_None)
      return false;
    for (int x = 0; x < width; ++x) {
      auto const evidence = evidence_of(row[static_cast<std::size_t>(x)], meaning, no_data);
      if (evidence.is_seen()) grid.set({x, height - 1 - y}, evidence);
    }
  }
  return true;
}

/// Where the picture's lower left corner lies in the site, how it is turned, and how large its pixels are there.
struct Placement {
  map::SitePoint corner;
  double yaw_rad = 0.0;
  double size_m = 0.0;
};

/// By three of its corners, each brought into the site's plane: any projection will do that is metric enough to leave
/// pixels squares.
base::Result<Placement> placement_of(GDALDataset& data, geo::Site const& site, std::string const& name) {
  std::array<double, 6> affine{};
  auto const* reference = data.GetSpatialRef();
  if (data.GetGeoTransform(affine.data()) != CE_None || !reference)
    return fail(ErrorKind::invalid_input, fmt::format("{} does not say where it lies", name),
                "give it a coordinate system and a place, for example with gdal_translate -a_srs ... -a_ullr ...");
  auto source = *reference;
  source.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  auto plane = internal::plane_of(site);
  std::unique_ptr<OGRCoordinateTransformation> const into(OGRCreateCoordinateTransformation(&source, &plane));
  if (!into) return fail(ErrorKind::invalid_input, fmt::format("{}: {}", name, internal::last_complaint()));
  double const width = data.GetRasterXSize();
  double const height = data.GetRasterYSize();
  std::array<double, 3> xs{};
  std::array<double, 3> ys{};
  std::array<std::array<double, 2>, 3> const corners = {{{0.0, height}, {width, height}, {0.0, 0.0}}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    xs[i] = affine[0] + corners[i][0] * affine[1] + corners[i][1] * affine[2];
    ys[i] = affine[3] + corners[i][0] * affine[4] + corners[i][1] * affine[5];
  }
  if (into->Transform(3, xs.data(), ys.data()) == 0)
    return fail(ErrorKind::invalid_input, fmt::format("{} does not lie anywhere near the site {}", name, site.id()));
  Eigen::Vector2d const right(xs[1] - xs[0], ys[1] - ys[0]);
  Eigen::Vector2d const up(xs[2] - xs[0], ys[2] - ys[0]);
  double const size_m = right.norm() / width;
  double const skew = std::abs(right.dot(up)) / (right.norm() * up.norm());
  if (!(size_m >= 0.001 && size_m <= 100.0) || std::abs(up.norm() / height / size_m - 1.0) > 0.01 || skew > 0.01)
    return fail(
        ErrorKind::invalid_input,
        fmt::format("the pixels of {} are no squares of 1 mm to 100 m in the plane of the site {}", name, site.id()),
        "reproject it to UTM first: gdalwarp -t_srs EPSG:326xx");
  return Placement{map::SitePoint(xs[0], ys[0]), std::atan2(right.y(), right.x()), size_m};
}

}  // namespace

base::Result<> write_grid_geotiff(OccupancyGrid const& grid, geo::Site const& site, std::filesystem::path const& path) {
  auto const box = internal::seen_cells(grid, path.stem().string());
  if (!box) return std::unexpected(box.error());
  return internal::with_gdal(fmt::format("{} cannot be written", path.string()), [&] {
    auto* manager = GetGDALDriverManager();
    GDALDatasetUniquePtr const whole(manager->GetDriverByName("MEM")->Create(
        "", static_cast<int>(box->width), static_cast<int>(box->height), 2, GDT_Int16, nullptr));
    if (!whole) return false;
    auto affine = pixels_to_plane(grid, *box);
    auto const plane = internal::plane_of(site);
    whole->SetGeoTransform(affine.data());
    whole->SetSpatialRef(&plane);
    describe(*whole);
    for (int band : {1, 2}) whole->GetRasterBand(band)->SetNoDataValue(unseen);
    if (!write_rows(*whole, grid, *box)) return false;
    CPLStringList options;
    options.SetNameValue("COMPRESS", "DEFLATE");
    options.SetNameValue("PREDICTOR", "YES");
    options.SetNameValue("OVERVIEW_RESAMPLING", "NEAREST");
    GDALDatasetUniquePtr const file(manager->GetDriverByName("COG")->CreateCopy(path.c_str(), whole.get(), false,
                                                                                options.List(), nullptr, nullptr));
    return file != nullptr;
  });
}

base::Result<OccupancyGrid> read_grid_geotiff(std::filesystem::path const& path, geo::Site const& site) {
  base::Result<OccupancyGrid> grid = fail(ErrorKind::io, "");
  auto const done = internal::with_gdal(fmt::format("{} cannot be read as a GeoTIFF", path.string()), [&] {
    std::array const drivers = {"GTiff", static_cast<char const*>(nullptr)};
    GDALDatasetUniquePtr const data(
        GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers.data(), nullptr, nullptr));
    if (!data || data->GetRasterCount() < 1) return false;
    if (std::int64_t{data->GetRasterXSize()} * data->GetRasterYSize() > internal::most_cells) {
      grid = fail(ErrorKind::invalid_input, fmt::format("{} has more than 400 million cells", path.string()));
      return true;
    }
    auto const placement = placement_of(*data, site, path.string());
    if (!placement) {
      grid = std::unexpected(placement.error());
      return true;
    }
    grid = OccupancyGrid(placement->size_m, {placement->corner, placement->yaw_rad});
    return read_cells(*data, *grid);
  });
  if (!done) return fail(ErrorKind::invalid_input, done.error().message);
  return grid;
}

}  // namespace lapwing::formats
