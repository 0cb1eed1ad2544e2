#include "missions/vocabulary.hpp"

#include <utility>

#include "missions/mission_block.hpp"
#include "missions/send_message.hpp"

namespace lapwing::missions {

tasks::Vocabulary vocabulary(plan::plausibility::Settings settings) {
  return {.builders = {mission_block(std::move(settings))}, .instructions = {send_message()}};
}

}  // namespace lapwing::missions
