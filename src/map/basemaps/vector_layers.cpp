#include "map/basemaps/vector_layers.hpp"

#include <nlohmann/json.hpp>

namespace lapwing::map {

std::vector<std::string> vector_layers_of(std::string_view json) {
  // An archive is somebody else's: it gets so much room and no more.
  constexpr std::size_t most_layers = 200;
  constexpr std::size_t most_name_bytes = 100;
  std::vector<std::string> names;
  auto const object = nlohmann::json::parse(json, nullptr, false);
  auto const layers = object.is_object() ? object.find("vector_layers") : object.end();
  if (!object.is_object() || layers == object.end() || !layers->is_array()) return names;
  for (auto const& layer : *layers) {
    auto const id = layer.is_object() ? layer.find("id") : layer.end();
    if (!layer.is_object() || id == layer.end() || !id->is_string()) continue;
    auto name = id->get<std::string>();
    if (!name.empty() && name.size() <= most_name_bytes && names.size() < most_layers) names.push_back(std::move(name));
  }
  return names;
}

}  // namespace lapwing::map
