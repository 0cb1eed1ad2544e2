#include "explore/lot/slots/picture_block.hpp"

#include <functional>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "explore/testing/lot_pictures.hpp"

namespace lapwing::explore {
namespace {

using testing::lot_map;
using testing::sight_at;
using testing::slot_at;

/// Errors of a camera's pose that are drawn anew for each picture.
class LoosePoses {
 public:
  explicit LoosePoses(unsigned seed) : random_(seed) {}

  /// What a camera with such a pose would tell of slots that it sees.
  LotSight look(double x, double y, double seconds, std::vector<Corners> const& slots) {
    auto sight = sight_at(x, y, seconds);
    sight.doubt = {.position_m = 0.5, .angle_rad = 0.0, .heading_rad = 0.03, .height_m = 0.4};
    PictureShift const off{.v = {draw(0.5), draw(0.5), draw(0.03), draw(0.02)}};
    for (auto const& slot : slots) {
      auto const middle = middle_of(slot);
      if (std::abs(middle.x() - x) > 11.0 || std::abs(middle.y() - y) > 10.0) continue;
      Corners told;
      for (std::size_t i = 0; i < 4; ++i) {
        auto const at = off.of(slot[i], {x, y});
        told[i] = {at.x() + draw(0.05), at.y() + draw(0.05)};
      }
      // Cars stand as they like, so that a row looks elsewhere otherwise.
      bool const is_taken = std::hash<double>{}(middle.x() + 100.0 * middle.y()) % 2 == 0;
      sight.slots.push_back({.outline = told, .surety = 0.95, .taken_chance = is_taken ? 0.9 : 0.1});
    }
    return sight;
  }

 private:
  double draw(double sigma) { return std::normal_distribution<double>(0.0, sigma)(random_); }
  std::mt19937 random_;
};

std::vector<Corners> two_rows() {
  std::vector<Corners> slots;
  for (int i = 0; i < 20; ++i)
    for (double const y : {12.0, 26.0}) slots.push_back(slot_at(6.0 + 2.5 * i, y));
  return slots;
}

/// Of each true slot, by how much the one on the map is off.
std::vector<Eigen::Vector2d> offsets(LotMap const& lot, std::vector<Corners> const& truth) {
  std::vector<Eigen::Vector2d> off;
  for (auto const& slot : truth) {
    for (auto const& known : lot.slots().slots()) {
      Eigen::Vector2d const apart = middle_of(known.outline).v - middle_of(slot).v;
      if (apart.norm() < 1.0) off.push_back(apart);
    }
  }
  return off;
}

TEST(PictureShift, IsWhatASlightlyOtherPoseDoesToThePicture) {
  auto sight = sight_at(28.0, 20.0, 0.0);
  geo::Pixel const pixel{300.0, 500.0};
  auto const told = geo::ground_at(sight.view, pixel);
  ASSERT_TRUE(told);
  PictureShift const shift{.v = {0.4, -0.3, 0.02, -0.03}};
  auto const by_pose = geo::ground_at(shifted(sight, shift).view, pixel);
  ASSERT_TRUE(by_pose);
  EXPECT_LT(geo::distance_m(*by_pose, shift.of(*told, below_camera(sight))), 0.02) << "up to products of small numbers";
}

TEST(PictureShift, IsFoundFromPlacesThatAreKnown) {
  auto sight = sight_at(28.0, 20.0, 0.0);
  sight.doubt = {.position_m = 1.0, .angle_rad = 0.0, .heading_rad = 0.1, .height_m = 2.0};
  PictureShift const off{.v = {0.7, -0.5, 0.06, 0.04}};
  std::vector<Tie> ties;
  for (double const x : {20.0, 25.0, 31.0, 36.0})
    for (double const y : {15.0, 24.0})
      ties.push_back({.in_picture = {x, y}, .on_map = off.of({x, y}, {28.0, 20.0}), .sigma_m = 0.02});
  ties.push_back({.in_picture = {24.0, 18.0}, .on_map = {25.2, 18.0}, .sigma_m = 0.02});  // taken for its neighbour
  auto const fit = fitted_shift(sight, ties);
  EXPECT_LT((fit.shift.v - off.v).head<2>().norm(), 0.05);
  EXPECT_NEAR(fit.shift.v[2], 0.06, 0.01);
  EXPECT_NEAR(fit.shift.v[3], 0.04, 0.01);
  EXPECT_LT(fit.sigma[0], 0.05) << "and it is sure of it";
  auto const without = fitted_shift(sight, {});
  EXPECT_EQ(without.shift.v, Eigen::Vector4d::Zero().eval());
  EXPECT_NEAR(without.sigma[0], 1.0, 1e-9) << "as sure as the pose is";
}

TEST(PictureBlock, PicturesWithLoosePosesMakeOneMapThatIsTrueToScale) {
  auto const truth = two_rows();
  LoosePoses camera(3);
  auto lot = lot_map();
  double seconds = 0.0;
  for (double const y : {10.0, 19.0, 28.0})
    for (double x = 6.0; x < 56.0; x += 3.0) lot.add(camera.look(x, y, seconds += 5.0, truth));
  auto const off = offsets(lot, truth);
  ASSERT_EQ(off.size(), truth.size());
  ASSERT_EQ(lot.slots().slots().size(), truth.size());
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (auto const& one : off) mean += one / static_cast<double>(off.size());
  EXPECT_LT(mean.norm(), 0.3) << "51 poses, each half a metre off";
  for (auto const& one : off) EXPECT_LT((one - mean).norm(), 0.35);
}

TEST(PictureBlock, SettlesWhereDenseLeastSquaresDoes) {
  auto const truth = two_rows();
  LoosePoses camera(7);
  PictureBlock block;
  std::vector<KnownSlot> slots;
  for (auto const& slot : truth)
    slots.push_back({.id = "slot", .outline = slot, .finds = {}, .fixed = slot, .fixed_weight = 0.0});
  slots[0].fixed_weight = 4.0;
  constexpr double weight = 25.0;
  constexpr double tie_sigma_m = 2.0;
  std::vector<LotSight> sights;
  for (std::size_t k = 0; k < 5; ++k) {
    double const x = 8.0 + 6.0 * static_cast<double>(k);
    sights.push_back(camera.look(x, 19.0, 5.0 * static_cast<double>(k), truth));
    if (k > 0)
      for (double const y : {15.0, 22.0})
        sights[k].tie_points.push_back({sights[k - 1].at, {x - 3.0, y}, {x - 2.6, y - 0.3}, tie_sigma_m});
    auto const number = block.next_number();
    block.add({.sight = sights[k], .expected = expected_shift(sights[k])});
    for (auto const& seen : sights[k].slots)
      for (auto& slot : slots)
        if (geo::distance_m(middle_of(slot.outline), middle_of(seen.outline)) < 1.25)
          slot.finds.push_back({.picture = number, .in_picture = seen.outline, .weight = weight / 25.0});
  }
  // Unknowns: four of each picture, two of each slot; every find, every tie point and every expectation is a row.
  auto const pictures = static_cast<Eigen::Index>(4 * sights.size());
  auto const unknowns = pictures + static_cast<Eigen::Index>(2 * slots.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
  double const kept = std::exp(-5.0 / base::to_seconds(PictureBlock::errors_last));
  for (std::size_t k = 0; k < sights.size(); ++k) {
    auto const at = static_cast<Eigen::Index>(4 * k);
    Eigen::MatrixXd row = Eigen::MatrixXd::Zero(4, unknowns);
    row.middleCols<4>(at).setIdentity();
    if (k > 0) row.middleCols<4>(at - 4) = -kept * Eigen::Matrix4d::Identity();
    Eigen::Vector4d const rest = (k > 0 ? 1.0 - kept * kept : 1.0) * expected_shift(sights[k]).cwiseAbs2();
    normal += row.transpose() * rest.cwiseInverse().asDiagonal() * row;
  }
  for (std::size_t k = 1; k < sights.size(); ++k) {
    for (auto const& tie : sights[k].tie_points) {
      auto const at = static_cast<Eigen::Index>(4 * k);
      Eigen::MatrixXd row = Eigen::MatrixXd::Zero(2, unknowns);
      row.middleCols<4>(at) = shift_of_place(tie.here.v - below_camera(sights[k]).v);
      row.middleCols<4>(at - 4) = -shift_of_place(tie.there.v - below_camera(sights[k - 1]).v);
      normal += row.transpose() * row / (tie_sigma_m * tie_sigma_m);
      right -= row.transpose() * (tie.here.v - tie.there.v) / (tie_sigma_m * tie_sigma_m);
    }
  }
  for (std::size_t j = 0; j < slots.size(); ++j) {
    auto const at = pictures + static_cast<Eigen::Index>(2 * j);
    normal.diagonal().segment<2>(at).array() += slots[j].fixed_weight + 1e-9;
    right.segment<2>(at) += slots[j].fixed_weight * middle_of(slots[j].fixed).v;
    for (auto const& find : slots[j].finds) {
      auto const picture = static_cast<Eigen::Index>(4 * find.picture);
      auto const middle = middle_of(find.in_picture);
      Eigen::MatrixXd row = Eigen::MatrixXd::Zero(2, unknowns);
      row.middleCols<4>(picture) = shift_of_place(middle.v - below_camera(sights[find.picture]).v);
      row.middleCols<2>(at) = -Eigen::Matrix2d::Identity();
      normal += find.weight * row.transpose() * row;
      right -= find.weight * row.transpose() * middle.v;
    }
  }
  Eigen::VectorXd const best = normal.ldlt().solve(right);
  block.settle(slots);
  for (std::size_t j = 0; j < slots.size(); ++j) {
    if (slots[j].finds.empty()) continue;
    Eigen::Vector2d const dense = best.segment<2>(pictures + static_cast<Eigen::Index>(2 * j));
    EXPECT_LT((middle_of(slots[j].outline).v - dense).norm(), 1e-5) << j;
  }
}

/// Along one row, round its end, and back along the other one, which no picture shows together with it; the drone errs
/// another way on the way back. Each picture shows four places of the one before it.
std::vector<LotSight> there_and_back(std::vector<Corners> const& truth, bool has_ties) {
  std::vector<map::SitePoint> way;
  for (double x = 6.0; x < 58.0; x += 3.0) way.emplace_back(x, 4.0);
  for (double y = 7.0; y < 34.0; y += 3.0) way.emplace_back(58.0, y);
  for (double x = 58.0; x > 5.0; x -= 3.0) way.emplace_back(x, 34.0);
  std::vector<LotSight> sights;
  PictureShift before;
  for (std::size_t k = 0; k < way.size(); ++k) {
    bool const is_back = 2 * k > way.size();
    PictureShift const off{.v = {is_back ? -0.5 : 0.5, is_back ? 0.4 : -0.4, 0.0, 0.0}};
    auto sight = sight_at(way[k].x(), way[k].y(), 0.6 * static_cast<double>(k));
    sight.doubt = {.position_m = 0.5, .angle_rad = 0.0, .heading_rad = 0.03, .height_m = 0.4};
    for (auto slot : truth) {
      auto const middle = middle_of(slot);
      if (std::abs(middle.x() - way[k].x()) > 9.0 || std::abs(middle.y() - way[k].y()) > 9.0) continue;
      for (auto& corner : slot) corner = off.of(corner, way[k]);
      sight.slots.push_back({.outline = slot, .surety = 0.95});
    }
    if (has_ties && k > 0) {
      for (double const east : {-5.0, 5.0}) {
        for (double const north : {-4.0, 4.0}) {
          map::SitePoint const place(way[k].x() + east, way[k].y() + north);
          sight.tie_points.push_back({sights.back().at, off.of(place, way[k]), before.of(place, way[k - 1]), 0.005});
        }
      }
    }
    sight.ties_later = has_ties;
    sights.push_back(std::move(sight));
    before = off;
  }
  return sights;
}

/// How far the two rows lie elsewhere to each other than they do.
double torn_m(std::vector<LotSight> const& sights, std::vector<Corners> const& truth) {
  auto lot = lot_map();
  for (auto const& sight : sights) lot.add(sight);
  Eigen::Vector2d apart = Eigen::Vector2d::Zero();
  for (auto const& slot : truth)
    for (auto const& known : lot.slots().slots())
      if (Eigen::Vector2d const off = middle_of(known.outline).v - middle_of(slot).v; off.norm() < 1.2)
        apart += (middle_of(slot).y() < 20.0 ? 1.0 : -1.0) * off / (0.5 * static_cast<double>(truth.size()));
  return apart.norm();
}

TEST(PictureBlock, TiePointsHoldRowsTogetherThatNoPictureShowsTogether) {
  auto const truth = two_rows();
  auto const by_poses_alone_m = torn_m(there_and_back(truth, false), truth);
  EXPECT_GT(by_poses_alone_m, 0.5);
  EXPECT_LT(torn_m(there_and_back(truth, true), truth), 0.2 * by_poses_alone_m);
}

TEST(PictureBlock, ATiePointHoldsWhenItsEarlierPictureDoesNotMoveAnyMore) {
  auto const truth = slot_at(20.0, 20.0);
  PictureShift const off{.v = {0.5, -0.4, 0.0, 0.0}};
  auto const told = [&](LotSight const& sight) {
    auto slot = truth;
    for (auto& corner : slot) corner = off.of(corner, below_camera(sight));
    return slot;
  };
  PictureBlock block;
  std::vector<KnownSlot> slots(2);
  slots[0] = {.id = "of the map", .outline = truth, .finds = {}, .fixed = truth, .fixed_weight = 1e4};
  slots[1] = {.id = "new", .outline = truth, .finds = {}};

  // The map has the slot of the first picture, which lies right by that; the second one has its slot for itself.
  auto const first = sight_at(20.0, 20.0, 0.0);
  auto second = sight_at(20.0, 20.0, 0.6);
  for (double const x : {14.0, 26.0})
    for (double const y : {15.0, 25.0}) second.tie_points.push_back({first.at, {x, y}, {x, y}, 0.01});
  slots[0].finds.push_back({.picture = block.next_number(), .in_picture = told(first), .weight = 1e4});
  block.add({.sight = first, .expected = expected_shift(first)});
  slots[1].finds.push_back({.picture = block.next_number(), .in_picture = told(second), .weight = 25.0});
  block.add({.sight = second, .expected = expected_shift(second)});
  auto const is_right = [&] { return geo::distance_m(middle_of(slots[1].outline), middle_of(truth)) < 0.05; };
  block.settle(slots);
  EXPECT_TRUE(is_right());
  // Until the first one is the oldest of too many.
  for (std::size_t k = 1; k < PictureBlock::most_pictures; ++k) {
    auto other = sight_at(50.0, 20.0, 0.6 * static_cast<double>(k));
    other.vehicle = "drone 2";
    block.add({.sight = other, .expected = expected_shift(other)});
  }
  block.settle(slots);
  EXPECT_TRUE(slots[0].finds.empty()) << "it does not move any more";
  EXPECT_FALSE(slots[1].finds.empty());
  EXPECT_TRUE(is_right());
}

TEST(PictureBlock, SlotsOfTheMapHoldThePicturesInPlace) {
  auto const truth = two_rows();
  LoosePoses camera(11);
  auto lot = lot_map();
  for (std::size_t i = 0; i < truth.size(); i += 4) lot.know("known-" + std::to_string(i), truth[i]);
  for (double x = 6.0; x < 56.0; x += 3.0) lot.add(camera.look(x, 19.0, 5.0 * x, truth));
  for (auto const& one : offsets(lot, truth)) EXPECT_LT(one.norm(), 0.25);
}

TEST(PictureBlock, OnlyTheNewestPicturesMayMove) {
  auto const truth = two_rows();
  LoosePoses camera(5);
  auto lot = lot_map();
  for (std::size_t i = 0; i < PictureBlock::most_pictures + 100; ++i)
    lot.add(camera.look(6.0 + static_cast<double>(i % 17) * 3.0, 15.0 + 8.0 * static_cast<double>(i % 2),
                        30.0 * static_cast<double>(i), truth));
  std::size_t finds = 0;
  for (auto const& slot : lot.slots().slots()) {
    finds += slot.finds.size();
    EXPECT_GT(slot.fixed_weight, 0.0);
  }
  EXPECT_LE(finds, PictureBlock::most_pictures * truth.size());
  EXPECT_EQ(lot.slots().slots().size(), truth.size());
  for (auto const& one : offsets(lot, truth)) EXPECT_LT(one.norm(), 0.3);
}

TEST(PictureBlock, ASlotThatMovesWithItsPicturesIsToldAnew) {
  auto lot = lot_map();
  auto const row = std::vector<Corners>{slot_at(22.0, 20.0), slot_at(24.5, 20.0), slot_at(27.0, 20.0)};
  auto const look_off_by = [&](double off_m, double seconds) {
    auto sight = sight_at(24.5, 20.0, seconds);
    for (auto slot : row) {
      for (auto& corner : slot) corner.v.x() += off_m;
      sight.slots.push_back({.outline = slot, .surety = 0.95});
    }
    return sight;
  };
  lot.add(look_off_by(0.6, 0.0));
  EXPECT_EQ(lot.take_news({.site = "lot", .writer = "drone 1"}).slots.size(), 3U);
  lot.add(look_off_by(0.0, 100.0));
  EXPECT_EQ(lot.take_news({.site = "lot", .writer = "drone 1"}).slots.size(), 3U) << "half way between the two";
  EXPECT_NEAR(middle_of(lot.slots().slots()[0].outline).x(), 22.3, 0.1);
}

}  // namespace
}  // namespace lapwing::explore
