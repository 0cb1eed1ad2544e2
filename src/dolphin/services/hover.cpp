#include "dolphin/services/hover.hpp"

#include <fmt/format.h>

#include "dolphin/services/describe.hpp"
#include "dolphin/services/navigation.hpp"

namespace lapwing::dolphin {

namespace {

std::string text_of(Occurrence const& one, Document const& document) {
  switch (one.kind) {
    case WordKind::variable: return describe_word(*one.variable, document);
    case WordKind::function: return describe_word(*one.functions, document);
    case WordKind::instruction: return describe_word(*one.instruction, nullptr);
    case WordKind::command: return describe_word(*one.instruction, one.block);
    case WordKind::builder: return describe_word(*one.block);
    case WordKind::chain: return describe_word(*one.chain);
    case WordKind::member: return describe_word(*one.method);
    case WordKind::unit: return describe_word(*one.unit);
    case WordKind::constant:
    case WordKind::type: return fmt::format("```dolphin\n{}\n```\n{}", one.name->name, one.name->doc);
    case WordKind::signal: return fmt::format("The signal `{}`.", document.text(one.span));
    case WordKind::plan: break;
  }
  auto const places = definition(document, one.span.begin);
  if (places.empty()) return fmt::format("The plan `{}`, made elsewhere.", document.text(one.span));
  return fmt::format("The mission `{}`, defined in line {}.", document.text(one.span),
                     document.source().line(places.front().begin));
}

}  // namespace

std::optional<Hover> hover(Document const& document, std::uint32_t offset) {
  auto const* found = document.occurrence_at(offset);
  if (!found) return std::nullopt;
  return Hover{found->span, text_of(*found, document)};
}

}  // namespace lapwing::dolphin
