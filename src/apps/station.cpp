#include <memory>

#include <fmt/format.h>

#include "apps/session.hpp"
#include "apps/signals.hpp"
#include "apps/verb.hpp"

namespace lapwing::apps {

namespace {

struct StationOptions {
  std::vector<std::string> links;
  std::string on_stop = "loiter";
  int port = 8080;
};

int refuse(base::Error const& error) {
  print_error(error);
  return error.kind == base::ErrorKind::io ? exit_halted : exit_usage;
}

int serve(StationOptions const& options) {
  auto const on_stop = parse_on_stop(options.on_stop);
  if (!on_stop) return refuse(on_stop.error());
  Session session({.on_stop = *on_stop});
  auto const links = options.links.empty() ? std::vector<std::string>{default_link} : options.links;
  if (auto opened = session.open_links(links); !opened) return refuse(opened.error());
  if (auto opened = session.open_map(options.port, std::nullopt); !opened) return refuse(opened.error());
  fmt::print(stderr, "\n    map  {}\n\nlistening for vehicles on {}; Ctrl-C ends\n", session.map->url(),
             fmt::join(links, ", "));
  {
    StopSignals const signals(session.loop, [&session] { session.loop.stop(); });
    session.loop.run();
  }
  // Vehicles that fly a script of ours are put into their stop mode before the process goes.
  bool const was_running = session.host.status().state == station::ScriptState::running;
  session.host.stop();
  session.run_to_end(std::nullopt);
  return was_running ? exit_interrupted : exit_done;
}

}  // namespace

void add_station(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<StationOptions>();
  auto* verb = program.add_subcommand("station", "Ground station with the map; scripts start from the browser");
  verb->add_option("--link", options->links,
                   "Where vehicles are (may be repeated); default " + std::string(default_link));
  verb->add_option("--port", options->port, "TCP port of the map on 127.0.0.1")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  verb->add_option("--on-stop", options->on_stop, "What a vehicle does when its task is stopped: loiter, rtl or land");
  verb->callback([options, &exit_code] { exit_code = serve(*options); });
}

}  // namespace lapwing::apps
