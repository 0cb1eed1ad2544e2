#include "dolphin/check/fixes.hpp"

#include <fmt/format.h>

#include <utility>

namespace lapwing::dolphin {

namespace {

using base::Edit;
using base::Hint;
using base::SourceFile;
using base::Span;

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

/// Takes the sign behind the word away, but where what follows would then be read as one expression with the word.
std::vector<Edit> without_sign(SourceFile const& source, Span word, char sign) {
  auto const text = source.text();
  auto const behind_blanks = [&](std::uint32_t at) {
    while (at < text.size() && is_blank(text[at])) ++at;
    return at;
  };
  auto const at = behind_blanks(word.end);
  if (at >= text.size() || text[at] != sign) return {};
  auto const next = behind_blanks(at + 1);
  if (next >= text.size() || std::string_view("-+([{").contains(text[next])) return {};
  return {{{word.end, next}, " "}};
}

}  // namespace

Hint did_you_mean_in_quotes(SourceFile const& source, ast::Expr const& expr, std::string_view word,
                            std::span<std::string_view const> candidates) {
  auto const inside = Span{expr.span.begin + 1, expr.span.end - 1};
  auto hint = base::did_you_mean(inside, word, candidates);
  if (expr.span.size() != word.size() + 2 || source.text(inside) != word) hint.fix.clear();
  return hint;
}

Hint without_colon(SourceFile const& source, Span word) {
  return {fmt::format("write {} without the colon", source.text(word)), without_sign(source, word, ':')};
}

Hint wrapped_in_action(ast::Expr const& closure) {
  Hint hint("wrap it: action { ... }");
  if (std::holds_alternative<ast::Closure>(closure.node))
    hint.fix = {{{closure.span.begin, closure.span.begin}, "action "}};
  return hint;
}

Hint executed(SourceFile const& source, Span task) {
  auto const [begin, end] = task;
  Hint hint("write execute before it, or give it a name");
  hint.fix = {{{begin, begin}, "execute "}};
  if (source.text().substr(begin, 1) == "(") hint.fix = {{{begin, begin}, "execute("}, {{end, end}, ")"}};
  return hint;
}

Hint without_equals_sign(SourceFile const& source, Span word) {
  return {fmt::format("write {} without =", source.text(word)), without_sign(source, word, '=')};
}

std::vector<Edit> with_parentheses(Span callee, Span argument) {
  return {{{callee.end, argument.begin}, "("}, {{argument.end, argument.end}, ")"}};
}

std::vector<Edit> argument_in_parentheses(SourceFile const& source, Span callee, Span all) {
  auto const text = source.text({callee.end, all.end});
  auto const begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return {{{callee.end, all.end}, fmt::format(" ({})", text.substr(begin))}};
}

Hint in_front(SourceFile const& source, Span during, Span all) {
  auto const task = source.text({all.begin, during.begin});
  auto const limit = source.text({during.end, all.end});
  auto chain = fmt::format("during{} run {}", limit, task.substr(0, task.find_last_not_of(".? \t\r\n") + 1));
  // A call binds tighter than what may follow it; the chain takes all of that.
  if (limit.starts_with('(')) chain = fmt::format("({})", chain);
  return {"write during 30.seconds run task", {{all, std::move(chain)}}};
}

Hint with_unit(SourceFile const& source, ast::Expr const& number, std::string_view unit) {
  auto const text = source.text(number.span);
  Hint hint(fmt::format("write {}.{}", text, unit));
  if (text.find_first_not_of("0123456789._") == std::string_view::npos)
    hint.fix = {{{number.span.end, number.span.end}, fmt::format(".{}", unit)}};
  return hint;
}

}  // namespace lapwing::dolphin
