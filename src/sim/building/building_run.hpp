#pragma once

#include <memory>
#include <vector>

#include "base/async/scope.hpp"
#include "base/error.hpp"
#include "link/byte_link.hpp"
#include "link/pipe_link.hpp"
#include "sim/building/building.hpp"

namespace lapwing::sim::building {

/// Lets a building's time pass with a loop's, and gives each robot's line as byte links. Under an unpaced loop it runs
/// as fast as the machine computes. Goes on by itself until destroyed; the building outlives it.
class BuildingRun {
 public:
  BuildingRun(base::Loop& loop, Building& building);
  BuildingRun(BuildingRun const&) = delete;
  BuildingRun& operator=(BuildingRun const&) = delete;

  /// The host's end of a robot's line, in memory. Several may be open; all hear the board. A board speaks on a link
  /// from the first byte on that comes over it, so greet it.
  [[nodiscard]] std::unique_ptr<link::ByteLink> connect(std::size_t robot);
  /// Serves a robot's line over a link of any kind: `tcpin://127.0.0.1:5770`, a serial port.
  void serve(std::size_t robot, std::unique_ptr<link::ByteLink> link);
  /// The same, by its URL. Errors: those of the link.
  [[nodiscard]] base::Result<> serve(std::size_t robot, link::Url const& url);

 private:
  /// The board's end of one link.
  struct Line {
    std::size_t robot = 0;
    std::unique_ptr<link::ByteLink> link;
    std::vector<link::Peer> heard;
  };
  base::Task<void> live();
  void speak();

  base::Loop& loop_;
  Building& building_;
  base::TimePoint began_;
  double began_s_;
  std::vector<std::unique_ptr<link::PipeHub>> hubs_;  ///< one a robot, made when somebody connects
  std::vector<std::unique_ptr<Line>> lines_;          // at fixed places: links call back into them
  base::Scope scope_;
};

}  // namespace lapwing::sim::building
