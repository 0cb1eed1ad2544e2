#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/text/source.hpp"

/// The syntax tree of a mission script (docs/reference, grammar in the language specification 1.7).
///
/// Plain structs owned from the top down. Every node has the span of its source text. The parser undoes spellings: a
/// command call and a call with parentheses are the same `Call`, `waitFor({c}).then(t)` and `waitFor {c} then t` the
/// same `Chain`. Parentheses leave only a flag. The height of a tree is limited by the parser (`max_tree_height`), so
/// recursive passes over it are safe.
namespace lapwing::dolphin::ast {

using base::Span;

inline constexpr std::uint16_t max_tree_height = 256;

struct Expr;
struct Stmt;
using ExprPtr = std::unique_ptr<Expr>;
using StmtPtr = std::unique_ptr<Stmt>;

/// A word with its place.
struct Identifier {
  std::string text;
  Span span;
};

/// Statements in order. A value of a closure or function body is that of its last statement when that is an expression
/// or assignment.
struct Block {
  std::vector<StmtPtr> statements;
  Span span;  ///< braces included where there are any
};

// ---- expressions --------------------------------------------------------------------------------

struct NullLiteral {};
struct BoolLiteral {
  bool value;
};
struct IntegerLiteral {
  std::int64_t value;
};
struct DecimalLiteral {
  double value;
};
/// Any string without interpolation; escapes already replaced.
struct StringLiteral {
  std::string value;
};
/// "text $name text ${expr}": pieces in order; adjacent texts are one.
struct GString {
  using Piece = std::variant<std::string, ExprPtr>;
  std::vector<Piece> pieces;
};
/// A variable, when it stands alone; a function (first) or a variable that holds a closure, when it is the callee of a
/// Call.
struct Name {
  std::string text;
};
struct ListLiteral {
  std::vector<ExprPtr> items;
};
struct MapEntry {
  ExprPtr key;  ///< a bare word before the colon is a StringLiteral
  ExprPtr value;
};
struct MapLiteral {
  std::vector<MapEntry> entries;
};
/// a..b, or a..<b without b.
struct Range {
  ExprPtr first;
  ExprPtr last;
  bool inclusive = true;
};

enum class UnaryOp { logical_not, minus, plus, complement };
struct Unary {
  UnaryOp op;
  ExprPtr operand;
};
/// ++x, x++, --x, x--.
struct Step {
  ExprPtr target;
  int by = 1;           ///< 1 or -1
  bool prefix = false;  ///< the value is the one after the step
};

/// `>> | / & ^ + -` mean what their operands at run time say (task, vehicle set, position, number).
enum class BinaryOp {
  power,
  multiply,
  divide,
  remainder,
  add,
  subtract,
  shift_right,
  shift_left,
  less,
  less_equal,
  greater,
  greater_equal,
  in,
  equal,
  not_equal,
  compare,
  bit_and,
  bit_xor,
  bit_or,
  logical_and,
  logical_or,
  elvis,
  find,   ///< =~
  match,  ///< ==~
};
struct Binary {
  BinaryOp op;
  ExprPtr left;
  ExprPtr right;
  Span op_span;
};
/// /x+/: a regular expression.
struct PatternLiteral {
  std::string text;
};
/// x as T, (T) x
struct Cast {
  ExprPtr operand;
  Identifier type;
};
/// x instanceof T
struct InstanceOf {
  ExprPtr operand;
  Identifier type;
};
struct Ternary {
  ExprPtr condition;
  ExprPtr if_true;
  ExprPtr if_false;
};

/// object.name, also a unit: 10.minutes.
struct Member {
  ExprPtr object;
  Identifier name;
  bool safe = false;       ///< ?.
  bool is_spread = false;  ///< *.: of each element
};
/// object[index]; task[vehicles].
struct Index {
  ExprPtr object;
  ExprPtr index;
};

/// One argument as written; named ones keep their key. `execute` and `setConnectionTimeout` take keys as variables
/// (lexical scope, `_` is any vehicle); everywhere else the named arguments are gathered, in written order, into one
/// map passed as first argument.
struct Argument {
  std::optional<Identifier> name;
  ExprPtr value;
};
enum class CallStyle {
  parentheses,  ///< f(a, b), and trailing closures: f {..}, f(a) {..}
  command,      ///< f a, b
  label,        ///< f: a   - inside builder blocks a mistaken spelling of `f a`, elsewhere an error of the checker
};
/// Callee Name: function, builder or builder command, else a variable with a closure (builder commands first, REC-36).
/// Callee Member: a method of the object (or a closure in a map). Anything else: a value to call. Trailing closures are
/// the last arguments.
struct Call {
  ExprPtr callee;
  std::vector<Argument> arguments;
  CallStyle style = CallStyle::parentheses;
};
struct New {
  Identifier type;
  std::vector<Argument> arguments;
};

struct Parameter {
  std::optional<Identifier> type;
  Identifier name;
  ExprPtr fallback;  ///< may be null
};
struct Closure {
  std::vector<Parameter> parameters;
  bool has_arrow = false;  ///< without an arrow there is one optional parameter, `it`
  Block body;
};

enum class ChainKind {
  wait_for,  ///< waitFor subject then body
  when,      ///< when subject then body (branch of allOf, oneOf, choose)
  until,     ///< until subject run body
  during,    ///< during subject run body; subject is a closure or seconds
  watch,     ///< watch subject onError body; subject is the task, body the handler
};
struct Chain {
  ChainKind kind;
  ExprPtr subject;
  ExprPtr body;
  Span head_span;             ///< the first word
  bool is_otherwise = false;  ///< `otherwise task`: the same as `when { true } then task`, and last
};

/// Stands where something was too wrong to keep; the sink then holds an error.
struct ErrorExpr {};

struct Expr {
  using Node = std::variant<ErrorExpr, NullLiteral, BoolLiteral, IntegerLiteral, DecimalLiteral, StringLiteral, GString,
                            PatternLiteral, Name, ListLiteral, MapLiteral, Range, Unary, Step, Binary, Cast, InstanceOf,
                            Ternary, Member, Index, Call, New, Closure, Chain>;
  Node node;
  Span span;  ///< parentheses not included
  bool in_parentheses = false;
  std::uint16_t height = 1;  ///< of the tree, statements of closures included
};

// ---- statements ---------------------------------------------------------------------------------

struct ExprStmt {
  ExprPtr expr;
};
/// Assigning to a name that is not declared makes a script-global variable, also inside closures and functions.
struct Assign {
  ExprPtr target;              ///< Name, Member or Index
  std::optional<BinaryOp> op;  ///< add for +=, and so on
  ExprPtr value;
  std::vector<ExprPtr> more = {};  ///< further targets: a = b = value, (a, b) = list; then there is no op
  bool unpacks = false;            ///< (a, b) = list: each target gets an element
};
/// def x = e, int k = 4, def (p, q) = list. A local: seen by nested closures, not by functions declared with def f().
struct VarDecl {
  std::optional<Identifier> type;  ///< nothing for def
  std::vector<Identifier> names;
  bool unpacks = false;  ///< def (p, q) = list
  ExprPtr value;         ///< may be null
};
struct FunctionDecl {
  Identifier name;
  std::vector<Parameter> parameters;
  Block body;
};
struct If {
  ExprPtr condition;
  Block then;
  std::optional<Block> otherwise;  ///< `else if` is a block of one If
};
struct While {
  ExprPtr condition;
  Block body;
  bool body_first = false;  ///< do { } while (condition)
};
/// for (init; condition; update); each part may be null.
struct For {
  StmtPtr init;
  ExprPtr condition;
  StmtPtr update;
  Block body;
};
struct ForIn {
  Identifier variable;
  ExprPtr iterable;
  Block body;
};
struct SwitchCase {
  ExprPtr value;  ///< null for default
  Block body;     ///< falls through to the next case unless it breaks
};
struct Switch {
  ExprPtr subject;
  std::vector<SwitchCase> cases;
};
struct Catch {
  std::vector<Identifier> types;  ///< none: everything
  Identifier name;
  Block body;
};
struct Try {
  Block body;
  std::vector<Catch> catches;
  std::optional<Block> finally;
};
struct Throw {
  ExprPtr value;
};
struct Return {
  ExprPtr value;  ///< may be null
};
struct Break {};
struct Continue {};
struct Assert {
  ExprPtr condition;
  ExprPtr message;  ///< may be null
};
/// Accepted and ignored, with a note.
struct Import {
  std::string path;
};

struct Stmt {
  using Node = std::variant<ExprStmt, Assign, VarDecl, FunctionDecl, If, While, For, ForIn, Switch, Try, Throw, Return,
                            Break, Continue, Assert, Import>;
  Node node;
  Span span;
  std::uint16_t height = 1;
};

/// A whole script. Spans point into the SourceFile it was parsed from.
struct Program {
  Block body;
  std::vector<Span> comments;  ///< in order, for formatters and hover texts
  std::vector<Span> unread;    ///< what the parser passed over after mistakes: names in it may be defined there
};

}  // namespace lapwing::dolphin::ast
