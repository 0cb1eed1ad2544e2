// Parameter files and cached parameters: any bytes are refused with a reason, or say the same after they were written
// again.
#include <cstdint>
#include <string_view>

#include "parameters/cache.hpp"
#include "parameters/comparison.hpp"
#include "parameters/parameter_file.hpp"
#include "require.hpp"

namespace {

using namespace lapwing::parameters;
using lapwing::fuzz::require;

void check_same(std::vector<Parameter> const& all, std::string const& rewritten) {
  auto const again = read_parameter_file("again", rewritten);
  require(again.has_value());
  require(again->parameters.size() == all.size());
  require(differences(all, again->parameters).empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string_view const text(reinterpret_cast<char const*>(data), size);
  auto const file = read_parameter_file("fuzz.params", text);
  if (!file) {
    require(!file.error().message.empty());
    return 0;
  }
  require(!file->parameters.empty() || file->of_other_components > 0);
  check_same(file->parameters, qgroundcontrol_text(file->parameters, {}));
  check_same(file->parameters, mission_planner_text(file->parameters));
  for (auto const& parameter : file->parameters) (void)belongs_to_one_vehicle(parameter.name);
  if (auto const cached = parse_cached(text)) {
    auto const again = parse_cached(to_text(*cached));
    require(again && again->taken == cached->taken && again->hash == cached->hash);
  }
  return 0;
}
