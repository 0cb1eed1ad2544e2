#include "vision/evaluate.hpp"

#include <algorithm>
#include <numeric>

namespace lapwing::vision {

namespace {

struct Verdict {
  double score;
  bool right;
};

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

void judge(Judged const& picture, double least_overlap, std::vector<Verdict>& verdicts) {
  std::vector<std::size_t> order(picture.found.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](auto a, auto b) { return picture.found[a].score > picture.found[b].score; });
  std::vector<bool> taken(picture.truth.size());
  for (auto const at : order) {
    auto const& detection = picture.found[at];
    std::size_t best = picture.truth.size();
    double most = least_overlap;
    for (std::size_t k = 0; k < picture.truth.size(); ++k) {
      auto const common = overlap(detection.box, picture.truth[k]);
      if (taken[k] || common < most) continue;
      best = k;
      most = common;
    }
    bool const right = best < picture.truth.size();
    if (right) taken[best] = true;
    verdicts.push_back({detection.score, right});
  }
}

double average_precision(std::span<Verdict const> sorted, std::size_t there) {
  if (there == 0) return 0.0;
  std::vector<double> precision;
  std::size_t right = 0;
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    right += sorted[k].right ? 1 : 0;
    precision.push_back(share(right, k + 1));
  }
  double best = 0.0;
  double sum = 0.0;
  for (std::size_t k = sorted.size(); k-- > 0;) {
    best = std::max(best, precision[k]);
    if (sorted[k].right) sum += best;
  }
  return sum / static_cast<double>(there);
}

}  // namespace

double overlap(Box const& a, Box const& b) {
  double const width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  double const height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  if (width <= 0.0 || height <= 0.0) return 0.0;
  return width * height / (a.area() + b.area() - width * height);
}

double Figures::precision() const {
  return share(right, right + wrong);
}

double Figures::recall() const {
  return share(right, there);
}

double Figures::wrong_a_picture() const {
  return share(wrong, pictures);
}

Figures evaluate(std::span<Judged const> pictures, double threshold, double least_overlap) {
  Figures figures{.pictures = pictures.size()};
  std::vector<Verdict> verdicts;
  for (auto const& picture : pictures) {
    figures.there += picture.truth.size();
    judge(picture, least_overlap, verdicts);
  }
  std::ranges::stable_sort(verdicts, std::ranges::greater(), &Verdict::score);
  for (auto const& verdict : verdicts) {
    if (verdict.score < threshold) break;
    (verdict.right ? figures.right : figures.wrong) += 1;
  }
  figures.average_precision = average_precision(verdicts, figures.there);
  return figures;
}

}  // namespace lapwing::vision
