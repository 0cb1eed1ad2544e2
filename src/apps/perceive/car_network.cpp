#include "apps/perceive/car_network.hpp"

#include <fstream>
#include <iterator>

#include "host/files/files.hpp"

namespace lapwing::apps {

std::string car_network(base::Logger const& log) {
  auto const name = host::home_directory() / "models/cars.onnx";
  std::ifstream file(name, std::ios::binary);
  if (!file) log.warn(name.string() + " is not there: cars are looked for by their contrast alone");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace lapwing::apps
