#include "dolphin/services/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "dolphin/names/vehicle_types.hpp"
#include "dolphin/services/cursor.hpp"
#include "dolphin/services/describe.hpp"
#include "dolphin/services/values.hpp"

namespace lapwing::dolphin {

namespace {

using enum TokenKind;

constexpr auto statement_words = std::to_array<std::string_view>(
    {"assert", "break", "continue", "def", "for", "if", "return", "switch", "throw", "try", "while"});
constexpr auto value_words = std::to_array<std::string_view>({"false", "new", "null", "true"});

std::string snippet_of(ast::ChainKind kind) {
  switch (kind) {
    case ast::ChainKind::wait_for: return "waitFor { $1 } then $0";
    case ast::ChainKind::when: return "when { $1 } then $0";
    case ast::ChainKind::until: return "until { $1 } run $0";
    case ast::ChainKind::during: return "during ${1:30.seconds} run $0";
    case ast::ChainKind::watch: return "watch $1 onError { $0 }";
  }
  return {};
}

/// A place to fill in: `${2:pos}`; with its choices in quotes where it has some.
std::string place_for(ParameterSpec const& parameter, NamedArguments named, std::size_t number) {
  if (!parameter.choices.empty()) return fmt::format("'${{{}|{}|}}'", number, fmt::join(parameter.choices, ","));
  if (named == NamedArguments::values && parameter.kinds.meets(Kind::map))
    return fmt::format("${{{}:name}}: 1", number);
  if (parameter.kinds == Kinds(Kind::text)) return fmt::format("'${{{}:{}}}'", number, parameter.name);
  if (parameter.kinds == Kinds(Kind::closure)) return fmt::format("{{ ${{{}}} }}", number);
  return fmt::format("${{{}:{}}}", number, parameter.name);
}

/// The call with places for what must be said.
std::string call_snippet(InstructionSpec const& spec, bool is_statement) {
  if (spec.signatures.empty()) return {};
  auto const& signature = spec.signatures.front();
  std::vector<std::string> places;
  for (auto const& parameter : signature.parameters) {
    if (!parameter.optional) places.push_back(place_for(parameter, spec.named, places.size() + 1));
  }
  if (places.empty()) return fmt::format("{}()", spec.name);
  return is_statement ? fmt::format("{} {}", spec.name, fmt::join(places, ", "))
                      : fmt::format("{}({})", spec.name, fmt::join(places, ", "));
}

std::string call_snippet(ast::FunctionDecl const& function) {
  std::vector<std::string> places;
  for (auto const& parameter : function.parameters) {
    if (!parameter.fallback) places.push_back(fmt::format("${{{}:{}}}", places.size() + 1, parameter.name.text));
  }
  return fmt::format("{}({})", function.name.text, fmt::join(places, ", "));
}

bool is_error_type(NameSpec const& type) {
  return type.name.ends_with("Error") || type.name.ends_with("Exception");
}

class Completer {
 public:
  Completer(Document const& document, std::uint32_t offset)
      : document_(document), cursor_(cursor_at(document, offset)), blocks_(blocks_round(document, cursor_)) {}

  Completion run() {
    out_.replaced = cursor_.word;
    if (cursor_.in_comment || cursor_.in_number) return out_;
    if (auto const word = interpolated_word()) {
      out_.replaced = *word;
      variables();
    } else if (cursor_.in_text) {
      texts();
    } else if (at(dot) || at(safe_dot)) {
      members();
    } else if (at(kw_new) || at(kw_as) || at(kw_instanceof)) {
      names(types(), CompletionKind::type, 0);
    } else if (in_catch()) {
      for (auto const& one : types()) {
        if (is_error_type(one)) add(one.name, CompletionKind::type, 0).detail = one.doc;
      }
    } else if (at(kw_def) || (!cursor_.begins_statement && (at(integer) || at(decimal)))) {
      return out_;
    } else {
      words();
    }
    return out_;
  }

 private:
  [[nodiscard]] bool at(TokenKind kind) const {
    return cursor_.before != no_token && document_.stream().tokens[cursor_.before].kind == kind;
  }
  CompletionItem& add(std::string_view label, CompletionKind kind, int rank) {
    return out_.items.emplace_back(CompletionItem{.label = std::string(label), .kind = kind, .rank = rank});
  }

  /// `catch (|` and `catch (TaskError | |`, where the types stand.
  [[nodiscard]] bool in_catch() const {
    auto const& tokens = document_.stream().tokens;
    auto i = cursor_.before;
    while (i != no_token && i >= 2 && tokens[i].kind == bit_or && tokens[i - 1].kind == identifier) i -= 2;
    return i != no_token && i > 0 && tokens[i].kind == left_paren && tokens[i - 1].kind == kw_catch;
  }
  /// Whether a call may bring its arguments: nothing stands behind the word that could be them.
  [[nodiscard]] bool is_free_behind() const {
    auto const line = document_.source().line_span(document_.source().line(cursor_.word.end));
    auto const rest = document_.text({cursor_.word.end, std::max(cursor_.word.end, line.end)});
    auto const next = rest.find_first_not_of(" \t");
    return next == std::string_view::npos || std::string_view(")]};,").contains(rest[next]) ||
           rest.substr(next).starts_with("//");
  }

  // ---- within quotes

  /// What is being written behind the $ of a text in double quotes.
  [[nodiscard]] std::optional<base::Span> interpolated_word() const {
    if (!cursor_.in_text) return std::nullopt;
    auto const text = document_.source().text();
    auto const is_letter = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    };
    auto begin = cursor_.offset;
    while (begin > cursor_.word.begin && is_letter(text[begin - 1])) --begin;
    bool const has_dollar = begin > 0 && text[begin - 1] == '$' && (begin < 2 || text[begin - 2] != '\\');
    auto const& tokens = document_.stream().tokens;
    auto const holds = [&](Token const& token) { return token.span.end < begin; };
    auto const token = std::ranges::partition_point(tokens, holds);
    if (!has_dollar || token == tokens.end()) return std::nullopt;
    bool const is_single = token->kind == string && text[token->span.begin] == '\'';
    return is_single ? std::nullopt : std::optional(base::Span{begin, cursor_.offset});
  }

  void texts() {
    auto const call = open_call(document_, cursor_);
    if (!call) return;
    auto const name = document_.text(document_.stream().tokens[call->callee].span);
    auto const callee = callee_named(name, blocks_, document_.vocabulary());
    if (!callee.spec) return;
    if (name == "task" || name == "imcPlan") return defined_words(WordKind::plan, "mission");
    if (name == "poll") return defined_words(WordKind::signal, "signal");
    bool const is_pick = callee.block && callee.block->kind == BlockKind::pick;
    if (is_pick && name == "type") return values(vehicle_types);
    for (auto const& signature : callee.spec->signatures) {
      if (call->argument < signature.parameters.size()) values(signature.parameters[call->argument].choices);
    }
  }
  template <class Table>
  void values(Table const& table) {
    for (auto const one : table) {
      bool const is_new = std::ranges::find(out_.items, one, &CompletionItem::label) == out_.items.end();
      if (is_new) add(one, CompletionKind::value, 0);
    }
  }
  void defined_words(WordKind kind, std::string_view detail) {
    std::set<std::string_view> seen;
    for (auto const& one : document_.occurrences()) {
      bool const is_wanted = one.kind == kind && (kind != WordKind::plan || one.is_definition);
      bool const is_here = one.span.begin <= cursor_.offset && cursor_.offset <= one.span.end;
      if (!is_wanted || is_here || !seen.insert(document_.text(one.span)).second) continue;
      add(document_.text(one.span), CompletionKind::value, 0).detail = detail;
    }
  }

  // ---- behind a point

  void members() {
    auto const facts = facts_of_value_before(document_, cursor_.before);
    if (facts.kinds.meets(Kinds::number())) {
      for (auto const& unit : units()) {
        auto& made = add(unit.name, CompletionKind::unit, facts.is_number() ? 0 : 2);
        made.detail = unit.doc;
        made.markdown = describe_word(unit);
      }
    }
    std::set<std::string_view> seen;
    for (auto const& method : methods()) {
      if (!method.receiver.meets(facts.kinds) || !seen.insert(method.name).second) continue;
      auto const kind = method.is_property ? CompletionKind::property : CompletionKind::method;
      auto& made = add(method.name, kind, method.receiver.is_any() ? 3 : 1);
      made.detail = describe(method.result);
      made.markdown = describe_word(method);
      if (!method.is_property && is_free_) made.snippet = fmt::format("{}($0)", method.name);
    }
  }

  // ---- elsewhere

  void words() {
    auto const call = open_call(document_, cursor_);
    auto const callee = call ? document_.text(document_.stream().tokens[call->callee].span) : std::string_view();
    if (callee == "post" || callee == "consume" || callee == "poll") signals();
    if (callee == "execute" || callee == "setConnectionTimeout") vehicle_keys();
    if (cursor_.begins_statement && !blocks_.empty()) commands(*blocks_.front());
    variables();
    functions();
    instructions_and_blocks();
    chains();
    names(constants(), CompletionKind::constant, 4);
    for (auto const one : value_words) add(one, CompletionKind::keyword, 5);
    if (!cursor_.begins_statement) return;
    for (auto const one : statement_words) add(one, CompletionKind::keyword, 5);
  }

  void names(std::span<NameSpec const> table, CompletionKind kind, int rank) {
    for (auto const& one : table) {
      auto& made = add(one.name, kind, rank);
      made.detail = one.doc;
    }
  }

  void signals() {
    std::set<std::string_view> seen;
    for (auto const& one : document_.occurrences()) {
      bool const is_here = one.span.begin <= cursor_.offset && cursor_.offset <= one.span.end;
      if (one.kind != WordKind::signal || is_here || !seen.insert(document_.text(one.span)).second) continue;
      auto& made = add(document_.text(one.span), CompletionKind::value, 0);
      made.detail = "signal";
      made.insert = made.label + ": ";
    }
  }

  void vehicle_keys() {
    for (auto const& variable : document_.resolution().variables) {
      bool const is_wanted = document_.facts(variable).kinds == Kinds(Kind::vehicles) && can_be_seen(variable);
      if (!is_wanted) continue;
      auto& made = add(variable.name, CompletionKind::variable, 0);
      made.detail = "vehicles";
      made.insert = made.label + ": ";
      made.markdown = describe_word(variable, document_);
    }
  }

  void commands(BlockWords const& block) {
    for (auto const& one : block.words) {
      auto& made = add(one.name, CompletionKind::command, 0);
      made.detail = call_text(one, &block, 0).text;
      made.markdown = describe_word(one, &block);
      if (is_free_) made.snippet = call_snippet(one, true);
    }
  }

  [[nodiscard]] bool can_be_seen(Variable const& variable) const {
    if (variable.kind == VariableKind::global) return true;
    auto const found = document_.scopes().of_locals.find(&variable);
    if (found == document_.scopes().of_locals.end()) return false;
    auto const scope = found->second;
    bool const is_inside = scope.begin <= cursor_.offset && cursor_.offset <= scope.end;
    if (!is_inside || variable.defined.begin >= cursor_.word.begin) return false;
    return std::ranges::none_of(document_.scopes().functions, [&](base::Span function) {
      bool const hides = function.begin <= cursor_.offset && cursor_.offset < function.end;
      return hides && scope.begin < function.begin;
    });
  }

  void variables() {
    std::set<std::string_view> seen;
    for (auto const& variable : document_.resolution().variables) {
      bool const is_here = variable.defined.begin == cursor_.word.begin && variable.defined.size() > 0;
      if (variable.name == "it" || is_here || !can_be_seen(variable) || !seen.insert(variable.name).second) continue;
      auto& made = add(variable.name, CompletionKind::variable, 1);
      made.detail = kind_text(document_.facts(variable));  // hovering says more; there may be hundreds
    }
    auto const has_it = [&](base::Span closure) {
      return closure.begin < cursor_.offset && cursor_.offset < closure.end;
    };
    if (std::ranges::any_of(document_.scopes().implicit_parameters, has_it))
      add("it", CompletionKind::variable, 2).detail = "the parameter of this closure";
  }

  void functions() {
    for (auto const& [name, declarations] : document_.resolution().functions) {
      auto& made = add(name, CompletionKind::function, 1);
      made.detail = call_text(*declarations.front(), document_).text;
      made.markdown = describe_word(declarations, document_);
      if (is_free_) made.snippet = call_snippet(*declarations.front());
    }
  }

  void instructions_and_blocks() {
    for (auto const& one : instructions()) instruction(one);
    for (auto const& one : document_.vocabulary().instructions().added()) instruction(one);
    for (auto const& block : document_.vocabulary().blocks()) {
      if (!block.builder) continue;
      auto& made = add(block.name, CompletionKind::block, 3);
      made.detail = block.builder->doc;
      made.markdown = describe_word(block);
      if (is_free_) made.snippet = fmt::format("{} {{\n  $0\n}}", block.name);
    }
  }

  void instruction(InstructionSpec const& one) {
    bool const is_block = one.block != BlockKind::none && one.name != "move";
    auto& made = add(one.name, is_block ? CompletionKind::block : CompletionKind::instruction, 3);
    made.detail = call_text(one, nullptr, 0).text;
    made.markdown = describe_word(one, nullptr);
    if (is_block && is_free_) made.snippet = fmt::format("{} {{\n  $0\n}}", one.name);
    if (!is_block && is_free_) made.snippet = call_snippet(one, cursor_.begins_statement);
  }

  void chains() {
    bool const in_choice = !blocks_.empty() && blocks_.front()->kind == BlockKind::choice;
    for (auto const& one : chain_words()) {
      bool const is_when = one.kind == ast::ChainKind::when;
      if (is_when && !in_choice) continue;
      auto& made = add(one.name, CompletionKind::keyword, is_when ? 0 : 3);
      made.detail = one.usage;
      made.markdown = describe_word(one);
      if (is_free_) made.snippet = snippet_of(one.kind);
    }
  }

  Document const& document_;
  Cursor cursor_;
  std::vector<BlockWords const*> blocks_;
  bool is_free_ = is_free_behind();
  Completion out_;
};

}  // namespace

Completion complete(Document const& document, std::uint32_t offset) {
  return Completer(document, offset).run();
}

}  // namespace lapwing::dolphin
