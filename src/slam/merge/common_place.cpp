#include "slam/merge/common_place.hpp"

#include <algorithm>
#include <vector>

#include "slam/known/localizer.hpp"

namespace lapwing::slam {
namespace {

// Maps bend, so that distant places of two good ones may differ by so much.
constexpr double bend_m = 0.5;
constexpr double bend_rad = 0.1;
constexpr double good_fit = 0.8;

}  // namespace

std::optional<CommonPlace> find_common_place(KnownMap const& map, ScanLog const& drive, int least_witnesses,
                                             FrameOptions const& options) {
  auto const laid = localize_log(map, drive, std::nullopt, options, [](std::string_view, double) {});
  std::vector<int> found;
  for (int i = 0; i < static_cast<int>(laid.scans.size()); ++i)
    if (!laid.scans[i].is_lost && laid.scans[i].fit >= good_fit) found.push_back(i);
  std::optional<CommonPlace> best;
  for (auto const i : found) {
    CommonPlace place{.scan = i, .pose = laid.scans[i].pose};
    for (auto const k : found) {
      auto const expected = place.pose * between(drive.scans[i].odometry, drive.scans[k].odometry);
      auto const is_same =
          distance_m(expected, laid.scans[k].pose) < bend_m && turn_rad(expected, laid.scans[k].pose) < bend_rad;
      place.witnesses += k != i && is_same ? 1 : 0;
    }
    if (!best || place.witnesses > best->witnesses) best = place;
  }
  auto const needed = std::max(least_witnesses, static_cast<int>(found.size()) / 2);
  return best && best->witnesses >= needed ? best : std::nullopt;
}

}  // namespace lapwing::slam
