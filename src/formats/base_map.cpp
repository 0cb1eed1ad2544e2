#include "formats/base_map.hpp"

#include <fmt/format.h>

#include <cpl_string.h>
#include <gdal_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "formats/internal/gdal.hpp"

namespace lapwing::formats {

namespace {

namespace files = std::filesystem;
using base::ErrorKind;
using base::fail;

/// Passed through GDAL's C interface: what is called, and which part of the whole the step at hand is.
struct Step {
  Progress const& tell;
  double begin = 0.0;
  double end = 1.0;
  bool was_stopped = false;
};

int on_progress(double share, char const* /*message*/, void* data) {
  auto& step = *static_cast<Step*>(data);
  if (!step.tell || step.tell(step.begin + std::min(share, 1.0) * (step.end - step.begin))) return TRUE;
  step.was_stopped = true;
  return FALSE;
}

/// Words of GDAL's own programs, for one use.
template <class Options, class Make, class Free>
std::unique_ptr<Options, Free> options_of(std::initializer_list<char const*> words, Make make, Free free) {
  CPLStringList list;
  for (auto const* word : words) list.AddString(word);
  return {make(list.List(), nullptr), free};
}

/// In web Mercator, with what lies outside the picture transparent; nothing is computed before it is read.
GDALDatasetUniquePtr in_mercator(GDALDataset& picture) {
  auto const options =
      options_of<GDALWarpAppOptions>({"-t_srs", "EPSG:3857", "-r", "bilinear", "-of", "VRT", "-dstalpha"},
                                     GDALWarpAppOptionsNew, &GDALWarpAppOptionsFree);
  GDALDatasetH source = &picture;
  return GDALDatasetUniquePtr(GDALDataset::FromHandle(GDALWarp("", nullptr, 1, &source, options.get(), nullptr)));
}

bool write_tiles(GDALDataset& mercator, files::path const& archive, Step& step) {
  auto options = options_of<GDALTranslateOptions>({"-of", "MBTILES", "-co", "TILE_FORMAT=PNG", "-co", "ZLEVEL=6"},
                                                  GDALTranslateOptionsNew, &GDALTranslateOptionsFree);
  GDALTranslateOptionsSetProgress(options.get(), on_progress, &step);
  GDALDatasetUniquePtr tiles(GDALDataset::FromHandle(
      GDALTranslate(archive.c_str(), GDALDataset::ToHandle(&mercator), options.get(), nullptr)));
  if (!tiles) return false;
  step.begin = 0.7;
  step.end = 1.0;
  std::vector<int> levels;
  for (int factor = 2; std::max(tiles->GetRasterXSize(), tiles->GetRasterYSize()) / factor >= 128; factor *= 2)
    levels.push_back(factor);
  return levels.empty() || tiles->BuildOverviews("AVERAGE", static_cast<int>(levels.size()), levels.data(), 0, nullptr,
                                                 on_progress, &step) == CE_None;
}

bool has_place(GDALDataset& picture) {
  std::array<double, 6> affine{};
  return picture.GetSpatialRef() != nullptr &&
         (picture.GetGeoTransform(affine.data()) == CE_None || picture.GetGCPCount() > 0);
}

}  // namespace

base::Result<> write_base_map(files::path const& picture, files::path const& archive, Progress const& progress) {
  auto const unfinished = archive.parent_path() / fmt::format(".{}.unfinished.mbtiles", archive.stem().string());
  std::error_code ignored;
  files::remove(unfinished, ignored);
  bool is_picture = true;
  bool is_placed = true;
  Step step{.tell = progress, .end = 0.7};
  auto const done = internal::with_gdal(fmt::format("map tiles of {} cannot be made", picture.string()), [&] {
    std::array const drivers = {"GTiff", "JP2OpenJPEG", "JPEG", "PNG", "GPKG", static_cast<char const*>(nullptr)};
    GDALDatasetUniquePtr const data(
        GDALDataset::Open(picture.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers.data(), nullptr, nullptr));
    is_picture = data != nullptr;
    if (!is_picture) return false;
    is_placed = has_place(*data);
    if (!is_placed) return false;
    auto const mercator = in_mercator(*data);
    return mercator && write_tiles(*mercator, unfinished, step);
  });
  if (done) {
    std::error_code error;
    files::rename(unfinished, archive, error);
    if (!error) return {};
    return fail(ErrorKind::io, fmt::format("{} cannot be written: {}", archive.string(), error.message()));
  }
  files::remove(unfinished, ignored);
  if (step.was_stopped) return fail(ErrorKind::cancelled, "stopped");
  if (!is_picture)
    return fail(ErrorKind::invalid_input, fmt::format("{} is no GeoTIFF, JPEG 2000, JPEG or PNG", picture.string()));
  if (!is_placed)
    return fail(ErrorKind::invalid_input, fmt::format("{} does not say where on Earth it lies", picture.string()),
                "a floor plan is placed on the map by hand: Layers, Place a picture");
  return fail(ErrorKind::invalid_input, done.error().message);
}

}  // namespace lapwing::formats
