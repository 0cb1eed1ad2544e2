#include "base/text/random_name.hpp"

#include <cstddef>
#include <random>

#include <fmt/format.h>

namespace lapwing::base {

std::string random_name(int digits) {
  std::random_device device;
  auto const wanted = static_cast<std::size_t>(digits);
  std::string name;
  while (name.size() < wanted) name += fmt::format("{:08x}", device());
  name.resize(wanted);
  return name;
}

}  // namespace lapwing::base
