#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "apps/files.hpp"
#include "apps/verb.hpp"
#include "base/loop.hpp"
#include "link/byte_link.hpp"
#include "link/url.hpp"
#include "mavlink/connection.hpp"
#include "mavlink/modes.hpp"

namespace lapwing::apps {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// Prints one line a finding and remembers whether anything is wrong.
class Findings {
 public:
  void good(std::string_view what) { fmt::print("  ok    {}\n", what); }
  void note(std::string_view what, std::string_view advice) { fmt::print("  note  {}\n        {}\n", what, advice); }
  void wrong(std::string_view what, std::string_view mend) {
    fmt::print("  WRONG {}\n        {}\n", what, mend);
    any_wrong_ = true;
  }
  [[nodiscard]] bool any_wrong() const { return any_wrong_; }

 private:
  bool any_wrong_ = false;
};

bool on_path(std::string const& program) {
  auto const* path = std::getenv("PATH");
  for (std::string rest = path ? path : ""; !rest.empty();) {
    auto const colon = rest.find(':');
    auto const candidate = fs::path(rest.substr(0, colon)) / program;
    if (::access(candidate.c_str(), X_OK) == 0) return true;
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
  }
  return false;
}

void look_at_installation(Findings& findings) {
  auto const home = home_directory();
  fmt::print("Installation in {}\n", home.string());
  for (auto const* tool : {"cmake", "ninja", "g++", "node", "npm"}) {
    if (!on_path(tool)) findings.wrong(fmt::format("{} is not installed", tool), "./lapwing build installs it");
  }
  if (fs::exists(home / ".venv/bin/python")) {
    findings.good("build-only Python environment");
  } else {
    findings.wrong("no Python environment .venv: MAVLink headers cannot be made", "./lapwing build makes it");
  }
  if (fs::exists(home / "web/dist/index.html")) {
    findings.good("browser app");
  } else {
    findings.wrong("the browser app is not built: demo and station have no map", "./lapwing build builds it");
  }
  if (!on_path("chromium"))
    findings.note("chromium is not installed: browser tests are skipped", "./lapwing test installs it");
}

void look_at_serial_devices(Findings& findings) {
  fmt::print("Serial devices\n");
  bool any = false;
  std::error_code error;
  for (auto const& entry : fs::directory_iterator("/dev", error)) {
    auto const name = entry.path().filename().string();
    if (name.rfind("ttyACM", 0) != 0 && name.rfind("ttyUSB", 0) != 0) continue;
    any = true;
    if (::access(entry.path().c_str(), R_OK | W_OK) == 0) {
      findings.good(fmt::format("{}: use --link serial://{}:57600", name, entry.path().string()));
    } else {
      findings.wrong(fmt::format("{}: no permission", name), "sudo usermod -aG dialout $USER, then log in again");
    }
  }
  if (!any) findings.good("none plugged in");
}

/// Listens for `time` and says which vehicles spoke.
void listen(Findings& findings, std::string const& text, base::Duration time, bool must_answer) {
  auto const url = link::parse_url(text);
  if (!url) return findings.wrong(url.error().message, url.error().hint);
  base::Loop loop;
  auto link = link::open(loop, *url);
  if (!link) return findings.wrong(link.error().message, link.error().hint);
  mavlink::Connection connection(loop, {}, {});
  std::map<int, std::string> heard;
  auto const subscription = connection.subscribe([&](mavlink::Received const& received) {
    auto const* heartbeat = std::get_if<mavlink::Heartbeat>(&received.message);
    if (!heartbeat) return;
    auto const family = mavlink::family_of(heartbeat->type);
    if (family == vehicle::Family::unknown) return;
    heard[received.source.system] =
        fmt::format("vehicle {}: {}, mode {}, {}", received.source.system, to_string(family),
                    mavlink::mode_name(mavlink::autopilot_of(heartbeat->autopilot), family, heartbeat->custom_mode),
                    heartbeat->armed() ? "armed" : "disarmed");
  });
  connection.add_link(std::move(*link));
  auto wait = [](base::Loop& on, base::Duration duration) -> base::Task<> { co_await on.sleep(duration); };
  loop.run_until_done(wait(loop, time));
  for (auto const& [id, line] : heard) findings.good(fmt::format("{} on {}", line, text));
  if (!heard.empty()) return;
  auto const silence = fmt::format("no vehicle on {} within {:.0f} s", text, base::to_seconds(time));
  auto const advice = "is it switched on, and does it send here? ArduPilot SITL: --serial0 udpclient:ADDRESS:14550";
  must_answer ? findings.wrong(silence, advice) : findings.note(silence, advice);
}

struct DoctorOptions {
  std::vector<std::string> links;
  double listen_s = 3.0;
};

int doctor(DoctorOptions const& options) {
  Findings findings;
  look_at_installation(findings);
  look_at_serial_devices(findings);
  fmt::print("Links\n");
  auto const time = base::from_seconds(options.listen_s);
  if (options.links.empty()) listen(findings, "udpin://127.0.0.1:14550", time, false);
  for (auto const& url : options.links) listen(findings, url, time, true);
  fmt::print("{}\n", findings.any_wrong() ? "Something is wrong: see the lines marked WRONG." : "All is well.");
  return findings.any_wrong() ? exit_failed : exit_done;
}

}  // namespace

void add_doctor(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<DoctorOptions>();
  auto* verb =
      program.add_subcommand("doctor", "What is installed, which links answer, what is wrong and how to mend it");
  verb->add_option("--link", options->links, "Link that should have a vehicle, e.g. udpin://0.0.0.0:14550");
  verb->add_option("--listen", options->listen_s, "Seconds to listen on each link")->check(CLI::Range(0.1, 60.0));
  verb->callback([options, &exit_code] { exit_code = doctor(*options); });
}

}  // namespace lapwing::apps
