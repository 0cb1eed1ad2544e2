#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bus/messages/description.hpp"

/// std_msgs: numbers in a row.
namespace lapwing::bus {

struct MultiArrayDimension {
  std::string label = {};
  std::uint32_t size = 0;
  std::uint32_t stride = 0;
  friend bool operator==(MultiArrayDimension const&, MultiArrayDimension const&) = default;
};
template <>
struct Description<MultiArrayDimension> {
  static constexpr std::string_view name = "std_msgs/msg/MultiArrayDimension";
  static constexpr auto fields =
      std::tuple{Field{"label", &MultiArrayDimension::label}, Field{"size", &MultiArrayDimension::size},
                 Field{"stride", &MultiArrayDimension::stride}};
};

struct MultiArrayLayout {
  std::vector<MultiArrayDimension> dim = {};
  std::uint32_t data_offset = 0;
  friend bool operator==(MultiArrayLayout const&, MultiArrayLayout const&) = default;
};
template <>
struct Description<MultiArrayLayout> {
  static constexpr std::string_view name = "std_msgs/msg/MultiArrayLayout";
  static constexpr auto fields =
      std::tuple{Field{"dim", &MultiArrayLayout::dim}, Field{"data_offset", &MultiArrayLayout::data_offset}};
};

struct Float64MultiArray {
  MultiArrayLayout layout = {};
  std::vector<double> data = {};
  friend bool operator==(Float64MultiArray const&, Float64MultiArray const&) = default;
};
template <>
struct Description<Float64MultiArray> {
  static constexpr std::string_view name = "std_msgs/msg/Float64MultiArray";
  static constexpr auto fields =
      std::tuple{Field{"layout", &Float64MultiArray::layout}, Field{"data", &Float64MultiArray::data}};
};

}  // namespace lapwing::bus
