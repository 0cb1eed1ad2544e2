#include "station/feeds/vehicles_feed.hpp"

#include <map>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "station/fields/field_changes.hpp"
#include "station/fields/field_json.hpp"
#include "station/fields/vehicle_fields.hpp"
#include "station/messages/feed_json.hpp"

namespace lapwing::station {

using internal::FieldChanges;
using internal::FieldJson;
using internal::FieldVisitor;
using vehicle::VehicleState;

namespace {

struct KnownVehicle {
  std::optional<unsigned long long> looked_at = std::nullopt;  ///< the registry's revision
  std::uint64_t told = 0;                                      ///< the newest of its fields'
  FieldChanges fields;
};

/// The vehicle's object with the fields that are chosen; without a choice all of them.
Json object_of(VehicleState const& state, base::TimePoint now, FieldJson::Choose choose = {}) {
  Json object{{"id", state.id.text}};
  FieldJson writer(object, now, std::move(choose));
  internal::vehicle_fields(writer, state);
  writer.finish();
  return object;
}

std::string vehicles_text(Json vehicles, bool is_full, base::TimePoint now) {
  return dump({{"type", "vehicles"},
               {"time_s", rounded(base::to_seconds(now.time_since_epoch()), 3)},
               {"full", is_full},
               {"vehicles", std::move(vehicles)}});
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
    auto const show = [&](FieldVisitor& visitor) { internal::vehicle_fields(visitor, *state); };
    if (!known.fields.look(show, revision_ + 1)) continue;
    known.told = revision_ + 1;
    is_news = true;
  }
  if (is_news) ++revision_;
  return revision_;
}

News VehiclesFeed::since(std::uint64_t revision, base::TimePoint now, std::size_t) const {
  Json vehicles = Json::array();
  for (auto const* state : registry_.all()) {
    auto const known = known_->vehicles.find(state->id);
    if (known == known_->vehicles.end() || known->second.told <= revision) continue;
    vehicles.push_back(object_of(*state, now, [&fields = known->second.fields, revision](std::string_view key) {
      auto const news = fields.news_of(key, revision);
      return FieldJson::News{.value = news.value, .age = news.age};
    }));
  }
  bool const is_whole = revision == 0;
  if (!is_whole && vehicles.empty()) return {};
  return {is_whole, {{.content = vehicles_text(std::move(vehicles), is_whole, now), .revision = revision_}}};
}

std::string vehicles_message(vehicle::Registry const& registry, base::TimePoint now) {
  Json vehicles = Json::array();
  for (auto const* state : registry.all()) vehicles.push_back(object_of(*state, now));
  return vehicles_text(std::move(vehicles), true, now);
}

}  // namespace lapwing::station
