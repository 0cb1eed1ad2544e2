#include "dolphin/names/needs.hpp"

#include <cmath>
#include <string_view>
#include <variant>

#include "dolphin/check/inference.hpp"
#include "dolphin/names/resolver.hpp"
#include "dolphin/syntax/ast_walk.hpp"

namespace lapwing::dolphin {

using namespace ast;

namespace {

/// More vehicles than any platform holds: what asks for more says it wrongly.
constexpr std::int64_t most_vehicles = 1000;

std::optional<double> as_number(std::optional<tasks::Argument> const& value) {
  if (!value) return std::nullopt;
  if (auto const* whole = std::get_if<std::int64_t>(&*value)) return static_cast<double>(*whole);
  if (auto const* decimal = std::get_if<double>(&*value)) return *decimal;
  return std::nullopt;
}

/// Reads what is the same in every run out of a tree: literals, variables that are assigned once, units, sums of these.
class Reader {
 public:
  explicit Reader(Program const& program) : resolution_(resolve(program)), inference_(resolution_, {}) {}

  Needs read(Block const& body) {
    for (auto const& statement : body.statements) visit(*statement);
    if (!needs_.home) needs_.home = first_place_;
    return std::move(needs_);
  }

 private:
  void visit(Stmt const& statement) {
    for_each_child(statement.node, [this](auto const& child) { visit(child); });
  }
  void visit(Expr const& expr) {
    if (auto const* call = std::get_if<Call>(&expr.node)) look_at(*call, expr);
    for_each_child(expr.node, [this](auto const& child) { visit(child); });
  }

  void look_at(Call const& call, Expr const& expr) {
    auto const* name = std::get_if<Name>(&call.callee->node);
    if (!name || call.arguments.empty()) return;
    auto const& argument = *call.arguments.front().value;
    if (name->text == "home" && !needs_.home) {
      needs_.home = call.arguments.size() == 1 ? place(argument) : coordinates(call.arguments);
    }
    if (name->text == "location" && !first_place_) first_place_ = place(expr);
    if (name->text != "pick") return;
    if (auto const* fields = std::get_if<Closure>(&argument.node)) add_pick(*fields, expr.span);
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
      auto const value = inference_.constant(*argument.value);
      auto const* text = value ? std::get_if<std::string>(&*value) : nullptr;
      if (!text) return false;
      if (field == "type") need.type = *text;
      if (field == "payload") need.payload.push_back(*text);
    }
    return true;
  }

  std::optional<double> number(Expr const& expr) const { return as_number(inference_.constant(expr)); }

  static std::optional<geo::Wgs84> on_earth(double lat, double lon, double height) {
    bool const is_place = std::abs(lat) <= 90.0 && std::abs(lon) <= 360.0;
    return is_place ? std::optional(geo::Wgs84::from_degrees(lat, lon, height)) : std::nullopt;
  }
  std::optional<geo::Wgs84> place(Expr const& expr) const {
    auto const value = inference_.constant(expr);
    auto const* found = value ? std::get_if<geo::Wgs84>(&*value) : nullptr;
    return found ? on_earth(found->lat_deg(), found->lon_deg(), found->alt_m) : std::nullopt;
  }
  /// `home 41.2, -8.6, 90`
  std::optional<geo::Wgs84> coordinates(std::vector<Argument> const& arguments) const {
    if (arguments.size() > 3) return std::nullopt;
    double values[3] = {};
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      auto const value = number(*arguments[i].value);
      if (!value) return std::nullopt;
      values[i] = *value;
    }
    return on_earth(values[0], values[1], values[2]);
  }

  Resolution const resolution_;
  Inference const inference_;
  std::optional<geo::Wgs84> first_place_;
  Needs needs_;
};

}  // namespace

Needs needs_of(Program const& program) {
  return Reader(program).read(program.body);
}

}  // namespace lapwing::dolphin
