#include "geo/area.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace lapwing::geo {
namespace {

Wgs84 at(double lat_deg, double lon_deg) {
  return Wgs84::from_degrees(lat_deg, lon_deg);
}

TEST(Area, IsSoundRoundAPlaceAndWithinCorners) {
  EXPECT_EQ(area_fault(Disc{at(41, -8), 50.0}), std::nullopt);
  EXPECT_EQ(area_fault(Outline{{at(41, -8), at(41.01, -8), at(41.01, -7.99), at(41, -7.99)}}), std::nullopt);
}

TEST(Area, SaysWhatIsWrongWithIt) {
  EXPECT_EQ(area_fault(Disc{at(41, -8), 0.0}), "its radius is not above 0 m");
  EXPECT_EQ(area_fault(Disc{at(41, std::numeric_limits<double>::quiet_NaN()), 5.0}), "its centre is no place");
  EXPECT_EQ(area_fault(Outline{{at(41, -8), at(41.01, -8)}}), "it takes 3 corners, not 2");
  EXPECT_EQ(area_fault(Outline{{at(41, -8), at(41.01, -8), at(141, -8)}}), "one of its corners is no place");
}

TEST(Area, IsNoneWithEdgesThatCross) {
  EXPECT_EQ(area_fault(Outline{{at(41, -8), at(41.01, -7.99), at(41.01, -8), at(41, -7.99)}}),
            "its edges cross or touch each other");
}

TEST(Area, DoesNotLookAtTheAltitudesOfItsCorners) {
  auto outline = Outline{{at(41, -8), at(41.01, -8), at(41.01, -7.99)}};
  outline.corners[1].alt_m = 5000.0;
  EXPECT_EQ(area_fault(outline), std::nullopt);
}

}  // namespace
}  // namespace lapwing::geo
