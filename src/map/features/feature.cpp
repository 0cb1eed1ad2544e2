#include "map/features/feature.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "base/text/utc_text.hpp"
#include "map/features/internal/property_access.hpp"
#include "map/features/text_fault.hpp"

namespace lapwing::map {

namespace {

using Fault = std::optional<std::string>;

Fault of(std::string_view name, Fault fault) {
  return fault ? Fault(fmt::format("{} {}", name, *fault)) : std::nullopt;
}

/// The first of several faults.
Fault any_of(std::initializer_list<Fault> faults) {
  auto const found = std::ranges::find_if(faults, &Fault::has_value);
  return found == faults.end() ? std::nullopt : *found;
}

Fault name_fault(std::string_view property, std::string_view name) {
  return of(property, text_fault(name, most_name_bytes));
}
Fault vehicle_fault(std::string_view property, std::string_view vehicle) {
  return of(property, text_fault(vehicle, most_id_bytes));
}
Fault optional_hash_fault(std::string_view property, std::string_view hash) {
  return hash.empty() ? std::nullopt : of(property, hash_fault(hash));
}

Fault range_fault(std::string_view property, std::optional<double> value, double least, double most) {
  if (!value || (*value >= least && *value <= most)) return std::nullopt;  // no number is not in any range
  return fmt::format("{} is {:g}, not from {:g} to {:g}", property, *value, least, most);
}
Fault height_fault(std::string_view property, std::optional<double> height_m) {
  return range_fault(property, height_m, -farthest_m, farthest_m);
}

Fault time_fault(std::string_view property, std::optional<base::UtcTime> time) {
  if (!time || is_sane(*time)) return std::nullopt;
  if (*time == base::UtcTime()) return fmt::format("{} is missing", property);
  return fmt::format("{} is {}, not from 1990 to 2200", property, base::utc_text(*time));
}

Fault fault(Slot const& slot) {
  return any_of({range_fault("taken_probability", slot.taken_probability, 0.0, 1.0),
                 time_fault("seen_at", slot.seen_at), vehicle_fault("seen_by", slot.seen_by),
                 name_fault("name", slot.name)});
}

Fault fault(Wall const& wall) {
  return any_of({range_fault("thickness_m", wall.thickness_m, 0.0, farthest_m),
                 range_fault("height_m", wall.height_m, 0.0, farthest_m)});
}

Fault covariance_fault(std::optional<Eigen::Matrix2d> const& covariance_m2) {
  if (!covariance_m2) return std::nullopt;
  if (!covariance_m2->allFinite()) return "covariance_xx_m2, _xy_m2 and _yy_m2 go together, and one of them is missing";
  auto const& c = *covariance_m2;
  constexpr double rounding = 1.0 + 1e-9;
  bool const is_symmetric = c(0, 1) == c(1, 0);
  bool const is_one = c(0, 0) >= 0.0 && c(1, 1) >= 0.0 && c(0, 1) * c(0, 1) <= c(0, 0) * c(1, 1) * rounding;
  return is_symmetric && is_one ? std::nullopt : Fault("covariance_xx_m2, _xy_m2 and _yy_m2 make no covariance");
}

Fault fault(PointOfInterest const& poi) {
  return any_of({height_fault("height_m", poi.height_m), name_fault("kind", poi.kind), name_fault("name", poi.name),
                 of("text", text_fault(poi.text, most_text_bytes, Lines::many)),
                 optional_hash_fault("picture", poi.picture),
                 range_fault("facing_rad", poi.facing_rad, -farthest_m, farthest_m),
                 range_fault("confidence", poi.confidence, 0.0, 1.0), covariance_fault(poi.covariance_m2)});
}

Fault rotation_fault(std::optional<Eigen::Quaterniond> const& rotation) {
  if (!rotation) return std::nullopt;
  if (!rotation->coeffs().allFinite()) return "camera_qx, _qy, _qz and _qw go together, and one of them is missing";
  constexpr double rounding = 1e-3;  // of files that write few digits
  if (std::abs(rotation->norm() - 1.0) <= rounding) return std::nullopt;
  return fmt::format("camera_qx, _qy, _qz and _qw have the length {:g}, not 1", rotation->norm());
}

Fault footprint_fault(std::vector<SitePoint> const& corners) {
  if (corners.empty()) return std::nullopt;
  constexpr std::size_t quadrilateral = 4;
  if (corners.size() != quadrilateral) return fmt::format("the footprint has {} corners, not 4", corners.size());
  return geo::is_counterclockwise(corners)
             ? Fault("the footprint's corners go counterclockwise; they go round as the picture's do, seen from above")
             : std::nullopt;
}

Fault fault(Picture const& picture) {
  constexpr double most_px = 1e6;
  bool const is_known_type = std::ranges::count(internal::picture_media_types, picture.media_type) > 0;
  return any_of({of("image", hash_fault(picture.image)), optional_hash_fault("thumbnail", picture.thumbnail),
                 is_known_type
                     ? std::nullopt
                     : Fault(fmt::format("media_type is none of {}", fmt::join(internal::picture_media_types, ", "))),
                 range_fault("width_px", picture.width_px, 0.0, most_px),
                 range_fault("height_px", picture.height_px, 0.0, most_px), time_fault("taken_at", picture.taken_at),
                 vehicle_fault("vehicle", picture.vehicle), height_fault("up_m", picture.up_m),
                 of("the camera's place:", geometry_fault(picture.position)), rotation_fault(picture.site_from_camera),
                 footprint_fault(picture.footprint)});
}

Fault fault(Track const& track) {
  if (auto wrong = vehicle_fault("vehicle", track.vehicle)) return wrong;
  constexpr double coarsest = 40.0;
  if (auto wrong = range_fault("thinning", track.thinning, 0.0, coarsest)) return wrong;
  for (std::size_t i = 0; i < track.samples.size(); ++i) {
    auto const& sample = track.samples[i];
    if (auto wrong = any_of({time_fault("its time", sample.at), height_fault("its height", sample.up_m)}))
      return fmt::format("point {} of the track: {}", i + 1, *wrong);
    if (i > 0 && sample.at <= track.samples[i - 1].at)
      return fmt::format("point {} of the track is not later than the one before it", i + 1);
  }
  return std::nullopt;
}

Fault fault(Area const& area) {
  if (auto wrong = any_of({name_fault("name", area.name), height_fault("lowest_m", area.lowest_m),
                           height_fault("highest_m", area.highest_m)}))
    return wrong;
  if (!area.lowest_m || !area.highest_m || *area.lowest_m < *area.highest_m) return std::nullopt;
  return fmt::format("highest_m is {:g}, not above lowest_m, {:g}", *area.highest_m, *area.lowest_m);
}

Fault account_fault(Account const& account) {
  return any_of({of("writer", id_fault(account.writer)), time_fault("at", account.at)});
}

/// Whoever tells something tells what was before. Else a removal could not tell what it takes away.
Fault future_fault(Feature const& feature) {
  auto const& at = feature.account.at;
  if (auto const* slot = std::get_if<Slot>(&feature.content); slot && slot->seen_at > at)
    return fmt::format("seen_at is {}, after the account's own time, {}", base::utc_text(*slot->seen_at),
                       base::utc_text(at));
  auto const* track = std::get_if<Track>(&feature.content);
  if (track && !track->samples.empty() && track->samples.back().at > at)
    return fmt::format("the track ends at {}, after the account's own time, {}",
                       base::utc_text(track->samples.back().at), base::utc_text(at));
  return std::nullopt;
}

Fault held_over_fault(Feature const& feature) {
  constexpr std::string_view name = "held_over";
  if (feature.held_over.size() > properties_of(layer_of(feature.content)).size())
    return fmt::format("{} has more entries than there are properties", name);
  for (auto const& held : feature.held_over) {
    if (!property_named(layer_of(feature.content), held.property))
      return fmt::format("{} names a property that the layer does not have", name);
    if (auto wrong = account_fault(held.account)) return fmt::format("{}: {}", name, *wrong);
    if (held.account > feature.account) return fmt::format("{} has a newer account than the feature", name);
  }
  return std::nullopt;
}

struct GeometryOf {
  Geometry operator()(Slot const& slot) const { return slot.outline; }
  Geometry operator()(Wall const& wall) const { return wall.line; }
  Geometry operator()(PointOfInterest const& poi) const { return poi.position; }
  Geometry operator()(Picture const& picture) const {
    if (picture.footprint.empty()) return picture.position;
    return SitePolygon{{picture.footprint}};
  }
  Geometry operator()(Track const& track) const {
    LineString line;
    line.points.reserve(track.samples.size());
    for (auto const& sample : track.samples) line.points.push_back(sample.position);
    return line;
  }
  Geometry operator()(Area const& area) const { return area.outline; }
};

}  // namespace

bool is_sane(base::UtcTime time) {
  using std::chrono::sys_days;
  using std::chrono::year;
  return time >= sys_days(year(1990) / 1 / 1) && time < sys_days(year(2200) / 1 / 1);
}

LayerKind layer_of(Content const& content) {
  return all_layers[content.index()];
}

Geometry geometry_of(Content const& content) {
  return std::visit(GeometryOf(), content);
}

std::optional<std::string> feature_fault(Feature const& feature) {
  if (auto wrong = any_of({of("id", id_fault(feature.id)), of("site", id_fault(feature.site)),
                           of("floor", text_fault(feature.floor, most_id_bytes)), account_fault(feature.account)}))
    return wrong;
  if (auto wrong = std::visit([](auto const& content) { return fault(content); }, feature.content)) return wrong;
  if (auto wrong = any_of({future_fault(feature), held_over_fault(feature)})) return wrong;
  return geometry_fault(geometry_of(feature.content));
}

}  // namespace lapwing::map
