#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dolphin/services/document.hpp"

/// Words about words, in Markdown, for hover texts, completion and signature help.
namespace lapwing::dolphin {

/// A call as one writes it: `takeOff pos, pitch = 15`, with where each parameter stands in the text.
struct CallText {
  std::string text;
  std::vector<base::Span> parameters;
};

/// Signature `index` of an instruction, or of a command of `block`.
[[nodiscard]] CallText call_text(InstructionSpec const& spec, BlockWords const* block, std::size_t index);
[[nodiscard]] CallText call_text(ast::FunctionDecl const& function, Document const& document);
/// "an angle in degrees, 15 if left out: upwards from the horizon"
[[nodiscard]] std::string parameter_text(InstructionSpec const& spec, BlockWords const* block, std::size_t signature,
                                         std::size_t parameter);

/// All signatures, what it does, its parameters, and what a platform makes of it.
[[nodiscard]] std::string describe_word(InstructionSpec const& spec, BlockWords const* block);
[[nodiscard]] std::string describe_word(BlockWords const& block);
[[nodiscard]] std::string describe_word(ChainSpec const& chain);
[[nodiscard]] std::string describe_word(UnitSpec const& unit);
[[nodiscard]] std::string describe_word(MethodSpec const& method);
[[nodiscard]] std::string describe_word(Variable const& variable, Document const& document);
[[nodiscard]] std::string describe_word(std::vector<ast::FunctionDecl const*> const& functions,
                                        Document const& document);

/// "a set of vehicles", "a time (number of seconds)".
[[nodiscard]] std::string kind_text(Facts const& facts);

}  // namespace lapwing::dolphin
