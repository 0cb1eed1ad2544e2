#include "host/files/files.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>

#include <fmt/format.h>

namespace lapwing::host {

namespace fs = std::filesystem;

namespace {

/// Of something whose size is not known before it ends.
base::Result<std::string> read_to_end(std::istream& in, std::string_view name) {
  std::string text;
  for (char c = 0; in.get(c);) {
    text += c;
    if (text.size() > max_script_bytes)
      return base::fail(base::ErrorKind::invalid_input, fmt::format("{}: too large for a script", name));
  }
  return text;
}

}  // namespace

base::Result<std::string> read_script(std::string const& path) {
  if (path == "-") return read_to_end(std::cin, "standard input");
  std::error_code error;
  auto const status = fs::status(path, error);
  if (!fs::exists(status)) return base::fail(base::ErrorKind::not_found, fmt::format("{}: no such file", path));
  if (fs::is_fifo(status)) {  // check <(make_script)
    std::ifstream pipe(path, std::ios::binary);
    return read_to_end(pipe, path);
  }
  if (!fs::is_regular_file(status))
    return base::fail(base::ErrorKind::invalid_input, fmt::format("{}: not a file", path));
  if (auto const size = fs::file_size(path, error); !error && size > max_script_bytes) {
    return base::fail(base::ErrorKind::invalid_input, fmt::format("{}: {} MB is too large for a script (limit {} MB)",
                                                                  path, size >> 20, max_script_bytes >> 20));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) return base::fail(base::ErrorKind::io, fmt::format("{}: {}", path, std::strerror(errno)));
  return std::string(std::istreambuf_iterator<char>(file), {});
}

base::Result<std::vector<ScriptText>> read_scripts(std::vector<std::string> const& paths) {
  std::vector<ScriptText> scripts;
  for (auto const& path : paths) {
    auto text = read_script(path);
    if (!text) return std::unexpected(text.error());
    scripts.push_back({path, *std::move(text)});
  }
  return scripts;
}

fs::path home_directory() {
  if (auto const* home = std::getenv("LAPWING_HOME")) return home;
  return LAPWING_SOURCE_DIR;
}

}  // namespace lapwing::host
