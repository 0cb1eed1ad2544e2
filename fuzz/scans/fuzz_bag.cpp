// Bags of ROS 2, MCAP or SQLite by their beginning: read or refused, and the log that is made of one is whole.
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "require.hpp"
#include "scans/bag_log.hpp"
#include "scans/storage/mcap.hpp"
#include "scans/storage/sqlite_bag.hpp"

namespace {

using lapwing::fuzz::require;
namespace scans = lapwing::scans;

void check(scans::BagContents& contents) {
  auto const made = scans::log_of(contents);
  if (!made) {
    require(!made.error().message.empty());
    return;
  }
  for (auto const& scan : made->log.scans) {
    auto const& sensor = made->log.sensors.at(static_cast<std::size_t>(scan.sensor));
    require(scan.ranges_m.size() == sensor.bearings_rad.size());
    require(std::isfinite(scan.odometry.x) && std::isfinite(scan.odometry.y) && std::isfinite(scan.odometry.yaw));
  }
}

/// SQLite reads files; this one lies where it costs no disk, if there is such a place.
std::filesystem::path const& scratch() {
  static auto const path = (std::filesystem::exists("/dev/shm") ? std::filesystem::path("/dev/shm")
                                                                : std::filesystem::temp_directory_path()) /
                           ("lapwing-fuzz-bag-" + std::to_string(::getpid()));
  return path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string const bytes(reinterpret_cast<char const*>(data), size);
  scans::BagContents contents({});
  if (scans::is_sqlite(bytes)) {
    std::ofstream(scratch(), std::ios::binary) << bytes;
    (void)scans::read_sqlite_bag(scratch(), contents);
    std::filesystem::remove(scratch());
  } else {
    std::istringstream file(bytes);
    (void)scans::read_mcap(file, contents);
  }
  check(contents);
  return 0;
}
