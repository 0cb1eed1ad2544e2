#include "apps/onboard/bus_config.hpp"

namespace lapwing::apps {

void read_bus(base::ConfigReader& root, bus::BusOptions& bus) {
  auto table = root.table("bus");
  if (!table) return;
  if (auto const domain = table->integer("domain", 0, 101)) bus.domain = static_cast<std::uint32_t>(domain->value);
  if (auto const network = table->flag("network")) bus.is_local = !network->value;
  table->refuse_unknown();
}

}  // namespace lapwing::apps
