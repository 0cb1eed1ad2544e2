#include "formats/vector_files.hpp"

#include <fmt/format.h>

#include <cpl_string.h>
#include <ogrsf_frmts.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string_view>
#include <utility>

#include "formats/internal/field_values.hpp"
#include "formats/internal/gdal.hpp"
#include "formats/internal/ogr_feature.hpp"
#include "formats/internal/site_records.hpp"

namespace lapwing::formats {

namespace {

using base::ErrorKind;
using base::fail;
using internal::Times;
namespace files = std::filesystem;

constexpr int most_features = 1'000'000;

/// How OGR is asked for a format.
struct Driver {
  char const* name;
  char const* extension;
  bool holds_one_layer;  ///< a file; `path` is a folder
  Times times;
  char const* layer_options;  ///< "NAME=VALUE ...", of each layer
};

Driver driver_of(VectorFormat format) {
  switch (format) {
    case VectorFormat::geopackage: return {"GPKG", ".gpkg", false, Times::as_times, "GEOMETRY_NAME=geom"};
    case VectorFormat::geojson:
      return {"GeoJSON", ".geojson", true, Times::as_times, "COORDINATE_PRECISION=10 ID_FIELD=id"};
    case VectorFormat::kml: return {"LIBKML", ".kml", false, Times::as_text, ""};
    case VectorFormat::kmz: return {"LIBKML", ".kmz", false, Times::as_text, ""};
    case VectorFormat::csv: return {"CSV", ".csv", true, Times::as_text, "GEOMETRY=AS_WKT CREATE_CSVT=NO"};
  }
  return {"GPKG", ".gpkg", false, Times::as_times, ""};
}

using Dataset = GDALDatasetUniquePtr;

Dataset create(Driver const& driver, files::path const& path) {
  auto* maker = GetGDALDriverManager()->GetDriverByName(driver.name);
  return Dataset(maker ? maker->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr) : nullptr);
}

/// A layer of one file with these fields.
OGRLayer* add_layer(GDALDataset& data, Driver const& driver, std::string const& name, OGRwkbGeometryType geometry,
                    std::function<void(OGRFeatureDefn&)> const& define_fields) {
  CPLStringList options(CSLTokenizeString2(driver.layer_options, " ", 0));
  auto globe = internal::wgs84_lon_lat();
  auto* layer = data.CreateLayer(name.c_str(), &globe, geometry, options.List());
  if (!layer) return nullptr;
  auto* definition = new OGRFeatureDefn("fields");
  definition->Reference();
  define_fields(*definition);
  bool is_whole = true;
  for (int i = 0; i < definition->GetFieldCount(); ++i)
    is_whole = layer->CreateField(definition->GetFieldDefn(i)) == OGRERR_NONE && is_whole;
  definition->Release();
  return is_whole ? layer : nullptr;
}

bool add_feature(OGRLayer& layer, std::function<void(OGRFeature&)> const& fill) {
  std::unique_ptr<OGRFeature, decltype(&OGRFeature::DestroyFeature)> const feature(
      OGRFeature::CreateFeature(layer.GetLayerDefn()), &OGRFeature::DestroyFeature);
  fill(*feature);
  return layer.CreateFeature(feature.get()) == OGRERR_NONE;
}

/// Counts features, and tells now and then how many there are.
class Counter {
 public:
  Counter(Progress const& progress, std::size_t all) : progress_(progress), all_(all) {}
  /// False: nobody wants the rest.
  [[nodiscard]] bool next() {
    constexpr std::size_t often = 500;
    if (count_++ % often != 0 || !progress_ || is_stopped_) return !is_stopped_;
    is_stopped_ = !progress_(static_cast<double>(count_) / static_cast<double>(all_));
    return !is_stopped_;
  }
  [[nodiscard]] bool is_stopped() const { return is_stopped_; }

 private:
  Progress const& progress_;
  std::size_t all_;
  std::size_t count_ = 0;
  bool is_stopped_ = false;
};

using ByLayer = std::map<map::LayerKind, std::vector<map::Feature const*>>;

bool write_layer(GDALDataset& data, Driver const& driver, map::LayerKind kind,
                 std::vector<map::Feature const*> const& features, MapContents const& contents, Counter& counter) {
  auto* layer = add_layer(data, driver, std::string(map::name_of(kind)), internal::geometry_type_of(kind),
                          [&](OGRFeatureDefn& fields) { internal::define_feature(fields, kind, driver.times); });
  if (!layer) return false;
  for (auto const* feature : features) {
    if (!counter.next()) return false;
    auto const site = contents.sites.find(feature->site);
    if (site == contents.sites.end()) continue;
    if (!add_feature(*layer,
                     [&](OGRFeature& row) { internal::write_feature(row, *feature, site->second, driver.times); }))
      return false;
  }
  return true;
}

bool write_sites(GDALDataset& data, Driver const& driver, MapContents const& contents) {
  auto* layer = add_layer(data, driver, internal::sites_layer, wkbPoint, internal::define_site);
  if (!layer) return false;
  for (auto const& [id, site] : contents.sites) {
    if (!add_feature(*layer, [&](OGRFeature& row) { internal::write_site(row, site); })) return false;
  }
  return true;
}

/// Calls `write(dataset)` for a new file; what was written counts only when closing it went well, too.
base::Result<> write_file(Driver const& driver, files::path const& path,
                          std::function<bool(GDALDataset&)> const& write) {
  std::error_code ignored;
  files::remove(path, ignored);
  return internal::with_gdal(fmt::format("{} cannot be written", path.string()), [&] {
    CPLSetThreadLocalConfigOption("LIBKML_NAME_FIELD", "id");
    auto data = create(driver, path);
    if (!data) return false;
    bool const in_one = data->TestCapability(ODsCTransactions) != 0 && data->StartTransaction() == OGRERR_NONE;
    bool const is_written = write(*data) && (!in_one || data->CommitTransaction() == OGRERR_NONE);
    data->FlushCache();
    data.reset();
    return is_written && CPLGetLastErrorType() < CE_Failure;
  });
}

ByLayer by_layer(MapContents const& contents) {
  ByLayer layers;
  for (auto const& feature : contents.features) layers[map::layer_of(feature.content)].push_back(&feature);
  return layers;
}

base::Result<> write_folder(MapContents const& contents, Driver const& driver, files::path const& folder,
                            Counter& counter) {
  std::error_code error;
  files::create_directories(folder, error);
  if (error) return fail(ErrorKind::io, fmt::format("{} cannot be made: {}", folder.string(), error.message()));
  auto const file = [&](std::string_view name) { return folder / (std::string(name) + driver.extension); };
  for (auto const& [kind, features] : by_layer(contents)) {
    auto const written = write_file(driver, file(map::name_of(kind)), [&](GDALDataset& data) {
      return write_layer(data, driver, kind, features, contents, counter);
    });
    if (!written) return written;
  }
  return write_file(driver, file(internal::sites_layer),
                    [&](GDALDataset& data) { return write_sites(data, driver, contents); });
}

/// Reads the features of one OGR layer into `contents`.
class LayerReader {
 public:
  LayerReader(MapContents& contents, ReadOptions const& options, OGRLayer& layer, std::string name)
      : contents_(contents), options_(options), layer_(layer), name_(std::move(name)) {}

  base::Result<> read() {
    auto const kind = map::layer_named(name_);
    if (!kind && !options_.layer)
      return fail(ErrorKind::invalid_input, fmt::format("`{}` is none of the map's layers", name_),
                  "say which layer it is: slots, walls, points_of_interest, pictures, tracks or areas");
    auto const reader = internal::FeatureReader(kind.value_or(*options_.layer), *layer_.GetLayerDefn());
    if (auto const known = know_globe(); !known) return known;
    layer_.ResetReading();
    for (auto& row : layer_) {
      if (static_cast<int>(contents_.features.size()) >= most_features)
        return fail(ErrorKind::invalid_input, "it has more than a million features", "split it");
      if (auto const read = read_row(*row, reader); !read) return told(row->GetFID(), read.error());
    }
    return {};
  }

 private:
  /// Which way its coordinates are brought to longitude and latitude.
  base::Result<> know_globe() {
    auto const* reference = layer_.GetSpatialRef();
    if (!reference) return {};
    auto source = *reference;
    source.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    auto globe = internal::wgs84_lon_lat();
    if (source.IsSame(&globe) != 0) return {};
    to_globe_.reset(OGRCreateCoordinateTransformation(&source, &globe));
    if (to_globe_) return {};
    return fail(ErrorKind::invalid_input,
                fmt::format("the coordinate system of `{}`: {}", name_, internal::last_complaint()));
  }

  base::Result<> read_row(OGRFeature& row, internal::FeatureReader const& reader) {
    auto* geometry = row.GetGeometryRef();
    if (!geometry) return fail(ErrorKind::invalid_input, "it has no geometry");
    if (to_globe_ && geometry->transform(to_globe_.get()) != OGRERR_NONE)
      return fail(ErrorKind::invalid_input, "its coordinates are nowhere on Earth");
    auto const site_id = reader.site_of(row);
    auto const* site = site_for(site_id, *geometry);
    if (!site)
      return fail(ErrorKind::invalid_input,
                  fmt::format("it lies in the site `{}`, which the file does not have", site_id),
                  "read it together with the layer `sites`, or say in which site it lies");
    auto feature = reader.read(row, *site, options_.account);
    if (!feature) return std::unexpected(feature.error());
    if (feature->floor.empty()) feature->floor = options_.floor;
    contents_.features.push_back(std::move(*feature));
    return {};
  }

  geo::Site const* site_for(std::string const& id, OGRGeometry const& geometry) {
    if (auto const known = contents_.sites.find(id); known != contents_.sites.end()) return &known->second;
    if (!id.empty()) return nullptr;
    if (options_.site) return &contents_.sites.find(options_.site->id())->second;
    if (contents_.sites.size() == 1) return &contents_.sites.begin()->second;
    if (!contents_.sites.empty()) return nullptr;
    OGREnvelope box;
    geometry.getEnvelope(&box);
    auto made =
        geo::Site::make("imported", geo::Wgs84::from_degrees((box.MinY + box.MaxY) / 2.0, (box.MinX + box.MaxX) / 2.0));
    return made ? &contents_.sites.emplace("imported", std::move(*made)).first->second : nullptr;
  }

  [[nodiscard]] std::unexpected<base::Error> told(GIntBig number, base::Error error) const {
    error.message = fmt::format("`{}`, feature {}: {}", name_, number, error.message);
    return std::unexpected(std::move(error));
  }

  MapContents& contents_;
  ReadOptions const& options_;
  OGRLayer& layer_;
  std::string name_;
  std::unique_ptr<OGRCoordinateTransformation> to_globe_;
};

base::Result<> read_sites(OGRLayer& layer, MapContents& contents) {
  for (auto& row : layer) {
    auto site = internal::read_site(*row);
    if (!site) return std::unexpected(site.error());
    contents.sites.insert_or_assign(site->id(), std::move(*site));
  }
  return {};
}

base::Result<> read_layers(GDALDataset& data, std::string const& file_name, ReadOptions const& options,
                           MapContents& contents) {
  // Formats of one layer a file name the layer by the file, whatever they say inside.
  bool const has_one = data.GetLayerCount() == 1;
  std::vector<std::pair<OGRLayer*, std::string>> others;
  for (auto* layer : data.GetLayers()) {
    std::string name = layer->GetName();
    if (has_one && !map::layer_named(name) && name != internal::sites_layer) name = file_name;
    if (name != internal::sites_layer) {
      others.emplace_back(layer, name);
    } else if (auto const read = read_sites(*layer, contents); !read) {
      return read;
    }
  }
  for (auto const& [layer, name] : others) {
    if (auto const read = LayerReader(contents, options, *layer, name).read(); !read) return read;
  }
  return {};
}

base::Result<> read_file(files::path const& path, ReadOptions const& options, MapContents& contents) {
  base::Result<> read;
  auto const opened = internal::with_gdal(fmt::format("{} cannot be read", path.string()), [&] {
    CPLSetThreadLocalConfigOption("LIBKML_NAME_FIELD", "id");
    std::array const drivers = {"GPKG",       "GeoJSON", "LIBKML", "CSV", "ESRI Shapefile",
                                "FlatGeobuf", "GPX",     "GML",    "DXF", static_cast<char const*>(nullptr)};
    CPLStringList wishes;
    Dataset const data(
        GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, drivers.data(), nullptr, nullptr));
    if (!data) return false;
    read = read_layers(*data, path.stem().string(), options, contents);
    return true;
  });
  if (!opened) return fail(ErrorKind::invalid_input, opened.error().message);
  if (!read) read.error().message = fmt::format("{}: {}", path.string(), read.error().message);
  return read;
}

std::vector<files::path> files_in(files::path const& folder) {
  std::vector<files::path> found;
  std::error_code ignored;
  for (auto const& entry : files::directory_iterator(folder, ignored)) {
    auto const extension = entry.path().extension();
    if (extension == ".geojson" || extension == ".csv") found.push_back(entry.path());
  }
  // What lies in sites comes after the sites.
  std::ranges::sort(found, {}, [](files::path const& path) {
    return std::pair(path.stem() != internal::sites_layer, path.string());
  });
  return found;
}

}  // namespace

base::Result<> write_vectors(MapContents const& contents, VectorFormat format, files::path const& path,
                             Progress const& progress) {
  auto const driver = driver_of(format);
  Counter counter(progress, contents.features.size());
  auto const written = driver.holds_one_layer ? write_folder(contents, driver, path, counter)
                                              : write_file(driver, path, [&](GDALDataset& data) {
                                                  for (auto const& [kind, features] : by_layer(contents)) {
                                                    if (!write_layer(data, driver, kind, features, contents, counter))
                                                      return false;
                                                  }
                                                  return write_sites(data, driver, contents);
                                                });
  if (counter.is_stopped()) return fail(ErrorKind::cancelled, "the export was stopped");
  return written;
}

base::Result<MapContents> read_vectors(files::path const& path, ReadOptions const& given) {
  auto options = given;
  if (options.account.at == base::UtcTime()) options.account.at = std::chrono::system_clock::now();
  MapContents contents;
  if (options.site) contents.sites.emplace(options.site->id(), *options.site);
  bool const is_folder = files::is_directory(path);
  auto const found = is_folder ? files_in(path) : std::vector{path};
  if (found.empty())
    return fail(ErrorKind::invalid_input, fmt::format("{} has no .geojson and no .csv files", path.string()));
  for (auto const& file : found) {
    if (auto const read = read_file(file, options, contents); !read) return std::unexpected(read.error());
  }
  return contents;
}

}  // namespace lapwing::formats
