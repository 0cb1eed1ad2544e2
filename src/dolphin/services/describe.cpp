#include "dolphin/services/describe.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "geo/position.hpp"

namespace lapwing::dolphin {

namespace {

using base::Span;

std::string_view unit_of(Dimension dimension) {
  switch (dimension) {
    case Dimension::none: return "";
    case Dimension::length: return "metres";
    case Dimension::angle: return "degrees";
    case Dimension::time: return "seconds";
    case Dimension::speed: return "metres per second";
    case Dimension::ratio: return "0 to 1";
  }
  return "";
}

std::string value_text(tasks::Argument const& value) {
  struct Visitor {
    std::string operator()(std::monostate) const { return "null"; }
    std::string operator()(bool one) const { return one ? "true" : "false"; }
    std::string operator()(std::int64_t one) const { return fmt::format("{}", one); }
    std::string operator()(double one) const { return std::isnan(one) ? "NaN" : fmt::format("{}", one); }
    std::string operator()(std::string const& one) const { return fmt::format("'{}'", one); }
    std::string operator()(geo::Wgs84 const&) const { return "a position"; }
    std::string operator()(geo::Ned const&) const { return "a displacement"; }
    std::string operator()(tasks::List const& one) const { return one.empty() ? "[]" : "a list"; }
    std::string operator()(geo::Area const&) const { return "an area"; }
    std::string operator()(tasks::LayerName const& one) const { return (*this)(one.text); }
  };
  return std::visit(Visitor{}, value);
}

/// What is taken when the argument is left out, where the platform says so.
std::optional<std::string> fallback(InstructionSpec const& spec, BlockWords const* block, std::size_t signature,
                                    std::size_t parameter) {
  if (!block || !block->builder || block->words.empty()) return std::nullopt;
  auto const index = static_cast<std::size_t>(&spec - block->words.data());
  if (index >= block->words.size()) return std::nullopt;
  auto const& one = block->builder->commands[index].overloads[signature].parameters[parameter];
  return one.fallback ? std::optional(value_text(*one.fallback)) : std::nullopt;
}

void add_parameter(CallText& out, std::string_view text) {
  auto const begin = static_cast<std::uint32_t>(out.text.size());
  out.text += text;
  out.parameters.push_back({begin, static_cast<std::uint32_t>(out.text.size())});
}

std::string code_block(std::string_view code) {
  return fmt::format("```dolphin\n{}\n```", code);
}

std::string doc_above(Span place, Document const& document) {
  auto const& source = document.source();
  auto line = source.line(place.begin);
  std::vector<std::string_view> lines;
  while (line > 1) {
    auto const text = source.text(source.line_span(--line));
    auto const begin = text.find_first_not_of(" \t");
    if (begin == std::string_view::npos || !text.substr(begin).starts_with("//")) break;
    auto words = text.substr(begin + 2);
    words.remove_prefix(std::min(words.find_first_not_of(" /"), words.size()));
    lines.push_back(words);
  }
  std::ranges::reverse(lines);
  return fmt::format("{}", fmt::join(lines, "\n"));
}

std::string_view scope_text(VariableKind kind) {
  switch (kind) {
    case VariableKind::global: return "global variable";
    case VariableKind::local: return "local variable";
    case VariableKind::parameter: return "parameter";
  }
  return "variable";
}

}  // namespace

std::string kind_text(Facts const& facts) {
  auto out = describe(facts.kinds);
  bool const has_unit = facts.is_number() && facts.dimension && *facts.dimension != Dimension::none;
  return has_unit ? fmt::format("{} ({})", out, unit_of(*facts.dimension)) : out;
}

CallText call_text(InstructionSpec const& spec, BlockWords const* block, std::size_t index) {
  CallText out{.text = std::string(spec.name), .parameters = {}};
  auto const& signature = spec.signatures[index];
  bool const is_block = spec.block != BlockKind::none && signature.parameters.size() == 1;
  if (is_block) {
    out.text += ' ';
    add_parameter(out, "{ ... }");
    return out;
  }
  if (signature.parameters.empty()) out.text += "()";
  for (std::size_t i = 0; i < signature.parameters.size(); ++i) {
    auto const& parameter = signature.parameters[i];
    out.text += i == 0 ? " " : ", ";
    auto const value = fallback(spec, block, index, i);
    auto const ending = value ? " = " + *value : std::string(parameter.optional ? "?" : "");
    add_parameter(out, fmt::format("{}{}", parameter.name, ending));
  }
  if (signature.repeats) out.text += ", ...";
  return out;
}

CallText call_text(ast::FunctionDecl const& function, Document const& document) {
  CallText out{.text = function.name.text + "(", .parameters = {}};
  for (auto const& parameter : function.parameters) {
    if (!out.parameters.empty()) out.text += ", ";
    auto text = parameter.name.text;
    if (parameter.fallback) text += fmt::format(" = {}", document.text(parameter.fallback->span));
    add_parameter(out, text);
  }
  out.text += ')';
  return out;
}

std::string parameter_text(InstructionSpec const& spec, BlockWords const* block, std::size_t signature,
                           std::size_t parameter) {
  auto const& one = spec.signatures[signature].parameters[parameter];
  auto out = describe(one.kinds);
  if (!one.items.is_any()) out += fmt::format(", each item {}", describe(one.items));
  if (one.dimension != Dimension::none) out += fmt::format(" in {}", unit_of(one.dimension));
  if (!one.choices.empty()) out = fmt::format("one of {}", fmt::join(one.choices, ", "));
  if (auto const value = fallback(spec, block, signature, parameter)) {
    out += fmt::format(", {} if left out", *value);
  } else if (one.optional) {
    out += ", may be left out";
  }
  return one.doc.empty() ? out : fmt::format("{}: {}", out, one.doc);
}

std::string describe_word(InstructionSpec const& spec, BlockWords const* block) {
  std::vector<std::string> calls;
  std::vector<std::string> parameters;
  for (std::size_t i = 0; i < spec.signatures.size(); ++i) {
    calls.push_back(call_text(spec, block, i).text);
    for (std::size_t j = 0; j < spec.signatures[i].parameters.size(); ++j) {
      auto line = fmt::format("- `{}`: {}", spec.signatures[i].parameters[j].name, parameter_text(spec, block, i, j));
      if (std::ranges::find(parameters, line) == parameters.end()) parameters.push_back(std::move(line));
    }
  }
  auto out = code_block(fmt::format("{}", fmt::join(calls, "\n"))) + "\n" + std::string(spec.doc);
  if (spec.block == BlockKind::none && !parameters.empty()) out += fmt::format("\n\n{}", fmt::join(parameters, "\n"));
  if (!spec.result.is_none()) out += fmt::format("\n\nGives {}.", kind_text({spec.result, spec.dimension}));
  if (block) out += fmt::format("\n\nInside `{} {{ ... }}`.", block->name);
  if (!spec.example.empty()) out += fmt::format("\n\nFor example:\n{}", code_block(spec.example));
  return out;
}

std::string describe_word(BlockWords const& block) {
  std::vector<std::string_view> words;
  for (auto const& one : block.words) words.push_back(one.name);
  auto const doc = block.builder ? block.builder->doc : std::string_view();
  return fmt::format("{}\n{}\n\nCommands: {}", code_block(fmt::format("{} {{ ... }}", block.name)), doc,
                     fmt::join(words, ", "));
}

std::string describe_word(ChainSpec const& chain) {
  return fmt::format("{}\n{}", code_block(chain.usage), chain.doc);
}

std::string describe_word(UnitSpec const& unit) {
  auto const value = fmt::format("1.{} is {}{}{}", unit.name, unit.factor, unit.dimension == Dimension::none ? "" : " ",
                                 unit.dimension == Dimension::ratio ? "of the whole" : unit_of(unit.dimension));
  return fmt::format("{}\n{}. {}", code_block(fmt::format("n.{}", unit.name)), unit.doc, value);
}

std::string describe_word(MethodSpec const& method) {
  auto const call = fmt::format(".{}{}", method.name, method.is_property ? "" : fmt::format("({})", method.arguments));
  auto const example = method.example.empty() ? "" : fmt::format("\n\nFor example `{}`.", method.example);
  return fmt::format("{}\n{}\n\nOf {}; gives {}.{}", code_block(call), method.doc, describe(method.receiver),
                     describe(method.result), example);
}

std::string describe_word(Variable const& variable, Document const& document) {
  auto out =
      fmt::format("{}\n", code_block(fmt::format("{}  // {}", variable.name, kind_text(document.facts(variable)))));
  if (variable.defined.size() == 0) return out + "The parameter of this closure.";
  out +=
      fmt::format("{}, defined in line {}", scope_text(variable.kind), document.source().line(variable.defined.begin));
  auto const doc = doc_above(variable.defined, document);
  return doc.empty() ? out : fmt::format("{}\n\n{}", out, doc);
}

std::string describe_word(std::vector<ast::FunctionDecl const*> const& functions, Document const& document) {
  std::vector<std::string> calls;
  for (auto const* one : functions) calls.push_back("def " + call_text(*one, document).text);
  auto const place = functions.front()->name.span;
  auto const doc = doc_above(place, document);
  auto const out =
      fmt::format("{}\nfunction, defined in line {}", code_block(fmt::format("{}", fmt::join(calls, "\n"))),
                  document.source().line(place.begin));
  return doc.empty() ? out : fmt::format("{}\n\n{}", out, doc);
}

}  // namespace lapwing::dolphin
