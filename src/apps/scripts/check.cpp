#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/verb.hpp"
#include "base/text/diagnostic.hpp"
#include "base/text/json.hpp"
#include "dolphin/machine/engine.hpp"
#include "host/files/files.hpp"
#include "host/files/plans.hpp"
#include "host/plausibility/options.hpp"
#include "host/vocabulary.hpp"

namespace lapwing::apps {

namespace {

nlohmann::json to_json(base::DiagnosticRecord const& record) {
  nlohmann::json json{{"file", record.file},         {"line", record.begin.line},       {"column", record.begin.column},
                      {"end_line", record.end.line}, {"end_column", record.end.column}, {"severity", record.severity},
                      {"message", record.message}};
  if (!record.code.empty()) json["code"] = record.code;
  if (!record.hint.empty()) json["hint"] = record.hint;
  for (auto const& note : record.notes) json["notes"].push_back(to_json(note));
  return json;
}

struct CheckOptions {
  std::vector<std::string> scripts;
  std::string plans;
  host::PlausibilityArguments plausibility;
  bool json = false;
};

/// What is wrong with the plan files; on standard output, or as records. Returns how many.
std::size_t check_plans(CheckOptions const& options, nlohmann::json& records) {
  auto const plans = host::load_plans(options.plans);
  auto const mistakes = plans ? plans->mistakes : std::vector{plans.error()};
  for (auto const& mistake : mistakes) {
    records.push_back({{"file", options.plans}, {"severity", "error"}, {"message", mistake.message}});
    if (!options.json) fmt::print("error: {}\n", mistake.message);
  }
  return mistakes.size();
}

int check(CheckOptions const& options) {
  auto plausibility = host::plausibility_of(options.plausibility);
  if (!plausibility) return host::refuse(plausibility.error());
  auto const vocabulary = host::vocabulary(*std::move(plausibility));
  auto all = nlohmann::json::array();
  std::size_t errors = check_plans(options, all);
  std::size_t warnings = 0;
  for (auto const& path : options.scripts) {
    auto const text = host::read_script(path);
    if (!text) {
      fmt::print(stderr, "lapwing: {}\n", text.error().message);
      ++errors;
      continue;
    }
    auto const source = std::make_shared<base::SourceFile const>(path, *text);
    base::Diagnostics diagnostics(*source);
    (void)dolphin::load(source, vocabulary, diagnostics);
    errors += diagnostics.error_count();
    warnings += diagnostics.warning_count();
    if (options.json) {
      for (auto const& record : base::to_records(diagnostics)) all.push_back(to_json(record));
    } else {
      fmt::print("{}", base::render(diagnostics));
    }
  }
  if (options.json) {
    fmt::print("{}\n", base::to_text(all, 2));
  } else if (errors + warnings == 0) {
    fmt::print("{}: no mistakes found\n", fmt::join(options.scripts, ", "));
  } else {
    fmt::print("{} error{}, {} warning{}\n", errors, errors == 1 ? "" : "s", warnings, warnings == 1 ? "" : "s");
  }
  return errors == 0 ? host::exit_done : host::exit_usage;
}

}  // namespace

void add_check(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<CheckOptions>();
  auto* verb = begin_verb(program, "check");
  verb->add_option("script", options->scripts, "Dolphin scripts")->required();
  verb->add_option("--plans", options->plans, "Check the plan files of this directory too (.plan, .waypoints)");
  host::add_plausibility_options(*verb, options->plausibility);
  verb->add_flag("--json", options->json, "Machine-readable list on standard output");
  verb->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace lapwing::apps
