#include "fleet/state/pictures.hpp"

#include <algorithm>
#include <utility>

namespace lapwing::fleet {

using base::TimePoint;
using vehicle::Pictures;
using Shown = vehicle::Aged<Pictures>;

namespace {

constexpr std::size_t pictures_kept = 2000;
constexpr std::int64_t longest_gap = 100;  // a longer one is a counter that began anew
constexpr base::Duration same_picture = std::chrono::seconds(1);
constexpr base::Duration clock_slack = std::chrono::seconds(3);

/// Zeros are what a camera without a position gives.
std::optional<geo::Wgs84> real(std::optional<geo::Wgs84> const& place) {
  if (place && place->lat_rad == 0.0 && place->lon_rad == 0.0) return std::nullopt;
  return place;
}

/// How many were passed over on the way to `now` in a counter of that size; nothing for one that was counted already.
std::optional<std::int64_t> gap(std::optional<std::int64_t> last, std::int64_t now, std::int64_t size) {
  if (!last) return 0;
  auto const step = ((now - *last) % size + size) % size;
  if (step == 0) return std::nullopt;
  return step - 1 <= longest_gap ? step - 1 : 0;
}

}  // namespace

void PictureTrace::add(Shown& shown, std::optional<geo::Wgs84> place, double relative_alt_m, TimePoint now) {
  if (!shown.value) shown.value.emplace();
  shown.heard = now;
  auto& pictures = *shown.value;
  ++pictures.taken;
  last_has_place_ = place.has_value();
  if (!place) {
    ++pictures.lost;
    return;
  }
  auto& recent = pictures.recent;
  if (recent.size() >= pictures_kept) recent.erase(recent.begin());
  recent.push_back({++number_, *place, relative_alt_m});
}

void PictureTrace::add_lost(Shown& shown, std::int64_t count, TimePoint now) {
  for (std::int64_t i = 0; i < count; ++i) add(shown, std::nullopt, 0.0, now);
}

bool PictureTrace::prefers(Source source, Shown& shown, TimePoint now) {
  if (source < source_) return false;
  bool const has_told_worse = source_ != Source::none && source > source_;
  source_ = source;
  if (has_told_worse && shown.value && now - shown.heard < same_picture && shown.value->taken > 0) {
    // The last one was this one.
    auto& pictures = *shown.value;
    if (last_has_place_) pictures.recent.pop_back();
    if (!last_has_place_) --pictures.lost;
    --pictures.taken;
  }
  return true;
}

bool PictureTrace::take(mavlink::CameraImageCaptured const& heard, std::uint8_t component, Shown& shown,
                        TimePoint now) {
  if (!prefers(Source::captured, shown, now)) return false;
  auto& camera = cameras_[{component, heard.camera}];
  if (camera.missing.erase(heard.image) > 0) {
    if (!heard.captured || !real(heard.position)) return false;
    --shown.value->lost;
    --shown.value->taken;
    add(shown, real(heard.position), heard.relative_alt_m.value_or(0.0), now);
    return true;
  }
  if (camera.last && heard.since_boot + clock_slack < camera.since_boot) camera = {};
  if (camera.last && heard.image <= *camera.last) return false;  // once more
  std::int64_t const first = camera.last ? *camera.last + 1 : heard.image;
  if (heard.image - first <= longest_gap) {
    for (auto image = first; image < heard.image; ++image) {
      camera.missing.insert(static_cast<std::int32_t>(image));
      wanted_.push_back({component, static_cast<std::int32_t>(image)});
    }
    add_lost(shown, heard.image - first, now);
  }
  while (camera.missing.size() > static_cast<std::size_t>(longest_gap)) camera.missing.erase(camera.missing.begin());
  camera.last = heard.image;
  camera.since_boot = heard.since_boot;
  if (heard.captured) add(shown, real(heard.position), heard.relative_alt_m.value_or(0.0), now);
  return true;
}

bool PictureTrace::take(mavlink::CameraFeedback const& heard, Shown& shown, TimePoint now) {
  if (!prefers(Source::feedback, shown, now)) return false;
  auto const passed = gap(last_feedback_, heard.image, 65536);
  if (!passed) return false;
  last_feedback_ = heard.image;
  add_lost(shown, *passed, now);
  add(shown, real(heard.position), heard.relative_alt_m.value_or(0.0), now);
  return true;
}

bool PictureTrace::take(mavlink::CameraTrigger const& heard, std::optional<geo::Wgs84> vehicle_position, Shown& shown,
                        TimePoint now) {
  if (!prefers(Source::trigger, shown, now)) return false;
  auto const passed = gap(last_trigger_, heard.seq, std::int64_t{1} << 32);
  if (!passed) return false;
  last_trigger_ = heard.seq;
  add_lost(shown, *passed, now);
  add(shown, vehicle_position, 0.0, now);
  return true;
}

std::vector<PictureTrace::Missing> PictureTrace::take_missing() {
  return std::exchange(wanted_, {});
}

bool PictureTrace::is_missing(Missing const& picture) const {
  return std::ranges::any_of(cameras_, [&](auto const& entry) {
    return entry.first.first == picture.component && entry.second.missing.contains(picture.image);
  });
}

void PictureTrace::restart() {
  cameras_.clear();
  last_feedback_.reset();
  last_trigger_.reset();
  wanted_.clear();
}

}  // namespace lapwing::fleet
