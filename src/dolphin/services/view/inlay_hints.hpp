#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dolphin/services/document.hpp"

namespace lapwing::dolphin {

/// A few words that an editor shows within the text without their being part of it.
struct InlayHint {
  enum class Kind { parameter, unit, height };
  std::uint32_t offset = 0;
  std::string text;
  Kind kind = Kind::unit;
};

/// In the part `within`, in order of place:
/// - the names of parameters before numbers: `surveyArea len: 200, width: 100`
/// - units behind numbers that have none: `move 60 m, 0 m`
/// - heights above home behind the positions of a mission whose home is known: `takeOff pad +20 m above home`
[[nodiscard]] std::vector<InlayHint> inlay_hints(Document const& document, base::Span within);

}  // namespace lapwing::dolphin
