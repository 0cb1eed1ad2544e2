#include "robot/poi/tag_book.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/LU>

#include "geo/position.hpp"

namespace lapwing::robot {

namespace {

constexpr double same_within_m = 1.0;  ///< the seed's, on the same side of the wall
constexpr double gate = 13.8;          ///< of a squared Mahalanobis distance in two dimensions: 999 of 1,000
constexpr double least_variance_m2 = 0.02 * 0.02;  ///< views err alike by the map that all of them are placed by
constexpr double votes_against = 0.5;

Eigen::Vector2d vector_of(map::SitePoint const& point) {
  return {point.x(), point.y()};
}

/// "106" is one of "B-106": who read it did not see the rest.
bool is_part_of(std::string const& part, std::string const& whole) {
  auto const is_between = [](char c) { return c == '-' || c == '.'; };
  auto const at = whole.find(part);
  if (part.empty() || at == std::string::npos || part.size() == whole.size()) return false;
  auto const end = at + part.size();
  return (at == 0 || is_between(whole[at - 1])) && (end == whole.size() || is_between(whole[end]));
}

/// Its own votes, and those for its parts.
double votes_for(std::string const& name, std::map<std::string, double> const& votes) {
  double sum = 0.0;
  for (auto const& [other, score] : votes)
    if (other == name || is_part_of(other, name)) sum += score;
  return sum;
}

std::string most_voted(std::map<std::string, double> const& votes) {
  if (votes.empty()) return {};
  return std::ranges::max_element(votes, {}, [&](auto const& vote) { return votes_for(vote.first, votes); })->first;
}

}  // namespace

std::string TagBook::Entry::name() const {
  return most_voted(names.empty() ? kinds : names);
}

std::string TagBook::Entry::text() const {
  auto const number = most_voted(names);
  auto const kind = most_voted(kinds);
  return number.empty() || kind.empty() ? number + kind : number + ' ' + kind;
}

double TagBook::Entry::confidence() const {
  auto const& votes = names.empty() ? kinds : names;
  double const all = std::accumulate(votes.begin(), votes.end(), votes_against,
                                     [](double sum, auto const& vote) { return sum + vote.second; });
  return votes_for(name(), votes) / all;
}

TagBook::Entry* TagBook::nearest(TagSight const& sight) {
  Entry* found = nullptr;
  double least_m = same_within_m;
  auto const& wall = sight.place.wall;
  for (auto& tag : tags_) {
    double const apart_m = geo::distance_m(tag.position, wall.position);
    if (apart_m > least_m) continue;
    if (std::abs(geo::wrap_pi(tag.facing_rad - wall.facing_rad)) > std::numbers::pi / 2.0) continue;
    Eigen::Vector2d const apart = vector_of(wall.position) - vector_of(tag.position);
    Eigen::Matrix2d const spread = tag.covariance_m2 + sight.place.covariance_m2;
    // What reads alike may lie as far off as the seed says, what reads otherwise only as far as places err.
    if (tag.name() != sight.name && apart.dot(spread.inverse() * apart) > gate) continue;
    least_m = apart_m;
    found = &tag;
  }
  return found;
}

void TagBook::move(MapMove const& moved) {
  for (auto& tag : tags_) {
    auto const now = moved({tag.position, tag.facing_rad});
    tag.position = now.position;
    tag.facing_rad = now.yaw_rad;
  }
}

TagBook::Entry const& TagBook::take(TagSight const& sight) {
  auto* tag = nearest(sight);
  if (!tag) {
    tags_.push_back({.number = static_cast<std::uint32_t>(tags_.size()) + 1,
                     .position = sight.place.wall.position,
                     .covariance_m2 = sight.place.covariance_m2,
                     .height_m = sight.place.height_m,
                     .facing_rad = sight.place.wall.facing_rad,
                     .sights = 0,
                     .names = {},
                     .kinds = {}});
    tag = &tags_.back();
  } else {
    Eigen::Matrix2d const gain = tag->covariance_m2 * (tag->covariance_m2 + sight.place.covariance_m2).inverse();
    Eigen::Vector2d const at =
        vector_of(tag->position) + gain * (vector_of(sight.place.wall.position) - vector_of(tag->position));
    tag->position = {at.x(), at.y()};
    Eigen::Matrix2d const left = (Eigen::Matrix2d::Identity() - gain) * tag->covariance_m2;
    tag->covariance_m2 = (left + left.transpose()) / 2.0;
    for (int axis = 0; axis < 2; ++axis)
      tag->covariance_m2(axis, axis) = std::max(tag->covariance_m2(axis, axis), least_variance_m2);
    tag->height_m += (sight.place.height_m - tag->height_m) / (tag->sights + 1);
  }
  ++tag->sights;
  auto const called = tag->name();
  if (!sight.name.empty()) tag->names[sight.name] += sight.score;
  if (!sight.kind.empty()) tag->kinds[sight.kind] += sight.score;
  if (tag->name() != called) tag->crop_score = 0.0;  // the crop shows what it is not called any more
  bool const is_as_it_is_called = sight.name.empty() ? tag->names.empty() : sight.name == tag->name();
  if (!sight.crop.empty() && is_as_it_is_called && sight.score > tag->crop_score) {
    tag->crop = sight.crop;
    tag->crop_score = sight.score;
    tag->picture.clear();
  }
  return *tag;
}

}  // namespace lapwing::robot
