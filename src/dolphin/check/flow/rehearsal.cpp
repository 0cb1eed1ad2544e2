#include "dolphin/check/flow/rehearsal.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "tasks/platform.hpp"

namespace lapwing::dolphin {

namespace {

using tasks::Argument;

struct Prepared {
  std::size_t overload = 0;
  std::vector<Argument> arguments;
  bool is_certain = true;  ///< no stand-ins
};

Argument stand_in(tasks::Parameter const& parameter) {
  if (parameter.fallback) return *parameter.fallback;
  switch (parameter.type) {
    case tasks::Type::number: return 1.0;
    case tasks::Type::integer: return std::int64_t{1};
    case tasks::Type::text: return std::string(parameter.choices.empty() ? "text" : parameter.choices.front());
    case tasks::Type::boolean: return true;
    case tasks::Type::position: return geo::Wgs84{};
    case tasks::Type::displacement: return geo::Ned{};
    case tasks::Type::list: return tasks::List{};
    case tasks::Type::area: return geo::Area(geo::Disc{.center = {}, .radius_m = 1.0});
    case tasks::Type::layer: return tasks::LayerName{"layer"};
  }
  return {};
}

/// One value that is no list and no area, as the platform wants it, or nothing when it is of another type.
std::optional<Argument> converted(Argument const& value, tasks::Type type) {
  auto const as_it_is = [&](bool fits) { return fits ? std::optional(value) : std::nullopt; };
  switch (type) {
    case tasks::Type::number:
      if (auto const* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
      return as_it_is(std::holds_alternative<double>(value));
    case tasks::Type::integer:
      if (auto const* decimal = std::get_if<double>(&value)) {
        bool const fits = std::abs(*decimal) < 9e18;  // also false for NaN
        return fits ? std::optional<Argument>(std::int64_t{std::llround(*decimal)}) : std::nullopt;
      }
      return as_it_is(std::holds_alternative<std::int64_t>(value));
    case tasks::Type::text: return as_it_is(std::holds_alternative<std::string>(value));
    case tasks::Type::boolean: return as_it_is(std::holds_alternative<bool>(value));
    case tasks::Type::position: return as_it_is(std::holds_alternative<geo::Wgs84>(value));
    case tasks::Type::displacement: return as_it_is(std::holds_alternative<geo::Ned>(value));
    case tasks::Type::layer:
      if (auto const* name = std::get_if<std::string>(&value)) return tasks::LayerName{*name};
      return std::nullopt;
    case tasks::Type::area:
      if (auto area = tasks::area_from(value)) return *std::move(area);
      return std::nullopt;
    case tasks::Type::list: return as_it_is(std::holds_alternative<tasks::List>(value));
  }
  return std::nullopt;
}

/// The same for any parameter; of a list each item is looked at.
std::optional<Argument> converted(Argument const& value, tasks::Parameter const& parameter) {
  auto const* list = std::get_if<tasks::List>(&value);
  if (parameter.type != tasks::Type::list || !list) return converted(value, parameter.type);
  tasks::List out;
  for (auto const& item : *list) {
    auto const known = converted(tasks::argument_of(item), parameter.items);
    auto const plain = known ? tasks::item_of(*known) : std::nullopt;
    if (!plain) return std::nullopt;
    out.push_back(*plain);
  }
  return out;
}

bool may_take(tasks::Type type, Kinds kinds) {
  switch (type) {
    case tasks::Type::number:
    case tasks::Type::integer: return kinds.meets(Kinds::number());
    case tasks::Type::layer:
    case tasks::Type::text: return kinds.meets(Kind::text);
    case tasks::Type::boolean: return kinds.meets(Kind::boolean);
    case tasks::Type::position: return kinds.meets(Kind::position);
    case tasks::Type::displacement: return kinds.meets(Kind::displacement);
    case tasks::Type::list: return kinds.meets(Kind::list);
    case tasks::Type::area: return kinds.meets(Kinds(Kind::area) | Kind::list);
  }
  return false;
}

/// Nothing when the overload cannot take the arguments of the call.
std::optional<Prepared> prepare(ast::Call const& call, tasks::Overload const& overload, Inference& inference) {
  if (call.arguments.size() > overload.parameters.size()) return std::nullopt;
  Prepared out;
  for (std::size_t i = 0; i < overload.parameters.size(); ++i) {
    auto const& parameter = overload.parameters[i];
    if (i >= call.arguments.size()) {
      if (!parameter.fallback) return std::nullopt;
      out.arguments.push_back(*parameter.fallback);
      continue;
    }
    auto const& expr = *call.arguments[i].value;
    if (call.arguments[i].name || !may_take(parameter.type, inference.facts(expr).kinds)) return std::nullopt;
    auto const constant = inference.constant(expr);
    auto known = constant ? converted(*constant, parameter) : std::nullopt;
    out.is_certain = out.is_certain && known;
    out.arguments.push_back(known ? *known : stand_in(parameter));
  }
  return out;
}

struct Chosen {
  std::size_t command;
  Prepared prepared;
};

/// The command and the one overload that the call can mean; nothing when that is not certain.
std::optional<Chosen> choose(ast::Call const& call, tasks::BuilderSpec const& builder, Inference& inference) {
  auto const* callee = std::get_if<ast::Name>(&call.callee->node);
  if (!callee) return std::nullopt;
  auto const command = std::ranges::find(builder.commands, callee->text, &tasks::CommandSpec::name);
  if (command == builder.commands.end()) return std::nullopt;
  std::optional<Prepared> out;
  for (std::size_t i = 0; i < command->overloads.size(); ++i) {
    auto prepared = prepare(call, command->overloads[i], inference);
    if (!prepared) continue;
    if (out) return std::nullopt;
    prepared->overload = i;
    out = std::move(prepared);
  }
  if (!out) return std::nullopt;
  return Chosen{static_cast<std::size_t>(command - builder.commands.begin()), *std::move(out)};
}

using Commands = std::span<std::pair<Chosen, base::Span> const>;

bool never_ends(Commands commands, tasks::BuilderSpec const& builder) {
  auto const session = builder.begin();
  for (auto const& [command, place] : commands) {
    if (!session->add(command.command, command.prepared.overload, command.prepared.arguments)) return false;
  }
  auto const task = session->finish();
  return task && (*task)->never_ends();
}

/// Precondition: with all its commands the block never ends.
std::optional<base::Span> first_unreached(Commands commands, tasks::BuilderSpec const& builder) {
  std::size_t ends = 0;
  std::size_t never = commands.size();
  while (never - ends > 1) {
    auto const middle = (ends + never) / 2;
    (never_ends(commands.first(middle), builder) ? never : ends) = middle;
  }
  return never < commands.size() ? std::optional(commands[never].second) : std::nullopt;
}

/// The commands of a block; nothing when it has another statement, or one that is not certain.
std::optional<std::vector<std::pair<Chosen, base::Span>>> commands_of(ast::Closure const& body,
                                                                      tasks::BuilderSpec const& builder,
                                                                      Inference& inference) {
  std::vector<std::pair<Chosen, base::Span>> commands;
  for (auto const& statement : body.body.statements) {
    auto const* expr = std::get_if<ast::ExprStmt>(&statement->node);
    auto const* call = expr ? std::get_if<ast::Call>(&expr->expr->node) : nullptr;
    auto chosen = call ? choose(*call, builder, inference) : std::nullopt;
    if (!chosen) return std::nullopt;
    commands.emplace_back(*std::move(chosen), statement->span);
  }
  return commands;
}

}  // namespace

Rehearsal rehearsal(ast::Closure const& body, tasks::BuilderSpec const& builder, Inference& inference) {
  auto const commands = commands_of(body, builder, inference);
  if (!commands) return {};
  auto const session = builder.begin();
  bool all_certain = true;
  for (auto const& [command, place] : *commands) {
    auto const added = session->add(command.command, command.prepared.overload, command.prepared.arguments);
    if (!added && command.prepared.is_certain) return {RehearsalProblem{place, added.error()}, nullptr, {}};
    all_certain = all_certain && command.prepared.is_certain;
    if (!added) return {};  // what follows may depend on what a stand-in could not do
  }
  auto finished = session->finish();
  if (finished) {
    auto const unreached = (*finished)->never_ends() ? first_unreached(*commands, builder) : std::nullopt;
    std::vector<RehearsalDoubt> doubts;
    if (all_certain) {
      for (auto& doubt : session->doubts()) {
        auto const place = doubt.call ? commands->at(*doubt.call).second : base::Span();
        doubts.push_back({place, std::move(doubt)});
      }
    }
    return {std::nullopt, *std::move(finished), unreached, std::move(doubts)};
  }
  return all_certain ? Rehearsal{RehearsalProblem{{}, finished.error()}, nullptr, {}} : Rehearsal();
}

}  // namespace lapwing::dolphin
