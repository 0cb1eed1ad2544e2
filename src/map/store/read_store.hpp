#pragma once

#include <memory>
#include <string>

#include "map/store/store.hpp"

namespace lapwing::map {

/// A store to look back in, which is left as it is, also while a station writes it. What is told to be kept is not.
/// Errors: io; refused for a store of an older or a newer program; invalid_input for what is none.
[[nodiscard]] base::Result<std::unique_ptr<Store>> open_to_read(base::Loop& loop, std::string const& address);

/// Whether a program that takes stores and other things means a store by that: a server, or a folder with one in it.
[[nodiscard]] bool is_store(std::string const& address);

}  // namespace lapwing::map
