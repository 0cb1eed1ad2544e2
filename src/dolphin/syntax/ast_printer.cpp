#include "dolphin/syntax/ast_printer.hpp"

#include <fmt/format.h>

#include <string_view>

namespace lapwing::dolphin {

namespace {

std::string_view symbol(ast::BinaryOp op) {
  using enum ast::BinaryOp;
  switch (op) {
    case power: return "**";
    case multiply: return "*";
    case divide: return "/";
    case remainder: return "%";
    case add: return "+";
    case subtract: return "-";
    case shift_right: return ">>";
    case shift_left: return "<<";
    case less: return "<";
    case less_equal: return "<=";
    case greater: return ">";
    case greater_equal: return ">=";
    case in: return "in";
    case equal: return "==";
    case not_equal: return "!=";
    case compare: return "<=>";
    case bit_and: return "&";
    case bit_xor: return "^";
    case bit_or: return "|";
    case logical_and: return "&&";
    case logical_or: return "||";
    case elvis: return "?:";
    case find: return "=~";
    case match: return "==~";
  }
  return "?";
}

std::string_view symbol(ast::UnaryOp op) {
  using enum ast::UnaryOp;
  switch (op) {
    case logical_not: return "!";
    case minus: return "-";
    case plus: return "+";
    case complement: return "~";
  }
  return "?";
}

std::string_view head(ast::ChainKind kind) {
  using enum ast::ChainKind;
  switch (kind) {
    case wait_for: return "waitFor";
    case when: return "when";
    case until: return "until";
    case during: return "during";
    case watch: return "watch";
  }
  return "?";
}

std::string print(ast::ExprPtr const& expr) {
  return expr ? print_tree(*expr) : "nothing";
}

std::string print(ast::Block const& block) {
  std::string out = "{";
  for (auto const& statement : block.statements) {
    if (out.size() > 1) out += "; ";
    out += print_tree(*statement);
  }
  return out + "}";
}

std::string print(std::vector<ast::Argument> const& arguments) {
  std::string out;
  for (auto const& argument : arguments) {
    out += argument.name ? fmt::format(" {}: {}", argument.name->text, print(argument.value))
                         : " " + print(argument.value);
  }
  return out;
}

std::string print(std::vector<ast::Parameter> const& parameters) {
  std::string out;
  for (auto const& parameter : parameters) {
    if (!out.empty()) out += ", ";
    if (parameter.type) out += parameter.type->text + " ";
    out += parameter.name.text;
    if (parameter.fallback) out += " = " + print(parameter.fallback);
  }
  return out;
}

std::string print(std::vector<ast::Identifier> const& names) {
  std::string out;
  for (auto const& name : names) out += (out.empty() ? "" : " ") + name.text;
  return out;
}

std::string quoted(std::string_view text) {
  std::string out = "'";
  for (char const c : text) {
    if (c == '\n') {
      out += "\\n";
    } else {
      out += c;
    }
  }
  return out + "'";
}

struct ExprPrinter {
  std::string operator()(ast::ErrorExpr const&) const { return "<error>"; }
  std::string operator()(ast::NullLiteral const&) const { return "null"; }
  std::string operator()(ast::BoolLiteral const& n) const { return n.value ? "true" : "false"; }
  std::string operator()(ast::IntegerLiteral const& n) const { return fmt::format("{}", n.value); }
  std::string operator()(ast::DecimalLiteral const& n) const { return fmt::format("{:#}", n.value); }
  std::string operator()(ast::StringLiteral const& n) const { return quoted(n.value); }
  std::string operator()(ast::GString const& n) const {
    std::string out = "(text";
    for (auto const& piece : n.pieces) {
      auto const* text = std::get_if<std::string>(&piece);
      out += " " + (text ? quoted(*text) : print(std::get<ast::ExprPtr>(piece)));
    }
    return out + ")";
  }
  std::string operator()(ast::PatternLiteral const& n) const { return "/" + n.text + "/"; }
  std::string operator()(ast::Name const& n) const { return n.text; }
  std::string operator()(ast::ListLiteral const& n) const {
    std::string out = "[";
    for (auto const& item : n.items) out += (out.size() > 1 ? ", " : "") + print(item);
    return out + "]";
  }
  std::string operator()(ast::MapLiteral const& n) const {
    std::string out = "[";
    for (auto const& entry : n.entries)
      out += (out.size() > 1 ? ", " : "") + print(entry.key) + ": " + print(entry.value);
    return n.entries.empty() ? "[:]" : out + "]";
  }
  std::string operator()(ast::Range const& n) const {
    return fmt::format("({} {} {})", n.inclusive ? ".." : "..<", print(n.first), print(n.last));
  }
  std::string operator()(ast::Unary const& n) const { return fmt::format("({} {})", symbol(n.op), print(n.operand)); }
  std::string operator()(ast::Step const& n) const {
    auto const* sign = n.by > 0 ? "++" : "--";
    return n.prefix ? fmt::format("({}_ {})", sign, print(n.target)) : fmt::format("(_{} {})", sign, print(n.target));
  }
  std::string operator()(ast::Binary const& n) const {
    return fmt::format("({} {} {})", symbol(n.op), print(n.left), print(n.right));
  }
  std::string operator()(ast::Cast const& n) const { return fmt::format("(as {} {})", print(n.operand), n.type.text); }
  std::string operator()(ast::InstanceOf const& n) const {
    return fmt::format("(instanceof {} {})", print(n.operand), n.type.text);
  }
  std::string operator()(ast::Ternary const& n) const {
    return fmt::format("(? {} {} {})", print(n.condition), print(n.if_true), print(n.if_false));
  }
  std::string operator()(ast::Member const& n) const {
    return fmt::format("{}{}{}", print(n.object), n.is_spread ? "*." : n.safe ? "?." : ".", n.name.text);
  }
  std::string operator()(ast::Index const& n) const {
    return fmt::format("(at {} {})", print(n.object), print(n.index));
  }
  std::string operator()(ast::Call const& n) const {
    return fmt::format("({} {}{})", n.style == ast::CallStyle::label ? "label" : "call", print(n.callee),
                       print(n.arguments));
  }
  std::string operator()(ast::New const& n) const { return fmt::format("(new {}{})", n.type.text, print(n.arguments)); }
  std::string operator()(ast::Closure const& n) const {
    auto const body = print(n.body);
    return n.has_arrow ? fmt::format("{{{} -> {}", print(n.parameters), body.substr(1)) : body;
  }
  std::string operator()(ast::Chain const& n) const {
    if (n.is_otherwise) return fmt::format("(otherwise {})", print(n.body));
    return fmt::format("({} {} {})", head(n.kind), print(n.subject), print(n.body));
  }
};

struct StmtPrinter {
  std::string operator()(ast::ExprStmt const& n) const { return print(n.expr); }
  std::string operator()(ast::Assign const& n) const {
    std::string targets = print(n.target);
    for (auto const& one : n.more) targets += (n.unpacks ? ", " : " = ") + print(one);
    return fmt::format("({}= {} {})", n.op ? symbol(*n.op) : "", n.unpacks ? "[" + targets + "]" : targets,
                       print(n.value));
  }
  std::string operator()(ast::VarDecl const& n) const {
    auto const names = n.unpacks ? "[" + print(n.names) + "]" : print(n.names);
    return fmt::format("({} {} {})", n.type ? n.type->text : "def", names, print(n.value));
  }
  std::string operator()(ast::FunctionDecl const& n) const {
    return fmt::format("(def {}({}) {})", n.name.text, print(n.parameters), print(n.body));
  }
  std::string operator()(ast::If const& n) const {
    auto const otherwise = n.otherwise ? " " + print(*n.otherwise) : "";
    return fmt::format("(if {} {}{})", print(n.condition), print(n.then), otherwise);
  }
  std::string operator()(ast::While const& n) const {
    if (n.body_first) return fmt::format("(do {} while {})", print(n.body), print(n.condition));
    return fmt::format("(while {} {})", print(n.condition), print(n.body));
  }
  std::string operator()(ast::For const& n) const {
    auto const part = [](ast::StmtPtr const& statement) { return statement ? print_tree(*statement) : "nothing"; };
    return fmt::format("(for {} {} {} {})", part(n.init), print(n.condition), part(n.update), print(n.body));
  }
  std::string operator()(ast::ForIn const& n) const {
    return fmt::format("(for-in {} {} {})", n.variable.text, print(n.iterable), print(n.body));
  }
  std::string operator()(ast::Switch const& n) const {
    std::string out = fmt::format("(switch {}", print(n.subject));
    for (auto const& one : n.cases)
      out += fmt::format(" ({} {})", one.value ? print(one.value) : "default", print(one.body));
    return out + ")";
  }
  std::string operator()(ast::Try const& n) const {
    std::string out = fmt::format("(try {}", print(n.body));
    for (auto const& one : n.catches) {
      auto const types = one.types.empty() ? "" : print(one.types) + " ";
      out += fmt::format(" (catch {}{} {})", types, one.name.text, print(one.body));
    }
    if (n.finally) out += fmt::format(" (finally {})", print(*n.finally));
    return out + ")";
  }
  std::string operator()(ast::Throw const& n) const { return fmt::format("(throw {})", print(n.value)); }
  std::string operator()(ast::Return const& n) const {
    return n.value ? fmt::format("(return {})", print(n.value)) : "(return)";
  }
  std::string operator()(ast::Break const&) const { return "(break)"; }
  std::string operator()(ast::Continue const&) const { return "(continue)"; }
  std::string operator()(ast::Assert const& n) const {
    return fmt::format("(assert {} {})", print(n.condition), print(n.message));
  }
  std::string operator()(ast::Import const& n) const { return fmt::format("(import {})", n.path); }
};

}  // namespace

std::string print_tree(ast::Expr const& expr) {
  return std::visit(ExprPrinter{}, expr.node);
}

std::string print_tree(ast::Stmt const& statement) {
  return std::visit(StmtPrinter{}, statement.node);
}

std::string print_tree(ast::Program const& program) {
  std::string out;
  for (auto const& statement : program.body.statements) out += print_tree(*statement) + "\n";
  return out;
}

}  // namespace lapwing::dolphin
