#include "vision/image/flight.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

namespace lapwing::vision {
namespace {

std::string number(std::uint32_t value, int bytes) {
  std::string text;
  for (int k = 0; k < bytes; ++k) text += static_cast<char>((value >> (8U * k)) & 0xFFU);
  return text;
}

std::string entry(std::uint32_t tag, std::uint32_t kind, std::uint32_t count, std::uint32_t value) {
  return number(tag, 2) + number(kind, 2) + number(count, 4) + number(value, 4);
}

std::string segment(std::string const& body) {
  auto const length = static_cast<std::uint32_t>(body.size() + 2);
  return std::string("\xFF\xE1") + static_cast<char>(length >> 8U) + static_cast<char>(length & 0xFFU) + body;
}

/// 41 degrees 30 minutes north, 81 degrees 36 minutes west, 300 m, 24 mm.
std::string exif() {
  std::uint32_t const gps = 8 + 2 + 2 * 12 + 4;
  std::uint32_t const camera = gps + 2 + 5 * 12 + 4;
  std::uint32_t const fractions = camera + 2 + 12 + 4;
  std::string tiff = std::string("II*\0", 4) + number(8, 4);
  tiff += number(2, 2) + entry(0x8825, 4, 1, gps) + entry(0x8769, 4, 1, camera) + number(0, 4);
  tiff += number(5, 2) + entry(1, 2, 2, 'N') + entry(2, 5, 3, fractions) + entry(3, 2, 2, 'W') +
          entry(4, 5, 3, fractions + 24) + entry(6, 5, 1, fractions + 48) + number(0, 4);
  tiff += number(1, 2) + entry(0xA405, 3, 1, 24) + number(0, 4);
  for (std::uint32_t const value : {41U, 30U, 0U, 81U, 36U, 0U, 300U}) tiff += number(value, 4) + number(1, 4);
  return segment(std::string("Exif\0\0", 6) + tiff);
}

std::string xmp(std::string const& said) {
  return segment(std::string("http://ns.adobe.com/xap/1.0/\0", 29) + "<rdf:Description " + said + "/>");
}

FlightRecord read(std::string const& segments) {
  auto const file = "\xFF\xD8" + segments;
  return read_flight(std::as_bytes(std::span(file)));
}

TEST(Flight, PlaceAndLensComeByExifHeightAndDirectionByXmp) {
  auto const flight = read(exif() + xmp("drone-dji:RelativeAltitude=\"+40.10\" drone-dji:FlightYawDegree=\"+10.0\" "
                                        "drone-dji:GimbalYawDegree=\"-90.0\" drone-dji:GimbalPitchDegree=\"-89.90\""));
  ASSERT_TRUE(flight.place && flight.height_m && flight.yaw_rad && flight.pitch_rad && flight.focal_35mm);
  EXPECT_NEAR(flight.place->lat_deg(), 41.5, 1e-9);
  EXPECT_NEAR(flight.place->lon_deg(), -81.6, 1e-9);
  EXPECT_DOUBLE_EQ(flight.place->alt_m, 300.0);
  EXPECT_DOUBLE_EQ(*flight.height_m, 40.1);
  EXPECT_NEAR(*flight.yaw_rad, -std::numbers::pi / 2.0, 1e-9);
  EXPECT_DOUBLE_EQ(*flight.focal_35mm, 24.0);
  auto const metres = metres_a_pixel(flight, {4000, 3000});
  ASSERT_TRUE(metres);
  EXPECT_NEAR(*metres, 40.1 * 43.27 / 24.0 / 5000.0, 1e-5);
}

TEST(Flight, ElementsAreReadAsAttributesAre) {
  auto const flight = read(xmp("><drone-dji:RelativeAltitude>25.5</drone-dji:RelativeAltitude><x"));
  ASSERT_TRUE(flight.height_m);
  EXPECT_DOUBLE_EQ(*flight.height_m, 25.5);
}

TEST(Flight, APixelLiesWhereTheCameraLooks) {
  FlightRecord flight{
      .place = geo::Wgs84::from_degrees(50.0, 8.0), .height_m = 40.0, .yaw_rad = std::numbers::pi / 2.0};
  // The camera's upper edge is east: what is above the middle lies east of it, what is to the right lies south.
  auto const above = place_of({500.0, 300.0}, {1000, 800}, flight, 0.1);
  ASSERT_TRUE(above);
  EXPECT_NEAR(geo::surface_distance_m(*flight.place, *above), 10.0, 0.01);
  EXPECT_NEAR(geo::bearing_rad(*flight.place, *above), std::numbers::pi / 2.0, 0.01);
  auto const right = place_of({600.0, 400.0}, {1000, 800}, flight, 0.1);
  ASSERT_TRUE(right);
  EXPECT_NEAR(std::abs(geo::wrap_pi(geo::bearing_rad(*flight.place, *right))), std::numbers::pi, 0.01);
  flight.pitch_rad = -std::numbers::pi / 4.0;
  EXPECT_FALSE(place_of({500.0, 300.0}, {1000, 800}, flight, 0.1)) << "aslant it would be wrong by metres";
}

TEST(Flight, WhatMakesNoSenseIsNotThere) {
  for (auto const& file : {std::string(), std::string("\x89PNG"), exif().substr(0, 90), exif().substr(0, 60),
                           xmp("drone-dji:RelativeAltitude=\"soon\""), xmp("RelativeAltitude=\"7\""),
                           xmp("drone-dji:RelativeAltitude=\"-3\"")}) {
    auto const flight = read(file);
    EXPECT_FALSE(flight.place || flight.height_m || flight.yaw_rad);
    EXPECT_FALSE(metres_a_pixel(flight, {4000, 3000}));
  }
}

}  // namespace
}  // namespace lapwing::vision
