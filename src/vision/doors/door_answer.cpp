#include "vision/doors/door_answer.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::vision {

namespace {

/// Boxes that overlap by so much mean one door, or vote on its edges, or are one in picture and mirror image. As
/// training/doors/network.py and train.py have them: the calibration of the network holds for these alone.
constexpr double is_the_same = 0.45;
constexpr double votes = 0.6;
constexpr double is_confirmed = 0.5;
constexpr double price_of_being_alone = 1.0;

/// The weighted mean of boxes, edge by edge.
class Vote {
 public:
  void add(Box const& box, double weight) {
    sum_.x += weight * box.x;
    sum_.y += weight * box.y;
    sum_.width += weight * box.width;
    sum_.height += weight * box.height;
    weight_ += weight;
  }
  [[nodiscard]] Box mean() const {
    return {
        .x = sum_.x / weight_, .y = sum_.y / weight_, .width = sum_.width / weight_, .height = sum_.height / weight_};
  }

 private:
  Box sum_;
  double weight_ = 0.0;
};

AnsweredDoor door_at(cv::Mat const& answer, int row, int column) {
  auto const said = [&](int channel) { return double{answer.ptr<float>(0, channel, row)[column]}; };
  double const x = (column + 0.5) * answer_step;
  double const y = (row + 0.5) * answer_step;
  double const left = x - said(1) * answer_step;
  double const top = y - said(2) * answer_step;
  return {.box = {.x = left,
                  .y = top,
                  .width = x + said(3) * answer_step - left,
                  .height = y + said(4) * answer_step - top},
          .surety = said(0)};
}

}  // namespace

std::vector<AnsweredDoor> doors_of_answer(cv::Mat const& answer, std::size_t most) {
  constexpr int places = answer_input / answer_step;
  CV_Assert(answer.dims == 4 && answer.size[1] == 5 && answer.size[2] == places && answer.size[3] == places);
  std::vector<AnsweredDoor> all;
  for (int row = 0; row < places; ++row) {
    for (int column = 0; column < places; ++column) all.push_back(door_at(answer, row, column));
  }
  std::ranges::stable_sort(all, std::ranges::greater(), &AnsweredDoor::surety);
  all.resize(std::min(all.size(), most));
  std::vector<AnsweredDoor> doors;
  std::vector<bool> is_told(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (is_told[k]) continue;
    Vote vote;
    for (std::size_t j = 0; j < all.size(); ++j) {
      double const same = overlap(all[k].box, all[j].box);
      if (same > votes || j == k) vote.add(all[j].box, chance_of(all[j].surety));
      if (same >= is_the_same) is_told[j] = true;
    }
    doors.push_back({.box = vote.mean(), .surety = all[k].surety});
  }
  return doors;
}

std::vector<AnsweredDoor> mirrored_back(std::vector<AnsweredDoor> doors) {
  for (auto& door : doors) door.box.x = answer_input - door.box.x - door.box.width;
  return doors;
}

std::vector<AnsweredDoor> agreed(std::span<AnsweredDoor const> picture, std::span<AnsweredDoor const> mirror) {
  std::vector<AnsweredDoor> doors;
  std::vector<bool> is_taken(mirror.size());
  for (auto const& door : picture) {
    std::size_t best = mirror.size();
    double most = is_confirmed;
    for (std::size_t k = 0; k < mirror.size(); ++k) {
      double const same = overlap(door.box, mirror[k].box);
      if (is_taken[k] || same <= most) continue;
      best = k;
      most = same;
    }
    if (best == mirror.size()) {
      doors.push_back({.box = door.box, .surety = door.surety - price_of_being_alone});
      continue;
    }
    is_taken[best] = true;
    Vote both;
    both.add(door.box, 1.0);
    both.add(mirror[best].box, 1.0);
    doors.push_back({.box = both.mean(), .surety = 0.5 * (door.surety + mirror[best].surety)});
  }
  for (std::size_t k = 0; k < mirror.size(); ++k) {
    if (!is_taken[k]) doors.push_back({.box = mirror[k].box, .surety = mirror[k].surety - price_of_being_alone});
  }
  return doors;
}

double chance_of(double surety) {
  return 1.0 / (1.0 + std::exp(-surety));
}

}  // namespace lapwing::vision
