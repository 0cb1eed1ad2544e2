#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "dolphin/check/fixes.hpp"
#include "dolphin/check/internal/checker_class.hpp"
#include "dolphin/names/foreign_words.hpp"

namespace lapwing::dolphin {

namespace {

std::size_t least_arguments(SignatureSpec const& signature) {
  auto const optional = [](ParameterSpec const& parameter) { return parameter.optional; };
  return signature.parameters.size() - static_cast<std::size_t>(std::ranges::count_if(signature.parameters, optional));
}

bool takes_count(SignatureSpec const& signature, std::size_t count) {
  return count >= least_arguments(signature) && (signature.repeats || count <= signature.parameters.size());
}

ParameterSpec const& parameter_at(SignatureSpec const& signature, std::size_t position) {
  return signature.parameters[std::min(position, signature.parameters.size() - 1)];
}

/// "takeOff position [, pitch]"
std::string usage(InstructionSpec const& spec, SignatureSpec const& signature) {
  std::string out(spec.name);
  std::string brackets;
  for (std::size_t i = 0; i < signature.parameters.size(); ++i) {
    auto const& parameter = signature.parameters[i];
    out += parameter.optional ? (i == 0 ? " [" : " [, ") : (i == 0 ? " " : ", ");
    bool const is_named = spec.named == NamedArguments::values && parameter.kinds.meets(Kind::map);
    out += is_named ? "name: value" : parameter.name;
    if (parameter.optional) brackets += ']';
  }
  return out + brackets + (signature.repeats ? ", ..." : "") + (signature.parameters.empty() ? "()" : "");
}

std::string usages(InstructionSpec const& spec) {
  std::vector<std::string> all;
  for (auto const& signature : spec.signatures) all.push_back(usage(spec, signature));
  return fmt::format("write {}", fmt::join(all, " or "));
}

std::string counted(std::size_t count) {
  return count == 1 ? "1 argument" : fmt::format("{} arguments", count);
}

std::size_t positional_count(ast::Call const& call) {
  auto const positional = [](ast::Argument const& argument) { return !argument.name; };
  return static_cast<std::size_t>(std::ranges::count_if(call.arguments, positional));
}

}  // namespace

void Checker::call(ast::Expr const& expr) {
  auto const& n = std::get<ast::Call>(expr.node);
  duplicate_keys(n);
  auto const* callee = std::get_if<ast::Name>(&n.callee->node);
  if (std::holds_alternative<ast::Member>(n.callee->node)) return method_call(n);
  if (!callee) return value_call(n);
  auto const& text = callee->text;
  auto const* word = block_word(text);
  if (n.style == ast::CallStyle::label) {
    if (!word) {
      diagnostics_.report(code("label"), n.callee->span, fmt::format("a label does nothing: {}:", text),
                          is_callable(text) ? without_colon(diagnostics_.source(), n.callee->span)
                                            : base::Hint("a map is written in square brackets: [name: value]"));
      return arguments(n, std::nullopt);
    }
    diagnostics_.report(code("legacy-spelling"), n.callee->span, fmt::format("{} takes no colon", text),
                        without_colon(diagnostics_.source(), n.callee->span));
  }
  if (word) return instruction_call(n, expr.span, *word);
  auto const local = resolution_.locals.find(n.callee.get());
  if (local != resolution_.locals.end() && !is_callable(text)) return closure_call(n, expr.span, *local->second);
  if (auto const found = resolution_.functions.find(text); found != resolution_.functions.end()) {
    return function_call(n, expr.span, found->second);
  }
  if (auto const* instruction = resolution_.instructions.find(text))
    return instruction_call(n, expr.span, *instruction);
  if (auto const* builder = find_builder(text)) return builder_call(n, expr.span, *builder);
  if (auto const* variable = resolution_.find(*n.callee)) return closure_call(n, expr.span, *variable);
  undefined_call(n, n.callee->span);
}

void Checker::undefined_call(ast::Call const& call, base::Span span) {
  auto const& text = std::get<ast::Name>(call.callee->node).text;
  if (!may_be_defined_in_unread(text) && reported_.insert(text).second) {
    bool const in_mission = !contexts_.empty() && contexts_.back().kind == BlockKind::platform;
    base::Hint hint = in_mission ? hint_for_mission_word(text) : hint_for_call(text);
    if (hint.empty()) hint = suggestion(text, span);
    if (hint.empty()) hint = block_of(text);
    if (hint.empty()) hint = hint_in_mission(text);
    auto const where = contexts_.empty() ? "" : fmt::format(" inside {}", contexts_.back().name);
    diagnostics_.report(code("unknown-instruction"), span, fmt::format("there is no instruction {}{}", text, where),
                        std::move(hint));
  }
  arguments(call, std::nullopt);
}

/// `'abc'()`: a value that is written where it is called.
void Checker::value_call(ast::Call const& call) {
  expression(call.callee);
  arguments(call, std::nullopt);
  auto const kinds = inference_.facts(*call.callee).kinds;
  if (kinds.is_none() || kinds.meets(Kinds(Kind::closure) | Kind::other)) return;
  diagnostics_.report(code("unknown-instruction"), call.callee->span,
                      fmt::format("{} cannot be called", describe(kinds)));
}

/// Checks the values of all arguments; the closure at the end, if any, in the context of the block that it is.
void Checker::arguments(ast::Call const& call, std::optional<BlockContext> context) {
  for (auto const& argument : call.arguments) {
    auto const* body = std::get_if<ast::Closure>(&argument.value->node);
    if (context && body) {
      closure(*body, context);
    } else {
      expression(argument.value);
    }
  }
}

void Checker::duplicate_keys(ast::Call const& call) {
  for (std::size_t i = 1; i < call.arguments.size(); ++i) {
    auto const& name = call.arguments[i].name;
    if (!name) continue;
    auto const same = [&](ast::Argument const& other) { return other.name && other.name->text == name->text; };
    auto const earlier = std::span(call.arguments).first(std::min<std::size_t>(i, 200));
    auto const first = std::ranges::find_if(earlier, same);
    if (first == earlier.end()) continue;
    diagnostics_.report(code("duplicate-key"), name->span, fmt::format("duplicate key {}", name->text), {},
                        {{first->name->span, "it stands here already"}});
  }
}

// ---- instructions -------------------------------------------------------------------------------

void Checker::instruction_call(ast::Call const& call, base::Span span, InstructionSpec const& spec) {
  bool const is_imc_block = spec.name == "imcPlan" && call.arguments.size() == 1 &&
                            std::holds_alternative<ast::Closure>(call.arguments[0].value->node);
  if (is_imc_block) {
    diagnostics_.report(code("imc-plan"), call.callee->span, "IMC plans are not supported",
                        "define a mission { ... }, or write imcPlan('name') for a plan made elsewhere");
    return;
  }
  note_signals(call, spec.name);
  names_plans_ = names_plans_ || spec.name == "task" || spec.name == "imcPlan";
  std::optional<BlockContext> context;
  if (spec.block != BlockKind::none) context = BlockContext{spec.block, spec.name, block_words(spec.block)};
  auto const outer = place_;
  auto const before = diagnostics_.error_count();
  place_.in_task = place_.in_task || spec.name == "action" || spec.name == "condition";
  arguments(call, context);
  place_ = outer;
  bool const is_broken = diagnostics_.error_count() > before;  // what they are is not known
  if (spec.name == "execute" && place_.in_task) {
    diagnostics_.report(code("nested-execute"), call.callee->span, "execute inside a task fails",
                        "join the tasks with >> or | and execute them together");
  }
  auto const positional = positional_count(call);
  auto const named = call.arguments.size() - positional;
  if (named > 0 && spec.named == NamedArguments::none) {
    auto const first =
        std::ranges::find_if(call.arguments, [](ast::Argument const& argument) { return argument.name.has_value(); });
    diagnostics_.report(code("named-arguments"), first->name->span, fmt::format("{} has no named arguments", spec.name),
                        usages(spec));
    return;
  }
  if (named > 0 && spec.named == NamedArguments::vehicles) {
    if (positional > 0)
      diagnostics_.report(code("named-arguments"), span,
                          fmt::format("{} takes either one value or values with names", spec.name));
    return vehicle_keys(call, spec);
  }
  if (named > 0 && positional == 0) return;  // signals and parameters have any name
  if (!is_broken) signatures(call, span, spec);
  if (diagnostics_.error_count() > before) return;
  if (spec.name == "setConnectionTimeout" && positional == 1) connection_timeout(*call.arguments[0].value);
  if (spec.block == BlockKind::choice) empty_choice(call, spec);
  single_vehicle(call, spec);
  values(call, spec);
  areas(call, spec);
}

/// `execute v1: task`, `setConnectionTimeout v1: 30`: keys are variables that hold vehicles.
void Checker::vehicle_keys(ast::Call const& call, InstructionSpec const& spec) {
  bool const runs_tasks = spec.name == "execute";
  for (auto const& argument : call.arguments) {
    if (!argument.name) continue;
    auto const& key = *argument.name;
    auto const* variable = resolution_.find(key);
    read_.insert(variable);
    if (!variable && !(runs_tasks && key.text == "_")) undefined_name(key.text, key.span);
    auto const kinds = variable ? inference_.facts(*variable).kinds : Kinds::any();
    if (!kinds.meets(Kind::vehicles)) {
      diagnostics_.report(code("not-vehicles"), key.span,
                          fmt::format("{} is {}, not a set of vehicles", key.text, describe(kinds)),
                          "vehicles come from pick { ... }");
    }
    auto const value = inference_.facts(*argument.value).kinds;
    if (runs_tasks && !value.meets(Kind::task)) {
      diagnostics_.report(code("not-a-task"), argument.value->span,
                          fmt::format("execute runs tasks, this is {}", describe(value)),
                          value == Kinds(Kind::closure) ? wrapped_in_action(*argument.value) : base::Hint());
    }
    if (!runs_tasks) connection_timeout(*argument.value);
  }
}

void Checker::connection_timeout(ast::Expr const& value) {
  auto const facts = inference_.facts(value);
  if (!facts.kinds.meets(Kinds::number())) {
    diagnostics_.report(code("argument-type"), value.span,
                        fmt::format("a connection timeout is a time, this is {}", describe(facts.kinds)));
  } else if (facts.dimension && *facts.dimension != Dimension::none && *facts.dimension != Dimension::time) {
    diagnostics_.report(code("argument-dimension"), value.span,
                        fmt::format("a connection timeout is a time, this is {}", noun(*facts.dimension)));
  } else if (auto const constant = inference_.constant(value)) {
    auto const* whole = std::get_if<std::int64_t>(&*constant);
    auto const* decimal = std::get_if<double>(&*constant);
    auto const seconds = whole ? static_cast<double>(*whole) : decimal ? *decimal : 5.0;
    if (seconds < 5.0 || seconds > 3600.0)
      diagnostics_.report(code("argument-value"), value.span, "a connection timeout lies between 5 s and 1 h");
  }
}

/// Finds a signature that takes the arguments, or says what is wrong with the one that comes nearest.
void Checker::signatures(ast::Call const& call, base::Span span, InstructionSpec const& spec) {
  auto const count = positional_count(call);
  SignatureSpec const* nearest = nullptr;
  std::size_t furthest = 0;
  for (auto const& signature : spec.signatures) {
    if (!takes_count(signature, count)) continue;
    auto const wrong = mismatch(call, signature);
    if (!wrong) return;
    if (!nearest || *wrong > furthest) {
      nearest = &signature;
      furthest = *wrong;
    }
  }
  if (nearest) return report_mismatch(call, spec, *nearest, furthest);
  diagnostics_.report(code("argument-count"), span, fmt::format("{} does not take {}", spec.name, counted(count)),
                      usages(spec));
}

/// The position of the first argument that the signature does not take.
std::optional<std::size_t> Checker::mismatch(ast::Call const& call, SignatureSpec const& signature) {
  std::size_t position = 0;
  for (auto const& argument : call.arguments) {
    if (argument.name) continue;
    auto const& parameter = parameter_at(signature, position);
    auto const facts = inference_.facts(*argument.value);
    if (!facts.kinds.is_none() && !facts.kinds.meets(parameter.kinds)) return position;
    bool const wrong_dimension = parameter.dimension != Dimension::none && facts.dimension &&
                                 *facts.dimension != Dimension::none && *facts.dimension != parameter.dimension;
    if (wrong_dimension) return position;
    auto const* text = std::get_if<ast::StringLiteral>(&argument.value->node);
    bool const wrong_choice = text && !parameter.choices.empty() &&
                              std::ranges::find(parameter.choices, text->value) == parameter.choices.end();
    if (wrong_choice || wrong_item(*argument.value, parameter)) return position;
    ++position;
  }
  return std::nullopt;
}

/// Of a list that is written out: the place of the first thing in it that does not belong there.
std::optional<std::size_t> Checker::wrong_item(ast::Expr const& value, ParameterSpec const& parameter) {
  auto const* list = std::get_if<ast::ListLiteral>(&value.node);
  if (!list || parameter.items.is_any()) return std::nullopt;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    auto const facts = inference_.facts(*list->items[i]);
    bool const wrong_dimension = parameter.dimension != Dimension::none && facts.dimension &&
                                 *facts.dimension != Dimension::none && *facts.dimension != parameter.dimension;
    if (!facts.kinds.meets(parameter.items) || wrong_dimension) return i;
  }
  return std::nullopt;
}

void Checker::report_item(ast::Expr const& item, std::size_t number, InstructionSpec const& spec,
                          ParameterSpec const& parameter) {
  auto const facts = inference_.facts(item);
  bool const is_number = facts.kinds.meets(parameter.items);  // so it is of another dimension
  auto const needed =
      parameter.dimension == Dimension::none ? describe(parameter.items) : std::string(noun(parameter.dimension));
  diagnostics_.report(is_number ? code("argument-dimension") : code("argument-type"), item.span,
                      fmt::format("item {} of {} of {} is {}, not {}", number, parameter.name, spec.name, needed,
                                  is_number ? std::string(noun(*facts.dimension)) : describe(facts.kinds)));
}

/// Corners that are the same in every run are looked at before anything moves.
void Checker::areas(ast::Call const& call, InstructionSpec const& spec) {
  constexpr auto an_area = Kinds(Kind::area) | Kind::list;
  auto const has_area = [&](SignatureSpec const& one) {
    return std::ranges::find(one.parameters, an_area, &ParameterSpec::kinds) != one.parameters.end();
  };
  if (std::ranges::none_of(spec.signatures, has_area)) return;
  auto const fits = [&](SignatureSpec const& one) {
    return takes_count(one, positional_count(call)) && !mismatch(call, one);
  };
  auto const signature = std::ranges::find_if(spec.signatures, fits);
  if (signature == spec.signatures.end()) return;
  std::size_t position = 0;
  for (auto const& argument : call.arguments) {
    if (argument.name) continue;
    auto const& parameter = parameter_at(*signature, position++);
    auto const known = parameter.kinds == an_area ? inference_.constant(*argument.value) : std::nullopt;
    auto const area = known ? tasks::area_from(*known) : std::nullopt;
    if (auto const fault = area ? geo::area_fault(*area) : std::nullopt)
      diagnostics_.report(code("argument-value"), argument.value->span,
                          fmt::format("{} of {} is no area: {}", parameter.name, spec.name, *fault));
  }
}

void Checker::report_mismatch(ast::Call const& call, InstructionSpec const& spec, SignatureSpec const& signature,
                              std::size_t position) {
  auto const& parameter = parameter_at(signature, position);
  std::size_t seen = 0;
  auto const wanted = [&](ast::Argument const& argument) { return !argument.name && seen++ == position; };
  auto const& value = *std::ranges::find_if(call.arguments, wanted)->value;
  if (auto const item = wrong_item(value, parameter))
    return report_item(*std::get<ast::ListLiteral>(value.node).items[*item], *item + 1, spec, parameter);
  auto const facts = inference_.facts(value);
  auto const* text = std::get_if<ast::StringLiteral>(&value.node);
  if (text && parameter.kinds.meets(Kind::text)) {
    diagnostics_.report(code("argument-choice"), value.span,
                        fmt::format("{} of {} is one of {}, not {}", parameter.name, spec.name,
                                    fmt::join(parameter.choices, ", "), text->value),
                        did_you_mean_in_quotes(diagnostics_.source(), value, text->value, parameter.choices));
    return;
  }
  auto const chosen =
      std::ranges::find_if(signature.parameters, [](ParameterSpec const& one) { return !one.choices.empty(); });
  auto hint = usage(spec, signature);
  if (text && chosen != signature.parameters.end()) {
    hint = fmt::format("{}; {} is one of {}", hint, chosen->name, fmt::join(chosen->choices, ", "));
  }
  bool const takes_quantity = parameter.dimension != Dimension::none && parameter.kinds.meets(Kinds::number());
  bool const is_number = takes_quantity && facts.kinds.meets(Kinds::number());
  auto const needed = takes_quantity ? std::string(noun(parameter.dimension)) : describe(parameter.kinds);
  auto const found = is_number && facts.dimension ? std::string(noun(*facts.dimension)) : describe(facts.kinds);
  bool const is_closure_for_task = parameter.kinds == Kinds(Kind::task) && facts.kinds == Kinds(Kind::closure);
  auto const& kind = is_number ? code("argument-dimension") : code("argument-type");
  diagnostics_.report(kind, value.span, fmt::format("{} of {} is {}, not {}", parameter.name, spec.name, needed, found),
                      is_closure_for_task ? wrapped_in_action(value) : base::Hint(fmt::format("write {}", hint)));
}

// ---- functions and builders ---------------------------------------------------------------------

void Checker::function_call(ast::Call const& call, base::Span span,
                            std::vector<ast::FunctionDecl const*> const& functions) {
  arguments(call, std::nullopt);
  auto const positional = positional_count(call);
  auto const count = positional + (positional < call.arguments.size() ? 1 : 0);  // all named ones are one map
  for (auto const* function : functions) {
    auto const least =
        std::ranges::count_if(function->parameters, [](ast::Parameter const& one) { return !one.fallback; });
    // A call without arguments may leave a single parameter null, as in Groovy.
    bool const leaves_null = count == 0 && function->parameters.size() == 1;
    bool const fits = count >= static_cast<std::size_t>(least) && count <= function->parameters.size();
    if (fits && functions.size() == 1) declared_arguments(call, *function);
    if (fits || leaves_null) return;
  }
  std::vector<std::string_view> parameters;
  for (auto const& parameter : functions.front()->parameters) parameters.push_back(parameter.name.text);
  auto const& name = functions.front()->name;
  diagnostics_.report(code("argument-count"), span, fmt::format("{} does not take {}", name.text, counted(count)),
                      fmt::format("it takes ({})", fmt::join(parameters, ", ")), {{name.span, "it is defined here"}});
}

/// False, with a complaint, when no value of the variable can be called: `v pick { }` lacks its =.
bool Checker::is_closure(ast::Call const& call, Variable const& variable) {
  auto const kinds = inference_.facts(variable).kinds;
  if (kinds.is_none() || kinds.meets(Kinds(Kind::closure) | Kind::other)) return true;
  auto const is_command = call.style == ast::CallStyle::command;
  auto const behind = call.callee->span.end;
  diagnostics_.report(code("unknown-instruction"), call.callee->span,
                      fmt::format("{} is {}, which cannot be called", variable.name, describe(kinds)),
                      is_command ? base::Hint(fmt::format("to change its value write {} = ...", variable.name),
                                              {{{behind, behind}, " ="}})
                                 : base::Hint());
  return false;
}

/// `f = { a, b -> ... }; f(1)`, when the variable holds one closure all the time. A list may stand for several
/// arguments.
void Checker::closure_call(ast::Call const& call, base::Span span, Variable const& variable) {
  arguments(call, std::nullopt);
  read_.insert(&variable);
  if (used_too_early(*call.callee, variable) || !is_closure(call, variable)) return;
  auto const* value = only_value(&variable);
  auto const* made = value ? std::get_if<ast::Closure>(&value->node) : nullptr;
  if (!made) return;
  auto const positional = positional_count(call);
  auto const count = positional + (positional < call.arguments.size() ? 1 : 0);
  auto const most = made->has_arrow ? made->parameters.size() : 1;
  auto const required = static_cast<std::size_t>(
      std::ranges::count_if(made->parameters, [](ast::Parameter const& one) { return !one.fallback; }));
  constexpr auto simple = Kinds::number() | Kind::text | Kind::boolean | Kind::task | Kind::position | Kind::closure;
  bool const may_spread = count == 1 && !inference_.facts(*call.arguments.front().value).kinds.within(simple);
  if ((count >= required && count <= most) || (count == 0 && required == 1) || may_spread) return;
  diagnostics_.report(code("argument-count"), span, fmt::format("{} does not take {}", variable.name, counted(count)),
                      {}, {{value->span, "it is made here"}});
}

void Checker::builder_call(ast::Call const& call, base::Span span, Builder const& builder) {
  auto const name = builder.spec->name;
  auto const before = diagnostics_.error_count();
  arguments(call, BlockContext{BlockKind::platform, name, builder.words});
  if (call.arguments.size() != 1 || call.arguments[0].name) {
    diagnostics_.report(code("argument-count"), span, fmt::format("{} takes a block", name),
                        fmt::format("write {} {{ ... }}", name));
    return;
  }
  auto const& value = *call.arguments[0].value;
  if (auto const facts = inference_.facts(value); !facts.kinds.meets(Kind::closure)) {
    diagnostics_.report(code("argument-type"), value.span,
                        fmt::format("{} takes a block, not {}", name, describe(facts.kinds)),
                        fmt::format("write {} {{ ... }}", name));
    return;
  }
  auto const* body = std::get_if<ast::Closure>(&value.node);
  if (!body) return;
  // A command that was not understood is missing in the block: what is said of the rest would be a follow-up mistake.
  bool const is_whole = diagnostics_.error_count() == before && !diagnostics_.has_error_within(value.span);
  if (is_whole) rehearse(*body, builder, call.callee->span);
}

/// Lets the platform build the block from the arguments that are known, so that it finds now what it would refuse
/// later.
void Checker::rehearse(ast::Closure const& body, Builder const& builder, base::Span span) {
  if (!builder.spec->begin) return;
  auto const& [problem, task, unreached, doubts] = tasks_.rehearsed(body, *builder.spec);
  if (unreached) {
    diagnostics_.report(code("unreachable-code"), *unreached, "this is never reached: what stands before it never ends",
                        "give it a time or a number of turns, or make a mission of its own of what follows");
  }
  for (auto const& [place, doubt] : doubts)
    diagnostics_.report(code("implausible-mission"), place.size() > 0 ? place : span, doubt.what, doubt.hint);
  if (problem) {
    auto const place = problem->place.size() > 0 ? problem->place : span;
    diagnostics_.report(code("invalid-mission"), place, problem->error.message, problem->error.hint);
  }
}

}  // namespace lapwing::dolphin
