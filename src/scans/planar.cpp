#include "scans/planar.hpp"

#include <cmath>

namespace lapwing::scans {

namespace {

/// As many frames as a robot may have; whoever sends more, or chains longer than this, is not listened to.
constexpr std::size_t most_frames = 1000;
constexpr int longest_chain = 30;

PlanarFrame operator*(PlanarFrame const& outer, PlanarFrame const& inner) {
  auto turned = inner.pose;
  if (outer.is_upside_down) {
    turned.y = -turned.y;
    turned.yaw = -turned.yaw;
  }
  return {.pose = outer.pose * turned, .is_upside_down = outer.is_upside_down != inner.is_upside_down};
}

}  // namespace

double yaw_of(bus::Quaternion const& q) {
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
}

bus::Quaternion rotation_to(double yaw_rad) {
  return {.z = std::sin(yaw_rad / 2.0), .w = std::cos(yaw_rad / 2.0)};
}

PlanarFrame planar(bus::Transform const& transform) {
  auto const& q = transform.rotation;
  double const z_axis_up = 1.0 - 2.0 * (q.x * q.x + q.y * q.y);
  return {.pose = {transform.translation.x, transform.translation.y, yaw_of(q)}, .is_upside_down = z_axis_up < 0.0};
}

void StaticFrames::take(bus::TFMessage const& message) {
  for (auto const& one : message.transforms) {
    auto const frame = planar(one.transform);
    bool const is_place = std::isfinite(frame.pose.x) && std::isfinite(frame.pose.y) && std::isfinite(frame.pose.yaw);
    if (is_place && (links_.size() < most_frames || links_.contains(one.child_frame_id)))
      links_.insert_or_assign(one.child_frame_id, Link{one.header.frame_id, frame});
  }
}

std::optional<PlanarFrame> StaticFrames::find(std::string const& frame, std::string const& base) const {
  PlanarFrame found;
  auto at = frame;
  for (int i = 0; i < longest_chain; ++i) {
    if (at == base) return found;
    auto const link = links_.find(at);
    if (link == links_.end()) return std::nullopt;
    found = link->second.in_parent * found;
    at = link->second.parent;
  }
  return std::nullopt;
}

std::string StaticFrames::root_of(std::string frame) const {
  auto link = links_.find(frame);
  for (int i = 0; i < longest_chain && link != links_.end(); ++i) {
    frame = link->second.parent;
    link = links_.find(frame);
  }
  return frame;
}

}  // namespace lapwing::scans
