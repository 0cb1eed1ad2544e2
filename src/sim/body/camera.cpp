#include "sim/body/camera.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::sim {

using mavlink::MavCmd;

namespace {

constexpr double shortest_period_s = 0.1;
constexpr int most_in_a_step = 20;  // of intervals shorter than a step
constexpr std::size_t shots_kept = 20'000;

}  // namespace

bool Camera::perform(MavCmd command, std::array<float, 4> const& params, mavlink::ItemPlace const& place,
                     base::Duration now) {
  switch (command) {
    case MavCmd::do_digicam_control:
      // Parameter 5 says whether to shoot; many senders leave all at zero and mean it.
      if (place.x >= 0.0) ++pending_;
      return true;
    case MavCmd::image_start_capture: {
      double const period_s = params[1];
      left_ = params[2] > 0.0F ? static_cast<int>(std::min(params[2], 100'000.0F)) : -1;
      if (left_ < 0 && !(period_s > 0.0)) left_ = 1;
      period_ = base::from_seconds(std::max(shortest_period_s, std::isfinite(period_s) ? period_s : 1.0));
      next_ = now;
      return true;
    }
    case MavCmd::image_stop_capture: left_ = 0; return true;
    case MavCmd::do_set_cam_trigg_dist:
      distance_m_ = params[0] > 0.0F ? static_cast<double>(params[0]) : 0.0;
      last_m_.reset();
      if (params[2] == 1.0F) ++pending_;
      return true;
    default: return false;
  }
}

void Camera::shoot(Body const& body, base::Duration now) {
  if (shots_.size() >= shots_kept) return;  // the card is full
  shots_.push_back({static_cast<int>(shots_.size()), now, body.position_m, body.attitude});
  last_m_ = body.position_m;
}

std::vector<Camera::Shot> Camera::step(Body const& body, base::Duration now) {
  for (; pending_ > 0; --pending_) shoot(body, now);
  for (int i = 0; i < most_in_a_step && left_ != 0 && now >= next_; ++i) {
    shoot(body, now);
    if (left_ > 0) --left_;
    next_ += period_;
  }
  if (distance_m_ > 0.0) {
    if (!last_m_) last_m_ = body.position_m;
    double const flown = std::hypot(body.position_m.north - last_m_->north, body.position_m.east - last_m_->east);
    if (flown >= distance_m_) shoot(body, now);
  }
  std::vector<Shot> fresh(shots_.begin() + static_cast<std::ptrdiff_t>(told_), shots_.end());
  told_ = shots_.size();
  return fresh;
}

}  // namespace lapwing::sim
