#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "dolphin/check/fixes.hpp"
#include "dolphin/check/internal/checker_class.hpp"
#include "dolphin/names/foreign_words.hpp"
#include "dolphin/syntax/ast_walk.hpp"
#include "dolphin/value/regular_expression.hpp"

namespace lapwing::dolphin {

namespace {

bool has_name(std::span<NameSpec const> table, std::string_view name) {
  return std::ranges::find(table, name, &NameSpec::name) != table.end();
}

std::vector<std::string_view> names_of(auto const& table) {
  std::vector<std::string_view> out;
  for (auto const& one : table) out.push_back(one.name);
  return out;
}

constexpr auto block_kinds = {BlockKind::pick, BlockKind::position, BlockKind::displacement, BlockKind::handler};

}  // namespace

// ---- names --------------------------------------------------------------------------------------

InstructionSpec const* Checker::block_word(std::string_view name) const {
  for (auto context = contexts_.rbegin(); context != contexts_.rend(); ++context) {
    auto const found = std::ranges::find(context->words, name, &InstructionSpec::name);
    if (found != context->words.end()) return &*found;
  }
  return nullptr;
}

Builder const* Checker::find_builder(std::string_view name) const {
  auto const found =
      std::ranges::find_if(builders_, [&](Builder const& builder) { return builder.spec->name == name; });
  return found == builders_.end() ? nullptr : &*found;
}

bool Checker::is_callable(std::string_view name) const {
  return block_word(name) || resolution_.functions.contains(name) || resolution_.instructions.find(name) ||
         find_builder(name);
}

bool Checker::may_be_defined_in_unread(std::string_view name) const {
  return unread_names_.contains(std::string(name));
}

/// Looks for what was meant among variables, functions and instructions alike; the words of the block one is in come
/// first.
base::Hint Checker::suggestion(std::string_view name, base::Span span) const {
  if (diagnostics_.error_count() >= base::Diagnostics::default_limit) return {};  // nobody would see it
  std::vector<std::string_view> near;
  for (auto const& context : contexts_) std::ranges::copy(names_of(context.words), std::back_inserter(near));
  if (auto found = base::did_you_mean(span, name, near); !found.empty()) return found;
  std::vector<std::string_view> all;
  for (auto const& variable : resolution_.variables) {
    if (variable.name != "it") all.push_back(variable.name);
  }
  for (auto const& [function, declarations] : resolution_.functions) all.push_back(function);
  for (auto const& builder : builders_) all.push_back(builder.spec->name);
  std::ranges::copy(names_of(instructions()), std::back_inserter(all));
  std::ranges::copy(names_of(resolution_.instructions.added()), std::back_inserter(all));
  std::ranges::copy(names_of(constants()), std::back_inserter(all));
  return base::did_you_mean(span, name, all);
}

std::string Checker::block_of(std::string_view name) const {
  for (auto const& builder : builders_) {
    auto const found = std::ranges::find(builder.words, name, &InstructionSpec::name);
    if (found != builder.words.end()) return fmt::format("{} stands inside {} {{ ... }}", name, builder.spec->name);
  }
  for (auto const kind : block_kinds) {
    auto const words = block_words(kind);
    if (std::ranges::find(words, name, &InstructionSpec::name) == words.end()) continue;
    for (auto const& instruction : instructions()) {
      if (instruction.block == kind) return fmt::format("{} stands inside {} {{ ... }}", name, instruction.name);
    }
    return fmt::format("{} stands inside onError {{ ... }}", name);
  }
  return {};
}

void Checker::undefined_name(std::string const& name, base::Span span) {
  if (may_be_defined_in_unread(name) || !reported_.insert(name).second) return;
  if (is_callable(name)) {
    diagnostics_.report(code("instruction-as-value"), span, fmt::format("{} is an instruction, not a variable", name),
                        fmt::format("to use it write {}(...)", name));
    return;
  }
  auto const is_hidden_local = locals_.contains(name);
  if (is_hidden_local) {
    diagnostics_.report(code("hidden-variable"), span, fmt::format("{} is not defined here", name),
                        "def makes a local; assign without def to see it everywhere");
    return;
  }
  bool const in_mission = !contexts_.empty() && contexts_.back().kind == BlockKind::platform;
  base::Hint hint = in_mission ? hint_for_mission_word(name) : hint_for_name(name);
  if (hint.empty()) hint = suggestion(name, span);
  if (hint.empty()) hint = block_of(name);
  if (hint.empty()) hint = hint_in_mission(name);
  diagnostics_.report(code("unknown-name"), span, fmt::format("{} is not defined", name), std::move(hint));
}

/// For words of ground stations, which want a mission round them: `land`, `rtl`.
std::string Checker::hint_in_mission(std::string_view name) const {
  bool const in_mission = !contexts_.empty() && contexts_.back().kind == BlockKind::platform;
  auto hint = hint_for_mission_word(name);
  return hint.empty() || in_mission ? hint : fmt::format("inside mission {{ ... }} {}", hint);
}

void Checker::name(ast::Expr const& expr) {
  auto const& text = std::get<ast::Name>(expr.node).text;
  if (auto const* variable = resolution_.find(expr)) {
    read_.insert(variable);
    used_too_early(expr, *variable);
    return;
  }
  if (has_name(constants(), text) || has_name(types(), text)) return;
  undefined_name(text, expr.span);
}

/// A global that gets its first value in a later statement of the script, or from what it is used in.
bool Checker::used_too_early(ast::Expr const& expr, Variable const& variable) {
  // In a loop the other branch of ?: may have given it one before.
  bool const defines_itself = &variable == defining_ && !place_.in_loop;
  bool const has_no_value = variable.first_statement > top_statement_ || defines_itself;
  bool const early = variable.kind == VariableKind::global && !place_.in_closure && has_no_value;
  if (!early || may_be_defined_in_unread(variable.name) || !reported_.insert(variable.name).second) return false;
  diagnostics_.report(code("used-before-value"), expr.span, fmt::format("{} has no value yet", variable.name), {},
                      {{variable.defined, "it gets its first value here"}});
  return true;
}

// ---- expressions --------------------------------------------------------------------------------

void Checker::expression(ast::ExprPtr const& expr) {
  if (expr) expression(*expr);
}

void Checker::expression(ast::Expr const& expr) {
  if (std::holds_alternative<ast::Name>(expr.node)) return name(expr);
  if (std::holds_alternative<ast::Call>(expr.node)) return call(expr);
  if (std::holds_alternative<ast::Chain>(expr.node)) return chain(expr);
  if (std::holds_alternative<ast::Member>(expr.node)) return member(expr);
  if (std::holds_alternative<ast::Index>(expr.node)) return index(expr);
  if (auto const* literal = std::get_if<ast::Closure>(&expr.node)) return closure(*literal, std::nullopt);
  if (auto const* cast = std::get_if<ast::Cast>(&expr.node)) type_name(cast->type);
  if (auto const* test = std::get_if<ast::InstanceOf>(&expr.node)) type_name(test->type);
  if (auto const* literal = std::get_if<ast::MapLiteral>(&expr.node)) map(*literal);
  if (auto const* literal = std::get_if<ast::PatternLiteral>(&expr.node)) pattern(*literal, expr.span);
  if (auto const* made = std::get_if<ast::New>(&expr.node)) {
    bool const is_own = made->type.text.ends_with("Exception") || made->type.text.ends_with("Error");
    if (!is_own) type_name(made->type);
    if (made->type.text == "Position") {
      diagnostics_.report(code("radians"), made->type.span, "new Position takes radians",
                          "location(lat, lon, height) takes degrees");
    }
  }
  auto const* binary = std::get_if<ast::Binary>(&expr.node);
  if (binary && missing_parentheses(expr, *binary)) return expression(binary->right);
  if (binary) return operation(*binary);
  ast::for_each_child(expr.node, [this](auto const& child) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(child)>, ast::Expr>) expression(child);
  });
}

void Checker::closure(ast::Closure const& closure, std::optional<BlockContext> context) {
  auto const outer = place_;
  bool const is_choice = context && context->kind == BlockKind::choice;
  place_ = {.in_closure = true, .in_task = outer.in_task, .can_be_stopped = is_choice && outer.can_be_stopped};
  // The blocks of pick and of a mission are carried out where they stand.
  bool const runs_now = context && context->kind != BlockKind::handler && context->kind != BlockKind::choice;
  place_.in_closure = outer.in_closure || !runs_now;
  if (context) contexts_.push_back(*context);
  for (auto const& parameter : closure.parameters) expression(parameter.fallback);
  block(closure.body, !runs_now);
  if (context) contexts_.pop_back();
  place_ = outer;
}

void Checker::map(ast::MapLiteral const& map) {
  std::unordered_set<std::string_view> keys;
  for (auto const& entry : map.entries) {
    auto const* key = entry.key ? std::get_if<ast::StringLiteral>(&entry.key->node) : nullptr;
    if (key && !keys.insert(key->value).second)
      diagnostics_.report(code("duplicate-key"), entry.key->span, fmt::format("duplicate key {}", key->value));
  }
}

void Checker::pattern(ast::PatternLiteral const& literal, base::Span span) {
  auto const made = RegularExpression::make(literal.text);
  if (!made) diagnostics_.report(code("invalid-pattern"), span, "this is no pattern: " + made.error());
}

/// `message [1, 2]` indexes something called message.
void Checker::index(ast::Expr const& expr) {
  auto const& n = std::get<ast::Index>(expr.node);
  auto const* callee = std::get_if<ast::Name>(&n.object->node);
  if (callee && !resolution_.find(*n.object) && is_callable(callee->text)) {
    auto const between = diagnostics_.source().text({n.object->span.end, expr.span.end});
    auto const bracket = n.object->span.end + static_cast<std::uint32_t>(std::min(between.find('['), between.size()));
    diagnostics_.report(
        code("instruction-as-value"), expr.span,
        fmt::format("this takes an element of {}, which is an instruction", callee->text),
        {fmt::format("write {}([...])", callee->text), with_parentheses(n.object->span, {bracket, expr.span.end})});
    return expression(n.index);
  }
  expression(n.object);
  expression(n.index);
  auto const facts = inference_.facts(*n.object);
  auto const inside = inference_.facts(*n.index);
  if (facts.kinds == Kinds(Kind::task) && !inside.kinds.meets(Kind::vehicles)) {
    diagnostics_.report(code("not-vehicles"), n.index->span,
                        fmt::format("a task is limited to a set of vehicles, not to {}", describe(inside.kinds)));
  }
  if (facts.kinds == Kinds(Kind::vehicles) && inside.kinds == Kinds(Kind::task)) {
    auto const& source = diagnostics_.source();
    auto const limited = fmt::format("{}[{}]", source.text(n.index->span), source.text(n.object->span));
    base::Hint hint(fmt::format("write {}", limited));
    if (std::holds_alternative<ast::Name>(n.index->node)) hint.fix = {{expr.span, limited}};
    diagnostics_.report(code("not-a-task"), expr.span, "a task is limited to vehicles, not vehicles to a task",
                        std::move(hint));
  }
}

/// `otherwise task` stands in `oneOf` and `choose`.
void Checker::otherwise(ast::Chain const& chain) {
  auto const choice = std::ranges::find(contexts_.rbegin(), contexts_.rend(), BlockKind::choice, &BlockContext::kind);
  if (choice == contexts_.rend()) {
    diagnostics_.report(code("misplaced-when"), chain.head_span, "otherwise stands outside oneOf and choose");
  } else if (choice->name == "allOf") {
    diagnostics_.report(code("misplaced-when"), chain.head_span, "allOf runs every branch, so it has no otherwise",
                        "write when { condition } then task");
  }
}

void Checker::chain(ast::Expr const& expr) {
  auto const& n = std::get<ast::Chain>(expr.node);
  bool const in_choice =
      std::ranges::any_of(contexts_, [](BlockContext const& context) { return context.kind == BlockKind::choice; });
  if (n.is_otherwise) {
    otherwise(n);
  } else if (n.kind == ast::ChainKind::when && !in_choice) {
    diagnostics_.report(code("misplaced-when"), n.head_span, "when stands outside oneOf, choose and allOf",
                        "outside of them write waitFor { ... } then task");
  }
  auto const outer = place_;
  bool const is_guard = n.kind != ast::ChainKind::watch && n.kind != ast::ChainKind::during;
  place_.in_task = place_.in_task || is_guard;
  expression(n.subject);
  place_.in_task = true;
  auto const* handler = std::get_if<ast::Closure>(&n.body->node);
  if (n.kind == ast::ChainKind::watch && handler) {
    closure(*handler, BlockContext{BlockKind::handler, "onError", block_words(BlockKind::handler)});
  } else {
    place_.in_task = outer.in_task;
    bool const can_stop = n.kind == ast::ChainKind::until || n.kind == ast::ChainKind::during;
    place_.can_be_stopped = place_.can_be_stopped || can_stop;
    expression(n.body);
  }
  place_ = outer;
  bool const is_choice = n.kind == ast::ChainKind::when || n.kind == ast::ChainKind::wait_for;
  if (is_choice && place_.can_be_stopped) consuming_guard(*n.subject);
  if (n.kind == ast::ChainKind::during) value(*n.subject, code("argument-value"), 0.0, 1e9, "a time limit");
  auto const& task = n.kind == ast::ChainKind::watch ? n.subject : n.body;
  auto const facts = inference_.facts(*task);
  if (!facts.kinds.meets(Kind::task)) {
    diagnostics_.report(code("not-a-task"), task->span,
                        fmt::format("a task is needed here, this is {}", describe(facts.kinds)),
                        facts.kinds == Kinds(Kind::closure) ? wrapped_in_action(*task) : base::Hint());
  }
  auto const limit = inference_.facts(*n.subject);
  bool const wrong_dimension = n.kind == ast::ChainKind::during && limit.dimension &&
                               *limit.dimension != Dimension::none && *limit.dimension != Dimension::time;
  if (wrong_dimension) {
    diagnostics_.report(code("argument-dimension"), n.subject->span,
                        fmt::format("during takes a time, this is {}", noun(*limit.dimension)));
  }
}

}  // namespace lapwing::dolphin
