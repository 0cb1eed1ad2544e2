#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/vehicles/doctor/checkup.hpp"
#include "apps/verb.hpp"
#include "host/files/files.hpp"
#include "host/links/ground.hpp"

namespace lapwing::apps {

namespace {

struct DoctorOptions {
  std::vector<std::string> links;
  double listen_s = 3.0;
  int port = 8080;
};

int doctor(DoctorOptions const& options) {
  bool is_wrong = false;
  auto const show = [&is_wrong](std::string const& title, Findings const& findings) {
    fmt::print("{}\n{}", title, render(findings));
    std::fflush(stdout);
    is_wrong = is_wrong || any_wrong(findings);
  };
  auto const* path = std::getenv("PATH");
  show(fmt::format("Installation in {}", host::home_directory().string()),
       look_at_installation(host::home_directory(), path ? path : ""));
  show("Map", look_at_map_port(options.port));
  show("Serial devices", look_at_serial_devices("/dev"));
  auto const time = base::from_seconds(options.listen_s);
  fmt::print("Links (listening {:g} s on each)\n", options.listen_s);
  std::fflush(stdout);
  bool const are_given = !options.links.empty();
  for (auto const& url : are_given ? options.links : std::vector<std::string>{host::default_link}) {
    auto const findings = listen(url, time, are_given);
    fmt::print("{}", render(findings));
    is_wrong = is_wrong || any_wrong(findings);
  }
  fmt::print("{}\n", is_wrong ? "Something is wrong: see the lines marked WRONG." : "All is well.");
  return is_wrong ? host::exit_failed : host::exit_done;
}

}  // namespace

void add_doctor(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<DoctorOptions>();
  auto* verb = begin_verb(program, "doctor");
  verb->add_option("--link", options->links, "Link that should have a vehicle, e.g. udpin://0.0.0.0:14550");
  verb->add_option("--listen", options->listen_s, "Seconds to listen on each link")
      ->check(CLI::Range(0.1, 60.0))
      ->capture_default_str();
  verb->add_option("--port", options->port, "Port that the map will want")
      ->check(CLI::Range(1, 65535))
      ->capture_default_str();
  verb->callback([options, &exit_code] { exit_code = doctor(*options); });
}

}  // namespace lapwing::apps
