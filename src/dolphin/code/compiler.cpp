#include "dolphin/code/compiler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <variant>

#include "dolphin/builtin/natives.hpp"
#include "dolphin/code/internal/compilation.hpp"
#include "dolphin/names/prelude.hpp"
#include "dolphin/syntax/codes.hpp"
#include "dolphin/syntax/parser.hpp"

namespace lapwing::dolphin {
namespace internal {

std::shared_ptr<Function const> Compilation::script(ast::Program const& tree, bool is_library) {
  is_library_ = is_library;
  functions_ = is_library ? &program_.method_index : &program_.function_index;
  declare_functions(tree.body);
  FunctionBuilder main(nullptr, is_library ? "prelude" : "script");
  function_ = &main;
  body(tree.body);
  function_ = nullptr;
  return main.finish();
}

std::shared_ptr<Function const> Compilation::answer(ast::Expr const& expr) {
  functions_ = &program_.function_index;
  for (std::size_t i = 0; i < program_.globals.size(); ++i) globals_[program_.globals[i]] = static_cast<int>(i);
  FunctionBuilder main(nullptr, "answer");
  function_ = &main;
  expression(expr);
  main.emit(Op::return_value);
  function_ = nullptr;
  return main.finish();
}

namespace {

/// Whether an answer to `ask` has no effects and only names that `program` knows.
class Purity {
 public:
  explicit Purity(Program const& program) : program_(program) {}

  bool holds(ast::Expr const& expr) const {
    return std::visit([&](auto const& node) { return is_pure(node); }, expr.node);
  }

 private:
  bool all(auto const& parts) const {
    return std::ranges::all_of(parts, [&](auto const& part) { return holds(*part); });
  }
  bool is_pure(ast::NullLiteral const&) const { return true; }
  bool is_pure(ast::BoolLiteral const&) const { return true; }
  bool is_pure(ast::IntegerLiteral const&) const { return true; }
  bool is_pure(ast::DecimalLiteral const&) const { return true; }
  bool is_pure(ast::StringLiteral const&) const { return true; }
  bool is_pure(ast::GString const& node) const {
    return std::ranges::all_of(node.pieces, [&](auto const& piece) {
      auto const* part = std::get_if<ast::ExprPtr>(&piece);
      return !part || holds(**part);
    });
  }
  bool is_pure(ast::Name const& node) const {
    return std::ranges::find(program_.globals, node.text) != program_.globals.end() || node.text == "PI" ||
           node.text == "E" || node.text == "NaN" || node.text == "Math";
  }
  bool is_pure(ast::ListLiteral const& node) const { return all(node.items); }
  bool is_pure(ast::MapLiteral const& node) const {
    return std::ranges::all_of(node.entries, [&](auto const& e) { return holds(*e.key) && holds(*e.value); });
  }
  bool is_pure(ast::Range const& node) const { return holds(*node.first) && holds(*node.last); }
  bool is_pure(ast::Unary const& node) const { return holds(*node.operand); }
  bool is_pure(ast::Binary const& node) const {
    return node.op != ast::BinaryOp::shift_left && holds(*node.left) && holds(*node.right);
  }
  bool is_pure(ast::Ternary const& node) const {
    return holds(*node.condition) && holds(*node.if_true) && holds(*node.if_false);
  }
  bool is_pure(ast::Member const& node) const { return holds(*node.object); }
  bool is_pure(ast::Index const& node) const { return holds(*node.object) && holds(*node.index); }
  bool is_pure(ast::Call const& node) const {
    auto const is_pure_argument = [&](auto const& argument) { return !argument.name && holds(*argument.value); };
    if (!std::ranges::all_of(node.arguments, is_pure_argument)) return false;
    if (auto const* method = std::get_if<ast::Member>(&node.callee->node)) return is_pure_method(*method);
    auto const* name = std::get_if<ast::Name>(&node.callee->node);
    auto const native = name ? find_native(name->text) : std::nullopt;
    return native && natives()[static_cast<std::size_t>(*native)].is_pure;
  }
  /// Methods that change nothing; `Math.sqrt(2)`.
  bool is_pure_method(ast::Member const& method) const {
    auto const* type = std::get_if<ast::Name>(&method.object->node);
    if (type && type->text == "Math") return method.name.text != "random";
    auto const is_it = [&](MethodSpec const& one) { return one.is_pure && one.name == method.name.text; };
    return std::ranges::any_of(methods(), is_it) && holds(*method.object);
  }
  bool is_pure(auto const&) const { return false; }

  Program const& program_;
};

}  // namespace
}  // namespace internal

std::shared_ptr<Program const> compile(ast::Program const& tree, std::shared_ptr<base::SourceFile const> source,
                                       tasks::Vocabulary const& vocabulary, base::Diagnostics& diagnostics) {
  auto program = std::make_shared<Program>();
  program->source = std::move(source);
  base::SourceFile const prelude_source("prelude", prelude());
  base::Diagnostics prelude_diagnostics(prelude_source);
  auto const prelude_tree = parse(prelude_diagnostics);
  internal::Compilation library(*program, vocabulary, prelude_diagnostics);
  (void)library.script(prelude_tree, true);
  if (prelude_diagnostics.has_errors()) {
    diagnostics.report(code("internal"), {}, "the prelude does not compile:\n" + base::render(prelude_diagnostics));
    return nullptr;
  }
  program->main = internal::Compilation(*program, vocabulary, diagnostics).script(tree, false);
  if (diagnostics.has_errors()) return nullptr;
  return program;
}

std::shared_ptr<Function const> compile_answer(std::string const& text, Program const& program) {
  base::SourceFile const source("answer", text);
  base::Diagnostics diagnostics(source);
  auto const tree = parse(diagnostics);
  if (diagnostics.has_errors() || tree.body.statements.size() != 1) return nullptr;
  auto const* statement = std::get_if<ast::ExprStmt>(&tree.body.statements.front()->node);
  if (!statement || !internal::Purity(program).holds(*statement->expr)) return nullptr;
  // A program of its own with the same global variables: the running one stays as it is.
  Program scratch;
  scratch.globals = program.globals;
  auto function = internal::Compilation(scratch, {}, diagnostics).answer(*statement->expr);
  return diagnostics.has_errors() ? nullptr : function;
}

}  // namespace lapwing::dolphin
