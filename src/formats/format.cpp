#include "formats/format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <utility>

#include "formats/archive.hpp"
#include "formats/grid_geotiff.hpp"
#include "formats/picture_geotiff.hpp"
#include "formats/print.hpp"
#include "formats/ros_map.hpp"

namespace lapwing::formats {

namespace {

using base::ErrorKind;
using base::fail;
namespace files = std::filesystem;

constexpr std::array table = {
    Format{.name = "geopackage",
           .extension = ".gpkg",
           .holds_features = true,
           .is_read = true,
           .note = "every layer whole; times to the millisecond"},
    Format{.name = "geojson",
           .extension = "",
           .holds_features = true,
           .is_read = true,
           .note = "a folder with a file a layer; places to 0.01 mm; times to the millisecond; across the antimeridian "
                   "longitudes go "
                   "on beyond 180 degrees"},
    Format{.name = "kml",
           .extension = ".kml",
           .holds_features = true,
           .is_read = true,
           .note = "for Google Earth; every property as extended data; times as text, to the millisecond"},
    Format{.name = "kmz", .extension = ".kmz", .holds_features = true, .is_read = true, .note = "KML, packed"},
    Format{.name = "csv",
           .extension = "",
           .holds_features = true,
           .is_read = true,
           .note = "a folder with a file a layer; the geometry is a column of WKT; times as text, to the millisecond"},
    Format{
        .name = "geotiff",
        .extension = ".tif",
        .holds_grids = true,
        .holds_pictures = true,
        .is_read = true,
        .note =
            "cloud optimized; grids exactly, a file each; pictures drawn onto the ground that they show, written only"},
    Format{.name = "ros",
           .extension = ".yaml",
           .holds_grids = true,
           .is_read = true,
           .note = "map.pgm and map.yaml for map servers: free, taken or unknown; raw: to the percent"},
    Format{.name = "svg",
           .extension = ".svg",
           .holds_features = true,
           .holds_grids = true,
           .note = "a floor on paper, 1 : 100; written only"},
    Format{.name = "pdf",
           .extension = ".pdf",
           .holds_features = true,
           .holds_grids = true,
           .note = "a floor on paper, 1 : 100; written only"},
};

std::optional<VectorFormat> vector_format(Format const& format) {
  if (format.name == "geopackage") return VectorFormat::geopackage;
  if (format.name == "geojson") return VectorFormat::geojson;
  if (format.name == "kml") return VectorFormat::kml;
  if (format.name == "kmz") return VectorFormat::kmz;
  if (format.name == "csv") return VectorFormat::csv;
  return std::nullopt;
}

base::Result<PrintOptions> print_options(MapContents const& contents, ExportOptions const& options) {
  auto const& [layers, site, floor, within] = options.choice;
  if (!site.empty()) return PrintOptions{site, floor, options.scale};
  if (contents.sites.size() == 1) return PrintOptions{contents.sites.begin()->first, floor, options.scale};
  return fail(ErrorKind::invalid_input,
              fmt::format("the map has {} sites, and a print shows one", contents.sites.size()),
              "say which: --site ID");
}

/// A file name of what people call a grid.
std::string file_name(map::GridKey const& key, std::set<std::string>& taken) {
  std::string name;
  for (char const c : fmt::format("{}-{}", key.floor.empty() ? key.site : key.floor, key.name)) {
    bool const is_plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    name.push_back(is_plain ? c : '_');
  }
  auto unique = name;
  for (int i = 2; !taken.insert(unique).second; ++i) unique = fmt::format("{}-{}", name, i);
  return unique;
}

base::Result<> make_folder(files::path const& folder) {
  std::error_code error;
  files::create_directories(folder, error);
  if (error) return fail(ErrorKind::io, fmt::format("{} cannot be made: {}", folder.string(), error.message()));
  return {};
}

/// How far a work of several steps is.
class Steps {
 public:
  Steps(Progress const& progress, std::size_t all) : progress_(progress), all_(all) {}
  /// False: nobody wants the rest.
  [[nodiscard]] bool next() {
    return !progress_ || progress_(static_cast<double>(done_++) / static_cast<double>(std::max<std::size_t>(all_, 1)));
  }

 private:
  Progress const& progress_;
  std::size_t all_;
  std::size_t done_ = 0;
};

std::unexpected<base::Error> stopped() {
  return fail(ErrorKind::cancelled, "the export was stopped");
}

base::Result<std::size_t> export_grids(MapContents const& contents, Format const& format, files::path const& folder,
                                       Steps& steps) {
  std::set<std::string> taken;
  std::size_t written = 0;
  for (auto const& [key, grid] : contents.grids) {
    auto const site = contents.sites.find(key.site);
    if (!steps.next()) return stopped();
    if (site == contents.sites.end()) continue;
    auto const name = file_name(key, taken);
    auto const done = format.name == "ros" ? write_ros_map(grid, folder, name)
                                           : write_grid_geotiff(grid, site->second, folder / (name + ".tif"));
    if (!done) return std::unexpected(done.error());
    ++written;
  }
  return written;
}

base::Result<std::size_t> export_pictures(MapContents const& contents, files::path const& folder, ReadBlob const& blob,
                                          Steps& steps) {
  std::size_t written = 0;
  for (auto const& feature : contents.features) {
    if (!steps.next()) return stopped();
    auto const* picture = std::get_if<map::Picture>(&feature.content);
    auto const site = contents.sites.find(feature.site);
    if (!picture || picture->footprint.size() != 4 || site == contents.sites.end()) continue;
    auto const bytes = blob(picture->image);
    if (!bytes) return std::unexpected(bytes.error());
    auto const path = folder / fmt::format("picture-{}.tif", picture->image.substr(0, 16));
    if (auto const done = write_picture_geotiff(*picture, *bytes, site->second, path); !done)
      return std::unexpected(done.error());
    ++written;
  }
  return written;
}

base::Result<> export_files(MapContents const& contents, Format const& format, files::path const& folder,
                            ExportOptions const& options) {
  if (auto const made = make_folder(folder); !made) return made;
  Steps steps(options.progress, contents.grids.size() + contents.features.size());
  auto const grids = export_grids(contents, format, folder, steps);
  if (!grids) return std::unexpected(grids.error());
  auto const pictures = format.holds_pictures && options.blob ? export_pictures(contents, folder, options.blob, steps)
                                                              : base::Result<std::size_t>(0U);
  if (!pictures) return std::unexpected(pictures.error());
  if (*grids + *pictures > 0) return {};
  return fail(ErrorKind::invalid_input, fmt::format("there is nothing in the map that {} holds", format.name));
}

/// By way of a folder beside it, which goes again.
base::Result<> export_packed(MapContents const& contents, Format const& format, files::path const& archive,
                             ExportOptions const& options) {
  auto folder = archive;
  folder += ".parts";
  std::error_code ignored;
  files::remove_all(folder, ignored);
  auto done = export_map(contents, format, folder, options);
  if (done) done = write_archive(folder, archive);
  files::remove_all(folder, ignored);
  return done;
}

}  // namespace

std::span<Format const> formats() {
  return table;
}

Format const* format_named(std::string_view name) {
  auto const found = std::ranges::find(table, name, &Format::name);
  return found == table.end() ? nullptr : &*found;
}

Format const* format_of(files::path const& path) {
  auto const extension = path.extension().string();
  if (extension == ".geojson" || extension == ".json") return format_named("geojson");
  if (extension == ".csv") return format_named("csv");
  if (extension == ".tiff") return format_named("geotiff");
  if (extension == ".yml") return format_named("ros");
  if (extension.empty()) return files::is_directory(path) ? format_named("geojson") : nullptr;
  auto const found = std::ranges::find(table, extension, &Format::extension);
  return found == table.end() ? nullptr : &*found;
}

bool is_folder(Format const& format) {
  return format.extension.empty() || (format.holds_grids && !format.holds_features);
}

base::Result<> export_map(MapContents const& contents, Format const& format, files::path const& path,
                          ExportOptions const& options) {
  bool const is_packed = path.extension() == ".zip" && is_folder(format);
  if (is_packed) return export_packed(contents, format, path, options);
  auto const chosen = chosen_of(contents, options.choice);
  if (auto const vectors = vector_format(format)) return write_vectors(chosen, *vectors, path, options.progress);
  if (format.name == "svg" || format.name == "pdf") {
    auto const print = print_options(chosen, options);
    if (!print) return std::unexpected(print.error());
    return write_print(chosen, *print, path);
  }
  return export_files(chosen, format, path, options);
}

base::Result<MapContents> import_map(files::path const& path, ReadOptions const& options) {
  std::error_code error;
  if (!files::exists(path, error)) return fail(ErrorKind::not_found, fmt::format("there is no {}", path.string()));
  auto const* format = format_of(path);
  if (format && !format->is_read)
    return fail(ErrorKind::invalid_input, fmt::format("{} is written only: it does not come back in", format->name),
                "read the map from GeoPackage, GeoJSON, KML, CSV, GeoTIFF or a ROS map");
  if (!format || !format->holds_grids) return read_vectors(path, options);
  if (!options.site)
    return fail(ErrorKind::invalid_input, fmt::format("{} does not say in which site it lies", path.string()),
                "say which: --site ID");
  auto grid = format->name == "ros" ? read_ros_map(path) : read_grid_geotiff(path, *options.site);
  if (!grid) return std::unexpected(grid.error());
  MapContents contents;
  contents.grids.emplace(map::GridKey{options.site->id(), options.floor, path.stem().string()}, std::move(*grid));
  contents.sites.emplace(options.site->id(), *options.site);
  return contents;
}

}  // namespace lapwing::formats
