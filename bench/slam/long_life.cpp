// A simulated office that a robot drives round again and again: what a pass costs the longer it goes on.
// usage: bench_long_life [PASSES [LATER_PASSES]]: passes (100), and after how many later ones a key frame is let go
// (the mapper's own number).
#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <vector>

#include <fmt/format.h>

#include "slam/mapper.hpp"
#include "slam/testing/simulated_drive.hpp"

namespace {

using namespace lapwing::slam;

constexpr double width_m = 12.0;
constexpr double height_m = 8.0;

double cpu_ms() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}
double heap_mb() {
  return static_cast<double>(::mallinfo2().uordblks + ::mallinfo2().hblkhd) / 1e6;
}

/// One way round in each of two passes, and the other way round in the next two.
std::vector<Eigen::Vector2d> way(int passes) {
  std::vector<Eigen::Vector2d> points{{0, 0}};
  for (int pass = 0; pass < passes; ++pass) {
    if (pass / 2 % 2 == 0)
      points.insert(points.end(), {{width_m, 0}, {width_m, height_m}, {0, height_m}, {0, 0}});
    else
      points.insert(points.end(), {{0, height_m}, {width_m, height_m}, {width_m, 0}, {0, 0}});
  }
  return points;
}

}  // namespace

int main(int argc, char** argv) {
  auto const passes = argc > 1 ? std::atoi(argv[1]) : 100;
  MapperOptions options;
  if (argc > 2) options.prune.passes = std::atoi(argv[2]);
  auto const drive = testing::drive(testing::office(width_m, height_m, 4.0, 1.0, 5), way(passes), {.beams = 91});
  auto const kind = kind_of(drive.log, options.gather);
  fmt::print("{} scans of {} passes; key frames let go after {} later passes\n", drive.log.scans.size(), passes,
             options.prune.passes);
  fmt::print("{:>5} {:>10} {:>11} {:>8} {:>9} {:>9} {:>9}\n", "pass", "key frames", "constraints", "heap MB", "CPU s",
             "ms a scan", "worst ms");
  auto const before_mb = heap_mb();
  Mapper mapper(options, kind, one_by_one);
  auto pass = 1;
  auto began_ms = cpu_ms();
  auto worst_ms = 0.0;
  auto first = std::size_t{0};
  auto const pass_m = 2.0 * (width_m + height_m);
  auto path_m = 0.0;
  for (std::size_t i = 0; i < drive.log.scans.size(); ++i) {
    auto const scan_ms = cpu_ms();
    mapper.follow(drive.log.scans[i], drive.log.sensors[0]);
    mapper.close_loops();
    worst_ms = std::max(worst_ms, cpu_ms() - scan_ms);
    if (i > 0) path_m += distance_m(drive.truth[i - 1], drive.truth[i]);
    if (path_m < pass * pass_m - 1e-6 && i + 1 < drive.log.scans.size()) continue;
    auto const took_ms = cpu_ms() - began_ms;
    if (pass <= 3 || pass == 5 || pass % 10 == 0)
      fmt::print("{:5} {:10} {:11} {:8.1f} {:9.2f} {:9.2f} {:9.1f}\n", pass, mapper.graph().size(),
                 mapper.graph().constraints.size(), heap_mb() - before_mb, 1e-3 * took_ms,
                 took_ms / static_cast<double>(i + 1 - first), worst_ms);
    std::fflush(stdout);
    ++pass;
    first = i + 1;
    worst_ms = 0.0;
    began_ms = cpu_ms();
  }
  mapper.finish([](std::string_view, double) {});
  std::vector<Pose2> truth;
  for (auto const& frame : mapper.graph().frames) truth.push_back(drive.truth[static_cast<std::size_t>(frame.scan)]);
  fmt::print("the end took {:.2f} s; key frames are {:.3f} m off at most\n", 1e-3 * (cpu_ms() - began_ms),
             testing::greatest_error_m(mapper.graph().poses, truth));
}
