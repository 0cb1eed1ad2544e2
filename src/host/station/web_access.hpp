#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/error.hpp"

namespace lapwing::host {

/// Where the map is served and who may use it.
struct WebAccess {
  std::string bind = "127.0.0.1";
  int port = 8080;
  std::string token_file = {};               ///< holds the token; empty: none
  bool generate_token = false;               ///< make one up and tell it once
  std::vector<std::string> host_names = {};  ///< names of this machine that browsers may use
};

/// What the command line says about it; the rest stays as it is.
struct WebArguments {
  std::optional<std::string> bind = {};
  std::optional<int> port = {};
  std::optional<std::string> token_file = {};
  bool generate_token = false;
};
void add_web_options(CLI::App& verb, WebArguments& arguments);
void apply(WebArguments const& arguments, WebAccess& access);

/// The token that requests must carry: the file's, a new one, or none (empty), which only loopback allows. Errors
/// (invalid_input, not_found, io) say how to go on, and never hold the token.
[[nodiscard]] base::Result<std::string> token_for(WebAccess const& access);

/// The token in a file that nobody but its owner can read (mode 0600), without blanks around it.
[[nodiscard]] base::Result<std::string> read_token(std::string const& path);
/// 192 random bits from the operating system, as 48 hexadecimal digits.
[[nodiscard]] std::string new_token();

/// What a browser can open, first the most useful: for a wildcard address, each of this machine's own. The token, when
/// there is one, stands behind '#', which browsers send to nobody.
[[nodiscard]] std::vector<std::string> map_addresses(std::string const& bind, int port, std::string const& token);

}  // namespace lapwing::host
