#include "autonomy/interface/command.hpp"

#include <array>

namespace lapwing::autonomy {

std::string_view command_name(std::size_t index) {
  static constexpr std::array<std::string_view, command_count> names{
      "Kill",           "Configure", "Arm", "Disarm", "Takeoff", "Land", "Autonomous Explore", "Autonomous Move",
      "Compulsive Move"};
  return names[index];
}

}  // namespace lapwing::autonomy
