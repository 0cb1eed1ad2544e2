#include "geo/transform.hpp"

#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace lapwing::geo {
namespace {

struct Map {};
struct Body {};
struct Lidar {};

constexpr double pi = std::numbers::pi;

template <class A, class B>
concept CanMultiply = requires(A a, B b) { a* b; };

template <class Frame>
Point<Frame> random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> metres(-100.0, 100.0);
  double const x = metres(random);
  return {x, metres(random)};
}

template <class To, class From>
Transform<To, From> random_transform(std::mt19937& random) {
  std::uniform_real_distribution<double> angle(-pi, pi);
  return {random_point<To>(random), angle(random)};
}

TEST(Transform, TurnsFirstAndMovesThen) {
  Transform<Map, Body> const map_from_body(Point<Map>(10.0, 5.0), pi / 2.0);
  auto const ahead = map_from_body * Point<Body>(1.0, 0.0);
  EXPECT_NEAR(ahead.x(), 10.0, 1e-12);
  EXPECT_NEAR(ahead.y(), 6.0, 1e-12);
  auto const forwards = map_from_body * Vector<Body>(1.0, 0.0);
  EXPECT_NEAR(forwards.x(), 0.0, 1e-12);
  EXPECT_NEAR(forwards.y(), 1.0, 1e-12);
  EXPECT_NEAR(map_from_body.yaw_rad(), pi / 2.0, 1e-12);
  EXPECT_EQ(map_from_body.origin(), (Point<Map>(10.0, 5.0)));
}

TEST(Transform, OfNeighboursCancelTheFrameBetween) {
  std::mt19937 random(7);
  for (int i = 0; i < 1000; ++i) {
    auto const map_from_body = random_transform<Map, Body>(random);
    auto const body_from_lidar = random_transform<Body, Lidar>(random);
    auto const hit = random_point<Lidar>(random);
    auto const at_once = (map_from_body * body_from_lidar) * hit;
    auto const one_by_one = map_from_body * (body_from_lidar * hit);
    EXPECT_LT(distance_m(at_once, one_by_one), 1e-10);
    EXPECT_LT(distance_m(map_from_body.inverse() * at_once, body_from_lidar * hit), 1e-10);
    EXPECT_NEAR(
        wrap_pi((map_from_body * body_from_lidar).yaw_rad() - map_from_body.yaw_rad() - body_from_lidar.yaw_rad()), 0.0,
        1e-12);
  }
}

TEST(Transform, InTheWrongOrderDoesNotCompile) {
  EXPECT_TRUE((CanMultiply<Transform<Map, Body>, Transform<Body, Lidar>>));
  EXPECT_FALSE((CanMultiply<Transform<Body, Lidar>, Transform<Map, Body>>));
  EXPECT_FALSE((CanMultiply<Transform<Map, Body>, Point<Map>>));
  EXPECT_FALSE((CanMultiply<Transform<Map, Body>, Point3<Body>>));
}

TEST(Transform, InThreeDimensionsTurnsAboutAnyAxis) {
  Eigen::Quaterniond const nose_down(Eigen::AngleAxisd(pi / 2.0, Eigen::Vector3d::UnitY()));
  Transform3<Map, Body> const map_from_body(Point3<Map>(0.0, 0.0, 10.0), nose_down);
  auto const below = map_from_body * Point3<Body>(3.0, 0.0, 0.0);
  EXPECT_NEAR(below.z(), 7.0, 1e-12);
  EXPECT_LT(distance_m(map_from_body.inverse() * below, Point3<Body>(3.0, 0.0, 0.0)), 1e-12);
  EXPECT_NEAR(map_from_body.rotation().angularDistance(nose_down), 0.0, 1e-12);
}

TEST(Pose, IsThePlaceOfItsBodysFrame) {
  std::mt19937 random(8);
  for (int i = 0; i < 1000; ++i) {
    auto const map_from_body = random_transform<Map, Body>(random);
    auto const pose = pose_of(map_from_body);
    auto const hit = random_point<Body>(random);
    EXPECT_LT(distance_m(pose.frame<Body>() * hit, map_from_body * hit), 1e-10);
    Pose<Body> const at_rest;
    EXPECT_LT(distance_m((map_from_body * at_rest).position, pose.position), 1e-12);
    EXPECT_NEAR(wrap_pi((map_from_body * at_rest).yaw_rad - pose.yaw_rad), 0.0, 1e-12);
  }
}

TEST(Pose, BetweenTwoTurnsTheShorterWay) {
  Pose<Map> const a{{0.0, 0.0}, 3.0};
  Pose<Map> const b{{2.0, 4.0}, -3.0};
  auto const half = between(a, b, 0.5);
  EXPECT_EQ(half.position, (Point<Map>(1.0, 2.0)));
  EXPECT_NEAR(std::abs(half.yaw_rad), pi, 1e-12);
  EXPECT_EQ(between(a, b, 0.0), a);
}

}  // namespace
}  // namespace lapwing::geo
