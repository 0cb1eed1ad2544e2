#pragma once

#include <optional>
#include <string>

#include "base/error.hpp"
#include "mavlink/signing.hpp"

namespace lapwing::apps {

/// A secret that lies in a file of its own, which nobody but its owner can read (mode 0600).
struct SecretFile {
  std::string path;
  std::string what;  ///< for people: "token file"
  std::string hint;  ///< how to make one
};
/// Without the blanks around it; at most a page of text. Errors (invalid_input, not_found, io) never hold any of it.
[[nodiscard]] base::Result<std::string> read_secret(SecretFile const& file);

/// The key for signing MAVLink: 64 hexadecimal digits are the key itself, anything else is a pass phrase. Without a
/// path there is none.
[[nodiscard]] base::Result<std::optional<mavlink::SigningKey>> read_signing_key(std::string const& path);

/// Of the option --signing-key.
inline constexpr auto signing_key_help =
    "File with the key that all MAVLink is signed with; what is not signed with it is not listened to";

}  // namespace lapwing::apps
