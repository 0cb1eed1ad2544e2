#include "fleet/network/fleet.hpp"

#include <utility>

namespace lapwing::fleet {

Fleet::Fleet(mavlink::Connection& connection, vehicle::Registry& registry, vehicle::Authority& authority,
             Options options, base::Logger log)
    : registry_(registry),
      authority_(authority),
      log_(std::move(log)),
      options_(options),
      alarms_(connection.loop(), registry, options.battery_limits, log_.named("alarm")) {
  open(connection, std::move(options));
}

Fleet::~Fleet() {
  for (auto const& network : networks_) network->connection().set_send_guard({});
}

void Fleet::add(mavlink::Connection& connection, std::string name) {
  auto options = options_;
  options.name = std::move(name);
  open(connection, std::move(options));
}

void Fleet::open(mavlink::Connection& connection, Options options) {
  auto& network = *networks_.emplace_back(std::make_unique<Network>(connection, registry_, std::move(options), log_));
  // Behind the network's own subscription: listeners find the vehicle as the message has left it.
  subscriptions_.push_back(connection.subscribe([this, &network](mavlink::Received const& received) {
    // By index: a listener may subscribe another one.
    for (std::size_t i = 0; i < listeners_.size(); ++i)
      if (auto const heard = listeners_[i].lock()) (*heard)(network, received);
  }));
  connection.set_send_guard([this, &network](mavlink::Address target, mavlink::Message const& message) {
    return check_sending(network, target, message);
  });
}

/// What is for every system is for each of the vehicles.
base::Result<> Fleet::check_sending(Network const& network, mavlink::Address target,
                                    mavlink::Message const& message) const {
  if (!send_guard_) return {};
  for (auto const* craft : network.all()) {
    if (target.system != 0 && target.system != craft->address.system) continue;
    if (auto allowed = send_guard_(*craft, message); !allowed) return allowed;
  }
  return {};
}

MavlinkVehicle* Fleet::find(vehicle::VehicleId const& id) const {
  for (auto const& network : networks_)
    if (auto* const craft = network->find(id)) return craft;
  return nullptr;
}

std::vector<MavlinkVehicle*> Fleet::all() const {
  std::vector<MavlinkVehicle*> crafts;
  for (auto const& network : networks_) {
    auto const of_network = network->all();
    crafts.insert(crafts.end(), of_network.begin(), of_network.end());
  }
  return crafts;
}

void Fleet::set_connection_timeout(vehicle::VehicleId const& id, base::Duration timeout) const {
  if (auto* const craft = find(id)) craft->connection_timeout = timeout;
}

std::shared_ptr<Fleet::Heard const> Fleet::subscribe(Heard heard) {
  std::erase_if(listeners_, [](auto const& listener) { return listener.expired(); });
  auto shared = std::make_shared<Heard const>(std::move(heard));
  listeners_.push_back(shared);
  return shared;
}

base::Task<> Fleet::give_back_rates() {
  base::Scope all(loop());
  for (auto const& network : networks_) all.spawn(network->give_back_rates());
  co_await all.join();
}

}  // namespace lapwing::fleet
