#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "map/features/feature.hpp"

/// Sound features of every kind with everything that they may have, now and then. For tests.
namespace lapwing::map::testing {

class RandomFeatures {
 public:
  explicit RandomFeatures(std::uint64_t seed) : random_(seed) {}

  [[nodiscard]] Content content(LayerKind layer) {
    switch (layer) {
      case LayerKind::slots: return slot();
      case LayerKind::walls: return wall();
      case LayerKind::points_of_interest: return point_of_interest();
      case LayerKind::pictures: return picture();
      case LayerKind::tracks: return track();
      case LayerKind::areas: return area();
    }
    return {};
  }

  /// On the ground of the site, told in 2027 of what was in 2026.
  [[nodiscard]] Feature feature(LayerKind layer, std::string id, std::string site) {
    return {.id = std::move(id),
            .site = std::move(site),
            .account = {.writer = fmt::format("writer {}", number(3)), .at = time() + std::chrono::days(365)},
            .content = content(layer)};
  }

  [[nodiscard]] double real(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }
  [[nodiscard]] int number(int below) { return std::uniform_int_distribution<int>(0, below - 1)(random_); }
  [[nodiscard]] bool chance() { return number(2) == 0; }
  /// In 2026, to the nanosecond.
  [[nodiscard]] base::UtcTime time() {
    using std::chrono::year;
    std::uniform_int_distribution<std::int64_t> within(0, 31'000'000'000'000'000);
    return std::chrono::sys_days(year(2026) / 1 / 1) + base::Duration(within(random_));
  }

 private:
  SitePoint point() { return {real(-500.0, 500.0), real(-500.0, 500.0)}; }
  std::optional<double> maybe(double least, double most) {
    return chance() ? std::optional(real(least, most)) : std::nullopt;
  }
  std::string word() {
    constexpr std::array<char const*, 7> words = {"",      "221",   "Büro 3",      "a \"b\" <c> & d",
                                                  "東 口", "x;y,z", "It's \\ here"};
    return words[static_cast<std::size_t>(number(words.size()))];
  }
  std::string hash() {
    std::string digits;
    while (digits.size() < 64) digits += "0123456789abcdef"[number(16)];
    return digits;
  }
  /// Round a middle, so its edges do not cross; counterclockwise.
  geo::Ring<geo::SiteFrame> ring(SitePoint const& middle, double least_m, double most_m, int corners) {
    geo::Ring<geo::SiteFrame> ring;
    for (int i = 0; i < corners; ++i) {
      double const angle = 2.0 * std::numbers::pi * (i + real(-0.3, 0.3)) / corners;
      double const radius_m = real(least_m, most_m);
      ring.push_back(middle + geo::Vector<geo::SiteFrame>(radius_m * std::cos(angle), radius_m * std::sin(angle)));
    }
    return ring;
  }
  SitePolygon polygon() {
    auto const middle = point();
    SitePolygon polygon{{ring(middle, 10.0, 20.0, 4 + number(5))}};
    if (chance()) {
      polygon.rings.push_back(ring(middle, 1.0, 3.0, 4));
      std::reverse(polygon.rings.back().begin(), polygon.rings.back().end());
    }
    return polygon;
  }

  Slot slot() {
    return {.outline = polygon(),
            .state = static_cast<SlotState>(number(3)),
            .taken_probability = maybe(0.0, 1.0),
            .seen_at = chance() ? std::optional(time()) : std::nullopt,
            .seen_by = word(),
            .name = word()};
  }
  Wall wall() {
    Wall wall{.line = {}, .thickness_m = maybe(0.01, 1.0), .height_m = maybe(1.0, 5.0)};
    for (int i = 0; i < 2 + number(4); ++i) wall.line.points.push_back(point());
    return wall;
  }
  PointOfInterest point_of_interest() {
    PointOfInterest poi{.position = point(),
                        .height_m = real(0.0, 3.0),
                        .kind = word(),
                        .name = word(),
                        .text = word(),
                        .picture = chance() ? hash() : "",
                        .facing_rad = maybe(-3.0, 3.0),
                        .confidence = maybe(0.0, 1.0)};
    if (chance()) poi.covariance_m2 = Eigen::Matrix2d{{1.0 + real(0.0, 1.0), 0.5}, {0.5, 1.0 + real(0.0, 1.0)}};
    return poi;
  }
  Picture picture() {
    Picture picture{.image = hash(),
                    .thumbnail = chance() ? hash() : "",
                    .media_type = chance() ? "image/jpeg" : "image/png",
                    .width_px = number(8000),
                    .height_px = number(6000),
                    .taken_at = time(),
                    .vehicle = word(),
                    .position = point(),
                    .up_m = real(-5.0, 120.0)};
    if (chance())
      picture.site_from_camera =
          Eigen::Quaterniond(real(0.1, 1.0), real(-1.0, 1.0), real(-1.0, 1.0), real(-1.0, 1.0)).normalized();
    if (chance()) {
      picture.footprint = ring(point(), 10.0, 20.0, 4);
      std::reverse(picture.footprint.begin(), picture.footprint.end());
    }
    return picture;
  }
  Track track() {
    Track track{.vehicle = word(), .samples = {}, .thinning = number(3)};
    auto at = time();
    for (int i = 0; i < 2 + number(30); ++i) {
      at += base::from_seconds(real(0.001, 2.0));
      track.samples.push_back({.position = point(), .up_m = real(0.0, 100.0), .at = at});
    }
    return track;
  }
  Area area() {
    return {.outline = polygon(),
            .purpose = static_cast<AreaPurpose>(number(3)),
            .name = word(),
            .lowest_m = maybe(-10.0, 10.0),
            .highest_m = maybe(20.0, 100.0)};
  }

  std::mt19937_64 random_;
};

}  // namespace lapwing::map::testing
