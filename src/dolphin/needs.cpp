#include "dolphin/needs.hpp"

#include <cmath>
#include <string_view>
#include <unordered_map>
#include <variant>

#include "dolphin/ast_walk.hpp"

namespace lapwing::dolphin {

using namespace ast;

namespace {

/// More vehicles than any platform holds: what asks for more says it wrongly.
constexpr std::int64_t most_vehicles = 1000;

/// Reads literals out of a tree, through variables that are assigned once.
class Reader {
 public:
  Needs read(Block const& body) {
    for (auto const& statement : body.statements) note_names(*statement);
    for (auto const& statement : body.statements) visit(*statement);
    if (!needs_.home) needs_.home = first_place_;
    return std::move(needs_);
  }

 private:
  void note_names(Stmt const& statement) {
    if (auto const* assign = std::get_if<Assign>(&statement.node)) {
      if (auto const* name = std::get_if<Name>(&assign->target->node))
        note(name->text, assign->op ? nullptr : assign->value.get());
    }
    if (auto const* declared = std::get_if<VarDecl>(&statement.node))
      for (auto const& name : declared->names) note(name.text, declared->unpacks ? nullptr : declared->value.get());
    for_each_child(statement.node, [this](auto const& child) { note_names(child); });
  }
  void note_names(Expr const& expr) {
    for_each_child(expr.node, [this](auto const& child) { note_names(child); });
  }
  /// A second value makes it unknown.
  void note(std::string const& name, Expr const* value) {
    auto const [known, is_new] = values_.try_emplace(name, value);
    if (!is_new) known->second = nullptr;
  }

  void visit(Stmt const& statement) {
    for_each_child(statement.node, [this](auto const& child) { visit(child); });
  }
  void visit(Expr const& expr) {
    if (auto const* call = std::get_if<Call>(&expr.node)) look_at(*call, expr.span);
    for_each_child(expr.node, [this](auto const& child) { visit(child); });
  }

  void look_at(Call const& call, Span span) {
    auto const* name = std::get_if<Name>(&call.callee->node);
    if (!name || call.arguments.empty()) return;
    auto const& argument = *call.arguments.front().value;
    if (name->text == "home" && !needs_.home) needs_.home = place(argument);
    if (name->text == "location" && !first_place_) first_place_ = place_of(call);
    if (name->text != "pick") return;
    if (auto const* fields = std::get_if<Closure>(&argument.node)) add_pick(*fields, span);
  }

  void add_pick(Closure const& fields, Span span) {
    VehicleNeed need{.type = {}, .payload = {}, .span = span};
    bool is_clear = true;
    for (auto const& statement : fields.body.statements) {
      auto const* line = std::get_if<ExprStmt>(&statement->node);
      auto const* call = line ? std::get_if<Call>(&line->expr->node) : nullptr;
      auto const* field = call ? std::get_if<Name>(&call->callee->node) : nullptr;
      is_clear = is_clear && field && take_field(field->text, call->arguments, need);
    }
    if (is_clear) {
      needs_.vehicles.push_back(std::move(need));
    } else {
      needs_.unclear.push_back(span);
    }
  }

  /// False when the field says something that cannot be read, or a particular vehicle.
  bool take_field(std::string_view field, std::vector<Argument> const& arguments, VehicleNeed& need) const {
    if (field == "timeout" || field == "region") return true;
    if (arguments.empty()) return false;
    if (field == "count") {
      auto const count = number(*arguments.front().value);
      if (!count || *count < 1 || *count > most_vehicles || *count != std::floor(*count)) return false;
      need.count = static_cast<int>(*count);
      return true;
    }
    if (field != "type" && field != "payload") return false;
    for (auto const& argument : arguments) {
      auto const* text = std::get_if<StringLiteral>(&known(*argument.value).node);
      if (!text) return false;
      if (field == "type") need.type = text->value;
      if (field == "payload") need.payload.push_back(text->value);
    }
    return true;
  }

  /// Follows names to what they stand for.
  Expr const& known(Expr const& expr) const {
    auto const* found = &expr;
    for (int hops = 0; hops < 8; ++hops) {
      auto const* name = std::get_if<Name>(&found->node);
      auto const value = name ? values_.find(name->text) : values_.end();
      if (value == values_.end() || !value->second) break;
      found = value->second;
    }
    return *found;
  }

  std::optional<double> number(Expr const& expr) const {
    auto const& value = known(expr);
    if (auto const* integer = std::get_if<IntegerLiteral>(&value.node)) return static_cast<double>(integer->value);
    if (auto const* decimal = std::get_if<DecimalLiteral>(&value.node)) return decimal->value;
    auto const* unary = std::get_if<Unary>(&value.node);
    if (!unary || unary->op != UnaryOp::minus) return std::nullopt;
    auto const positive = number(*unary->operand);
    if (!positive) return std::nullopt;
    return -*positive;
  }

  std::optional<geo::Wgs84> place(Expr const& expr) const {
    auto const* call = std::get_if<Call>(&known(expr).node);
    auto const* name = call ? std::get_if<Name>(&call->callee->node) : nullptr;
    if (!name || name->text != "location") return std::nullopt;
    return place_of(*call);
  }
  std::optional<geo::Wgs84> place_of(Call const& call) const {
    if (call.arguments.size() != 2 && call.arguments.size() != 3) return std::nullopt;
    double values[3] = {};
    for (std::size_t i = 0; i < call.arguments.size(); ++i) {
      auto const value = number(*call.arguments[i].value);
      if (!value) return std::nullopt;
      values[i] = *value;
    }
    if (std::abs(values[0]) > 90.0 || std::abs(values[1]) > 180.0) return std::nullopt;
    return geo::Wgs84::from_degrees(values[0], values[1], values[2]);
  }

  std::unordered_map<std::string, Expr const*> values_;
  std::optional<geo::Wgs84> first_place_;
  Needs needs_;
};

}  // namespace

Needs needs_of(Program const& program) {
  return Reader().read(program.body);
}

}  // namespace lapwing::dolphin
