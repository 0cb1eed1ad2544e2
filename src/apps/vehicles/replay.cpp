#include <filesystem>
#include <fstream>
#include <memory>

#include <fmt/format.h>

#include "apps/vehicles/replay_store.hpp"
#include "apps/verb.hpp"
#include "base/files/replace_file.hpp"
#include "host/files/files.hpp"
#include "host/links/recording.hpp"
#include "host/session/session.hpp"
#include "host/session/signals.hpp"
#include "link/pipe_link.hpp"
#include "map/store/read_store.hpp"
#include "mavlink/wire/tlog.hpp"

namespace lapwing::apps {

namespace {

struct ReplayOptions {
  std::string place;
  std::string session;
  bool headless = false;
  std::string report;
  host::WebArguments web;
  std::optional<double> speedup;
};

/// The script that flew when the recording was made, where it was kept; to be read, not to be started.
class RecordedScript final : public station::ScriptControl {
 public:
  explicit RecordedScript(std::filesystem::path path) {
    path.replace_extension(".dolphin");
    if (auto source = host::read_script(path.string())) {
      status_.name = path.filename().string();
      status_.source = *std::move(source);
    }
  }
  [[nodiscard]] station::ScriptStatus status() const override { return status_; }
  [[nodiscard]] std::vector<tasks::TaskView> task_trees() const override { return {}; }
  [[nodiscard]] std::expected<void, station::StartFailure> start(std::string, std::string) override {
    return std::unexpected(station::StartFailure{
        {base::ErrorKind::refused, "a recording is played: no vehicle is there to fly a script", "use run or station"},
        {}});
  }
  void stop(std::string) override {}

 private:
  station::ScriptStatus status_;
};

std::optional<base::UtcTime> begin_of(std::filesystem::path const& file) {
  std::ifstream in(file, std::ios::binary);
  mavlink::TlogReader reader(in);
  auto const first = reader.next();
  return first ? std::optional(first->at) : std::nullopt;
}

struct Played {
  std::uint64_t packets = 0;
  std::uint64_t skipped_bytes = 0;
  base::Duration lasted{};
};

/// Sends each packet when its time has come, then stops the loop. Of a clock that was set back, what follows comes at
/// once. `loop` shows the recording's calendar.
base::Task<> play(base::Loop& loop, std::filesystem::path file, link::ByteLink& far_end, Played& played) {
  std::ifstream in(file, std::ios::binary);
  mavlink::TlogReader reader(in);
  auto const began = loop.utc_now();
  auto const start = loop.now();
  while (auto const entry = reader.next()) {
    auto const due = entry->at - began;
    if (start + due > loop.now()) co_await loop.sleep_until(start + due);
    for (auto const peer : far_end.standing_peers()) far_end.send(peer, entry->packet);
    ++played.packets;
    played.lasted = std::max<base::Duration>(played.lasted, due);
  }
  played.skipped_bytes = reader.skipped_bytes();
  co_await loop.turn();  // the last packet arrives
  loop.stop();
}

void tell(host::Session const& session, std::filesystem::path const& file, Played const& played) {
  fmt::print("{}: {} packets in {:.1f} s\n", file.string(), played.packets, base::to_seconds(played.lasted));
  if (played.skipped_bytes > 0) fmt::print("{} bytes were no telemetry and left out\n", played.skipped_bytes);
  for (auto const* vehicle : session.ground.registry.all()) {
    fmt::print("{}: {:.0f} m of track\n", vehicle->name, vehicle->motion.track_m);
  }
}

void keep_map(host::Session& session) {
  fmt::print(stderr, "the recording has ended, the map stays open at {}; Ctrl-C ends\n", session.map->url());
  host::StopSignals const signals(session.loop, [&session] { session.loop.stop(); });
  session.loop.run();
}

int replay_kept(ReplayOptions const& options) {
  if (options.headless || !options.report.empty() || options.speedup)
    return host::refuse({base::ErrorKind::invalid_input,
                         "--headless, --report and --speedup are for recordings of telemetry, and this is a store",
                         "the page has play, pause and speed; `lapwing store ls STORE` tells what is in it"});
  return replay_store({.address = options.place, .session = options.session, .web = options.web});
}

int replay(ReplayOptions const& options) {
  if (map::is_store(options.place)) return replay_kept(options);
  if (!options.session.empty())
    return host::refuse(
        {base::ErrorKind::invalid_input,
         fmt::format("{}: this is no store, so there is no session in it", options.place),
         "--session names one of a store: a folder that a station was given by --store, or postgresql://..."});
  auto const file = host::find_recording(options.place);
  if (!file) return host::refuse(file.error());
  auto const began = begin_of(*file);
  if (!began) {
    return host::refuse({base::ErrorKind::invalid_input, fmt::format("{}: there is no telemetry in it", file->string()),
                         "a .tlog holds MAVLink packets, each with its time"});
  }
  RecordedScript script(*file);
  host::Session session({.speedup = options.speedup.value_or(options.headless ? 0.0 : 1.0),
                         .log_level = options.headless ? base::LogLevel::warn : base::LogLevel::info,
                         .begins_at = began,
                         .listens_only = true});
  auto pipe = link::make_pipe(session.loop);
  session.ground.connection.add_link(std::move(pipe.a));
  auto const far_end = std::move(pipe.b);
  far_end->start([](link::Peer, link::Bytes) {});  // nobody is there to answer
  if (!options.headless) {
    host::WebAccess access;
    host::apply(options.web, access);
    if (auto opened = session.open_map(access, {.store = {.place = host::StoreSettings::Place::temporary}}, &script);
        !opened)
      return host::refuse(opened.error());
  }
  bool was_interrupted = false;
  Played played;
  {
    host::StopSignals const signals(session.loop, [&] {
      was_interrupted = true;
      session.loop.stop();
    });
    base::Scope scope(session.loop);
    scope.spawn(play(session.loop, *file, *far_end, played));
    session.loop.run();
  }
  if (was_interrupted) return host::exit_interrupted;
  tell(session, *file, played);
  if (!options.report.empty()) {
    if (auto written = base::replace_file(options.report, host::to_json(session.report())); !written)
      return host::refuse(written.error());
  }
  if (session.map) keep_map(session);
  return host::exit_done;
}

}  // namespace

void add_replay(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<ReplayOptions>();
  auto* verb = begin_verb(program, "replay");
  verb->add_option("recording", options->place,
                   "A .tlog file, or a folder with some: its youngest; or a station's store, to look back in")
      ->required();
  verb->add_option("--session", options->session, "Of a store: which session, by name or id; default the newest");
  verb->add_flag("--headless", options->headless, "No map: play as fast as it goes and tell what was in it");
  verb->add_option("--report", options->report, "Write which vehicles moved how far to this file as JSON");
  host::add_web_options(*verb, options->web);
  verb->add_option("--speedup", options->speedup, "1 real time (default with the map), 10 ten times faster")
      ->check(CLI::Range(0.0, 1000.0));
  verb->callback([options, &exit_code] { exit_code = replay(*options); });
}

}  // namespace lapwing::apps
