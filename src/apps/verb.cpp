#include "apps/verb.hpp"

#include <algorithm>
#include <array>

#include "apps/verb_table.hpp"
#include "base/assert.hpp"

namespace lapwing::apps {
namespace {

constexpr std::string_view vehicles = "lapwing-vehicles";
constexpr std::string_view maps = "lapwing-map";
constexpr std::string_view slam = "lapwing-slam";
constexpr std::string_view eyes = "lapwing-vision";
constexpr std::string_view aboard = "lapwing-onboard";
constexpr std::string_view seeing = "lapwing-perceive";
constexpr std::string_view showing = "lapwing-stream";

/// In the order in which help shows them.
constexpr std::array table{
    Verb{"run", "Run a script on vehicles", vehicles},
    Verb{"demo", "Simulated vehicles fly a script while you watch on the map", vehicles},
    Verb{"plan", "Fly a script on simulated vehicles and show what it would do", vehicles},
    Verb{"mission", "Missions, fences and rally points: to and from vehicles and files", vehicles},
    Verb{"check", "Show every mistake in scripts, without vehicles", front_program},
    Verb{"fmt", "Put scripts into the common layout, without changing what they mean", front_program},
    Verb{"lsp", "Serve an editor (Language Server Protocol on standard input and output)", front_program},
    Verb{"sim", "Simulated vehicles that speak MAVLink, for any ground station", vehicles},
    Verb{"replay", "Play a recording of vehicles into the map", vehicles},
    Verb{"station", "Ground station with the map; scripts start from the browser", vehicles},
    Verb{"onboard", "The programs on a survey drone: flight bridge and decisions, started and watched", aboard},
    Verb{"perceive", "What a survey drone sees, maps and plans, as lapwing onboard starts it", seeing},
    Verb{"stream", "A survey drone's pictures as H.264 over RTSP, as lapwing onboard starts it", showing},
    Verb{"explore", "Let simulated robots explore a floor plan: travel, time and coverage", maps},
    Verb{"map", "Make a floor map of what a robot's laser and wheels recorded", slam},
    Verb{"store", "What the map's store holds: list, verify, compact, export, import, copy", maps},
    Verb{"detect", "What is in pictures: doors and their signs; from above cars and parking slots", eyes},
    Verb{"look", "What is in pictures on standard input, as run, demo and station start it", eyes},
    Verb{"overlook", "A simulated car park seen from above, as run and demo start it", seeing},
    Verb{"shoot", "Pictures of a robot's camera, as run and station start it", seeing},
    Verb{"basemap", "Make map tiles of a picture that knows where it lies, such as a GeoTIFF", maps},
    Verb{"param", "Parameters of vehicles: list, get, set, save, load, compare, copy", vehicles},
    Verb{"signing", "Keys that sign MAVLink: new, setup, rotate, off, drop, show", vehicles},
    Verb{"route", "Pass MAVLink on between links, with filters, rate limits and metrics", vehicles},
    Verb{"doctor", "What is installed, which links answer, what is wrong and how to mend it", vehicles},
};

}  // namespace

std::span<Verb const> all_verbs() {
  return table;
}

Verb const* find_verb(std::string_view name) {
  auto const found = std::ranges::find(table, name, &Verb::name);
  return found == table.end() ? nullptr : &*found;
}

CLI::App* begin_verb(CLI::App& program, std::string_view name) {
  auto const* verb = find_verb(name);
  LAPWING_ASSERT(verb != nullptr, name);
  return program.add_subcommand(std::string(verb->name), std::string(verb->about));
}

}  // namespace lapwing::apps
