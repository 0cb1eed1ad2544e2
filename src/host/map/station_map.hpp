#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "base/async/loop.hpp"
#include "base/error.hpp"
#include "base/log.hpp"
#include "map/live/live_map.hpp"
#include "map/store/store.hpp"

namespace lapwing::host {

/// Where the map is kept, and for how long its past is.
struct StoreSettings {
  enum class Place {
    usual,      ///< this user's folder for it; while another station has that, a temporary one
    temporary,  ///< a folder that goes with the program
    named,      ///< `address`
  };
  Place place = Place::usual;
  std::string address = {};  ///< a folder or postgresql://...
  std::uint64_t most_bytes = std::uint64_t{2} * 1024 * 1024 * 1024;
  std::chrono::hours longest{30 * 24};  ///< of the past
};

/// Folder of this user's for a station's map: $XDG_DATA_HOME/lapwing/map, or ~/.local/share/lapwing/map.
[[nodiscard]] std::filesystem::path usual_store();

/// A map that is kept: what the store had is on it, and what changes goes into the store.
class StationMap {
 public:
  /// Errors: those of `map::Store::open` and `load`, for a place that was named; the usual one falls back to a
  /// temporary one and says so in the log. The map outlives it.
  [[nodiscard]] static base::Result<std::unique_ptr<StationMap>> open(base::Loop& loop, ::lapwing::map::LiveMap& map,
                                                                      StoreSettings const& settings,
                                                                      base::Logger const& log);
  ~StationMap();
  StationMap(StationMap const&) = delete;
  StationMap& operator=(StationMap const&) = delete;

  [[nodiscard]] ::lapwing::map::Store& store() { return *store_; }
  /// For people.
  [[nodiscard]] std::string const& address() const { return address_; }

 private:
  StationMap(std::unique_ptr<::lapwing::map::Store> store, std::string address, std::filesystem::path goes_with)
      : store_(std::move(store)), address_(std::move(address)), goes_with_(std::move(goes_with)) {}

  std::unique_ptr<::lapwing::map::Store> store_;
  std::string address_;
  std::filesystem::path goes_with_;  ///< a folder that nobody wants afterwards; empty: none
};

}  // namespace lapwing::host
