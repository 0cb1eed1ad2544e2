#include "host/links/link_session.hpp"

#include <optional>
#include <utility>

#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"
#include "host/exit_code.hpp"
#include "host/session/signals.hpp"

namespace lapwing::host {

namespace {

base::LogHub::Sink warnings() {
  return [sink = base::standard_error_sink(base::LogLevel::warn)](base::LogRecord const& record) {
    bool const is_of_a_vehicle =
        (record.source == "fleet" || record.source == "alarm") && record.level < base::LogLevel::error;
    if (!is_of_a_vehicle) sink(record);
  };
}

base::Task<> nothing() {
  co_return;
}

}  // namespace

/// One job, until it is done or interrupted.
struct LinkSession::Work {
  explicit Work(base::Loop& on) : changed(on), scope(on) {}

  base::Task<> carry_out(base::Task<int> job) {
    code = co_await job;
    changed.notify_all();
  }
  base::Task<> until_settled(base::Task<int> job, base::Task<> clean_up) {
    scope.spawn(carry_out(std::move(job)));
    while (!code && !is_interrupted) co_await changed.wait();
    scope.clear();
    if (!code) co_await clean_up;
  }

  std::optional<int> code;
  bool is_interrupted = false;
  base::Notifier changed;
  base::Scope scope;
};

LinkSession::LinkSession(SigningSetup signing, std::string const& source, base::Loop::Pace pace)
    : loop(pace),
      log(hub, source),
      ground(loop, log, {.asks_for_messages = false}, std::move(signing)),
      keeper_(loop, [this] { return ground.signed_until(); }, ground.signing.time_file, log.named("signing")) {
  hub.add_sink(warnings());
}

base::Result<> LinkSession::open(std::vector<std::string> const& urls) {
  return ground.open(urls.empty() ? std::vector<std::string>{default_link} : urls);
}

int LinkSession::run(base::Task<int> job, base::Task<> clean_up) {
  Work work(loop);
  StopSignals const signals(loop, [&work] {
    work.is_interrupted = true;
    work.changed.notify_all();
  });
  loop.run_until_done(work.until_settled(std::move(job), std::move(clean_up)));
  return work.code.value_or(exit_interrupted);
}

int LinkSession::run(base::Task<int> job) {
  return run(std::move(job), nothing());
}

}  // namespace lapwing::host
