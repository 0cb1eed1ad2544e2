#include "slam/state/state_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "base/assert.hpp"
#include "base/crc32.hpp"
#include "slam/mapper_parameters.hpp"
#include "slam/scan/frame.hpp"
#include "slam/state/bytes.hpp"

namespace lapwing::slam {
namespace {

// A text file that was carried over from system to system loses its CR, and the rest is not taken for a state.
constexpr std::string_view magic = "LWslam\r\n";
constexpr std::uint32_t version = 2;
constexpr std::uint32_t without_bearings = 1;  // of scans; that version can be read, too
constexpr std::size_t head_bytes = magic.size() + 4 + 8 + 4;

constexpr std::uint64_t most_sensors = 10'000;
constexpr std::size_t most_beams = 20'000;
constexpr std::uint64_t most_parameters = 1'000;
/// Parameters that earlier builds had written and nothing goes by any more.
constexpr std::array gone_parameters{std::string_view("gather.step_trust")};
constexpr std::size_t most_name_bytes = 4'096;
constexpr std::uint64_t most_memory = 1'000;  // of odometry's errors
constexpr double most_place_m = 1e6;
constexpr double most_path_m = 1e9;
constexpr double most_information = 1e15;
constexpr std::uint64_t most_int = std::numeric_limits<int>::max();

void write(ByteWriter& to, MapperOptions const& options) {
  auto const all = all_parameters();
  to.number(static_cast<std::uint32_t>(all.size()));
  for (auto const& parameter : all) {
    to.text(parameter.name);
    to.real(parameter.get(options));
  }
}

void write(ByteWriter& to, RobotKind const& kind) {
  to.flag(kind.has_odometry);
  to.flag(kind.has_times);
  to.real(kind.scan_step_m);
}

void write(ByteWriter& to, Sensor const& sensor) {
  to.real(sensor.mount_m.x());
  to.real(sensor.mount_m.y());
  to.real(sensor.no_return_m);
  to.number(static_cast<std::uint32_t>(sensor.bearings_rad.size()));
  for (auto const bearing : sensor.bearings_rad) to.real(bearing);
}

void write(ByteWriter& to, KeyFrame const& frame, Pose2 const& pose, Scan const& scan) {
  to.number(static_cast<std::uint32_t>(frame.scan));
  to.flag(frame.is_cut);
  to.real(frame.path_m);
  to.pose(pose);
  to.real(scan.time.count());
  to.pose(scan.odometry);
  to.number(static_cast<std::uint32_t>(scan.sensor));
  for (auto const range : scan.ranges_m) to.real(range);
  to.flag(!scan.bearings_rad.empty());
  for (auto const bearing : scan.bearings_rad) to.real(bearing);
}

void write(ByteWriter& to, Constraint const& constraint) {
  to.number(static_cast<std::uint32_t>(constraint.from));
  to.number(static_cast<std::uint32_t>(constraint.to));
  to.flag(constraint.is_loop);
  to.pose(constraint.from_to);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) to.real(constraint.information(row, column));
}

void write(ByteWriter& to, PastDrive const& drive) {
  to.text(std::string_view(drive.name).substr(0, most_name_bytes));
  to.number(static_cast<std::uint32_t>(drive.scans));
  to.number(static_cast<std::uint32_t>(drive.key_frames));
  to.real(drive.path_m);
}

void write(ByteWriter& to, PastScan const& scan) {
  to.real(scan.time.count());
  to.number(static_cast<std::uint32_t>(scan.frame));
  to.pose(scan.in_frame);
}

void write(ByteWriter& to, FrontEnd::Memory const& memory) {
  to.flag(memory.last_odometry.has_value());
  to.pose(memory.last_odometry.value_or(Pose2{}));
  to.pose(memory.last_motion);
  for (auto const* ratios : {&memory.noise.shift, &memory.noise.turn}) {
    to.number(static_cast<std::uint32_t>(ratios->size()));
    for (auto const ratio : *ratios) to.real(ratio);
  }
}

bool is_near(Pose2 const& pose) {
  // One comparison that is false for what is no number, too.
  return std::abs(pose.x) < most_place_m && std::abs(pose.y) < most_place_m && std::abs(pose.yaw) < most_place_m;
}

std::unexpected<base::Error> wrong(std::string message) {
  return base::fail(base::ErrorKind::invalid_input, std::move(message),
                    "take a copy of the state from before, or make the map anew from its logs");
}

/// Reads a payload part by part; the first part that is wrong ends it.
class StateReader {
 public:
  StateReader(std::string_view payload, std::uint32_t version) : from_(payload), version_(version) {}

  base::Result<SavedMap> read() && {
    bool const is_right = read_options() && read_kind() && read_sensors() && read_frames() && read_constraints() &&
                          read_drives() && read_past() && read_front_end() && read_end();
    if (!is_right) return wrong(fmt::format("this state of a mapping is damaged: {}", against_));
    return std::move(saved_);
  }

 private:
  bool is(bool claim, std::string_view against) {
    if (from_.is_short()) {
      against_ = "it ends too early";
      return false;
    }
    if (!claim && against_.empty()) against_ = against;
    return claim;
  }
  /// How many of them follow; 0 where so many cannot.
  bool count(std::uint64_t& count, std::uint64_t most, std::size_t each, std::string_view what) {
    count = from_.number<std::uint32_t>();
    return is(count <= most && from_.has(count, each), fmt::format("it has {} {}", count, what));
  }
  bool index(int& index, std::uint64_t size, std::string_view what) {
    auto const value = from_.number<std::uint32_t>();
    index = static_cast<int>(value);
    return is(value < size && value < most_int, fmt::format("{} {} of {}", what, value, size));
  }

  bool read_options() {
    std::uint64_t parameters = 0;
    if (!count(parameters, most_parameters, 4 + 8, "parameters")) return false;
    auto const all = all_parameters();
    for (std::uint64_t i = 0; i < parameters; ++i) {
      auto const name = from_.text();
      auto const value = from_.real();
      if (std::ranges::find(gone_parameters, name) != gone_parameters.end()) continue;
      auto const found = std::ranges::find(all, name, &Parameter::name);
      if (!is(found != all.end(), "a parameter that is not known")) return false;
      if (!is(is_usable(*found, value), fmt::format("{} is {}", found->name, value))) return false;
      found->set(saved_.memory.options, value);
    }
    return true;
  }

  bool read_kind() {
    auto& kind = saved_.memory.kind;
    kind.has_odometry = from_.number<std::uint8_t>() != 0;
    kind.has_times = from_.number<std::uint8_t>() != 0;
    kind.scan_step_m = from_.real();
    return is(kind.scan_step_m >= 0.0 && kind.scan_step_m < most_place_m, "its scans are nowhere near each other");
  }

  bool read_sensors() {
    std::uint64_t sensors = 0;
    if (!count(sensors, most_sensors, 4 * 4, "kinds of scans")) return false;
    for (std::uint64_t i = 0; i < sensors; ++i)
      if (!read_sensor()) return false;
    return true;
  }

  bool read_sensor() {
    constexpr float most_mount_m = 100.0F;
    Sensor sensor;
    sensor.mount_m.x() = from_.single();
    sensor.mount_m.y() = from_.single();
    sensor.no_return_m = from_.single();
    std::uint64_t beams = 0;
    if (!count(beams, most_beams, 4, "beams in a scan")) return false;
    for (std::uint64_t b = 0; b < beams; ++b) sensor.bearings_rad.push_back(from_.single());
    bool const is_there =
        sensor.mount_m.cwiseAbs().maxCoeff() < most_mount_m && sensor.mount_m.allFinite() && sensor.no_return_m > 0.0F;
    if (!is(is_there && looks_around(sensor.bearings_rad), "beams that no laser has")) return false;
    saved_.memory.seen.sensors.push_back(std::move(sensor));
    return true;
  }

  static bool are_ascending_angles(std::vector<float> const& bearings) {
    constexpr float most_rad = 4.0F * std::numbers::pi_v<float>;
    return std::ranges::is_sorted(bearings) &&
           std::ranges::all_of(bearings, [](float bearing) { return std::abs(bearing) <= most_rad; });
  }

  /// Ascending, and none so close together by the others' measure that a frame of them would have no end of bins.
  static bool looks_around(std::vector<float> const& bearings) {
    constexpr std::size_t most_bins_a_beam = 16;
    if (!are_ascending_angles(bearings)) return false;
    Scan nothing;
    nothing.ranges_m.assign(bearings.size(), 0.0F);
    auto const bins = frame_of(nothing, Sensor{.bearings_rad = bearings}, FrameOptions{}).bins();
    return static_cast<std::size_t>(bins) <= most_bins_a_beam * (bearings.size() + 1);
  }

  bool read_frames() {
    auto const scans = from_.number<std::uint32_t>();
    std::uint64_t frames = 0;
    constexpr std::size_t least_bytes = 4 + 1 + 8 + 24 + 8 + 24 + 4;
    if (!is(scans < most_int, "it has no end of scans") || !count(frames, scans, least_bytes, "key frames"))
      return false;
    scans_ = scans;
    for (std::uint64_t i = 0; i < frames; ++i)
      if (!read_frame()) return false;
    return true;
  }

  bool read_frame() {
    auto& seen = saved_.memory.seen;
    auto& graph = saved_.graph;
    KeyFrame frame;
    if (!index(frame.scan, scans_, "a key frame is of scan")) return false;
    frame.is_cut = from_.number<std::uint8_t>() != 0;
    frame.path_m = from_.real();
    auto const pose = from_.pose();
    Scan scan{.time = LogTime(from_.real()), .odometry = from_.pose(), .ranges_m = {}};
    if (!index(scan.sensor, seen.sensors.size(), "a key frame is of kind")) return false;
    auto const& sensor = seen.sensors[static_cast<std::size_t>(scan.sensor)];
    if (!is(from_.has(sensor.bearings_rad.size(), 4), "a scan is cut off")) return false;
    for (std::size_t b = 0; b < sensor.bearings_rad.size(); ++b) scan.ranges_m.push_back(from_.single());
    if (!read_bearings(scan, sensor)) return false;
    bool const is_next = graph.frames.empty()
                             ? frame.path_m >= 0.0
                             : frame.scan > graph.frames.back().scan && frame.path_m >= graph.frames.back().path_m;
    bool const is_somewhere = is_near(pose) && is_near(scan.odometry) && std::isfinite(scan.time.count());
    if (!is(is_next && is_somewhere && frame.path_m < most_path_m,
            fmt::format("key frame {} is out of order or nowhere", graph.frames.size())))
      return false;
    frame.frame = frame_of(scan, sensor, saved_.memory.options.frame);
    graph.frames.push_back(std::move(frame));
    graph.poses.push_back(pose);
    seen.scans.push_back(std::move(scan));
    return true;
  }

  bool read_bearings(Scan& scan, Sensor const& sensor) {
    if (version_ == without_bearings || from_.number<std::uint8_t>() == 0) return true;
    auto const beams = sensor.bearings_rad.size();
    if (!is(from_.has(beams, 4), "a scan is cut off")) return false;
    for (std::size_t b = 0; b < beams; ++b) scan.bearings_rad.push_back(from_.single());
    return is(are_ascending_angles(scan.bearings_rad), "beams that no laser has");
  }

  bool read_constraints() {
    std::uint64_t constraints = 0;
    if (!count(constraints, most_int, 4 + 4 + 1 + 24 + 72, "constraints")) return false;
    auto const frames = saved_.graph.frames.size();
    for (std::uint64_t i = 0; i < constraints; ++i) {
      Constraint constraint;
      if (!index(constraint.from, frames, "a constraint is from key frame") ||
          !index(constraint.to, frames, "a constraint is to key frame"))
        return false;
      constraint.is_loop = from_.number<std::uint8_t>() != 0;
      constraint.from_to = from_.pose();
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) constraint.information(row, column) = from_.real();
      bool const is_finite = constraint.information.allFinite() &&
                             constraint.information.cwiseAbs().maxCoeff() < most_information &&
                             constraint.information.diagonal().minCoeff() >= 0.0;
      if (!is(constraint.from != constraint.to && is_near(constraint.from_to) && is_finite,
              fmt::format("constraint {} says nothing", i)))
        return false;
      saved_.graph.constraints.push_back(constraint);
    }
    return true;
  }

  bool read_drives() {
    std::uint64_t drives = 0;
    if (!count(drives, most_int, 4 + 4 + 4 + 8, "drives")) return false;
    std::uint64_t scans = 0;
    for (std::uint64_t i = 0; i < drives; ++i) {
      PastDrive drive;
      drive.name = from_.text();
      if (!index(drive.scans, std::uint64_t{scans_} + 1, "a drive's scans are") ||
          !index(drive.key_frames, std::uint64_t{scans_} + 1, "a drive's key frames are"))
        return false;
      drive.path_m = from_.real();
      scans += static_cast<std::uint64_t>(drive.scans);
      if (!is(drive.name.size() <= most_name_bytes && drive.path_m >= 0.0 && drive.path_m < most_path_m,
              "a drive without end"))
        return false;
      saved_.memory.drives.push_back(std::move(drive));
    }
    return is(scans == scans_, fmt::format("its drives have {} scans of {}", scans, scans_));
  }

  bool read_past() {
    auto& memory = saved_.memory;
    if (!is(from_.has(scans_, 8 + 4 + 24), "scans are missing")) return false;
    memory.past.reserve(scans_);
    for (std::uint32_t i = 0; i < scans_; ++i) {
      PastScan scan;
      scan.time = LogTime(from_.real());
      if (!index(scan.frame, saved_.graph.frames.size(), "a scan is near key frame")) return false;
      scan.in_frame = from_.pose();
      if (!is(std::isfinite(scan.time.count()) && is_near(scan.in_frame), fmt::format("scan {} is nowhere", i)))
        return false;
      memory.past.push_back(scan);
    }
    for (auto* number : {&memory.loops.searches, &memory.loops.closures, &memory.loops.doubted, &memory.loops.revoked})
      if (!index(*number, most_int, "loops")) return false;
    return true;
  }

  bool read_front_end() {
    auto& memory = saved_.memory.front_end;
    bool const has_odometry = from_.number<std::uint8_t>() != 0;
    auto const odometry = from_.pose();
    memory.last_motion = from_.pose();
    if (!is(is_near(odometry) && is_near(memory.last_motion), "the last motion had no end")) return false;
    if (has_odometry) memory.last_odometry = odometry;
    for (auto* ratios : {&memory.noise.shift, &memory.noise.turn}) {
      std::uint64_t size = 0;
      if (!count(size, most_memory, 8, "errors of odometry")) return false;
      for (std::uint64_t i = 0; i < size; ++i) {
        ratios->push_back(from_.real());
        if (!is(ratios->back() >= 0.0 && ratios->back() < most_path_m, "an error of odometry without end"))
          return false;
      }
    }
    return true;
  }

  bool read_end() {
    auto& memory = saved_.memory;
    memory.odometry = from_.pose();
    memory.key_odometry = from_.pose();
    memory.time = LogTime(from_.real());
    bool const is_somewhere =
        is_near(memory.odometry) && is_near(memory.key_odometry) && std::isfinite(memory.time.count());
    return is(is_somewhere, "the last scan is nowhere") && is(!saved_.graph.frames.empty(), "it has no key frame") &&
           is(from_.rest() == 0, "something follows its end");
  }

  ByteReader from_;
  std::uint32_t version_;
  SavedMap saved_;
  std::uint32_t scans_ = 0;
  std::string against_;
};

}  // namespace

std::string write_state(Graph const& graph, MapMemory const& memory) {
  LAPWING_ASSERT(!memory.kind.is_sparse);
  LAPWING_ASSERT(memory.seen.scans.size() == graph.frames.size(), memory.seen.scans.size(), graph.frames.size());
  ByteWriter payload;
  write(payload, memory.options);
  write(payload, memory.kind);
  payload.number(static_cast<std::uint32_t>(memory.seen.sensors.size()));
  for (auto const& sensor : memory.seen.sensors) write(payload, sensor);
  payload.number(static_cast<std::uint32_t>(memory.past.size()));
  payload.number(static_cast<std::uint32_t>(graph.frames.size()));
  for (std::size_t k = 0; k < graph.frames.size(); ++k)
    write(payload, graph.frames[k], graph.poses[k], memory.seen.scans[k]);
  payload.number(static_cast<std::uint32_t>(graph.constraints.size()));
  for (auto const& constraint : graph.constraints) write(payload, constraint);
  payload.number(static_cast<std::uint32_t>(memory.drives.size()));
  for (auto const& drive : memory.drives) write(payload, drive);
  for (auto const& scan : memory.past) write(payload, scan);
  auto const& loops = memory.loops;
  for (auto const number : {loops.searches, loops.closures, loops.doubted, loops.revoked})
    payload.number(static_cast<std::uint32_t>(number));
  write(payload, memory.front_end);
  payload.pose(memory.odometry);
  payload.pose(memory.key_odometry);
  payload.real(memory.time.count());

  auto const bytes = std::move(payload).take();
  ByteWriter head;
  head.number(version);
  head.number(static_cast<std::uint64_t>(bytes.size()));
  head.number(base::crc32(bytes));
  return std::string(magic) + std::move(head).take() + bytes;
}

base::Result<SavedMap> read_state(std::string_view bytes) {
  if (!bytes.starts_with(magic))
    return base::fail(base::ErrorKind::invalid_input, "this is no state of a mapping",
                      "`lapwing map LOG --out DIR` writes one as DIR/mapping.state");
  ByteReader head(bytes.substr(magic.size()));
  auto const written_as = head.number<std::uint32_t>();
  auto const size = head.number<std::uint64_t>();
  auto const sum = head.number<std::uint32_t>();
  if (head.is_short()) return wrong("this state of a mapping is cut off in its first bytes");
  if (written_as != version && written_as != without_bearings)
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("this state of a mapping is of version {}, and up to version {} they are read",
                                  written_as, version),
                      "resume it with the program that wrote it, or make the map anew from its logs");
  auto const payload = bytes.substr(head_bytes);
  if (payload.size() < size)
    return wrong(fmt::format("this state of a mapping is cut off: {} of {} bytes", payload.size(), size));
  if (payload.size() > size)
    return wrong(fmt::format("this state of a mapping has {} bytes behind its end", payload.size() - size));
  if (base::crc32(payload) != sum) return wrong("this state of a mapping is damaged: its checksum does not match");
  return StateReader(payload, written_as).read();
}

}  // namespace lapwing::slam
