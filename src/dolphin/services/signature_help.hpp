#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dolphin/services/describe.hpp"

namespace lapwing::dolphin {

struct SignatureHelp {
  struct Signature {
    CallText call;
    std::string doc;
    std::vector<std::string> parameter_docs;  ///< one for each parameter, may be empty
  };
  std::vector<Signature> signatures;
  std::size_t active_signature = 0;  ///< the first that takes as many arguments
  std::size_t active_parameter = 0;
};

/// How the call whose arguments are being written at the offset goes.
[[nodiscard]] std::optional<SignatureHelp> signature_help(Document const& document, std::uint32_t offset);

}  // namespace lapwing::dolphin
