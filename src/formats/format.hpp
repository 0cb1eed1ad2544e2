#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "formats/base_map.hpp"
#include "formats/choice.hpp"
#include "formats/map_contents.hpp"
#include "formats/vector_files.hpp"

/// Every kind of file that a map goes into and comes out of. docs/reference/formats.md is compared with this table.
namespace lapwing::formats {

struct Format {
  std::string_view name;       ///< on the command line: "geopackage"
  std::string_view extension;  ///< by which files of it are known; empty: a folder
  bool holds_features = false;
  bool holds_grids = false;
  bool holds_pictures = false;  ///< the images themselves, not only where they were taken
  bool is_read = false;         ///< and not only written
  std::string_view note;        ///< what gets lost, for people
};

[[nodiscard]] std::span<Format const> formats();
/// Null: there is none of that name.
[[nodiscard]] Format const* format_named(std::string_view name);
/// Whether it is several files: a file a layer, or a grid.
[[nodiscard]] bool is_folder(Format const& format);
/// By the name of a file or folder; null: none.
[[nodiscard]] Format const* format_of(std::filesystem::path const& path);

struct ExportOptions {
  Choice choice = {};    ///< a print shows one site: the one that is chosen, or the only one
  double scale = 100.0;  ///< of prints, 1 : scale
  ReadBlob blob = {};    ///< for formats that hold pictures
  Progress progress = {};
};

/// Writes the map, or what of it the format holds, as a file or folder `path`. A format that holds grids alone writes
/// one file a grid into the folder `path`. A `path` that ends in .zip becomes an archive of what would be a folder.
/// Errors: invalid_input, also when nothing in the map fits the format; io; cancelled.
[[nodiscard]] base::Result<> export_map(MapContents const& contents, Format const& format,
                                        std::filesystem::path const& path, ExportOptions const& options = {});

/// Reads any file or folder of a format that is read. Errors as those of the formats.
[[nodiscard]] base::Result<MapContents> import_map(std::filesystem::path const& path, ReadOptions const& options = {});

}  // namespace lapwing::formats
