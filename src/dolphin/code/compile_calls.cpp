#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ranges>
#include <variant>

#include "dolphin/builtin/natives.hpp"
#include "dolphin/code/internal/compilation.hpp"
#include "dolphin/value/objects.hpp"

namespace lapwing::dolphin::internal {
namespace {

ast::Closure const* only_closure(ast::Call const& node) {
  if (node.arguments.size() != 1 || node.arguments.front().name) return nullptr;
  return std::get_if<ast::Closure>(&node.arguments.front().value->node);
}

bool has_names(ast::Call const& node) {
  return std::ranges::any_of(node.arguments, [](auto const& argument) { return argument.name.has_value(); });
}

/// Named arguments are gathered into one.
std::size_t given_count(ast::Call const& node) {
  auto const named =
      std::ranges::count_if(node.arguments, [](auto const& argument) { return argument.name.has_value(); });
  return node.arguments.size() - static_cast<std::size_t>(named > 0 ? named - 1 : 0);
}

bool is_choice(std::string_view name) {
  return name == "oneOf" || name == "choose" || name == "allOf";
}

}  // namespace

std::span<BlockWords const> built_in_blocks() {
  static std::array<BlockWords, 3> const blocks = {{
      {"pick", {"count", "type", "id", "payload", "region", "timeout"}},
      {"pos", {"lat", "lon", "hae", "height"}},
      {"moveDistance", {"north", "east", "down"}},
  }};
  return blocks;
}

bool Compilation::is_platform_block(std::string_view name) const {
  return std::ranges::any_of(vocabulary_.builders, [&](auto const& builder) { return builder.name == name; });
}

bool Compilation::has_command(std::string_view block, std::string_view command) const {
  for (auto const& words : built_in_blocks()) {
    if (words.name == block) return std::ranges::find(words.commands, command) != words.commands.end();
  }
  auto const& builders = vocabulary_.builders;
  auto const builder = std::ranges::find(builders, block, &tasks::BuilderSpec::name);
  return builder != builders.end() &&
         std::ranges::any_of(builder->commands, [&](auto const& known) { return known.name == command; });
}

void Compilation::call(ast::Call const& node, base::Span span) {
  if (auto const* name = std::get_if<ast::Name>(&node.callee->node)) return named_call(name->text, node, span);
  if (auto const* member = std::get_if<ast::Member>(&node.callee->node)) return method_call(*member, node);
  expression(*node.callee);
  int const count = arguments(node.arguments);
  function_->emit(Op::call_value, 0, count);
}

void Compilation::named_call(std::string const& name, ast::Call const& node, base::Span span) {
  if (block_command(name, node)) return;
  if (auto const function = function_for(name, given_count(node))) {
    int const count = arguments(node.arguments);
    function_->emit(Op::call_function, *function, count);
    return;
  }
  if (block_call(name, node)) return;
  if (has_names(node) && (name == "execute" || name == "setConnectionTimeout")) return keyed_call(name, node);
  if (name == "imcPlan" && only_closure(node)) {
    return diagnostics_.report(code("imc-plan"), span, "IMC plans are not supported",
                               "define a mission { ... } or load a plan by its name");
  }
  if (name == "poll") {
    int const count = arguments(node.arguments);
    function_->emit(Op::call_function, program_.method_index.at("poll"), count);
    return;
  }
  if (find_native(name)) return native_call(name, arguments(node.arguments), span);
  auto const added = std::ranges::find(vocabulary_.instructions, name, &tasks::VehicleInstruction::name);
  if (added != vocabulary_.instructions.end()) return vehicle_instruction(*added, node, span);
  load(name);
  int const count = arguments(node.arguments);
  function_->emit(Op::call_value, 0, count);
}

bool Compilation::block_command(std::string const& name, ast::Call const& node) {
  for (auto const& block : blocks_ | std::views::reverse) {
    if (!has_command(block, name)) continue;
    int const count = arguments(node.arguments);
    auto& commands = function_->function().commands;
    commands.push_back({block, name});
    function_->emit(Op::block_command, static_cast<int>(commands.size()) - 1, count);
    return true;
  }
  return false;
}

void Compilation::built(std::string_view block, ast::Closure const& node) {
  function_->emit(Op::begin_block, function_->name(block));
  blocks_.emplace_back(block);
  closure(node);
  blocks_.pop_back();
  function_->emit(Op::call_value, 0, 0);
  function_->emit(Op::pop);
  function_->emit(Op::end_block);
}

bool Compilation::block_call(std::string const& name, ast::Call const& node) {
  if (name == "move" && node.arguments.size() == 2) {
    auto const* displacement = std::get_if<ast::Closure>(&node.arguments[1].value->node);
    if (!displacement) return false;
    expression(*node.arguments[0].value);
    built("moveDistance", *displacement);
    native_call("move", 2, node.callee->span);
    return true;
  }
  auto const* block = only_closure(node);
  if (!block) return false;
  if (name == "pick") {
    built("pick", *block);
    native_call("pick", 1, node.callee->span);
    return true;
  }
  if (name == "pos" || name == "moveDistance" || is_choice(name) || is_platform_block(name)) {
    built(name, *block);
    return true;
  }
  return false;
}

void Compilation::method_call(ast::Member const& callee, ast::Call const& node) {
  auto& f = *function_;
  auto const* type = std::get_if<ast::Name>(&callee.object->node);
  if (type && is_type_name(type->text) && !is_variable(type->text)) {
    int const count = arguments(node.arguments);
    f.emit(Op::call_static, f.name(type->text + "." + callee.name.text), count);
    return;
  }
  if (callee.is_spread) {
    return each_element(*callee.object, [&] {
      int const count = arguments(node.arguments);
      f.emit(Op::call_method, f.name(callee.name.text), count);
    });
  }
  expression(*callee.object);
  int const nothing = callee.safe ? f.emit(Op::jump_if_null) : -1;
  int const count = arguments(node.arguments);
  f.emit(Op::call_method, f.name(callee.name.text), count);
  if (nothing >= 0) f.patch(nothing);
}

int Compilation::arguments(std::vector<ast::Argument> const& arguments) {
  int count = 0;
  if (std::ranges::any_of(arguments, [](auto const& argument) { return argument.name.has_value(); })) {
    named_arguments(arguments);
    ++count;
  }
  for (auto const& argument : arguments) {
    if (argument.name) continue;
    expression(*argument.value);
    ++count;
  }
  if (count > 255)
    diagnostics_.report(code("argument-count"), arguments.front().value->span, "more than 255 arguments");
  return count;
}

void Compilation::named_arguments(std::vector<ast::Argument> const& arguments) {
  int count = 0;
  for (auto const& argument : arguments) {
    if (!argument.name) continue;
    text(argument.name->text);
    expression(*argument.value);
    ++count;
  }
  function_->emit(Op::make_map, count);
}

/// `execute v: t, _: u`: for each entry the key's text, the key's value (null for `_`) and the entry's value.
void Compilation::keyed_call(std::string const& native, ast::Call const& node) {
  int count = 0;
  for (auto const& argument : node.arguments) {
    if (!argument.name) {
      diagnostics_.report(code("named-arguments"), argument.value->span,
                          "every part needs a vehicle set before it: name: value");
      continue;
    }
    text(argument.name->text);
    if (argument.name->text == "_") function_->emit(Op::null);
    if (argument.name->text != "_") name(argument.name->text, argument.name->span);
    expression(*argument.value);
    count += 3;
  }
  if (count > 255) diagnostics_.report(code("argument-count"), node.callee->span, "more than 85 parts");
  function_->emit(Op::call_native, find_native(native + " keyed").value(), count);
}

void Compilation::native_call(std::string_view name, int count, base::Span span) {
  int const index = find_native(name).value();
  auto const& native = natives()[static_cast<std::size_t>(index)];
  if (!native.signatures.empty()) check_count(name, argument_count(native), count, span);
  function_->emit(Op::call_native, index, count);
}

/// A platform's: its name goes before what it is given.
void Compilation::vehicle_instruction(tasks::VehicleInstruction const& instruction, ast::Call const& node,
                                      base::Span span) {
  text(std::string(instruction.name));
  int const count = arguments(node.arguments);
  auto const is_needed = [](tasks::Parameter const& parameter) { return !parameter.fallback; };
  auto const needed = static_cast<std::size_t>(std::ranges::count_if(instruction.parameters, is_needed));
  auto const known = instruction.parameters.size();
  check_count(instruction.name, {1 + needed, 1 + known + (instruction.takes_values ? 1 : 0)}, count, span);
  function_->emit(Op::call_native, find_native("vehicle instruction").value(), 1 + count);
}

void Compilation::check_count(std::string_view name, ArgumentCount takes, int count, base::Span span) {
  if (takes.allows(static_cast<std::size_t>(count))) return;
  auto const expected =
      takes.least == takes.most ? fmt::format("{}", takes.least) : fmt::format("{} to {}", takes.least, takes.most);
  diagnostics_.report(code("argument-count"), span,
                      fmt::format("{} takes {} arguments, not {}", name, expected, count));
}

void Compilation::chain(ast::Chain const& node, base::Span span) {
  expression(*node.subject);
  expression(*node.body);
  switch (node.kind) {
    case ast::ChainKind::wait_for: return native_call("waitFor", 2, span);
    case ast::ChainKind::until: return native_call("until", 2, span);
    case ast::ChainKind::watch: return native_call("watch", 2, span);
    case ast::ChainKind::during: function_->emit(Op::call_function, program_.method_index.at("during"), 2); return;
    case ast::ChainKind::when: {
      if (!std::ranges::any_of(blocks_, is_choice)) {
        diagnostics_.report(code("misplaced-when"), node.head_span, "when stands only inside oneOf, choose or allOf",
                            "write waitFor { ... } then ...");
      }
      auto& commands = function_->function().commands;
      commands.push_back({"choice", "when"});
      function_->emit(Op::block_command, static_cast<int>(commands.size()) - 1, 2);
    }
  }
}

}  // namespace lapwing::dolphin::internal
