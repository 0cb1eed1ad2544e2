#include "dolphin/services/view/inlay_hints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "dolphin/syntax/ast_walk.hpp"

namespace lapwing::dolphin {

namespace {

using base::Span;

std::string_view symbol(Dimension dimension) {
  switch (dimension) {
    case Dimension::length: return " m";
    case Dimension::time: return " s";
    case Dimension::angle: return "°";
    case Dimension::speed: return " m/s";
    case Dimension::none:
    case Dimension::ratio: return "";
  }
  return "";
}

/// A number as it stands in the text, a sign before it or not.
bool is_plain_number(ast::Expr const& expr) {
  auto const* unary = std::get_if<ast::Unary>(&expr.node);
  bool const is_signed = unary && unary->op != ast::UnaryOp::logical_not;
  auto const& node = is_signed ? unary->operand->node : expr.node;
  return std::holds_alternative<ast::IntegerLiteral>(node) || std::holds_alternative<ast::DecimalLiteral>(node);
}

/// Places in a mission whose heights are of interest once its home is known.
struct Mission {
  std::optional<double> home_altitude_m;
};

class Annotator {
 public:
  Annotator(Document const& document, Span within) : document_(document), within_(within) {}

  std::vector<InlayHint> run() {
    for (auto const& one : document_.program().body.statements) child_(*one);
    std::ranges::stable_sort(out_, {}, &InlayHint::offset);
    return std::move(out_);
  }

 private:
  void add(std::uint32_t offset, std::string text, InlayHint::Kind kind) {
    if (within_.begin <= offset && offset <= within_.end) out_.push_back({offset, std::move(text), kind});
  }

  /// Returns true when it has looked at what is inside, too.
  bool look_at(ast::Call const& call) {
    auto const* callee = std::get_if<ast::Name>(&call.callee->node);
    auto const* word = callee ? document_.occurrence_at(call.callee->span.begin) : nullptr;
    if (!word) return false;
    if (word->kind == WordKind::builder) {
      missions_.emplace_back();
      for (auto const& argument : call.arguments) child_(*argument.value);
      missions_.pop_back();
      return true;
    }
    if (!word->instruction) return false;
    if (auto const* signature = signature_for(call, *word->instruction)) arguments(call, *signature);
    if (word->kind == WordKind::command && !missions_.empty()) heights(call, callee->text == "home");
    return false;
  }

  [[nodiscard]] static SignatureSpec const* signature_for(ast::Call const& call, InstructionSpec const& spec) {
    auto const has_name = [](ast::Argument const& argument) { return argument.name.has_value(); };
    if (std::ranges::any_of(call.arguments, has_name)) return nullptr;
    auto const takes = [&](SignatureSpec const& one) { return one.parameters.size() >= call.arguments.size(); };
    auto const found = std::ranges::find_if(spec.signatures, takes);
    return found == spec.signatures.end() ? nullptr : &*found;
  }

  void arguments(ast::Call const& call, SignatureSpec const& signature) {
    for (std::size_t i = 0; i < call.arguments.size(); ++i) {
      auto const& value = *call.arguments[i].value;
      auto const& parameter = signature.parameters[i];
      if (!is_plain_number(value) || !parameter.kinds.meets(Kinds::number())) continue;
      auto const behind = end_of(value);
      bool const says_something = signature.parameters.size() > 1 && !signature.repeats;
      if (says_something) add(begin_of(value), fmt::format("{}:", parameter.name), InlayHint::Kind::parameter);
      if (auto const unit = symbol(parameter.dimension); !unit.empty())
        add(behind, std::string(unit), InlayHint::Kind::unit);
    }
  }

  /// Behind each position of a command: the first mistake in heights is to mix those above sea level and above home.
  void heights(ast::Call const& call, bool is_home) {
    auto& home = missions_.back().home_altitude_m;
    for (auto const& argument : call.arguments) {
      auto const known = document_.constant(*argument.value);
      auto const* place = known ? std::get_if<geo::Wgs84>(&*known) : nullptr;
      if (place && is_home) home = place->alt_m;
      if (!place || is_home || !home) continue;
      auto const above = std::round(place->alt_m - *home);
      auto const text = above < 0 ? fmt::format(" {} m below home", -above) : fmt::format(" {} m above home", above);
      add(end_of(*argument.value), text, InlayHint::Kind::height);
    }
    bool const is_in_numbers = is_home && call.arguments.size() == 3;
    auto const altitude = is_in_numbers ? document_.constant(*call.arguments[2].value) : std::nullopt;
    if (!altitude) return;
    if (auto const* whole = std::get_if<std::int64_t>(&*altitude)) home = static_cast<double>(*whole);
    if (auto const* decimal = std::get_if<double>(&*altitude)) home = *decimal;
  }

  /// Spans do not hold the parentheses round an expression.
  [[nodiscard]] std::uint32_t begin_of(ast::Expr const& expr) const {
    auto const before = document_.source().text().substr(0, expr.span.begin);
    bool const has_parenthesis = expr.in_parentheses && before.ends_with('(');
    return expr.span.begin - (has_parenthesis ? 1 : 0);
  }
  [[nodiscard]] std::uint32_t end_of(ast::Expr const& expr) const {
    auto const behind = document_.source().text().substr(expr.span.end);
    bool const has_parenthesis = expr.in_parentheses && behind.starts_with(')');
    return expr.span.end + (has_parenthesis ? 1 : 0);
  }

  struct Child {
    Annotator& self;
    void operator()(ast::Stmt const& one) const { ast::for_each_child(one.node, *this); }
    void operator()(ast::Expr const& one) const {
      auto const* call = std::get_if<ast::Call>(&one.node);
      if (call && self.look_at(*call)) return;
      ast::for_each_child(one.node, *this);
    }
  };

  Document const& document_;
  Span within_;
  std::vector<Mission> missions_;
  std::vector<InlayHint> out_;
  Child child_{*this};
};

}  // namespace

std::vector<InlayHint> inlay_hints(Document const& document, Span within) {
  return Annotator(document, within).run();
}

}  // namespace lapwing::dolphin
