#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <string>
#include <vector>

#include "dolphin/check/internal/checker_class.hpp"
#include "dolphin/names/foreign_words.hpp"
#include "dolphin/syntax/ast_walk.hpp"

/// What the checker knows of what stands behind a point: properties, units, methods and how many arguments they take.
namespace lapwing::dolphin {

namespace {

/// Kinds that have the methods of the table and nothing else. Maps have their keys besides; ranges, exceptions and null
/// are told apart at run time.
constexpr auto closed = Kinds::number() | Kind::text | Kind::boolean | Kind::list | Kind::closure | Kind::position |
                        Kind::displacement | Kind::area | Kind::vehicles | Kind::task;
/// Those of which a property can be checked, too: behind a list stands the property of all that is in it.
constexpr auto with_properties = Kinds(Kind::text) | Kind::boolean | Kind::closure | Kind::position |
                                 Kind::displacement | Kind::area | Kind::vehicles | Kind::task;

std::vector<MethodSpec const*> specs_of(Kinds kinds, std::string_view name) {
  std::vector<MethodSpec const*> out;
  for (auto const& method : methods()) {
    if (method.name == name && method.receiver.meets(kinds)) out.push_back(&method);
  }
  return out;
}

std::vector<std::string_view> names_of(Kinds kinds, bool also_properties = true) {
  std::vector<std::string_view> out;
  for (auto const& method : methods()) {
    if (method.receiver.meets(kinds) && (also_properties || !method.is_property)) out.push_back(method.name);
  }
  return out;
}

/// `getName` is the property `name`; empty for other words.
std::string property_of(std::string_view getter) {
  bool const is_getter = getter.size() > 3 && getter.starts_with("get") && std::isupper(getter[3]);
  if (!is_getter) return {};
  std::string out(getter.substr(3));
  out[0] = static_cast<char>(std::tolower(out[0]));
  return out;
}

base::Hint hint_for(ast::Identifier const& name, Kinds kinds, bool also_properties = true) {
  if (auto foreign = hint_for_method(name.text); !foreign.empty()) return foreign;
  return base::did_you_mean(name.span, name.text, names_of(kinds, also_properties));
}

/// Collects every word that some map of the script may have as a key.
struct Keys {
  std::unordered_set<std::string>& out;

  void visit(ast::Stmt const& statement) {
    auto const* assign = std::get_if<ast::Assign>(&statement.node);
    if (assign) note(*assign->target);
    ast::for_each_child(statement.node, [this](auto const& child) { visit(child); });
  }
  void visit(ast::Expr const& expr) {
    if (auto const* literal = std::get_if<ast::MapLiteral>(&expr.node)) {
      for (auto const& entry : literal->entries) note_text(*entry.key);
    }
    if (auto const* call = std::get_if<ast::Call>(&expr.node)) {
      for (auto const& argument : call->arguments) {
        if (argument.name) out.insert(argument.name->text);
        if (!argument.name) note_text(*argument.value);
      }
    }
    ast::for_each_child(expr.node, [this](auto const& child) { visit(child); });
  }
  void note(ast::Expr const& target) {
    if (auto const* member = std::get_if<ast::Member>(&target.node)) out.insert(member->name.text);
    if (auto const* index = std::get_if<ast::Index>(&target.node)) note_text(*index->index);
  }
  void note_text(ast::Expr const& expr) {
    if (auto const* text = std::get_if<ast::StringLiteral>(&expr.node)) out.insert(text->value);
  }
};

}  // namespace

bool Checker::may_be_key(std::string const& name) {
  if (!map_keys_) {
    Keys keys{map_keys_.emplace()};
    for (auto const& statement : program_.body.statements) keys.visit(*statement);
  }
  return map_keys_->contains(name);
}

/// Members of values whose kind is known for sure.
void Checker::member(ast::Expr const& expr) {
  auto const& n = std::get<ast::Member>(expr.node);
  expression(n.object);
  if (n.is_spread) return;
  auto const facts = inference_.facts(*n.object);
  if (facts.is_number()) return unit(n);
  if (facts.kinds.is_none() || !facts.kinds.within(with_properties)) return;
  auto const found = specs_of(facts.kinds, n.name.text);
  if (std::ranges::any_of(found, &MethodSpec::is_property)) return;
  auto hint = hint_for(n.name, facts.kinds);
  if (!found.empty()) hint = fmt::format("a method has parentheses: .{}({})", n.name.text, found.front()->arguments);
  diagnostics_.report(
      code("unknown-member"), n.name.span,
      fmt::format("{} has no {} {}", describe(facts.kinds), found.empty() ? "member" : "property", n.name.text),
      std::move(hint));
}

/// `10.minutes`
void Checker::unit(ast::Member const& n) {
  if (find_unit(n.name.text)) return;
  auto const found = specs_of(Kinds::number(), n.name.text);
  if (std::ranges::any_of(found, &MethodSpec::is_property)) return;
  std::vector<std::string_view> known;
  for (auto const& one : units()) known.push_back(one.name);
  auto hint = base::did_you_mean(n.name.span, n.name.text, known);
  if (auto const meant = unit_meant(n.name.text); !meant.empty())
    hint = {fmt::format("did you mean {}?", meant), {{n.name.span, std::string(meant)}}};
  if (!found.empty()) hint = fmt::format("a method has parentheses: .{}({})", n.name.text, found.front()->arguments);
  diagnostics_.report(code("unknown-unit"), n.name.span, fmt::format("there is no unit {}", n.name.text),
                      std::move(hint));
}

/// `object.name(...)`: a method of its kind, with as many arguments as it takes.
void Checker::method_call(ast::Call const& call) {
  auto const& callee = std::get<ast::Member>(call.callee->node);
  expression(callee.object);
  arguments(call, std::nullopt);
  if (callee.is_spread || is_function_of_type(callee)) return;
  auto const kinds = inference_.facts(*callee.object).kinds;
  if (kinds.is_none() || !kinds.within(closed | Kind::map)) return;
  auto const& name = callee.name;
  auto const found = specs_of(kinds, name.text);
  bool const is_map = kinds.meets(Kind::map);
  if (is_map && may_be_key(name.text)) return;
  auto const is_method = [](MethodSpec const* one) { return !one->is_property; };
  if (std::ranges::none_of(found, is_method)) {
    auto const property = property_of(name.text);
    auto const as_property = specs_of(kinds, property);
    bool const is_getter = call.arguments.empty() && !property.empty() &&
                           (kinds.meets(Kind::list) || std::ranges::any_of(as_property, &MethodSpec::is_property));
    if (!is_getter) unknown_method(callee, kinds, !found.empty());
    return;
  }
  auto const positional = static_cast<std::size_t>(
      std::ranges::count_if(call.arguments, [](ast::Argument const& one) { return !one.name; }));
  auto const count = positional + (positional < call.arguments.size() ? 1 : 0);  // all named ones are one map
  auto const takes = [&](MethodSpec const* one) { return !one->is_property && argument_count(*one).allows(count); };
  if (std::ranges::any_of(found, takes)) return;
  auto const& method = **std::ranges::find_if(found, is_method);
  diagnostics_.report(code("argument-count"), name.span,
                      fmt::format("{} does not take {} argument{}", name.text, count, count == 1 ? "" : "s"),
                      fmt::format("write .{}({})", name.text, method.arguments));
}

void Checker::unknown_method(ast::Member const& callee, Kinds kinds, bool is_property) {
  auto const& name = callee.name;
  auto hint = hint_for(name, kinds, is_property);
  // A map may have got a closure under any key.
  bool const is_literal = std::holds_alternative<ast::MapLiteral>(callee.object->node);
  if (kinds.meets(Kind::map) && !is_literal && hint.empty()) return;
  if (is_property) hint = fmt::format("it is no method: write .{} without parentheses", name.text);
  diagnostics_.report(code("unknown-member"), name.span,
                      fmt::format("{} has no {} {}", describe(kinds), is_property ? "method" : "member", name.text),
                      std::move(hint));
}

/// `Math.sqrt(2)`: functions of numbers with their type in front.
bool Checker::is_function_of_type(ast::Member const& callee) {
  auto const* type = std::get_if<ast::Name>(&callee.object->node);
  if (!type || resolution_.find(*callee.object)) return false;
  if (type->text != "Math") return std::ranges::find(types(), type->text, &NameSpec::name) != types().end();
  if (find_instruction(callee.name.text) || callee.name.text == "random") return true;
  std::vector<std::string_view> known;
  for (auto const& one : instructions()) known.push_back(one.name);
  diagnostics_.report(code("unknown-member"), callee.name.span,
                      fmt::format("Math has no function {}", callee.name.text),
                      base::did_you_mean(callee.name.span, callee.name.text, known));
  return true;
}

}  // namespace lapwing::dolphin
