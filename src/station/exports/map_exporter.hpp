#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/async/task.hpp"
#include "base/error.hpp"

namespace lapwing::station {

/// A kind of file that a map can be written as.
struct ExportFormat {
  std::string name;       ///< "geopackage"
  std::string extension;  ///< ".gpkg"
  bool holds_features = false;
  bool holds_grids = false;
  bool holds_pictures = false;
  std::string note;  ///< what gets lost, for people
};

/// What of the map shall be in the file.
struct ExportWish {
  std::string format = {};
  std::vector<std::string> layers = {};                  ///< these alone; empty: all
  std::string site = {};                                 ///< this one alone; empty: all
  std::string floor = {};                                ///< this one alone; empty: all
  std::optional<std::array<double, 4>> within_deg = {};  ///< west, south, east, north
  double scale = 100.0;                                  ///< of prints, 1 : scale
};

/// Writes the map into files of other programs. It is somebody else's work: the libraries for these files stay out of
/// the process that talks to vehicles.
class MapExporter {
 public:
  virtual ~MapExporter() = default;

  /// Error: not_found, with what to do, where nobody here can write any.
  [[nodiscard]] virtual base::Task<base::Result<std::vector<ExportFormat>>> formats() = 0;
  /// What has been accepted into the map so far, as a file of that format. `progress` hears now and then how much is
  /// done, 0 to 1. Who lets go of the task stops the work. Errors: invalid_input, also when the format holds nothing of
  /// what was chosen; timed_out; io.
  [[nodiscard]] virtual base::Task<base::Result<>> write(ExportWish wish, std::filesystem::path file,
                                                         std::function<void(double)> progress) = 0;
};

}  // namespace lapwing::station
