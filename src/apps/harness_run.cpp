#include "apps/harness_run.hpp"

#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "apps/console.hpp"
#include "apps/script_host.hpp"
#include "apps/session.hpp"
#include "apps/signals.hpp"
#include "apps/simulation.hpp"
#include "apps/verb.hpp"
#include "tasks/event_json.hpp"
#include "tasks/harness_platform.hpp"

namespace lapwing::apps {

int run_on_harness(std::string const& name, std::string const& source, std::string const& events,
                   std::optional<std::uint64_t> seed, LoadedPlans plans) {
  using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
  File opened(events.empty() || events == "-" ? nullptr : std::fopen(events.c_str(), "w"), &std::fclose);
  std::FILE* const sink = events == "-" ? stdout : opened.get();
  if (!events.empty() && !sink) {
    print_error({base::ErrorKind::io, fmt::format("{}: cannot write", events), {}});
    return exit_usage;
  }

  base::Loop loop(pace_for(0.0, seed));
  base::LogHub hub;
  hub.add_sink([to_terminal = base::standard_error_sink(base::LogLevel::info)](base::LogRecord const& record) {
    if (record.source != script_source) to_terminal(record);
  });
  base::Logger const log(hub, "lapwing");
  for (auto const& mistake : plans.mistakes) log.warn(mistake.message);
  tasks::HarnessPlatform platform(loop, std::move(plans.library));
  auto const console = make_console(loop, log);
  auto const note = [sink, task_log = log.named("task")](tasks::TaskEvent const& event) {
    if (sink) fmt::print(sink, "{}\n", tasks::to_json_line(event));
    task_log.info(to_log_text(event));
  };
  ScriptHost host(loop, platform, *console, log, note, seed.value_or(1));
  auto const started = host.start(name, source);
  fmt::print(stderr, "{}", host.rendered_diagnostics());
  if (!started) return exit_usage;
  StopSignals const signals(loop, [&host] { host.stop(); });
  loop.run_until_done(host.ended());
  return dolphin::exit_code(*host.outcome());
}

}  // namespace lapwing::apps
