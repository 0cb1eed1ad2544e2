#include "vision/cars/car_network.hpp"

#include <gtest/gtest.h>

namespace lapwing::vision {
namespace {

// What the network finds is tried on whole pictures: tests/system/words/cars_are_found_from_above.py.

TEST(CarNetwork, WhatIsNoNetworkIsRefusedWithWhatToDo) {
  for (std::string const& bytes : {std::string(), std::string("no network"), std::string(5000, '\x08')}) {
    auto const network = CarNetwork::load(bytes);
    ASSERT_FALSE(network.has_value());
    EXPECT_NE(network.error().message.find("cannot be loaded"), std::string::npos);
    EXPECT_FALSE(network.error().hint.empty());
  }
}

}  // namespace
}  // namespace lapwing::vision
