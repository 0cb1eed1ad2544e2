#pragma once

#include <cstdint>
#include <vector>

#include "video/scene/projector.hpp"
#include "video/world/car_park.hpp"

namespace lapwing::video {

/// The crown of a tree, as leaves at heights: drawn once, by chance.
struct Crown {
  struct Leaves {
    Eigen::Vector3d at;
    double radius_m = 0.3;
    cv::Scalar colour;
  };
  Tree tree;
  std::vector<Leaves> leaves;  ///< the lowest first
};

[[nodiscard]] Crown crown_of(Tree const& tree, Sun const& sun, std::uint64_t seed, std::uint64_t number);
void draw_tree(Projector const& projector, Crown const& crown, Sun const& sun);
void draw_block(Projector const& projector, Block const& block, Sun const& sun);

}  // namespace lapwing::video
