// Logs of scans, relations and pose graphs as text: read or refused, and what was read is whole.
#include <cstdint>
#include <string_view>

#include "require.hpp"
#include "slam/graph/g2o.hpp"
#include "slam/readers/any_log.hpp"
#include "slam/relations.hpp"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace lapwing;
  std::string_view const text(reinterpret_cast<char const*>(data), size);
  if (auto const log = slam::read_log(text)) {
    for (auto const& scan : log->scans)
      fuzz::require(scan.ranges_m.size() == log->sensors.at(static_cast<std::size_t>(scan.sensor)).bearings_rad.size());
  }
  (void)slam::read_relations(text);
  if (auto const graph = slam::read_g2o(text)) {
    auto const again = slam::read_g2o(slam::write_g2o(graph->poses, graph->constraints));
    fuzz::require(again && again->poses == graph->poses && again->constraints.size() == graph->constraints.size());
  }
  return 0;
}
