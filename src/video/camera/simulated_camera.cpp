#include "video/camera/simulated_camera.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include "base/text/utc_text.hpp"

namespace lapwing::video {

namespace {

enum Subject : std::uint64_t { for_noise = 501, for_part_of_noise, for_missing, for_pose };

constexpr int noise_more_px = 96;
constexpr double noise_middle = 128.0;
constexpr std::size_t most_moments = 256;

std::uint64_t number_of(base::UtcTime at) {
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(at.time_since_epoch()).count());
}

cv::Mat noise_for(CameraSettings const& settings) {
  if (settings.faults.noise <= 0.0) return {};
  cv::Mat noise(settings.lens.height_px + noise_more_px, settings.lens.width_px + noise_more_px, CV_8UC3);
  cv::RNG rng(Dice(settings.seed, for_noise).bits());
  rng.fill(noise, cv::RNG::NORMAL, cv::Scalar::all(noise_middle), cv::Scalar::all(settings.faults.noise));
  return noise;
}

geo::Vector3<geo::SiteFrame> shift_of(CameraSettings const& settings, CarPark const& park) {
  if (!settings.anchor) return {};
  auto const shift = geo::to_enu(geo::LocalFrame(park.anchor).ned_from(*settings.anchor));
  return {shift.east, shift.north, shift.up};
}

/// Normal, and another within some seconds: two values and a way between them that keeps the spread.
double wandering(std::uint64_t seed, std::uint64_t axis, base::UtcTime at) {
  constexpr double spell_s = 3.0;
  double const spells = std::chrono::duration<double>(at.time_since_epoch()).count() / spell_s;
  auto const knot = static_cast<std::int64_t>(std::floor(spells));
  double const share = spells - static_cast<double>(knot);
  double const from = Dice(seed, for_pose, axis, static_cast<std::uint64_t>(knot)).gaussian();
  double const to = Dice(seed, for_pose, axis, static_cast<std::uint64_t>(knot + 1)).gaussian();
  return ((1.0 - share) * from + share * to) / std::hypot(1.0 - share, share);
}

geo::CameraPlace between(Moment const& a, Moment const& b, base::UtcTime at) {
  auto const whole = std::chrono::duration<double>(b.at - a.at).count();
  double const share = whole > 0.0 ? std::chrono::duration<double>(at - a.at).count() / whole : 1.0;
  auto const from = a.site_from_camera.origin();
  auto const to = b.site_from_camera.origin();
  return {from + (to - from) * share, a.site_from_camera.rotation().slerp(share, b.site_from_camera.rotation())};
}

}  // namespace

SimulatedCamera::SimulatedCamera(CameraSettings settings, CarPark park, cv::Mat const& photograph)
    : settings_(std::move(settings)),
      world_from_told_(shift_of(settings_, park)),
      scene_(std::move(park), photograph),
      rays_(rays_of(settings_.lens)),
      noise_(noise_for(settings_)) {}

Moment SimulatedCamera::exposed(Moment const& asked) {
  if (!moments_.empty() && asked.at < moments_.back().at) moments_.clear();
  moments_.push_back(asked);
  if (moments_.size() > most_moments) moments_.pop_front();
  auto const at = std::max(moments_.front().at,
                           asked.at - std::chrono::duration_cast<base::UtcTime::duration>(settings_.faults.delay));
  while (moments_.size() > 1 && moments_[1].at <= at) moments_.pop_front();
  auto const& next = moments_.size() > 1 ? moments_[1] : moments_.front();
  return {between(moments_.front(), next, at), at};
}

geo::CameraPlace SimulatedCamera::disturbed(Moment const& moment) const {
  auto const& faults = settings_.faults;
  auto const drawn = [&](std::uint64_t axis) { return wandering(settings_.seed, axis, moment.at); };
  geo::Vector3<geo::SiteFrame> const off(faults.position_m * drawn(0), faults.position_m * drawn(1),
                                         faults.position_m * drawn(2));
  Eigen::Vector3d const turn = faults.angle_rad * Eigen::Vector3d(drawn(3), drawn(4), drawn(5));
  Eigen::Quaterniond rotation = moment.site_from_camera.rotation();
  if (turn.norm() > 0.0) rotation = rotation * Eigen::AngleAxisd(turn.norm(), turn.normalized());
  return {moment.site_from_camera.origin() + off + world_from_told_, rotation};
}

void SimulatedCamera::spoil(cv::Mat& picture, base::UtcTime at) const {
  if (settings_.faults.blur_px > 0.0) cv::GaussianBlur(picture, picture, {}, settings_.faults.blur_px);
  if (noise_.empty()) return;
  Dice dice(settings_.seed, for_part_of_noise, number_of(at));
  cv::Point const from(static_cast<int>(dice.bits() % noise_more_px), static_cast<int>(dice.bits() % noise_more_px));
  cv::addWeighted(picture, 1.0, noise_(cv::Rect(from, picture.size())), 1.0, -noise_middle, picture);
}

base::Result<Frame> SimulatedCamera::take(Moment const& moment) {
  auto const then = exposed(moment);
  if (Dice(settings_.seed, for_missing, number_of(moment.at)).happens(settings_.faults.missing_share))
    return base::fail(base::ErrorKind::timed_out,
                      "the simulated camera gave no picture at " + base::to_iso8601(moment.at),
                      "missing_share of its settings says how often it gives none");
  geo::GroundView const view{.lens = settings_.lens, .site_from_camera = disturbed(then)};
  Frame frame{.picture = scene_.seen(view, rays_, occupation_at(scene_.park(), then.at)),
              .taken = then.at,
              .lens = settings_.lens};
  spoil(frame.picture, then.at);
  return frame;
}

}  // namespace lapwing::video
