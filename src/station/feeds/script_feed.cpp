#include "station/feeds/script_feed.hpp"

#include "station/messages/messages.hpp"

namespace lapwing::station {

std::string ScriptFeed::text() const {
  return script_message(script_.status());
}

}  // namespace lapwing::station
