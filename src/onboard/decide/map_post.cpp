#include "onboard/decide/map_post.hpp"

#include <utility>

#include "autonomy/operator/map_text.hpp"

namespace lapwing::onboard {

using link::operator_link::Kind;

void MapPost::follow(Session const& session) {
  readers_[session.peer()] = {.connection = session.counters().connections, .told = nullptr};
}

bool MapPost::is_followed_by(Session const& session) const {
  auto const found = readers_.find(session.peer());
  return found != readers_.end() && session.is_connected() &&
         found->second.connection == session.counters().connections;
}

void MapPost::put(std::optional<autonomy::OccupancyMap> const& map) {
  if (!map || !is_sound(*map)) return;
  if (newest_ && is_alike(newest_->map, *map) && newest_->map.cells == map->cells) return;
  auto const revision = newest_ ? newest_->revision + 1 : 1;
  newest_ = std::make_shared<Version const>(Version{.map = *map, .revision = revision});
}

void MapPost::tell(Session& session) {
  if (!newest_ || !is_followed_by(session)) return;
  auto& told = readers_.find(session.peer())->second.told;
  if (told == newest_ || session.waiting(Kind::durable) > most_waiting) return;
  auto text = told && is_alike(told->map, newest_->map)
                  ? autonomy::map_changes_text(told->map, told->revision, newest_->map, newest_->revision)
                  : autonomy::map_text(newest_->map, newest_->revision).value();
  // One that finds no room is told later, with what has changed until then.
  if (session.send({.kind = Kind::durable, .text = std::move(text)})) told = newest_;
}

}  // namespace lapwing::onboard
