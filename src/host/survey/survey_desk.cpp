#include "host/survey/survey_desk.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "autonomy/operator/command_text.hpp"
#include "autonomy/operator/map_follower.hpp"
#include "autonomy/operator/map_request.hpp"
#include "link/pictures/whep_client.hpp"

namespace lapwing::host {

namespace wire = link::operator_link;
using namespace std::chrono_literals;

namespace {

/// A command that comes later than that was meant for another moment.
constexpr base::Duration command_lives = 5s;
constexpr base::Duration kill_lives = 10s;

/// So long a browser may wait for a picture; then it is told that there is none.
constexpr base::Duration picture_patience = 3s;
/// A drone sends pictures for so long after the last one that was asked for.
constexpr base::Duration watched_for = 5s;

/// What overtakes what waits: of where to fly the last word counts, which says nothing of heights.
std::string_view key_of(autonomy::Command const& command) {
  if (std::holds_alternative<autonomy::command::Kill>(command)) return "kill";
  return std::holds_alternative<autonomy::command::Configure>(command) ? "heights" : "flight";
}

bool stops(autonomy::Command const& command) {
  return std::holds_alternative<autonomy::command::Kill>(command) ||
         std::holds_alternative<autonomy::command::Land>(command) ||
         std::holds_alternative<autonomy::command::Disarm>(command);
}

link::pictures::View wire_view(vehicle::PictureView view) {
  using link::pictures::View;
  return view == vehicle::PictureView::raw ? View::raw : View::annotated;
}

}  // namespace

struct SurveyDesk::Seat {
  Seat(::lapwing::map::LiveMap& map, std::string drone) : name(drone), lot(map, std::move(drone)) {}

  std::string name;
  std::optional<autonomy::report::Heartbeat> heartbeat = {};
  std::optional<autonomy::report::Survey> survey = {};
  std::deque<vehicle::SurveyWords> words = {};
  std::string complaint = {};  ///< the last one of the map, so that it is told once
  LotWriter lot;
  autonomy::MapFollower occupancy = {};
  std::unique_ptr<wire::Client> client = {};

  /// Of one view of the camera.
  struct Look {
    std::shared_ptr<link::pictures::PictureClient> client = {};  ///< null: nobody looks
    base::TimePoint asked_at{};
    std::uint64_t before = 0;  ///< numbers of looks that are over
    std::uint64_t newest = 0;
  };
  link::pictures::Source camera = {};
  link::pictures::Source video = {};
  std::array<Look, 2> looks = {};
  [[nodiscard]] Look& look_at(vehicle::PictureView view) { return looks.at(static_cast<std::size_t>(view)); }
};

SurveyDesk::SurveyDesk(base::Loop& loop, base::Logger log)
    : loop_(loop), log_(std::move(log)), heard_(loop), scope_(loop) {}

SurveyDesk::~SurveyDesk() = default;

base::Result<std::unique_ptr<SurveyDesk>> SurveyDesk::open(base::Loop& loop, ::lapwing::map::LiveMap& map,
                                                           base::Logger log, std::vector<SurveyLink> links) {
  std::unique_ptr<SurveyDesk> desk(new SurveyDesk(loop, std::move(log)));
  std::set<std::string> names;
  for (auto& link : links) {
    auto const camera = camera_of(link);
    auto const video = video_of(link);
    auto& name = link.name;
    auto& settings = link.settings;
    if (!names.insert(name).second)
      return base::fail(base::ErrorKind::invalid_input, fmt::format("two survey drones are called {}", name),
                        "give each a name of its own");
    auto seat = std::make_unique<Seat>(map, name);
    seat->camera = camera;
    seat->video = video;
    if (settings.client.end.name.empty()) settings.client.end.name = "station";
    auto client =
        wire::connect(loop, std::move(settings),
                      {.arrived = [raw = desk.get(), one = seat.get()] { raw->hear(*one); },
                       .event =
                           [raw = desk.get(), one = seat.get()](wire::Event const& event) {
                             if (event.kind == wire::EventKind::connected) raw->ask_for_map(*one);
                             auto const text = event.text.empty() ? "" : ": " + event.text;
                             raw->log_.info(fmt::format("{}: {}{}", one->name, wire::to_string(event.kind), text));
                             raw->heard_.notify_all();
                           }});
    if (!client) return std::unexpected(client.error());
    seat->client = *std::move(client);
    desk->seats_.push_back(std::move(seat));
  }
  return desk;
}

void SurveyDesk::hear(Seat& seat) {
  while (auto const message = seat.client->session().take()) take(seat, message->text);
  heard_.notify_all();
}

void SurveyDesk::take(Seat& seat, std::string const& text) {
  auto report = autonomy::parse_report(text);
  if (!report) return say(seat, report.error().message);
  if (auto const* const log = std::get_if<autonomy::report::ErrorLog>(&*report)) return say(seat, log->message);
  auto const shown = show(seat, *std::move(report));
  auto complaint = shown ? std::string() : fmt::format("the map does not take it: {}", shown.error().message);
  if (!complaint.empty() && complaint != seat.complaint) say(seat, complaint);
  if (!complaint.empty()) seat.complaint = std::move(complaint);
}

base::Result<> SurveyDesk::show(Seat& seat, autonomy::Report report) {
  auto const now = loop_.utc_now();
  if (auto const* const slots = std::get_if<autonomy::report::Slots>(&report)) {
    if (slots->survey) seat.survey = slots->survey;
    return seat.lot.take(*slots, now);
  }
  if (auto* const whole = std::get_if<autonomy::report::Map>(&report)) {
    seat.occupancy.take(std::move(*whole));
    return seat.lot.take(*seat.occupancy.map(), now);
  }
  if (auto const* const changes = std::get_if<autonomy::report::MapChanges>(&report)) {
    using enum autonomy::MapFollower::Outcome;
    auto const outcome = seat.occupancy.take(*changes);
    if (outcome == missed) ask_for_map(seat);
    return outcome == shown ? seat.lot.take(*seat.occupancy.map(), now) : base::Result<>();
  }
  seat.heartbeat = std::get<autonomy::report::Heartbeat>(std::move(report));
  auto taken = seat.lot.take(*seat.heartbeat, now);
  seat.heartbeat->map.reset();
  return taken;
}

/// A drone that does not know of it says so once, and goes on sending the map in its heartbeats.
void SurveyDesk::ask_for_map(Seat& seat) {
  (void)seat.client->session().send({.kind = wire::Kind::command,
                                     .text = std::string(map_request_text(autonomy::MapRequest::as_changes)),
                                     .key = "map",
                                     .lifetime = command_lives});
}

void SurveyDesk::say(Seat& seat, std::string words) {
  log_.warn(fmt::format("{}: {}", seat.name, words));
  seat.words.push_back({.at = loop_.utc_now(), .text = std::move(words)});
  if (seat.words.size() > words_kept) seat.words.pop_front();
}

std::vector<vehicle::SurveyDroneView> SurveyDesk::drones() const {
  std::vector<vehicle::SurveyDroneView> views;
  for (auto const& seat : seats_) {
    auto const& told = seat->heartbeat.value_or(autonomy::report::Heartbeat{});
    views.push_back({.name = seat->name,
                     .is_connected = seat->client->is_connected(),
                     .trouble = seat->client->last_error(),
                     .state = told.state,
                     .mode = told.mode,
                     .is_armed = told.is_armed,
                     .is_healthy = told.is_healthy,
                     .health_reason = told.health_reason,
                     .user_error = told.user_error,
                     .height_m = told.height_m,
                     .position = told.position,
                     .battery = told.battery,
                     .slots = seat->survey && seat->survey->slots ? seat->survey->slots : seat->lot.slots(),
                     .coverage = seat->survey ? std::optional(seat->survey->coverage) : std::nullopt,
                     .words = {seat->words.begin(), seat->words.end()}});
  }
  return views;
}

SurveyDesk::Seat* SurveyDesk::seat_of(std::string_view drone) const {
  auto const found = std::ranges::find_if(seats_, [&](auto const& seat) { return seat->name == drone; });
  return found == seats_.end() ? nullptr : found->get();
}

std::optional<autonomy::report::Heartbeat> SurveyDesk::heartbeat(std::string_view drone) const {
  auto const* const seat = seat_of(drone);
  return seat ? seat->heartbeat : std::nullopt;
}

bool SurveyDesk::is_connected(std::string_view drone) const {
  auto const* const seat = seat_of(drone);
  return seat && seat->client->is_connected();
}

std::optional<autonomy::report::Survey> SurveyDesk::survey(std::string_view drone) const {
  auto const* const seat = seat_of(drone);
  return seat ? seat->survey : std::nullopt;
}

base::Result<> SurveyDesk::command(std::string_view drone, std::string const& command) {
  if (seat_of(drone) && autonomy::parse_command(command) && on_operator_) on_operator_(drone);
  return order(drone, command);
}

base::Result<> SurveyDesk::order(std::string_view drone, std::string const& command) {
  auto const read = autonomy::parse_command(command);
  if (!barred_.empty() && read && !stops(*read))
    return base::fail(base::ErrorKind::refused, barred_, "release it first; Land, Disarm and Kill are taken");
  return stop(drone, command);
}

base::Result<> SurveyDesk::stop(std::string_view drone, std::string const& command) {
  auto* const seat = seat_of(drone);
  if (!seat) return base::fail(base::ErrorKind::not_found, fmt::format("there is no survey drone '{}'", drone));
  auto const read = autonomy::parse_command(command);
  if (!read) return std::unexpected(read.error());
  return send(*seat, *read, command);
}

base::Result<> SurveyDesk::send(Seat& seat, autonomy::Command const& command, std::string const& text) {
  bool const is_kill = std::holds_alternative<autonomy::command::Kill>(command);
  if (!is_kill && !seat.client->is_connected())
    return base::fail(base::ErrorKind::refused, fmt::format("{} is not connected", seat.name),
                      seat.client->last_error());
  auto const sent = seat.client->session().send({.kind = wire::Kind::command,
                                                 .text = text,
                                                 .key = std::string(key_of(command)),
                                                 .lifetime = is_kill ? kill_lives : command_lives});
  if (!sent) return std::unexpected(sent.error());
  log_.warn(fmt::format("{}: {} asked for", seat.name, autonomy::name_of(command)));
  scope_.spawn(follow(seat, *sent, std::string(autonomy::name_of(command))));
  return {};
}

base::Result<> SurveyDesk::look(Seat& seat, vehicle::PictureView view) {
  auto& look = seat.look_at(view);
  look.asked_at = loop_.now();
  if (look.client) return {};
  auto opened = link::pictures::PictureClient::open(loop_, seat.camera, wire_view(view));
  if (!opened) return std::unexpected(opened.error());
  look.client = *std::move(opened);
  look.before = look.newest;
  scope_.spawn(close_when_idle(seat, view));
  return {};
}

base::Task<> SurveyDesk::close_when_idle(Seat& seat, vehicle::PictureView view) {
  auto& look = seat.look_at(view);
  while (loop_.now() < look.asked_at + watched_for) co_await loop_.sleep_until(look.asked_at + watched_for);
  look.client.reset();
}

base::Task<base::Result<vehicle::DronePicture>> SurveyDesk::picture(std::string drone, vehicle::PictureView view,
                                                                    std::uint64_t after) {
  auto* const seat = seat_of(drone);
  if (!seat) co_return base::fail(base::ErrorKind::not_found, fmt::format("there is no survey drone '{}'", drone));
  if (auto const looks = look(*seat, view); !looks) co_return std::unexpected(looks.error());
  auto& look = seat->look_at(view);
  auto const client = look.client;  // lives as long as somebody waits for it
  auto const before = look.before;
  auto asking = client->next(after > before ? after - before : 0, picture_patience);
  auto const picture = co_await asking;
  if (!picture) co_return std::unexpected(picture.error());
  look.newest = std::max(look.newest, before + picture->number);
  co_return vehicle::DronePicture{
      .jpeg = picture->picture.jpeg, .taken = picture->picture.taken, .number = before + picture->number};
}

base::Task<base::Result<vehicle::DroneVideo>> SurveyDesk::video(std::string drone, vehicle::PictureView view,
                                                                std::string offer) {
  auto* const seat = seat_of(drone);
  if (!seat) co_return base::fail(base::ErrorKind::not_found, fmt::format("there is no survey drone '{}'", drone));
  auto beginning = link::pictures::begin_video(loop_, seat->video, wire_view(view), std::move(offer));
  auto begun = co_await beginning;
  if (!begun) co_return std::unexpected(begun.error());
  co_return vehicle::DroneVideo{.answer = std::move(begun->answer), .session = std::move(begun->session)};
}

base::Task<base::Result<>> SurveyDesk::end_video(std::string drone, std::string session) {
  auto* const seat = seat_of(drone);
  if (!seat) co_return base::fail(base::ErrorKind::not_found, fmt::format("there is no survey drone '{}'", drone));
  auto ending = link::pictures::end_video(loop_, seat->video, std::move(session));
  co_return co_await ending;
}

base::Task<> SurveyDesk::follow(Seat& seat, wire::MessageId id, std::string command) {
  auto const taken = co_await seat.client->session().taken(id, kill_lives);
  if (!taken) say(seat, fmt::format("{} has not reached it: {}", command, taken.error().message));
}

}  // namespace lapwing::host
