#include "perceive/perceive.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/files/replace_file.hpp"
#include "base/wall_clock.hpp"
#include "perceive/memory/memory_file.hpp"
#include "perceive/without_throwing.hpp"

namespace lapwing::perceive {

using namespace std::chrono_literals;

namespace {

constexpr base::Duration think_period = 200ms;
constexpr base::Duration map_period = 1s;
constexpr base::Duration setpoint_period = 100ms;
constexpr base::Duration keep_period = 3s;
/// So long it may take until the flight controller has said where the drone was when the light fell in.
constexpr base::Duration pose_patience = 400ms;
constexpr base::Duration pose_lasts = 2s;
/// What was found is drawn into the pictures that come after it, for a while.
constexpr base::Duration findings_last = 2s;
/// Lower than that the drone stands, and the ground before its lens says nothing.
constexpr double standing_m = 2.0;
constexpr auto slots_file = "slots.geojson";
constexpr auto memory_file = "survey.jsonl";
/// Cards wear out by what is written; the memory is written whole each time.
constexpr double memory_bytes_a_s = 200'000.0;

/// What came of making the surveyor, or adapting it.
struct Adapted {
  bool is_new = false;
  Recalled recalled = {};
};

/// What became of looking at a picture.
struct Look {
  std::optional<std::string> fault = {};
  std::optional<explore::LotSight> sight = {};
  double took_s = 0.0;
};

}  // namespace

base::Result<std::unique_ptr<Perceive>> Perceive::open(base::Loop& loop, bus::Bus& bus, PerceiveSettings settings,
                                                       base::Logger log) {
  std::error_code error;
  std::filesystem::create_directories(settings.folder, error);
  if (error)
    return base::fail(base::ErrorKind::io,
                      fmt::format("{} cannot be made: {}", settings.folder.string(), error.message()));
  auto eye = LotEye::make(settings.network, settings.order.lot);
  if (!eye) return std::unexpected(eye.error());
  eye->tie_pictures();
  auto topics = Topics::open(loop, bus);
  if (!topics) return std::unexpected(topics.error());
  std::unique_ptr<LiveView> live_view;
  if (settings.stream) {
    auto opened = LiveView::open(loop, *settings.stream);
    if (!opened) return std::unexpected(opened.error());
    live_view = *std::move(opened);
  }
  std::unique_ptr<Perceive> perceive(new Perceive(loop, std::move(settings), std::move(log)));
  perceive->topics_ = *std::move(topics);
  perceive->live_view_ = std::move(live_view);
  perceive->film_.emplace(loop, perceive->director(), perceive->log_);
  perceive->eye_.emplace(loop, std::make_unique<LotEye>(*std::move(eye)));
  perceive->mind_.emplace(loop, std::make_unique<Mind>());
  perceive->sight_.began = loop.now();
  auto& scope = perceive->scope_;
  scope.spawn(perceive->see());
  if (perceive->live_view_) scope.spawn(perceive->show());
  scope.spawn(perceive->think());
  scope.spawn(perceive->speak());
  scope.spawn(perceive->report_health());
  scope.spawn(perceive->keep());
  return perceive;
}

Perceive::Perceive(base::Loop& loop, PerceiveSettings settings, base::Logger log)
    : loop_(loop), settings_(std::move(settings)), log_(std::move(log)), seen_(loop), scope_(loop) {}

double Perceive::ground_up_m() const {
  return topics_->heard().ground->home.z() + settings_.order.ground_m;
}

// ---- seeing

/// A simulated camera is to know where on the globe it is, and from where it looks; real ones know.
Filming::Director Perceive::director() {
  bool const needs_place = settings_.camera.kind == video::CameraSettings::Kind::simulated;
  return {
      .camera = [this, needs_place]() -> std::optional<video::CameraSettings> {
        auto const& ground = topics_->heard().ground;
        if (needs_place && !ground) return std::nullopt;
        auto settings = settings_.camera;
        if (ground) settings.anchor = ground->anchor;
        return settings;
      },
      .moment = [this, needs_place]() -> std::optional<video::Moment> {
        if (!is_placed()) return needs_place ? std::nullopt : std::optional(video::Moment{.at = base::wall_now()});
        auto const& pose = *topics_->heard().track.newest();
        return video::Moment{.site_from_camera = video::camera_on(pose.place, settings_.camera.mount), .at = pose.at};
      },
      .pictures_a_s =
          [this] {
            bool const is_watched = live_view_ && live_view_->is_watched();
            return is_watched ? std::max(settings_.shown_a_s, settings_.looks_a_s) : settings_.looks_a_s;
          },
  };
}

bool Perceive::is_placed() const {
  auto const& heard = topics_->heard();
  return heard.ground && heard.track.newest() != nullptr && loop_.now() - *heard.pose_at < pose_lasts;
}

/// The picture that has just come each time, as soon as one is due.
base::Task<> Perceive::see() {
  auto const period = base::from_seconds(1.0 / settings_.looks_a_s);
  // Pictures do not come at the very moment: one that is a little early is looked at, not the one after it.
  auto const early = period / 5;
  std::uint64_t last = 0;
  for (auto due = loop_.now();;) {
    auto shooting = film_->next(last);
    auto shot = co_await shooting;
    last = shot.number;
    if (loop_.now() + early < due) continue;
    if (!is_placed()) {
      sight_.place_fault = "it is not known where the drone is";
      continue;
    }
    due = std::max(due, loop_.now() - early) + period;
    auto looking = look_at(std::move(shot.frame));
    co_await looking;
  }
}

base::Task<> Perceive::look_at(video::Frame frame) {
  auto placing = place_of(frame);
  auto const place = co_await placing;
  if (!place) {
    ++thought_.unplaced;
    sight_.place_fault = "nobody knows where the drone was when a picture was taken: do the clocks agree?";
    co_return;
  }
  sight_.place_fault.clear();
  geo::GroundView const view{.lens = frame.lens, .site_from_camera = *place, .ground_up_m = ground_up_m()};
  if (view.height_m() < standing_m) {
    sight_.good_at = loop_.now();
    sight_.picture_fault.clear();
    co_return;
  }
  auto looking = eye_->run([view, picture = frame.picture, at = frame.taken](LotEye& eye) {
    auto const began = std::chrono::steady_clock::now();
    Look look{.fault = picture_fault(picture)};
    if (!look.fault) {
      auto sight =
          without_throwing([&] { return base::Result<std::optional<explore::LotSight>>(eye.look(picture, view, at)); });
      if (sight)
        look.sight = *std::move(sight);
      else
        look.fault = sight.error().message;
    }
    look.took_s = base::to_seconds(std::chrono::steady_clock::now() - began);
    return look;
  });
  auto look = co_await looking;
  ++sight_.looked_at;
  sight_.took_s = look.took_s;
  sight_.picture_fault = look.fault.value_or("");
  if (look.fault) {
    ++sight_.blind;
    co_return;
  }
  sight_.good_at = loop_.now();
  if (!look.sight) co_return;
  if (newest_) ++thought_.passed_over;
  look.sight->vehicle = settings_.vehicle;
  seen_last_ = look.sight;
  newest_ = std::move(look.sight);
  seen_.notify_all();
}

base::Task<std::optional<geo::CameraPlace>> Perceive::place_of(video::Frame const& frame) {
  if (frame.site_from_camera) co_return frame.site_from_camera;
  auto const deadline = loop_.now() + pose_patience;
  constexpr base::Duration look_again = 20ms;
  for (;;) {
    auto const& track = topics_->heard().track;
    if (auto const place = track.at(frame.taken)) co_return video::camera_on(*place, settings_.camera.mount);
    bool const may_come = track.newest() == nullptr || track.newest()->at < frame.taken;
    if (!may_come || loop_.now() >= deadline) co_return std::nullopt;
    co_await loop_.sleep(look_again);
  }
}

// ---- showing

base::Task<> Perceive::show() {
  std::uint64_t last = 0;
  for (;;) {
    auto shooting = film_->next(last);
    auto shot = co_await shooting;
    last = shot.number;
    live_view_->show(shot.frame.picture, shot.frame.taken);
    if (live_view_->is_watched(link::pictures::View::annotated)) scope_.spawn(show_findings(std::move(shot.frame)));
  }
}

/// What was found last, as it lies in this picture.
base::Task<> Perceive::show_findings(video::Frame frame) {
  std::optional<explore::LotSight> sight;
  if (is_placed() && seen_last_ && frame.taken - seen_last_->at < findings_last) {
    auto placing = place_of(frame);
    if (auto const place = co_await placing) {
      sight = seen_last_;
      sight->view = {.lens = frame.lens, .site_from_camera = *place, .ground_up_m = ground_up_m()};
      if (sight->view.height_m() < standing_m) sight.reset();
    }
  }
  live_view_->show(frame.picture, frame.taken, std::move(sight));
}

// ---- thinking

base::Task<> Perceive::think() {
  auto map_at = loop_.now();
  for (;;) {
    if (!newest_) co_await seen_.wait_until(loop_.now() + think_period);
    auto adapting = adapt_surveyor();
    if (!co_await adapting) {
      co_await loop_.sleep(think_period);
      continue;
    }
    auto const& heard = topics_->heard();
    News news{.now = base::wall_now(), .sight = std::exchange(newest_, std::nullopt), .explores = heard.explores};
    bool const has_pose = heard.track.newest() != nullptr && loop_.now() - *heard.pose_at < pose_lasts;
    if (has_pose) news.drone = heard.track.newest()->place;
    news.speed_m_s = heard.track.speed_m_s();
    if (heard.home_by) news.flying_s = base::to_seconds(*heard.home_by - loop_.now());
    news.wanted = topics_->take_wanted();
    news.wants_map = loop_.now() >= map_at;
    if (news.wants_map) map_at = loop_.now() + map_period;
    if (news.explores && !thought_.explores) topics_->ask_for_speed(settings_.order.planner.flight.speed_m_s);
    thought_.explores = news.explores;
    auto const at = news.now;
    auto const began = loop_.now();
    auto thinking = mind_->run([news = std::move(news)](Mind& mind) { return mind.surveyor->think(news); });
    auto const conclusion = co_await thinking;
    thought_.took_s = base::to_seconds(loop_.now() - began);
    carry_out(conclusion, at);
  }
}

/// Made once it is known where the drone is on the globe, and adapted to heights and home when they change.
base::Task<bool> Perceive::adapt_surveyor() {
  auto const& heard = topics_->heard();
  thought_.has_home = heard.ground.has_value();
  if (!heard.ground) co_return false;
  auto adapting = mind_->run([order = settings_.order, ground = *heard.ground, heights = heard.heights,
                              remembers = settings_.remembers,
                              file = settings_.folder / memory_file](Mind& mind) -> base::Result<Adapted> {
    if (mind.surveyor) {
      auto const adapted = mind.surveyor->adapt(ground.home, heights);
      if (!adapted) return std::unexpected(adapted.error());
      return Adapted{};
    }
    auto made = Surveyor::make(order, ground, heights);
    if (!made) return std::unexpected(made.error());
    mind.surveyor.emplace(*std::move(made));
    auto const now = base::wall_now();
    Adapted adapted{.is_new = true, .recalled = recall(file, mind.surveyor->site(), now, remembers)};
    if (adapted.recalled.memory) mind.surveyor->recall(*std::move(adapted.recalled.memory), now);
    return adapted;
  });
  auto const adapted = co_await adapting;
  auto const fault = adapted ? std::string() : adapted.error().message;
  if (!fault.empty() && fault != thought_.fault)
    log_.error(fmt::format("no survey: {}{}{}", fault, adapted.error().hint.empty() ? "" : "; ", adapted.error().hint));
  thought_.fault = fault;
  if (adapted && adapted->is_new) {
    auto const& recalled = adapted->recalled;
    if (!recalled.words.empty()) recalled.is_fault ? log_.warn(recalled.words) : log_.info(recalled.words);
    // Whoever shows the map sees what there was, before anything is looked at anew.
    if (recalled.memory) scope_.spawn(write_slots());
    log_.info("the survey is ready: it begins with AutonomousExplore");
  }
  has_surveyor_ = has_surveyor_ || adapted;
  co_return has_surveyor_;
}

void Perceive::carry_out(Conclusion const& conclusion, base::UtcTime at) {
  goal_ = conclusion.goal;
  sees_lot_ = conclusion.sees_lot;
  thought_.has_goal = goal_.has_value();
  if (conclusion.figures != thought_.figures) has_new_slots_ = true;
  thought_.figures = conclusion.figures;
  if (conclusion.is_in_lot) topics_->say_in_lot(*conclusion.is_in_lot);
  if (conclusion.map) topics_->say_map(*conclusion.map, at);
  if (!conclusion.report) return;
  log_.info(*conclusion.report);
  topics_->say_report(*conclusion.report);
  scope_.spawn(write_slots());
}

// ---- speaking

base::Task<> Perceive::speak() {
  constexpr int sees_lot_every = 5;
  for (int turn = 0;; ++turn) {
    if (goal_ && topics_->heard().explores) topics_->say_goal(*goal_);
    if (sees_lot_ && turn % sees_lot_every == 0) topics_->say_sees_lot(*sees_lot_);
    co_await loop_.sleep(setpoint_period);
  }
}

base::Task<> Perceive::report_health() {
  constexpr base::Duration period = 1s;
  auto looked_at = sight_.looked_at;
  for (auto at = loop_.now();;) {
    auto const& heard = topics_->heard();
    sight_.film = film_->record();
    thought_.pose_age.reset();
    if (heard.pose_at) thought_.pose_age = loop_.now() - *heard.pose_at;
    topics_->say_health(vision_health(sight_, loop_.now()), mapper_health(thought_), planner_health(thought_));
    co_await loop_.sleep(period);
    sight_.looks_a_s = static_cast<double>(sight_.looked_at - looked_at) /
                       base::to_seconds(loop_.now() - std::exchange(at, loop_.now()));
    looked_at = sight_.looked_at;
  }
}

// ---- what is kept

base::Task<> Perceive::keep() {
  for (;;) {
    co_await loop_.sleep(keep_period);
    if (std::exchange(has_new_slots_, false)) {
      has_new_memory_ = true;
      auto writing = write_slots();
      co_await writing;
    }
    if (has_new_memory_ && loop_.now() >= memory_due_) {
      auto writing = write_memory();
      co_await writing;
    }
  }
}

base::Task<> Perceive::write_slots() {
  auto telling = mind_->run([](Mind& mind) { return mind.surveyor ? mind.surveyor->slots_line() : std::string(); });
  if (auto const line = co_await telling; !line.empty()) topics_->say_slots(line);
  auto writing = mind_->run([file = settings_.folder / slots_file](Mind& mind) -> base::Result<> {
    if (!mind.surveyor) return {};
    return base::replace_file(file, mind.surveyor->slots_text(base::wall_now()));
  });
  auto const written = co_await writing;
  tell_write_fault(told_write_fault_, written, "the slots are");
}

/// What a process that is started anew takes up.
base::Task<> Perceive::write_memory() {
  has_new_memory_ = false;
  auto const lasts = std::chrono::duration_cast<base::UtcTime::duration>(settings_.remembers);
  auto writing = mind_->run([file = settings_.folder / memory_file, lasts](Mind& mind) -> base::Result<std::size_t> {
    if (!mind.surveyor || lasts <= base::UtcTime::duration::zero()) return std::size_t{0};
    auto const now = base::wall_now();
    auto const text = mind.surveyor->memory(now, now - lasts);
    if (auto const written = base::replace_file(file, text); !written) return std::unexpected(written.error());
    return text.size();
  });
  auto const written = co_await writing;
  if (written) memory_due_ = loop_.now() + base::from_seconds(static_cast<double>(*written) / memory_bytes_a_s);
  tell_write_fault(told_memory_fault_, written ? base::Result<>() : std::unexpected(written.error()), "the map is");
}

/// Once, until it is another one.
void Perceive::tell_write_fault(std::string& told, base::Result<> const& written, std::string_view what) {
  auto const fault = written ? std::string() : written.error().message;
  if (!fault.empty() && fault != told) log_.error(fmt::format("{} not written: {}", what, fault));
  told = fault;
}

void Perceive::leave(std::function<void()> done) {
  scope_.spawn(write_and_end(std::move(done)));
}

base::Task<> Perceive::write_and_end(std::function<void()> done) {
  auto writing = write_slots();
  co_await writing;
  auto remembering = write_memory();
  co_await remembering;
  done();
}

}  // namespace lapwing::perceive
