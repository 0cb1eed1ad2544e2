#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/async/loop.hpp"
#include "map/store/store.hpp"
#include "station/exports/map_exporter.hpp"

namespace lapwing::host {

/// Has `lapwing-map` write files of a store: a process of its own, nice to others and with limits, so that neither a
/// large map nor a mistake in the libraries for such files reaches the process that talks to vehicles.
class MapExports final : public station::MapExporter {
 public:
  /// The program that lies beside this one.
  [[nodiscard]] static std::filesystem::path usual_program();

  /// Loop and store outlive it; `address` is the store's.
  MapExports(base::Loop& loop, ::lapwing::map::Store& store, std::string address,
             std::filesystem::path program = usual_program())
      : loop_(loop), store_(store), address_(std::move(address)), program_(std::move(program)) {}

  [[nodiscard]] base::Task<base::Result<std::vector<station::ExportFormat>>> formats() override;
  [[nodiscard]] base::Task<base::Result<>> write(station::ExportWish wish, std::filesystem::path file,
                                                 std::function<void(double)> progress) override;

 private:
  base::Loop& loop_;
  ::lapwing::map::Store& store_;
  std::string address_;
  std::filesystem::path program_;
  std::vector<station::ExportFormat> formats_;  ///< empty until the program has told them
};

}  // namespace lapwing::host
