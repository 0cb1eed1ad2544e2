#include "map/features/feature.hpp"

#include <chrono>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "base/testing/cpu_time.hpp"
#include "map/features/properties.hpp"
#include "map/testing/random_features.hpp"

namespace lapwing::map {
namespace {

using namespace std::chrono_literals;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr auto now = base::UtcTime(1'795'255'972s);

SitePolygon square(double side_m = 10.0) {
  return {{{{0.0, 0.0}, {side_m, 0.0}, {side_m, side_m}, {0.0, side_m}}}};
}

Feature with(Content content) {
  return {.id = "a", .site = "yard", .account = {.writer = "drone 1", .at = now}, .content = std::move(content)};
}

std::string fault_of(Feature const& feature) {
  return feature_fault(feature).value_or("none");
}

TEST(Feature, IsSoundHoweverMuchOfItIsKnown) {
  testing::RandomFeatures random(3);
  for (auto const layer : all_layers)
    for (int i = 0; i < 100; ++i) EXPECT_EQ(fault_of(random.feature(layer, "f", "yard")), "none") << name_of(layer);
}

TEST(Feature, NeedsAnIdASiteAndAnAccount) {
  auto feature = with(Slot{.outline = square()});
  feature.id = "";
  EXPECT_EQ(fault_of(feature), "id is empty");
  feature.id = std::string(101, 'a');
  EXPECT_EQ(fault_of(feature), "id has 101 bytes; at most 100 are taken");
  feature.id = "a\nb";
  EXPECT_EQ(fault_of(feature), "id has the control character U+000A");
  feature.id = "a\u202Eb";
  EXPECT_EQ(fault_of(feature), "id has the control character U+202E");
  feature.id = "\xC3(";
  EXPECT_EQ(fault_of(feature), "id is no UTF-8");
  feature.id = "\xC0\xAF";
  EXPECT_EQ(fault_of(feature), "id is no UTF-8") << "a form longer than needed";
  feature.id = "\xED\xA0\x80";
  EXPECT_EQ(fault_of(feature), "id is no UTF-8") << "a surrogate";
  feature.id = "\xF0\x9F";
  EXPECT_EQ(fault_of(feature), "id is no UTF-8") << "cut off";
  feature.id = "Büro 東口 \U0001F697";
  EXPECT_EQ(fault_of(feature), "none");
  feature.site = "";
  EXPECT_EQ(fault_of(feature), "site is empty");
  feature.site = "yard";
  feature.floor = "\t";
  EXPECT_EQ(fault_of(feature), "floor has the control character U+0009");
  feature.floor = "";
  feature.account.writer = "";
  EXPECT_EQ(fault_of(feature), "writer is empty");
  feature.account = {"drone 1", {}};
  EXPECT_EQ(fault_of(feature), "at is missing");
  feature.account.at = base::UtcTime(-10'000'000s);
  EXPECT_EQ(fault_of(feature), "at is 1969-09-07T06:13:20.000Z, not from 1990 to 2200");
}

TEST(Feature, HasNumbersWithinBounds) {
  EXPECT_EQ(fault_of(with(Slot{.outline = square(), .taken_probability = 1.3})),
            "taken_probability is 1.3, not from 0 to 1");
  EXPECT_EQ(fault_of(with(Slot{.outline = square(), .taken_probability = nan})),
            "taken_probability is nan, not from 0 to 1");
  EXPECT_EQ(fault_of(with(Slot{.outline = square(), .seen_at = base::UtcTime(1s)})),
            "seen_at is 1970-01-01T00:00:01.000Z, not from 1990 to 2200");
  EXPECT_EQ(fault_of(with(Slot{.outline = square(), .seen_at = now + 1ms})),
            "seen_at is 2026-11-21T10:12:52.001Z, after the account's own time, 2026-11-21T10:12:52.000Z");
  EXPECT_EQ(fault_of(with(Wall{.line = {{{}, {1.0, 0.0}}}, .thickness_m = -1.0})),
            "thickness_m is -1, not from 0 to 100000");
  EXPECT_EQ(fault_of(with(Area{.outline = square(), .lowest_m = 5.0, .highest_m = 4.0})),
            "highest_m is 4, not above lowest_m, 5");
  EXPECT_EQ(fault_of(with(PointOfInterest{.position = {}, .height_m = nan})),
            "height_m is nan, not from -100000 to 100000");
}

TEST(Feature, HasTextsThatCanBeShown) {
  EXPECT_EQ(fault_of(with(PointOfInterest{.position = {}, .text = "two\nlines"})), "none");
  EXPECT_EQ(fault_of(with(PointOfInterest{.position = {}, .name = "two\nlines"})),
            "name has the control character U+000A");
  EXPECT_EQ(fault_of(with(PointOfInterest{.position = {}, .text = "\x1b[2J"})),
            "text has the control character U+001B");
  EXPECT_EQ(fault_of(with(PointOfInterest{.position = {}, .text = std::string(4001, 'a')})),
            "text has 4001 bytes; at most 4000 are taken");
  EXPECT_EQ(fault_of(with(PointOfInterest{.position = {}, .picture = "../../etc/passwd"})),
            "picture is no hash (64 digits of SHA-256, in small letters)");
}

TEST(Feature, HasACovarianceOrNone) {
  Content poi = PointOfInterest();
  ASSERT_TRUE(property_named(LayerKind::points_of_interest, "covariance_xx_m2")->set(poi, 1.0));
  EXPECT_EQ(fault_of(with(poi)), "covariance_xx_m2, _xy_m2 and _yy_m2 go together, and one of them is missing");
  std::get<PointOfInterest>(poi).covariance_m2 = Eigen::Matrix2d{{1.0, 2.0}, {2.0, 1.0}};
  EXPECT_EQ(fault_of(with(poi)), "covariance_xx_m2, _xy_m2 and _yy_m2 make no covariance");
  std::get<PointOfInterest>(poi).covariance_m2 = Eigen::Matrix2d{{1.0, 1.0}, {1.0, 1.0}};
  EXPECT_EQ(fault_of(with(poi)), "none");
}

TEST(Feature, IsAPictureThatWasTaken) {
  std::string const hash(64, 'a');
  Picture const sound{.image = hash, .taken_at = now};
  EXPECT_EQ(fault_of(with(sound)), "none");
  auto picture = sound;
  picture.image = "";
  EXPECT_EQ(fault_of(with(picture)), "image is no hash (64 digits of SHA-256, in small letters)");
  picture = sound;
  picture.taken_at = {};
  EXPECT_EQ(fault_of(with(picture)), "taken_at is missing");
  picture = sound;
  picture.media_type = "text/html";
  EXPECT_EQ(fault_of(with(picture)),
            "media_type is none of image/jpeg, image/png, image/webp, image/avif, image/tiff, image/gif");
  picture = sound;
  picture.width_px = -1;
  EXPECT_EQ(fault_of(with(picture)), "width_px is -1, not from 0 to 1e+06");
  picture = sound;
  picture.site_from_camera = Eigen::Quaterniond(1.0, 1.0, 0.0, 0.0);
  EXPECT_EQ(fault_of(with(picture)), "camera_qx, _qy, _qz and _qw have the length 1.41421, not 1");
  picture.site_from_camera->w() = nan;
  EXPECT_EQ(fault_of(with(picture)), "camera_qx, _qy, _qz and _qw go together, and one of them is missing");
  picture = sound;
  picture.footprint = {{0.0, 0.0}, {0.0, 10.0}, {10.0, 0.0}};
  EXPECT_EQ(fault_of(with(picture)), "the footprint has 3 corners, not 4");
  picture.footprint = square().rings.front();
  EXPECT_EQ(fault_of(with(picture)),
            "the footprint's corners go counterclockwise; they go round as the picture's do, seen from above");
}

TEST(Feature, IsATrackInTheOrderOfTime) {
  Track track{.samples = {{.position = {}, .at = now - 1s}, {.position = {}, .at = now - 1s}}};
  EXPECT_EQ(fault_of(with(track)), "point 2 of the track is not later than the one before it");
  track.samples.back().at += 1ns;
  EXPECT_EQ(fault_of(with(track)), "none");
  track.samples.back().up_m = nan;
  EXPECT_EQ(fault_of(with(track)), "point 2 of the track: its height is nan, not from -100000 to 100000");
  track.samples.back() = {.position = {}, .at = now + 1s};
  EXPECT_EQ(fault_of(with(track)),
            "the track ends at 2026-11-21T10:12:53.000Z, after the account's own time, 2026-11-21T10:12:52.000Z");
  EXPECT_EQ(fault_of(with(Track())), "a line takes two points, and this has 0");
}

TEST(Feature, HoldsOverWhatItsLayerHas) {
  auto feature = with(Slot{.outline = square(), .name = "12"});
  feature.held_over = {{"name", {"drone 2", now - 1s}}};
  EXPECT_EQ(fault_of(feature), "none");
  feature.held_over = {{"height_m", {"drone 2", now}}};
  EXPECT_EQ(fault_of(feature), "held_over names a property that the layer does not have");
  feature.held_over = {{"name", {"", now}}};
  EXPECT_EQ(fault_of(feature), "held_over: writer is empty");
  feature.held_over = {{"name", {"drone 2", now + 1s}}};
  EXPECT_EQ(fault_of(feature), "held_over has a newer account than the feature");
}

TEST(Account, IsInAnOrderThatAllAgreeOn) {
  Account const early{"z", now};
  Account const late{"a", now + 1s};
  EXPECT_LT(early, late);
  EXPECT_LT((Account{"a", now}), early);
}

TEST(Geometry, IsRefusedWithTheReason) {
  EXPECT_EQ(geometry_fault(SitePoint(nan, 0.0)), "point 1 of the place is no number");
  EXPECT_EQ(geometry_fault(SitePoint(120'000.0, 0.0)),
            "point 1 of the place lies 120 km from the site's anchor; the map of a site ends at 100 km");
  EXPECT_EQ(geometry_fault(LineString{{{}}}), "a line takes two points, and this has 1");
  EXPECT_EQ(geometry_fault(LineString{{{}, {0.0, nan}}}), "point 2 of the line is no number");
  EXPECT_EQ(geometry_fault(SitePolygon()), "there is no ring");
  EXPECT_EQ(geometry_fault(SitePolygon{{{{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}}}}),
            "its edges cross or touch each other");
  auto holed = square();
  holed.rings.push_back({{nan, 0.0}});
  EXPECT_EQ(geometry_fault(holed), "point 1 of hole 1 is no number");
}

TEST(Geometry, IsRefusedAtOnceWhenItIsHuge) {
  SitePolygon huge{{{}}};
  huge.rings.front().resize(1'000'000);
  auto const began = base::cpu_time();
  EXPECT_EQ(geometry_fault(huge), "it has 1000001 points; at most 10000 are taken");
  EXPECT_EQ(geometry_fault(LineString{huge.rings.front()}), "it has 1000000 points; at most 100000 are taken");
  SitePolygon hollow = square();
  hollow.rings.resize(1'000'000);
  EXPECT_TRUE(geometry_fault(hollow).has_value());
  EXPECT_LT(base::cpu_time() - began, 5s) << "with a sanitizer on a busy machine";
}

/// A comb at 45 degrees, so that the boxes round its teeth overlap: what a search for crossing edges takes longest for.
SitePolygon slanting_comb(std::size_t corners) {
  SitePolygon comb{{{}}};
  auto& ring = comb.rings.front();
  auto const put = [&](double along, double across) {
    ring.emplace_back((along - across) * std::numbers::sqrt2 / 2.0, (along + across) * std::numbers::sqrt2 / 2.0);
  };
  int const teeth = static_cast<int>(corners - 2) / 2;
  for (int i = 0; i < teeth; ++i) {
    put(i * 0.1, 0.0);
    put(i * 0.1 + 0.05, 5'000.0);
  }
  put(teeth * 0.1, -1.0);
  put(-1.0, -1.0);
  return comb;
}

TEST(Geometry, IsJudgedInBoundedTimeHoweverItsEdgesLie) {
  auto const began = base::cpu_time();
  EXPECT_EQ(geometry_fault(slanting_comb(1'300)), std::nullopt);
  EXPECT_EQ(geometry_fault(slanting_comb(most_corners - 1)),
            "its edges lie too close together to be examined; simplify it or cut it in several");
  EXPECT_LT(base::cpu_time() - began, 60s) << "with a sanitizer; every edge against every other would take hours";
}

/// All its edges begin at one x, and their spans along y overlap.
TEST(Geometry, IsNotExaminedAsABundleEither) {
  SitePolygon bundle{{{}}};
  for (int i = 0; i < static_cast<int>(most_corners) - 1; ++i)
    bundle.rings.front().emplace_back(i % 2 == 0 ? 0.0 : 5'000.0, i % 2 == 0 ? 1e-3 * i : 5'000.0 + 1e-3 * i);
  EXPECT_EQ(geometry_fault(bundle),
            "its edges lie too close together to be examined; simplify it or cut it in several");
}

TEST(Geometry, MayBeAWindingCoast) {
  testing::RandomFeatures random(5);
  SitePolygon coast{{{}}};
  int const corners = static_cast<int>(most_corners) - 1;
  for (int i = 0; i < corners; ++i) {
    double const angle = 2.0 * std::numbers::pi * i / corners;
    double const radius_m = 5'000.0 + 500.0 * std::sin(30.0 * angle) + random.real(-20.0, 20.0);
    coast.rings.front().emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle));
  }
  EXPECT_EQ(geometry_fault(coast), std::nullopt);
}

TEST(Geometry, HasBoundsAndACount) {
  EXPECT_EQ(bounds(SitePoint(1.0, 2.0)), (SiteBox{{1.0, 2.0}, {1.0, 2.0}}));
  EXPECT_EQ(bounds(LineString{{{1.0, 2.0}, {-1.0, 5.0}}}), (SiteBox{{-1.0, 2.0}, {1.0, 5.0}}));
  EXPECT_EQ(bounds(square()), (SiteBox{{0.0, 0.0}, {10.0, 10.0}}));
  EXPECT_EQ(point_count(SitePoint()), 1U);
  EXPECT_EQ(point_count(LineString{{{}, {}}}), 2U);
  EXPECT_EQ(point_count(SitePolygon{{{{}, {}, {}}, {{}, {}, {}}}}), 6U);
}

}  // namespace
}  // namespace lapwing::map
