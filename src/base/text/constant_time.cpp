#include "base/text/constant_time.hpp"

#include <cstddef>

namespace lapwing::base {

bool equal_in_constant_time(std::string_view given, std::string_view secret) {
  bool const same_length = given.size() == secret.size();
  auto const against = same_length ? secret : given;
  unsigned char difference = same_length ? 0 : 1;
  for (std::size_t i = 0; i < given.size(); ++i) difference |= static_cast<unsigned char>(given[i] ^ against[i]);
  return difference == 0;
}

}  // namespace lapwing::base
