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
constexpr std::size_t most_seen_from = 8;  ///< who was seen more often than that hangs where it seems to
constexpr double leads_on_rad = 0.1;       ///< that a robot's pose lags while it turns
constexpr double leads_on_from_m = 0.5;    ///< nearer to one another, places err
constexpr double leads_on_to_m = 8.0;      ///< from the camera; nothing is read from farther away

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

TagBook::Entry entry_of(TagSight const& sight) {
  TagBook::Entry entry{.position = sight.place.wall.position,
                       .covariance_m2 = sight.place.covariance_m2,
                       .height_m = sight.place.height_m,
                       .facing_rad = sight.place.wall.facing_rad,
                       .sights = 1,
                       .seen_from = {sight.from},
                       .names = {},
                       .kinds = {},
                       .crop = sight.crop,
                       .crop_score = sight.crop.empty() ? 0.0 : sight.score};
  if (!sight.name.empty()) entry.names[sight.name] = sight.score;
  if (!sight.kind.empty()) entry.kinds[sight.kind] = sight.score;
  return entry;
}

double apart_m(TagBook::Entry const& one, TagBook::Entry const& other) {
  return geo::distance_m(one.position, other.position);
}

/// All lines of sight to the one lead on to the other, which looks back along them, and says the same or more: the edge
/// that the one seems to hang on may have hidden some of it.
bool is_seen_past(TagBook::Entry const& one, TagBook::Entry const& other) {
  if (one.names.empty() || other.names.empty() || one.name().size() < 2) return false;
  if (!other.name().contains(one.name())) return false;
  if (one.seen_from.size() != static_cast<std::size_t>(one.sights)) return false;
  Eigen::Vector2d const facing(std::cos(other.facing_rad), std::sin(other.facing_rad));
  return std::ranges::all_of(one.seen_from, [&](map::SitePoint const& from) {
    Eigen::Vector2d const to_one = vector_of(one.position) - vector_of(from);
    Eigen::Vector2d const to_other = vector_of(other.position) - vector_of(from);
    double const beyond_m = to_other.norm() - to_one.norm();
    double const off = std::atan2(to_other.y(), to_other.x()) - std::atan2(to_one.y(), to_one.x());
    return beyond_m > leads_on_from_m && to_other.norm() < leads_on_to_m &&
           std::abs(geo::wrap_pi(off)) < leads_on_rad && facing.dot(to_other) < 0.0;
  });
}

/// What has the same number may lie as far off as the seed says, anything else only as far as places err: the next door
/// may lead to a room of the same kind.
bool is_one(TagBook::Entry const& one, TagBook::Entry const& other) {
  if (is_seen_past(one, other) || is_seen_past(other, one)) return true;
  if (apart_m(one, other) > same_within_m) return false;
  if (std::abs(geo::wrap_pi(one.facing_rad - other.facing_rad)) > std::numbers::pi / 2.0) return false;
  if (!one.names.empty() && one.name() == other.name()) return true;
  Eigen::Vector2d const apart = vector_of(other.position) - vector_of(one.position);
  Eigen::Matrix2d const spread = one.covariance_m2 + other.covariance_m2;
  return apart.dot(spread.inverse() * apart) <= gate;
}

void add_votes(std::map<std::string, double>& votes, std::map<std::string, double> const& more) {
  for (auto const& [name, score] : more) votes[name] += score;
}

/// By their covariances, heights by the number of sights.
void join_places(TagBook::Entry& tag, TagBook::Entry const& other) {
  Eigen::Matrix2d const gain = tag.covariance_m2 * (tag.covariance_m2 + other.covariance_m2).inverse();
  Eigen::Vector2d const at = vector_of(tag.position) + gain * (vector_of(other.position) - vector_of(tag.position));
  tag.position = {at.x(), at.y()};
  Eigen::Matrix2d const left = (Eigen::Matrix2d::Identity() - gain) * tag.covariance_m2;
  tag.covariance_m2 = (left + left.transpose()) / 2.0;
  for (int axis = 0; axis < 2; ++axis)
    tag.covariance_m2(axis, axis) = std::max(tag.covariance_m2(axis, axis), least_variance_m2);
  tag.height_m += (other.height_m - tag.height_m) * other.sights / (tag.sights + other.sights);
}

/// Texts by adding up the votes. What was seen past an edge adds nothing.
void join(TagBook::Entry& tag, TagBook::Entry const& other) {
  if (is_seen_past(other, tag)) return;
  if (is_seen_past(tag, other)) {
    auto const number = tag.number;
    tag = other;
    tag.number = number;
    return;
  }
  join_places(tag, other);
  tag.sights += other.sights;
  tag.seen_from.insert(tag.seen_from.end(), other.seen_from.begin(), other.seen_from.end());
  if (tag.seen_from.size() > most_seen_from) tag.seen_from.clear();
  auto const called = tag.name();
  add_votes(tag.names, other.names);
  add_votes(tag.kinds, other.kinds);
  if (tag.name() != called) tag.crop_score = 0.0;  // the crop shows what it is not called any more
  if (other.crop.empty() || other.name() != tag.name() || other.crop_score <= tag.crop_score) return;
  tag.crop = other.crop;
  tag.crop_score = other.crop_score;
  tag.picture = other.picture;
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

void TagBook::keep_picture(std::uint32_t number, std::string picture) {
  auto const tag = std::ranges::find(tags_, number, &Entry::number);
  if (tag != tags_.end()) tag->picture = std::move(picture);
}

TagBook::Entry const* TagBook::find(std::uint32_t number) const {
  auto const tag = std::ranges::find(tags_, number, &Entry::number);
  return tag == tags_.end() ? nullptr : &*tag;
}

TagBook::Entry const& TagBook::take(TagSight const& sight) {
  auto const seen = entry_of(sight);
  Entry* nearest = nullptr;
  for (auto& tag : tags_)
    if (is_one(tag, seen) && (!nearest || apart_m(tag, seen) < apart_m(*nearest, seen))) nearest = &tag;
  if (nearest) {
    join(*nearest, seen);
    return *nearest;
  }
  tags_.push_back(seen);
  tags_.back().number = ++last_number_;
  return tags_.back();
}

std::vector<TagBook::Joined> TagBook::move(MapMove const& moved) {
  for (auto& tag : tags_) {
    auto const now = moved({tag.position, tag.facing_rad});
    tag.position = now.position;
    tag.facing_rad = now.yaw_rad;
    for (auto& from : tag.seen_from) from = moved({from, 0.0}).position;
  }
  std::vector<Joined> joined;
  for (std::size_t i = 0; i < tags_.size(); ++i)
    for (std::size_t k = i + 1; k < tags_.size();) {
      if (!is_one(tags_[i], tags_[k])) {
        ++k;
        continue;
      }
      join(tags_[i], tags_[k]);
      joined.push_back({.gone = tags_[k].number, .into = tags_[i].number});
      tags_.erase(tags_.begin() + static_cast<std::ptrdiff_t>(k));
    }
  return joined;
}

}  // namespace lapwing::robot
