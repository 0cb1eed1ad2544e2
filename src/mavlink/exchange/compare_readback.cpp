#include <cmath>

#include <fmt/format.h>

#include "mavlink/exchange/mission_transfer.hpp"

namespace lapwing::mavlink {

namespace {

double constexpr angle_tolerance_rad = 4e-9;  // two units of the wire, 2 cm
double constexpr local_tolerance_m = 1e-3;
double constexpr altitude_tolerance_m = 0.0101;  // ArduPilot cuts to whole centimetres
double constexpr rally_tolerance_m = 1.0;        // and to whole metres for rally points

/// Frames that mean the same, mapped to one of them.
MavFrame plain(MavFrame frame) {
  switch (frame) {
    case MavFrame::global_int: return MavFrame::global;
    case MavFrame::global_relative_alt_int: return MavFrame::global_relative_alt;
    case MavFrame::global_terrain_alt_int: return MavFrame::global_terrain_alt;
    default: return frame;
  }
}

bool close(double sent, double got) {
  if (std::isnan(sent)) return std::isnan(got);
  return std::fabs(got - sent) <= 1e-4 * std::fmax(1.0, std::fabs(sent));
}

/// ArduPilot stores most parameters as whole numbers, radii above 255 in tens, and of a navigation command's parameters
/// 2 to 4 only those that it uses; in place of the others it returns 0 or 1.
bool close_on_ardupilot(MavCmd command, std::size_t index, double sent, double got) {
  if (std::isnan(sent)) return true;
  if (close(sent, got) || got == std::trunc(sent)) return true;
  if (!has_place(command) || index == 0) return false;
  return got == 0.0 || std::fabs(got) == 1.0 || std::fabs(got - sent) < 10.0;
}

class Comparison {
 public:
  Comparison(std::size_t index, MissionItem const& sent, MissionItem const& got, bool ardupilot)
      : index_(index), sent_(sent), got_(got), ardupilot_(ardupilot) {}

  void add_differences(std::vector<Difference>& all) const {
    if (sent_.command != got_.command) {
      all.push_back(
          fmt::format("item {}: command {}, sent {}", index_, to_string(got_.command), to_string(sent_.command)));
      return;
    }
    bool const placed = has_place(sent_.command) && sent_.frame != MavFrame::mission;
    // ArduPilot's fences have neither frames nor heights: it returns 0 for both.
    bool const is_flat = ardupilot_ && sent_.type == MissionType::fence;
    if (placed && !is_flat && plain(sent_.frame) != plain(got_.frame)) {
      all.push_back(fmt::format("item {}: frame {}, sent {}", index_, static_cast<int>(got_.frame),
                                static_cast<int>(sent_.frame)));
    } else if (placed) {
      add_place(all, !is_flat);
    }
    add_params(all);
    if (!ardupilot_ && sent_.autocontinue != got_.autocontinue)
      all.push_back(fmt::format("item {}: autocontinue {}, sent {}", index_, got_.autocontinue, sent_.autocontinue));
  }

 private:
  void add_place(std::vector<Difference>& all, bool has_height) const {
    auto const& a = sent_.place;
    auto const& b = got_.place;
    bool const moved = is_global(sent_.frame)
                           ? std::fabs(a.lat_rad - b.lat_rad) > angle_tolerance_rad ||
                                 std::fabs(a.lon_rad - b.lon_rad) > angle_tolerance_rad
                           : std::fabs(a.x - b.x) > local_tolerance_m || std::fabs(a.y - b.y) > local_tolerance_m;
    if (moved) all.push_back(fmt::format("item {}: position {}, sent {}", index_, text(got_), text(sent_)));
    if (!has_height) return;
    bool const is_rally = ardupilot_ && sent_.type == MissionType::rally;
    if (std::fabs(a.z_m - b.z_m) > (is_rally ? rally_tolerance_m : altitude_tolerance_m))
      all.push_back(fmt::format("item {}: altitude {:.2f} m, sent {:.2f} m", index_, b.z_m, a.z_m));
  }

  void add_params(std::vector<Difference>& all) const {
    for (std::size_t i = 0; i < sent_.params.size(); ++i) {
      auto const a = static_cast<double>(sent_.params[i]);
      auto const b = static_cast<double>(got_.params[i]);
      if (ardupilot_ ? !close_on_ardupilot(sent_.command, i, a, b) : !close(a, b))
        all.push_back(
            fmt::format("item {}: parameter {} of {} is {}, sent {}", index_, i + 1, to_string(sent_.command), b, a));
    }
  }

  [[nodiscard]] static std::string text(MissionItem const& item) {
    if (!is_global(item.frame)) return fmt::format("{:.3f} {:.3f}", item.place.x, item.place.y);
    geo::Wgs84 const place{item.place.lat_rad, item.place.lon_rad, 0.0};
    return fmt::format("{:.7f} {:.7f}", place.lat_deg(), place.lon_deg());
  }

  std::size_t index_;
  MissionItem const& sent_;
  MissionItem const& got_;
  bool ardupilot_;
};

}  // namespace

std::vector<Difference> compare_readback(std::span<MissionItem const> sent, std::span<MissionItem const> got,
                                         MavAutopilot autopilot) {
  std::vector<Difference> all;
  if (sent.size() != got.size()) {
    all.push_back(fmt::format("the vehicle holds {} items, sent {}", got.size(), sent.size()));
    return all;
  }
  for (std::size_t i = 0; i < sent.size(); ++i) {
    auto const differences = compare_item(i, sent[i], got[i], autopilot);
    all.insert(all.end(), differences.begin(), differences.end());
  }
  return all;
}

std::vector<Difference> compare_item(std::size_t index, MissionItem const& sent, MissionItem const& got,
                                     MavAutopilot autopilot) {
  std::vector<Difference> all;
  bool const ardupilot = autopilot == MavAutopilot::ardupilotmega;
  bool const is_home = ardupilot && index == 0 && sent.type == MissionType::mission;
  if (!is_home) Comparison(index, sent, got, ardupilot).add_differences(all);
  return all;
}

}  // namespace lapwing::mavlink
