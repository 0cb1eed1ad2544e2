#include "host/vocabulary.hpp"

#include <utility>

#include "autonomy/words/vocabulary.hpp"
#include "base/assert.hpp"
#include "missions/vocabulary.hpp"
#include "robot/words/vocabulary.hpp"

namespace lapwing::host {

tasks::Vocabulary vocabulary(plan::plausibility::Settings settings) {
  auto words = missions::vocabulary(std::move(settings));
  auto const robots_fit = tasks::join(words, robot::vocabulary());
  auto const survey_fits = tasks::join(words, autonomy::vocabulary());
  LAPWING_ASSERT(robots_fit && survey_fits);  // no word of one is a word of the other
  return words;
}

}  // namespace lapwing::host
