#include "slam/state/resume.hpp"

#include <utility>

#include <fmt/format.h>

#include "slam/known/find_start.hpp"
#include "slam/known/known_map.hpp"
#include "slam/known/localizer.hpp"
#include "slam/loops/contradiction.hpp"
#include "slam/merge/fit_on_map.hpp"

namespace lapwing::slam {
namespace {

constexpr double good_fit = 0.7;  // of a scan's points on walls of the map
// How far a robot may be moved between two drives and still go on with the same odometry.
constexpr double same_place_m = 1.0;
constexpr double same_place_rad = 0.5;
// Where a robot is searched for: so often, and so far on its way.
constexpr double search_step_m = 2.0;
constexpr double most_searched_m = 30.0;
// What is asked of a drive that was found: so many key frames on the map, and the share of them that fits it.
constexpr int least_met = 15;
constexpr double least_that_fits = 0.7;

struct Begun {
  Beginning beginning;
  std::optional<Pose2> start;  ///< of the first scan; none where it goes on
};

base::Result<KnownMap> known_of(SavedMap const& saved) {
  return KnownMap::make(draw_grid(saved.memory.seen, saved.graph.poses, {}));
}

Frame first_frame(ScanLog const& log, FrameOptions const& options) {
  auto const& scan = log.scans.front();
  return frame_of(scan, log.sensors[static_cast<std::size_t>(scan.sensor)], options);
}

/// The first scan laid on the map near that pose.
Laid laid_near(KnownMap const& known, Frame const& frame, Pose2 const& pose) {
  return Localizer(known, pose, Pose2{}).follow(frame, Pose2{});
}

bool goes_on(SavedMap const& saved, KnownMap const& known, Frame const& frame, ScanLog const& log) {
  auto const& memory = saved.memory;
  if (!memory.kind.has_odometry || !log.has_odometry) return false;
  auto const& odometry = log.scans.front().odometry;
  if (distance_m(memory.odometry, odometry) > same_place_m || turn_rad(memory.odometry, odometry) > same_place_rad)
    return false;
  auto const expected = saved.graph.poses.back() * between(memory.key_odometry, odometry);
  auto const laid = laid_near(known, frame, expected);
  return laid.fit >= good_fit && distance_m(laid.pose, expected) < same_place_m / 2 &&
         turn_rad(laid.pose, expected) < same_place_rad / 2;
}

/// The beginning of the log, as far as it is searched, with odometry in any case.
ScanLog beginning_of(ScanLog const& log, FrameOptions const& options) {
  ScanLog part{.sensors = log.sensors, .scans = {}};
  ScanOdometry by_scans;
  auto path_m = 0.0;
  for (auto scan : log.scans) {
    if (!log.has_odometry)
      scan.odometry =
          by_scans.follow(frame_of(scan, log.sensors[static_cast<std::size_t>(scan.sensor)], options), scan.time);
    if (!part.scans.empty()) path_m += distance_m(part.scans.back().odometry, scan.odometry);
    if (path_m > most_searched_m) break;
    part.scans.push_back(std::move(scan));
  }
  return part;
}

std::optional<Pose2> found_on(KnownMap const& known, ScanLog const& log, FrameOptions const& options) {
  auto const part = beginning_of(log, options);
  auto const& first = part.scans.front().odometry;
  auto searched = first;
  for (std::size_t i = 0; i < part.scans.size(); ++i) {
    auto const& odometry = part.scans[i].odometry;
    if (i > 0 && distance_m(searched, odometry) < search_step_m) continue;
    searched = odometry;
    if (auto const found = find_start(known, part, i, options)) return found->pose * between(odometry, first);
  }
  return std::nullopt;
}

base::Result<Begun> begin(SavedMap const& saved, ScanLog const& log, std::optional<Pose2> const& start) {
  auto const known = known_of(saved);
  if (!known) return std::unexpected(known.error());
  auto const& options = saved.memory.options.frame;
  auto const frame = first_frame(log, options);
  if (start) {
    auto const laid = laid_near(*known, frame, *start);
    if (laid.fit < good_fit)
      return base::fail(
          base::ErrorKind::invalid_input,
          fmt::format(
              "{:.0f} % of the first scan's points lie on walls of the map near {:.2f}, {:.2f} ({:.0f} % at least)",
              100.0 * laid.fit, start->x, start->y, 100.0 * good_fit),
          "leave out where it begins, and it is searched for");
    return Begun{.beginning = Beginning::told, .start = laid.pose};
  }
  if (goes_on(saved, *known, frame, log)) return Begun{.beginning = Beginning::goes_on, .start = std::nullopt};
  if (auto const found = found_on(*known, log, options)) return Begun{.beginning = Beginning::found, .start = found};
  return base::fail(base::ErrorKind::invalid_input,
                    fmt::format("its odometry does not go on where the last drive ended, and within {:.0f} m of its "
                                "way no place on the map fits that can be told from every other",
                                most_searched_m),
                    "say where it begins (--start x,y,heading), or map both logs together");
}

/// What speaks against a drive that was found on the map.
std::string against(Mapping const& mapping, int first_scan, LoopOptions const& options, ForEach const& for_each) {
  auto const& graph = mapping.graph;
  ScanLog seen{.sensors = mapping.memory.seen.sensors, .scans = {}};
  std::vector<Pose2> poses;
  std::vector<int> frames;
  auto apart = graph.poses;
  constexpr double beyond_sight_m = 1e4;
  for (int k = 0; k < graph.size(); ++k) {
    if (graph.frames[k].scan < first_scan) {
      seen.scans.push_back(mapping.memory.seen.scans[k]);
      poses.push_back(graph.poses[k]);
    } else {
      frames.push_back(k);
      apart[k].x += beyond_sight_m;
    }
  }
  auto const fit = fit_on_map(seen, poses, graph, frames);
  if (fit.met < least_met)
    return fmt::format("{} of its key frames were taken on the map, and {} are needed", fit.met, least_met);
  if (fit.share() < least_that_fits)
    return fmt::format("{:.0f} % of its key frames fit what was seen there ({:.0f} % at least)", 100.0 * fit.share(),
                       100.0 * least_that_fits);
  auto const passes = agreement_of_passes(graph, graph.poses, apart, options.least_gap_m, for_each);
  auto const most = options.most_contradiction;
  if (passes.conflict() <= most) return {};
  return fmt::format("{:.0f} % of the points in sight lie in free space of the map ({:.0f} % at most)",
                     100.0 * passes.conflict(), 100.0 * most);
}

}  // namespace

std::string_view to_string(Beginning beginning) {
  using enum Beginning;
  switch (beginning) {
    case goes_on: return "goes on";
    case told: return "told";
    case found: return "found";
  }
  return "";
}

base::Result<ResumedLog> resume_log(SavedMap saved, ScanLog const& log, std::optional<Pose2> const& start,
                                    ForEach const& for_each, Progress const& progress) {
  if (log.scans.empty()) return base::fail(base::ErrorKind::invalid_input, "there is no scan in it");
  auto const options = saved.memory.options;
  auto const kind = kind_of(log, options.gather);
  if (kind.is_sparse)
    return base::fail(
        base::ErrorKind::invalid_input,
        fmt::format("a mapping does not go on with scans of fewer than {} readings", options.gather.few_readings));
  progress("beginning", 0.0);
  auto const begun = begin(saved, log, start);
  if (!begun) return std::unexpected(begun.error());
  auto const first_scan = static_cast<int>(saved.memory.past.size());
  Mapper mapper(std::move(saved), for_each);
  mapper.begin_drive(kind, begun->start);
  ResumedLog resumed{.mapping = map_drive(std::move(mapper), log, for_each, progress), .beginning = begun->beginning};
  if (begun->beginning != Beginning::found) return resumed;
  if (auto const why = against(resumed.mapping, first_scan, options.loops, for_each); !why.empty())
    return base::fail(base::ErrorKind::invalid_input, fmt::format("where it seems to begin on the map, {}", why),
                      "say where it begins (--start x,y,heading)");
  return resumed;
}

}  // namespace lapwing::slam
