#include "route/filter.hpp"

#include <algorithm>

namespace lapwing::route {

namespace {

void insert(std::vector<std::uint32_t>& sorted, std::uint32_t id) {
  auto const place = std::ranges::lower_bound(sorted, id);
  if (place == sorted.end() || *place != id) sorted.insert(place, id);
}

}  // namespace

void Filter::Ids::allow(std::uint8_t id) {
  if (!allowed) allowed.emplace();
  allowed->set(id);
}

void Filter::allow_message(std::uint32_t id) {
  is_open_ = false;
  insert(allowed_messages_, id);
}

void Filter::block_message(std::uint32_t id) {
  is_open_ = false;
  insert(blocked_messages_, id);
}

void Filter::allow_system(std::uint8_t id) {
  is_open_ = false;
  systems_.allow(id);
}

void Filter::block_system(std::uint8_t id) {
  is_open_ = false;
  systems_.blocked.set(id);
}

void Filter::allow_component(std::uint8_t id) {
  is_open_ = false;
  components_.allow(id);
}

void Filter::block_component(std::uint8_t id) {
  is_open_ = false;
  components_.blocked.set(id);
}

bool Filter::passes_message(std::uint32_t id) const {
  if (std::ranges::binary_search(blocked_messages_, id)) return false;
  return allowed_messages_.empty() || std::ranges::binary_search(allowed_messages_, id);
}

}  // namespace lapwing::route
