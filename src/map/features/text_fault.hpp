#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lapwing::map {

enum class Lines { one, many };

/// Why it is no text that may stand on the map ("is no UTF-8", "has 3000 bytes; at most 200 are taken"); nothing for a
/// sound one. Control characters and those that turn the direction of writing are none: texts come from anywhere and
/// go to terminals, pages and files.
[[nodiscard]] std::optional<std::string> text_fault(std::string_view text, std::size_t most_bytes,
                                                    Lines lines = Lines::one);
/// The same for an id, which must not be empty either.
[[nodiscard]] std::optional<std::string> id_fault(std::string_view id);
/// The same for the hash of something in the store: 64 digits of SHA-256.
[[nodiscard]] std::optional<std::string> hash_fault(std::string_view hash);

inline constexpr std::size_t most_id_bytes = 100;
inline constexpr std::size_t most_name_bytes = 200;
inline constexpr std::size_t most_text_bytes = 4'000;

}  // namespace lapwing::map
