#include "slam/state/state_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/crc32.hpp"
#include "slam/mapper.hpp"
#include "slam/mapper_parameters.hpp"
#include "slam/state/bytes.hpp"
#include "slam/testing/simulated_drive.hpp"

namespace lapwing::slam {
namespace {

/// Of a short drive, with a range that is no number, one that came back from nowhere and bearings of a scan's own.
Mapping const& mapping() {
  static auto const made = [] {
    auto drive = testing::drive(testing::office(20.0, 12.0, 4.0, 1.0, 5), {{0, 0}, {4, 0}, {4, 0.5}}, {.beams = 31});
    drive.log.scans[0].ranges_m[3] = std::numeric_limits<float>::quiet_NaN();
    drive.log.scans[0].ranges_m[4] = std::numeric_limits<float>::infinity();
    auto& turned = drive.log.scans[1].bearings_rad;
    turned = drive.log.sensors[0].bearings_rad;
    for (auto& bearing : turned) bearing += 0.001F;
    MapperOptions options;
    options.loops.submap_frames = 12;
    options.gather.few_readings = 10;
    auto mapping = map_log(drive.log, options, one_by_one, [](std::string_view, double) {});
    mapping.memory.drives.back().name = "monday.clf";
    return mapping;
  }();
  return made;
}

std::string const& state() {
  static auto const bytes = write_state(mapping().graph, mapping().memory);
  return bytes;
}

std::string error_of(std::string const& bytes) {
  auto const read = read_state(bytes);
  return read ? "" : read.error().message;
}

TEST(StateFile, GivesBackEveryBit) {
  auto const read = read_state(state());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(write_state(read->graph, read->memory), state());
  auto const& memory = mapping().memory;
  EXPECT_EQ(read->graph.poses, mapping().graph.poses);
  EXPECT_EQ(read->memory.options.loops.submap_frames, 12);
  EXPECT_EQ(read->memory.past, memory.past);
  EXPECT_EQ(read->memory.drives, memory.drives);
  EXPECT_EQ(read->memory.loops, memory.loops);
  EXPECT_EQ(read->memory.seen.sensors, memory.seen.sensors);
  EXPECT_EQ(read->memory.front_end.last_odometry, memory.front_end.last_odometry);
  EXPECT_EQ(read->memory.time, memory.time);
}

TEST(StateFile, FindsTheSamePointsInTheScans) {
  auto const read = read_state(state());
  ASSERT_TRUE(read);
  ASSERT_EQ(read->graph.size(), mapping().graph.size());
  for (int k = 0; k < read->graph.size(); ++k) {
    EXPECT_EQ(read->graph.frames[k].scan, mapping().graph.frames[k].scan);
    EXPECT_EQ(read->graph.frames[k].frame.points, mapping().graph.frames[k].frame.points);
    EXPECT_EQ(read->graph.frames[k].frame.normals, mapping().graph.frames[k].frame.normals);
  }
}

TEST(StateFile, RefusesWhatIsNoState) {
  EXPECT_EQ(error_of("FLASER 2 1.0 1.0"), "this is no state of a mapping");
  EXPECT_EQ(error_of(""), "this is no state of a mapping");
}

TEST(StateFile, RefusesANewerVersion) {
  auto bytes = state();
  bytes[8] = 3;
  EXPECT_EQ(error_of(bytes), "this state of a mapping is of version 3, and up to version 2 they are read");
}

// Its scans said nothing of bearings of their own.
TEST(StateFile, ReadsTheVersionBefore) {
  auto memory = mapping().memory;
  for (auto& scan : memory.seen.scans) scan.bearings_rad.clear();
  auto payload = write_state(mapping().graph, memory).substr(24);
  for (auto const& scan : memory.seen.scans) {
    ByteWriter ranges;
    for (auto const range : scan.ranges_m) ranges.real(range);
    auto const bytes = std::move(ranges).take();
    auto const at = payload.find(bytes);
    ASSERT_NE(at, std::string::npos);
    payload.erase(at + bytes.size(), 1);
  }
  ByteWriter head;
  head.number(std::uint32_t{1});
  head.number(std::uint64_t{payload.size()});
  head.number(base::crc32(payload));
  auto const read = read_state("LWslam\r\n" + std::move(head).take() + payload);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(write_state(read->graph, read->memory), write_state(mapping().graph, memory));
}

/// Of a build that had this parameter, too.
std::string state_with(std::string_view parameter) {
  auto payload = state().substr(24);
  ByteWriter more;
  more.number(static_cast<std::uint32_t>(all_parameters().size() + 1));
  more.text(parameter);
  more.real(1.0);
  payload.replace(0, 4, std::move(more).take());
  ByteWriter head;
  head.number(std::uint32_t{2});
  head.number(std::uint64_t{payload.size()});
  head.number(base::crc32(payload));
  return "LWslam\r\n" + std::move(head).take() + payload;
}

TEST(StateFile, ReadsWhatABuildHasWrittenWithAParameterThatIsNoLongerThere) {
  auto const read = read_state(state_with("gather.step_trust"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(write_state(read->graph, read->memory), state());
  EXPECT_NE(error_of(state_with("gather.never_was")), "");
}

TEST(StateFile, SaysWhereItIsCutOff) {
  EXPECT_EQ(error_of(state().substr(0, 20)), "this state of a mapping is cut off in its first bytes");
  auto const size = state().size() - 24;
  EXPECT_EQ(error_of(state().substr(0, state().size() - 1)),
            fmt::format("this state of a mapping is cut off: {} of {} bytes", size - 1, size));
  EXPECT_EQ(error_of(state() + "more"), "this state of a mapping has 4 bytes behind its end");
}

TEST(StateFile, NoticesEveryFlippedBit) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    auto bytes = state();
    auto& byte = bytes[24 + random() % (bytes.size() - 24)];
    byte = static_cast<char>(byte ^ (1 << (random() % 8)));
    EXPECT_EQ(error_of(bytes), "this state of a mapping is damaged: its checksum does not match");
  }
}

TEST(StateFile, RefusesNumbersThatNoMappingHas) {
  auto const refused = [](auto change) {
    auto graph = mapping().graph;
    auto memory = mapping().memory;
    change(graph, memory);
    return error_of(write_state(graph, memory));
  };
  constexpr auto begin = "this state of a mapping is damaged: ";
  EXPECT_EQ(refused([](Graph& graph, MapMemory&) { graph.constraints[0].to = 9999; }),
            fmt::format("{}a constraint is to key frame 9999 of {}", begin, mapping().graph.size()));
  EXPECT_EQ(refused([](Graph& graph, MapMemory&) { graph.constraints[1].to = graph.constraints[1].from; }),
            fmt::format("{}constraint 1 says nothing", begin));
  EXPECT_EQ(refused([](Graph& graph, MapMemory&) { graph.poses[2].x = std::nan(""); }),
            fmt::format("{}key frame 2 is out of order or nowhere", begin));
  EXPECT_EQ(refused([](Graph& graph, MapMemory&) { graph.frames[2].scan = graph.frames[1].scan; }),
            fmt::format("{}key frame 2 is out of order or nowhere", begin));
  EXPECT_EQ(refused([](Graph&, MapMemory& memory) { memory.past[3].frame = -1; }),
            fmt::format("{}a scan is near key frame 4294967295 of {}", begin, mapping().graph.size()));
  EXPECT_EQ(refused([](Graph&, MapMemory& memory) { memory.drives.clear(); }),
            fmt::format("{}its drives have 0 scans of {}", begin, mapping().memory.past.size()));
  EXPECT_EQ(refused([](Graph&, MapMemory& memory) { memory.options.loops.submap_frames = 0; }),
            fmt::format("{}loops.submap_frames is 0", begin));
  EXPECT_EQ(refused([](Graph&, MapMemory& memory) { std::ranges::reverse(memory.seen.sensors[0].bearings_rad); }),
            fmt::format("{}beams that no laser has", begin));
}

}  // namespace
}  // namespace lapwing::slam
