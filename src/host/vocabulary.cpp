#include "host/vocabulary.hpp"

#include <utility>

#include "base/assert.hpp"
#include "missions/vocabulary.hpp"
#include "robot/words/vocabulary.hpp"

namespace lapwing::host {

tasks::Vocabulary vocabulary(plan::plausibility::Settings settings) {
  auto words = missions::vocabulary(std::move(settings));
  auto const fits = tasks::join(words, robot::vocabulary());
  LAPWING_ASSERT(fits);  // no word of one is a word of the other
  return words;
}

}  // namespace lapwing::host
