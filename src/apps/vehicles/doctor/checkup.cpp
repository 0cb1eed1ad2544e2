#include "apps/vehicles/doctor/checkup.hpp"

#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "base/async/loop.hpp"
#include "host/links/ground.hpp"
#include "link/byte_link.hpp"
#include "link/url.hpp"
#include "mavlink/connection/connection.hpp"
#include "mavlink/wire/modes.hpp"
#include "station/http/http_server.hpp"

namespace lapwing::apps {

namespace {

namespace fs = std::filesystem;

bool is_on_path(std::string const& search_path, std::string const& program) {
  for (std::string rest = search_path; !rest.empty();) {
    auto const colon = rest.find(':');
    auto const candidate = fs::path(rest.substr(0, colon)) / program;
    if (::access(candidate.c_str(), X_OK) == 0) return true;
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
  }
  return false;
}

/// What was heard on one link.
struct Heard {
  std::map<int, std::string> vehicles;  ///< by system id
  std::size_t others = 0;               ///< MAVLink messages that are no vehicle's heartbeat
};

std::string describe(int system, mavlink::Heartbeat const& heartbeat, vehicle::Family family) {
  return fmt::format("vehicle {}: {}, mode {}, {}", system, to_string(family),
                     mavlink::mode_name(mavlink::autopilot_of(heartbeat.autopilot), family, heartbeat.custom_mode),
                     heartbeat.armed() ? "armed" : "disarmed");
}

/// ": 12 messages/s, 2 % lost, round trip 120 ms".
std::string describe(mavlink::SourceReport const& source) {
  auto text = fmt::format(": {:.0f} message{}/s, {:.0f} % lost", source.messages_per_s,
                          std::lround(source.messages_per_s) == 1 ? "" : "s", 100 * source.loss);
  if (source.round_trip) text += fmt::format(", round trip {:.0f} ms", 1000 * base::to_seconds(*source.round_trip));
  return text;
}

void note(Heard& heard, mavlink::Received const& received) {
  auto const* heartbeat = std::get_if<mavlink::Heartbeat>(&received.message);
  auto const family = heartbeat ? mavlink::family_of(heartbeat->type) : vehicle::Family::unknown;
  if (family == vehicle::Family::unknown) {
    ++heard.others;
  } else {
    heard.vehicles[received.source.system] = describe(received.source.system, *heartbeat, family);
  }
}

/// Why nobody may have been heard, by how the link works.
std::string advice_on_silence(link::Url const& url) {
  switch (url.transport) {
    case link::Transport::udp_in:
      return url.host.starts_with("127.")
                 ? fmt::format(
                       "only this machine can send to {}: for vehicles on a network use udpin://0.0.0.0:{}\n"
                       "ArduPilot SITL beside it: --serial0 udpclient:127.0.0.1:{}",
                       url.host, url.port_or_baud, url.port_or_baud)
                 : fmt::format("does the vehicle send to UDP port {} of this machine, and does a firewall let it in?",
                               url.port_or_baud);
    case link::Transport::udp_out:
    case link::Transport::udp_bcast: return "is the vehicle switched on, and does it listen at that address and port?";
    case link::Transport::tcp_in: return "nobody connected: does the vehicle know this machine's address and port?";
    case link::Transport::tcp_out: return "the connection stands: is its far end an autopilot's MAVLink port?";
    case link::Transport::serial:
      return fmt::format("is {} the autopilot's baud rate (SERIALn_BAUD), SERIALn_PROTOCOL 2, and TX wired to RX?",
                         url.port_or_baud);
  }
  return {};
}

std::string advice_on_closed(link::Url const& url, std::string const& why) {
  if (url.transport == link::Transport::tcp_out) return "start what should answer there, or mend host and port";
  if (url.transport != link::Transport::serial) return "mend address and port";
  if (why.contains("permission")) return "lapwing doctor lists the devices that may be used";
  if (why.contains("not there")) return "is it plugged in? lapwing doctor lists what is there";
  return "is another program using it, such as ModemManager or another ground station?";
}

Finding judge_silence(link::Url const& url, link::ByteLink const& link, Heard const& heard, double seconds) {
  auto const name = to_string(url);
  if (link.state() != link::LinkState::open) {
    auto const why = link.last_error();
    return {Verdict::wrong, fmt::format("{} is not open: {}", name, why.empty() ? "no answer" : why),
            advice_on_closed(url, why)};
  }
  if (heard.others > 0) {
    return {Verdict::note, fmt::format("MAVLink but no vehicle's heartbeat on {} within {:g} s", name, seconds),
            "is it another ground station, a camera or a radio? Listen longer with --listen 10"};
  }
  if (auto const bytes = link.counters().bytes_received; bytes > 0) {
    return {Verdict::note, fmt::format("{} bytes on {}, but no MAVLink in them", bytes, name),
            url.transport == link::Transport::serial ? "the baud rate is probably another one"
                                                     : "something else than an autopilot sends there"};
  }
  return {Verdict::note, fmt::format("no vehicle on {} within {:g} s", name, seconds), advice_on_silence(url)};
}

base::Task<> wait(base::Loop& loop, base::Duration duration) {
  co_await loop.sleep(duration);
}

}  // namespace

bool any_wrong(Findings const& findings) {
  return std::ranges::any_of(findings, [](auto const& finding) { return finding.verdict == Verdict::wrong; });
}

std::string render(Findings const& findings) {
  std::string text;
  for (auto const& [verdict, what, advice] : findings) {
    auto const* word = verdict == Verdict::good ? "ok   " : verdict == Verdict::note ? "note " : "WRONG";
    text += fmt::format("  {} {}\n", word, what);
    for (std::size_t at = 0; at < advice.size();) {
      auto const end = std::min(advice.find('\n', at), advice.size());
      text += fmt::format("        {}\n", advice.substr(at, end - at));
      at = end + 1;
    }
  }
  return text;
}

Findings look_at_installation(fs::path const& home, std::string const& search_path) {
  Findings findings;
  for (auto const* tool : {"cmake", "ninja", "g++", "node", "npm"}) {
    if (is_on_path(search_path, tool)) continue;
    findings.push_back({Verdict::wrong, fmt::format("{} is not installed", tool), "./lapwing build installs it"});
  }
  if (findings.empty()) findings.push_back({Verdict::good, "tools of the build"});
  findings.push_back(fs::exists(home / ".venv/bin/python")
                         ? Finding{Verdict::good, "build-only Python environment"}
                         : Finding{Verdict::wrong, "no Python environment .venv: MAVLink headers cannot be made",
                                   "./lapwing build makes it"});
  findings.push_back(fs::exists(home / "web/dist/index.html")
                         ? Finding{Verdict::good, "browser app"}
                         : Finding{Verdict::wrong, "the browser app is not built: demo and station have no map",
                                   "./lapwing build builds it"});
  if (!is_on_path(search_path, "chromium")) {
    findings.push_back(
        {Verdict::note, "chromium is not installed: browser tests are skipped", "./lapwing test installs it"});
  }
  return findings;
}

namespace {

/// The name by which udev finds the device again in whatever socket it is plugged; else its own.
fs::path lasting_name(fs::path const& folder, fs::path const& device) {
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder / "serial/by-id", error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    std::error_code ignored;
    if (fs::equivalent(entry->path(), device, ignored)) return entry->path();
  }
  return device;
}

}  // namespace

Findings look_at_serial_devices(fs::path const& folder) {
  Findings findings;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    auto const path = entry->path().string();
    auto const name = entry->path().filename().string();
    if (!name.starts_with("ttyACM") && !name.starts_with("ttyUSB")) continue;
    if (::access(path.c_str(), R_OK | W_OK) == 0) {
      findings.push_back({Verdict::good, fmt::format("{}: use --link serial://{}:57600", name,
                                                     lasting_name(folder, entry->path()).string())});
    } else {
      findings.push_back({Verdict::wrong, fmt::format("{}: no permission", name),
                          "sudo usermod -aG dialout $USER, then log in again"});
    }
  }
  std::ranges::sort(findings, {}, &Finding::what);
  if (findings.empty()) findings.push_back({Verdict::good, "none plugged in"});
  return findings;
}

Findings look_at_map_port(int port) {
  base::Loop loop;
  station::HttpServer::Options options;
  options.port = port;
  auto const server = station::HttpServer::open(loop, options, {});
  if (server) return {{Verdict::good, fmt::format("port {} is free for the map", port)}};
  // Perhaps it is our own station that runs there.
  return {{Verdict::note, fmt::format("port {} is in use: by a station that runs already, or another program", port),
           fmt::format("ss -ltnp 'sport = :{}' names it; lapwing demo and station take another with --port N", port)}};
}

Findings listen(std::string const& text, base::Duration time, bool must_answer) {
  auto const parsed = host::parse_network_link(text);
  if (!parsed) return {{Verdict::wrong, parsed.error().message, parsed.error().hint}};
  auto const& url = parsed->url;
  base::Loop loop;
  auto opened = link::open(loop, url);
  if (!opened) {
    return {{must_answer ? Verdict::wrong : Verdict::note, opened.error().message, opened.error().hint}};
  }
  auto const& link = **opened;
  mavlink::Connection connection(loop, {}, {});
  Heard heard;
  auto const subscription =
      connection.subscribe([&heard](mavlink::Received const& received) { note(heard, received); });
  connection.add_link(std::move(*opened));
  loop.run_until_done(wait(loop, time));

  Findings findings;
  auto const sources = connection.report().at(0).sources;
  for (auto const& [id, line] : heard.vehicles) {
    auto const conflict = connection.conflict(static_cast<std::uint8_t>(id));
    auto const source = std::ranges::find_if(sources, [id = id](mavlink::SourceReport const& report) {
      return report.source == mavlink::Address{static_cast<std::uint8_t>(id), mavlink::autopilot_component};
    });
    auto const quality = source == sources.end() ? std::string() : describe(*source);
    findings.push_back({Verdict::good, fmt::format("{} on {}{}", line, text, quality)});
    if (!conflict) continue;
    findings.push_back({Verdict::wrong,
                        fmt::format("two vehicles have system id {}: {} and {}", id, conflict->first, conflict->second),
                        "give one another id (ArduPilot: SYSID_THISMAV)"});
  }
  if (!findings.empty()) return findings;
  findings.push_back(judge_silence(url, link, heard, base::to_seconds(time)));
  if (must_answer) findings.back().verdict = Verdict::wrong;
  return findings;
}

}  // namespace lapwing::apps
