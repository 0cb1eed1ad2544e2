#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>

#include "dolphin/names/resolver.hpp"
#include "dolphin/names/signatures.hpp"

namespace lapwing::dolphin {

/// What is known of a value before the script runs.
struct Facts {
  Kinds kinds = Kinds::any();          ///< it is one of these
  std::optional<Dimension> dimension;  ///< of a number; nothing: unknown; none: a plain number

  [[nodiscard]] bool is_number() const { return kinds.within(Kinds::number()) && !kinds.is_none(); }
};

/// Works out what expressions can be, from literals, instructions and all values that are assigned to a variable. Never
/// wrong about what it knows, and content to know nothing.
class Inference {
 public:
  Inference(Resolution const& resolution, std::span<tasks::BuilderSpec const> builders)
      : resolution_(resolution), builders_(builders) {}

  [[nodiscard]] Facts facts(ast::Expr const& expr) { return facts(expr, max_depth); }
  [[nodiscard]] Facts facts(Variable const& variable) { return facts(variable, max_depth); }
  /// The value, when it is the same in every run.
  [[nodiscard]] std::optional<tasks::Argument> constant(ast::Expr const& expr) const;

 private:
  /// Deeper expressions are not looked at, so that checking stays linear.
  static constexpr int max_depth = 24;

  struct Visitor;

  Facts facts(ast::Expr const& expr, int depth);
  Facts facts(Variable const& variable, int depth);
  Facts facts_of_name(ast::Expr const& expr, int depth);
  Facts facts_of_binary(ast::Binary const& binary, int depth);
  Facts facts_of_member(ast::Member const& member, int depth);
  Facts facts_of_call(ast::Call const& call, int depth);

  Resolution const& resolution_;
  std::span<tasks::BuilderSpec const> builders_;
  std::unordered_map<Variable const*, Facts> known_;
};

[[nodiscard]] UnitSpec const* find_unit(std::string_view name);

}  // namespace lapwing::dolphin
