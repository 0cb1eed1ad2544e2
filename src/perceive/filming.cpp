#include "perceive/filming.hpp"

#include <algorithm>
#include <utility>

#include "perceive/without_throwing.hpp"

namespace lapwing::perceive {

using namespace std::chrono_literals;

namespace {

constexpr base::Duration open_again_after = 3s;

}  // namespace

Filming::Filming(base::Loop& loop, Director director, base::Logger log)
    : loop_(loop),
      director_(std::move(director)),
      log_(std::move(log)),
      arrived_(loop),
      hand_(loop, std::make_unique<Hand>()),
      scope_(loop) {
  scope_.spawn(film());
}

base::Task<Filming::Shot> Filming::next(std::uint64_t after) {
  while (record_.pictures <= after) co_await arrived_.wait();
  co_return Shot{.frame = *newest_, .number = record_.pictures};
}

base::Task<> Filming::film() {
  for (auto next = loop_.now();;) {
    co_await loop_.sleep_until(next);
    auto working = record_.is_open ? take() : open_camera();
    co_await working;
    next = std::max(next + base::from_seconds(1.0 / director_.pictures_a_s()), loop_.now());
  }
}

base::Task<> Filming::open_camera() {
  auto settings = director_.camera();
  if (!settings) co_return;
  auto opening = hand_.run([settings = *std::move(settings)](Hand& hand) -> base::Result<> {
    hand.camera.reset();  // the one that is gone, first
    auto camera = video::open_camera(settings);
    if (!camera) return std::unexpected(camera.error());
    hand.camera = *std::move(camera);
    return {};
  });
  auto const opened = co_await opening;
  record_.is_open = opened.has_value();
  if (opened) {
    opened_at_ = loop_.now();
    log_.info("the camera is open");
    co_return;
  }
  note_failure(opened.error());
  co_await loop_.sleep(open_again_after);
}

base::Task<> Filming::take() {
  auto const moment = director_.moment();
  if (!moment) co_return;
  auto taking =
      hand_.run([moment = *moment](Hand& hand) { return without_throwing([&] { return hand.camera->take(moment); }); });
  auto frame = co_await taking;
  if (!frame) {
    note_failure(frame.error());
    if (frame.error().kind != base::ErrorKind::lost) co_return;
    record_.is_open = false;
    // One that has given pictures for a while is there still, as a rule: a picture that is none ends a stream.
    if (loop_.now() - opened_at_ < open_again_after) co_await loop_.sleep(open_again_after);
    co_return;
  }
  record_.fault.clear();
  ++record_.pictures;
  newest_ = *std::move(frame);
  arrived_.notify_all();
}

void Filming::note_failure(base::Error const& error) {
  if (record_.fault != error.message) log_.warn(error.message);
  record_.fault = error.message;
  ++record_.failed;
}

}  // namespace lapwing::perceive
