#include "perceive/live_view.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "base/text/utc_text.hpp"
#include "vision/annotate.hpp"
#include "vision/image/image.hpp"

namespace lapwing::perceive {

using link::pictures::View;

namespace {

/// As it lies in the picture; nothing where a corner is beyond its edge.
std::optional<vision::Detection> drawn_as(std::string category, explore::Corners const& outline,
                                          geo::GroundView const& view) {
  vision::Detection found;
  found.category = std::move(category);
  auto& corners = found.corners.emplace();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    auto const pixel = geo::seen_at(view, outline[i]);
    if (!pixel) return std::nullopt;
    corners[i] = {.x = pixel->x, .y = pixel->y};
  }
  auto const [left, right] = std::ranges::minmax(corners, {}, &vision::Point::x);
  auto const [top, bottom] = std::ranges::minmax(corners, {}, &vision::Point::y);
  found.box = {.x = left.x, .y = top.y, .width = right.x - left.x, .height = bottom.y - top.y};
  return found;
}

std::vector<vision::Detection> detections(explore::LotSight const& sight) {
  std::vector<vision::Detection> all;
  for (auto const& slot : sight.slots) {
    auto found = drawn_as("slot", slot.outline, sight.view);
    if (!found) continue;
    found->score = slot.surety;
    found->occupied_chance = slot.taken_chance;
    all.push_back(*std::move(found));
  }
  for (auto const& car : sight.cars) {
    auto found = drawn_as("car", car.outline, sight.view);
    if (!found) continue;
    found->score = car.chance;
    all.push_back(*std::move(found));
  }
  return all;
}

/// White on black: it is read on any ground.
void write_time(cv::Mat& drawn, base::UtcTime taken) {
  double const size = std::max(0.4, drawn.cols / 1600.0);
  cv::Point const at(4, drawn.rows - 6);
  auto const text = base::to_iso8601(taken);
  cv::putText(drawn, text, at, cv::FONT_HERSHEY_SIMPLEX, size, {0, 0, 0}, 4, cv::LINE_AA);
  cv::putText(drawn, text, at, cv::FONT_HERSHEY_SIMPLEX, size, {255, 255, 255}, 1, cv::LINE_AA);
}

}  // namespace

cv::Mat with_findings(cv::Mat const& picture, base::UtcTime taken, explore::LotSight const* sight) {
  auto drawn = vision::annotated(picture, sight ? detections(*sight) : std::vector<vision::Detection>());
  write_time(drawn, taken);
  return drawn;
}

base::Result<std::unique_ptr<LiveView>> LiveView::open(base::Loop& loop,
                                                       link::pictures::ServeSettings const& settings) {
  auto server = link::pictures::PictureServer::open(loop, settings);
  if (!server) return std::unexpected(server.error());
  return std::unique_ptr<LiveView>(new LiveView(loop, *std::move(server)));
}

LiveView::LiveView(base::Loop& loop, std::unique_ptr<link::pictures::PictureServer> server)
    : server_(std::move(server)), came_(loop), pen_(loop, std::make_unique<Pen>()), scope_(loop) {
  scope_.spawn(work());
}

bool LiveView::is_watched() const {
  return is_watched(View::raw) || is_watched(View::annotated);
}

void LiveView::show(cv::Mat picture, base::UtcTime taken) {
  put(View::raw, raw_, {.picture = std::move(picture), .taken = taken});
}

void LiveView::show(cv::Mat picture, base::UtcTime taken, std::optional<explore::LotSight> sight) {
  put(View::annotated, annotated_, {.picture = std::move(picture), .taken = taken, .sight = std::move(sight)});
}

void LiveView::put(View view, std::optional<Shown>& place, Shown shown) {
  if (shown.picture.empty() || !server_->is_watched(view)) return;
  place = std::move(shown);
  came_.notify_all();
}

base::Task<> LiveView::work() {
  for (;;) {
    if (!raw_ && !annotated_) co_await came_.wait();
    if (raw_) {
      auto making = make(View::raw, *std::exchange(raw_, std::nullopt));
      co_await making;
    }
    if (annotated_) {
      auto making = make(View::annotated, *std::exchange(annotated_, std::nullopt));
      co_await making;
    }
  }
}

base::Task<> LiveView::make(View view, Shown shown) {
  auto const taken = shown.taken;
  auto encoding = pen_.run([view, shown = std::move(shown)](Pen&) {
    auto const* const sight = shown.sight ? &*shown.sight : nullptr;
    return std::make_shared<std::string const>(
        vision::encode_jpeg(view == View::raw ? shown.picture : with_findings(shown.picture, shown.taken, sight)));
  });
  auto jpeg = co_await encoding;
  server_->offer(view, {.jpeg = std::move(jpeg), .taken = taken});
}

}  // namespace lapwing::perceive
