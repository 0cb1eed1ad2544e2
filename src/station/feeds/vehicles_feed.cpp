#include "station/feeds/vehicles_feed.hpp"

#include <map>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "station/messages/vehicle_fields.hpp"

namespace lapwing::station {

using internal::Field;
using internal::Fields;

namespace {

/// One key of a vehicle, and at which revisions of the feed it became as it is.
struct KnownField {
  Field field;
  std::uint64_t changed = 0;  ///< the value did
  std::uint64_t told = 0;     ///< the value did, or it was heard again
};

struct KnownVehicle {
  std::optional<unsigned long long> looked_at = std::nullopt;  ///< the registry's revision
  std::uint64_t told = 0;                                      ///< the newest of its fields'
  std::map<std::string, KnownField> fields;
};

/// Takes in what a vehicle's fields are now; whether any of them is news.
bool take_in(KnownVehicle& known, Fields now_known, std::uint64_t revision) {
  bool is_news = false;
  for (auto& [key, field] : now_known) {
    auto const [place, is_new] = known.fields.try_emplace(key);
    auto& before = place->second;
    bool const changed = is_new || before.field.value != field.value;
    if (!changed && before.field.heard == field.heard) continue;
    if (changed) before.changed = revision;
    before.told = revision;
    before.field = std::move(field);
    is_news = true;
  }
  if (known.fields.size() > now_known.size())
    std::erase_if(known.fields, [&](auto const& entry) { return !now_known.contains(entry.first); });
  if (is_news) known.told = revision;
  return is_news;
}

Json changes(std::string const& id, KnownVehicle const& vehicle, std::uint64_t since, base::TimePoint now) {
  Json object{{"id", id}};
  Json ages = Json::object();
  for (auto const& [key, known] : vehicle.fields) {
    if (known.told <= since) continue;
    if (known.changed > since) object[key] = known.field.value;
    if (known.field.heard) ages[key] = rounded(base::to_seconds(now - *known.field.heard), 3);
  }
  if (!ages.empty()) object["age_s"] = std::move(ages);
  return object;
}

}  // namespace

struct VehiclesFeed::Known {
  std::map<vehicle::VehicleId, KnownVehicle> vehicles;
};

VehiclesFeed::VehiclesFeed(vehicle::Registry const& registry)
    : registry_(registry), known_(std::make_unique<Known>()) {}
VehiclesFeed::~VehiclesFeed() = default;

std::uint64_t VehiclesFeed::refresh(base::TimePoint) {
  bool is_news = false;
  for (auto const* state : registry_.all()) {
    auto& known = known_->vehicles[state->id];
    auto const revision = registry_.revision(state->id);
    if (revision == known.looked_at) continue;
    known.looked_at = revision;
    is_news = take_in(known, internal::fields_of(*state), revision_ + 1) || is_news;
  }
  if (is_news) ++revision_;
  return revision_;
}

News VehiclesFeed::since(std::uint64_t revision, base::TimePoint now, std::size_t) const {
  Json vehicles = Json::array();
  for (auto const* state : registry_.all()) {
    auto const known = known_->vehicles.find(state->id);
    if (known == known_->vehicles.end() || known->second.told <= revision) continue;
    vehicles.push_back(changes(state->id.text, known->second, revision, now));
  }
  bool const is_whole = revision == 0;
  if (!is_whole && vehicles.empty()) return {};
  Json const message{{"type", "vehicles"},
                     {"time_s", rounded(base::to_seconds(now.time_since_epoch()), 3)},
                     {"full", is_whole},
                     {"vehicles", std::move(vehicles)}};
  return {is_whole, {{.content = dump(message), .revision = revision_}}};
}

std::string vehicles_message(vehicle::Registry const& registry, base::TimePoint now) {
  VehiclesFeed feed(registry);
  (void)feed.refresh(now);
  return feed.since(0, now, 0).frames.front().content;
}

}  // namespace lapwing::station
