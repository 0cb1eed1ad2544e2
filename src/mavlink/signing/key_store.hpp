#pragma once

#include <string>
#include <string_view>

#include "base/error.hpp"
#include "mavlink/signing/signing_guard.hpp"

namespace lapwing::mavlink {

/// The text of a key store: TOML with the tables [keys] (name = 64 hexadecimal digits), [use] (`everybody`; `links` by
/// URL and `vehicles` by system id, with its network before it ("north/7") where it
/// belongs to one; each a name or a list of names) and [unsigned] (`local-links`, `systems`,
/// `messages` by name or number). `file` is the name for messages. Errors are invalid_input, say where ("a.keys:3:9:
/// ..."), and never hold any of the text's values: keys must not get into logs.
[[nodiscard]] base::Result<KeyRing> parse_key_store(std::string_view file, std::string_view text);
/// Reads back as the same ring.
[[nodiscard]] std::string to_text(KeyRing const& ring);

/// 64 hexadecimal digits. Nothing for any other text.
[[nodiscard]] std::optional<SigningKey> parse_key(std::string_view digits);

/// A name that a key may have: 1 to 40 letters, digits, `-` and `_`.
[[nodiscard]] bool is_key_name(std::string_view name);

}  // namespace lapwing::mavlink
