// States of mappings: read or refused, and what was read is written again to the last bit and can go on. The first byte
// of an input says whether the rest is a file or the payload of one, whose length and checksum are then made to match.
#include <cstdint>
#include <string>

#include "require.hpp"
#include "slam/mapper.hpp"
#include "slam/state/bytes.hpp"
#include "slam/state/state_file.hpp"

#include <zlib.h>

namespace {

using namespace lapwing;

std::string file_of(std::string const& payload) {
  slam::ByteWriter head;
  head.number(std::uint32_t{1});
  head.number(static_cast<std::uint64_t>(payload.size()));
  head.number(static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<Bytef const*>(payload.data()), static_cast<z_size_t>(payload.size()))));
  return "LWslam\r\n" + std::move(head).take() + payload;
}

/// Another drive of two scans of the first kind that the state knows.
void go_on(slam::SavedMap saved) {
  constexpr std::size_t most_frames = 40;  // more takes the fuzzer's time
  if (saved.graph.frames.size() > most_frames || saved.memory.seen.sensors.empty()) return;
  auto const sensor = saved.memory.seen.sensors.front();
  auto const kind = saved.memory.kind;
  slam::Mapper mapper(std::move(saved), slam::one_by_one);
  mapper.begin_drive(kind, slam::Pose2{});
  slam::Scan scan;
  scan.ranges_m.assign(sensor.bearings_rad.size(), 2.0F);
  for (double const x : {0.0, 0.5}) {
    scan.odometry.x = x;
    mapper.follow(scan, sensor);
  }
  fuzz::require(mapper.graph().frames.size() == mapper.graph().poses.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  if (size == 0) return 0;
  std::string const rest(reinterpret_cast<char const*>(data) + 1, size - 1);
  auto const file = data[0] % 2 == 0 ? file_of(rest) : rest;
  auto saved = slam::read_state(file);
  if (!saved) {
    fuzz::require(!saved.error().message.empty());
    return 0;
  }
  auto const again = slam::read_state(slam::write_state(saved->graph, saved->memory));
  fuzz::require(again.has_value());
  fuzz::require(slam::write_state(again->graph, again->memory) == slam::write_state(saved->graph, saved->memory));
  go_on(*std::move(saved));
  return 0;
}
