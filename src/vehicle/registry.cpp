#include "vehicle/registry.hpp"

namespace lapwing::vehicle {

/// Shorter first makes decimal ids numeric: "9" before "10"; equal lengths compare as text.
bool Registry::NumericOrder::operator()(VehicleId const& a, VehicleId const& b) const {
  if (a.text.size() != b.text.size()) return a.text.size() < b.text.size();
  return a.text < b.text;
}

VehicleState& Registry::edit(VehicleId const& id) {
  auto& entry = entries_[id];
  entry.state.id = id;
  return entry.state;
}

VehicleState const* Registry::find(VehicleId const& id) const {
  auto const found = entries_.find(id);
  return found == entries_.end() ? nullptr : &found->second.state;
}

std::vector<VehicleState const*> Registry::all() const {
  std::vector<VehicleState const*> states;
  states.reserve(entries_.size());
  for (auto const& [id, entry] : entries_) states.push_back(&entry.state);
  return states;
}

void Registry::touch(VehicleId const& id) {
  ++entries_[id].revision;
}

void Registry::touch_membership(VehicleId const& id) {
  touch(id);
  changed_.notify_all();
}

unsigned long long Registry::revision(VehicleId const& id) const {
  auto const found = entries_.find(id);
  return found == entries_.end() ? 0 : found->second.revision;
}

}  // namespace lapwing::vehicle
