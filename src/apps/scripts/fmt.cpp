#include <cstdio>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/verb.hpp"
#include "base/files/replace_file.hpp"
#include "base/text/diagnostic.hpp"
#include "dolphin/services/format/formatting.hpp"
#include "host/files/files.hpp"

namespace lapwing::apps {

namespace {

namespace fs = std::filesystem;

struct FmtOptions {
  std::vector<std::string> scripts;
  bool only_checks = false;
  bool from_stdin = false;
};

enum class Formatted { unchanged, changed, failed };

/// The script in its layout; what is wrong with it is written to standard error.
std::optional<std::string> layout_of(std::string const& name, std::string const& text) {
  base::SourceFile const source(name, text);
  base::Diagnostics diagnostics(source);
  auto formatted = dolphin::format(diagnostics);
  if (!formatted) fmt::print(stderr, "{}", base::render(diagnostics));
  return formatted;
}

/// Replaces the file as a whole; links stay links and permissions stay as they are.
base::Result<> replace(std::string const& path, std::string const& text) {
  std::error_code error;
  auto const target = fs::canonical(path, error);
  auto const permissions = error ? fs::perms::none : fs::status(target, error).permissions();
  if (error) return base::fail(base::ErrorKind::io, fmt::format("{}: cannot write: {}", path, error.message()));
  if (auto written = base::replace_file(target.string(), text); !written) return written;
  fs::permissions(target, permissions, error);
  return {};
}

Formatted format_file(std::string const& path, bool only_checks) {
  auto const text = host::read_script(path);
  if (!text) {
    fmt::print(stderr, "lapwing: {}\n", text.error().message);
    return Formatted::failed;
  }
  auto const formatted = layout_of(path, *text);
  if (!formatted) return Formatted::failed;
  if (*formatted == *text) return Formatted::unchanged;
  if (!only_checks) {
    if (auto const written = replace(path, *formatted); !written) {
      fmt::print(stderr, "lapwing: {}\n", written.error().message);
      return Formatted::failed;
    }
  }
  fmt::print("{}\n", path);
  return Formatted::changed;
}

Formatted format_stdin(bool only_checks) {
  std::string const text(std::istreambuf_iterator<char>(std::cin), {});
  auto const formatted = layout_of("<stdin>", text);
  if (!formatted) return Formatted::failed;
  if (only_checks && *formatted != text) fmt::print("<stdin>\n");
  if (!only_checks) std::fwrite(formatted->data(), 1, formatted->size(), stdout);
  return *formatted == text ? Formatted::unchanged : Formatted::changed;
}

int format_all(FmtOptions const& options) {
  if (options.scripts.empty() && !options.from_stdin) {
    fmt::print(stderr, "lapwing fmt: name scripts, or - for standard input\n");
    return host::exit_usage;
  }
  bool changed = false;
  bool failed = false;
  auto const note = [&](Formatted result) {
    changed = changed || result == Formatted::changed;
    failed = failed || result == Formatted::failed;
  };
  if (options.from_stdin) note(format_stdin(options.only_checks));
  for (auto const& path : options.scripts) {
    note(path == "-" ? format_stdin(options.only_checks) : format_file(path, options.only_checks));
  }
  if (failed) return host::exit_usage;
  return options.only_checks && changed ? host::exit_failed : host::exit_done;
}

}  // namespace

void add_fmt(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<FmtOptions>();
  auto* verb = begin_verb(program, "fmt");
  verb->add_option("script", options->scripts, "Dolphin scripts, replaced in place; - reads standard input");
  verb->add_flag("--check", options->only_checks, "Change nothing; list what would change and exit with 1");
  verb->add_flag("--stdin", options->from_stdin, "Read standard input, write to standard output");
  verb->callback([options, &exit_code] { exit_code = format_all(*options); });
}

}  // namespace lapwing::apps
