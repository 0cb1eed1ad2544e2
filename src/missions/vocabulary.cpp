#include "missions/vocabulary.hpp"

#include <utility>

#include "missions/mission_block.hpp"

namespace lapwing::missions {

std::vector<tasks::BuilderSpec> vocabulary(plan::plausibility::Settings settings) {
  return {mission_block(std::move(settings))};
}

}  // namespace lapwing::missions
