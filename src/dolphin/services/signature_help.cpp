#include "dolphin/services/signature_help.hpp"

#include <algorithm>

#include "dolphin/services/cursor.hpp"

namespace lapwing::dolphin {

namespace {

SignatureHelp of_functions(std::vector<ast::FunctionDecl const*> const& functions, Document const& document) {
  SignatureHelp out;
  for (auto const* one : functions) {
    out.signatures.push_back({call_text(*one, document), {}, std::vector<std::string>(one->parameters.size())});
  }
  return out;
}

SignatureHelp of_instruction(Callee const& callee) {
  SignatureHelp out;
  for (std::size_t i = 0; i < callee.spec->signatures.size(); ++i) {
    SignatureHelp::Signature made{call_text(*callee.spec, callee.block, i), std::string(callee.spec->doc), {}};
    for (std::size_t j = 0; j < callee.spec->signatures[i].parameters.size(); ++j) {
      made.parameter_docs.push_back(parameter_text(*callee.spec, callee.block, i, j));
    }
    out.signatures.push_back(std::move(made));
  }
  return out;
}

}  // namespace

std::optional<SignatureHelp> signature_help(Document const& document, std::uint32_t offset) {
  auto const cursor = cursor_at(document, offset);
  if (cursor.in_comment) return std::nullopt;
  auto const call = open_call(document, cursor);
  if (!call) return std::nullopt;
  auto const name = document.text(document.stream().tokens[call->callee].span);
  auto const callee = callee_named(name, blocks_round(document, cursor), document.vocabulary());
  SignatureHelp out;
  auto const functions = document.resolution().functions.find(name);
  if (functions != document.resolution().functions.end() && !callee.block) {
    out = of_functions(functions->second, document);
  } else if (callee.spec) {
    out = of_instruction(callee);
  }
  if (out.signatures.empty()) return std::nullopt;
  auto const takes = [&](SignatureHelp::Signature const& one) { return one.parameter_docs.size() > call->argument; };
  auto const fits = std::ranges::find_if(out.signatures, takes);
  if (fits != out.signatures.end()) out.active_signature = static_cast<std::size_t>(fits - out.signatures.begin());
  out.active_parameter = call->argument;
  return out;
}

}  // namespace lapwing::dolphin
