#include "map/live/internal/layer.hpp"

#include <algorithm>
#include <iterator>

namespace lapwing::map::internal {

namespace {

/// What is left of a removed one: who was it?
Feature remains_of(Identity const& identity, Account const& removal) {
  Feature remains{.id = identity.id, .site = identity.site, .floor = identity.floor, .account = removal};
  switch (identity.kind) {
    case LayerKind::slots: remains.content = Slot(); break;
    case LayerKind::walls: remains.content = Wall(); break;
    case LayerKind::points_of_interest: remains.content = PointOfInterest(); break;
    case LayerKind::pictures: remains.content = Picture(); break;
    case LayerKind::tracks: remains.content = Track(); break;
    case LayerKind::areas: remains.content = Area(); break;
  }
  return remains;
}

}  // namespace

FeatureRecord const* Layer::find(std::string_view id) const {
  auto const found = records_.find(id);
  return found == records_.end() ? nullptr : &found->second;
}

Known Layer::known(std::string_view id) const {
  auto const* record = find(id);
  if (!record) return {};
  return {.feature = record->is_removed ? std::nullopt : std::optional(record->feature), .removal = record->removal};
}

FeatureRecord const& Layer::write(Identity const& identity, Known known, Revision revision) {
  auto& record = records_[identity.id];
  by_revision_.erase(record.revision);
  if (record.is_removed) removals_.erase(record.revision);
  if (record.revision != 0 && !record.is_removed) by_place_[record.feature.site].remove(place_of(record));

  record.is_removed = !known.feature.has_value();
  record.feature = known.feature ? *std::move(known.feature) : remains_of(identity, *known.removal);
  record.removal = std::move(known.removal);
  record.revision = revision;

  by_revision_.emplace(revision, &record);
  if (record.is_removed) {
    removals_.insert(revision);
    forget_oldest_removals();
  } else {
    by_place_[record.feature.site].insert(place_of(record));
  }
  return record;
}

std::vector<FeatureRecord const*> Layer::touch(std::string_view site, Revision& revision) {
  std::vector<FeatureRecord const*> touched;
  for (auto& [id, record] : records_) {
    if (record.feature.site != site || record.is_removed) continue;
    by_revision_.erase(record.revision);
    record.revision = ++revision;
    by_revision_.emplace(record.revision, &record);
    touched.push_back(&record);
  }
  return touched;
}

void Layer::note_removal(std::string_view id, Account const& removal) {
  auto const found = records_.find(id);
  if (found != records_.end()) found->second.removal = removal;
}

std::vector<FeatureRecord const*> Layer::all_in(std::string_view site, std::size_t most) const {
  std::vector<FeatureRecord const*> found;
  for (auto const& [id, record] : records_) {
    if (found.size() >= most) break;
    if (!record.is_removed && record.feature.site == site) found.push_back(&record);
  }
  return found;
}

std::vector<FeatureRecord const*> Layer::within(std::string_view site, SiteBox const& box, std::size_t most) const {
  auto const tree = by_place_.find(site);
  if (tree == by_place_.end()) return {};
  std::vector<FeatureRecord const*> found;
  auto const query = tree->second.qbegin(boost::geometry::index::intersects(box_of(box)));
  std::transform(query, tree->second.qend(), std::back_inserter(found),
                 [](Place const& place) { return place.second; });
  auto const by_id = [](FeatureRecord const* record) -> std::string const& { return record->feature.id; };
  auto const end = found.begin() + static_cast<std::ptrdiff_t>(std::min(most, found.size()));
  std::ranges::partial_sort(found, end, {}, by_id);
  found.erase(end, found.end());
  return found;
}

std::vector<FeatureRecord const*> Layer::changed_since(Revision revision, std::size_t most) const {
  std::vector<FeatureRecord const*> changed;
  for (auto entry = by_revision_.upper_bound(revision); entry != by_revision_.end() && changed.size() < most; ++entry)
    changed.push_back(entry->second);
  return changed;
}

Layer::Box Layer::box_of(SiteBox const& box) {
  return {{box.least.x(), box.least.y()}, {box.most.x(), box.most.y()}};
}

Layer::Place Layer::place_of(FeatureRecord const& record) {
  return {box_of(bounds(geometry_of(record.feature.content))), &record};
}

void Layer::forget_oldest_removals() {
  while (removals_.size() > most_removals) {
    auto const oldest = *removals_.begin();
    auto const entry = by_revision_.find(oldest);
    auto const id = entry->second->feature.id;
    by_revision_.erase(entry);
    removals_.erase(removals_.begin());
    records_.erase(id);
    oldest_remembered_ = oldest;
  }
}

}  // namespace lapwing::map::internal
