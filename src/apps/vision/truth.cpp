#include "apps/vision/truth.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace lapwing::apps::detect {

namespace {

namespace fs = std::filesystem;
using base::ErrorKind;
using base::fail;

base::Result<std::optional<std::vector<vision::Box>>> boxes_of(fs::path const& file, cv::Size const& size) {
  std::ifstream in(file);
  if (!in) return std::optional<std::vector<vision::Box>>();
  std::vector<vision::Box> boxes;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::istringstream words(line);
    int kind = 0;
    double x = 0.0;
    double y = 0.0;
    double width = 0.0;
    double height = 0.0;
    if (!(words >> kind >> x >> y >> width >> height))
      return fail(ErrorKind::invalid_input, fmt::format("{}:{}: not a line of labels: {}", file.string(), number, line),
                  "class x y width height, each relative to the picture");
    if (kind != 0) continue;
    boxes.push_back(
        {(x - width / 2) * size.width, (y - height / 2) * size.height, width * size.width, height * size.height});
  }
  return std::optional(std::move(boxes));
}

std::map<std::string, std::string> texts_of(fs::path const& file) {
  std::map<std::string, std::string> texts;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);  // what the columns are
  while (std::getline(in, line)) {
    if (line.ends_with('\r')) line.pop_back();
    auto const comma = line.find(',');
    if (comma != std::string::npos) texts[line.substr(0, comma)] = line.substr(comma + 1);
  }
  return texts;
}

}  // namespace

base::Result<Evaluation> evaluate_with(fs::path const& folder, std::span<Found const> found,
                                       std::string_view category) {
  auto const texts = texts_of(folder / "labels.csv");
  Evaluation evaluation;
  std::vector<vision::Judged> judged;
  for (auto const& one : found) {
    fs::path const picture(one.picture);
    auto const boxes = boxes_of(folder / (picture.stem().string() + ".txt"), one.size);
    if (!boxes) return std::unexpected(boxes.error());
    if (*boxes) {
      vision::Judged both{.found = {}, .truth = **boxes};
      std::ranges::copy_if(one.detections, std::back_inserter(both.found),
                           [&](auto const& thing) { return thing.category == category; });
      judged.push_back(std::move(both));
    }
    if (auto const text = texts.find(picture.filename().string()); text != texts.end()) {
      ++evaluation.signs;
      evaluation.right_signs +=
          std::ranges::any_of(one.detections, [&](auto const& thing) { return thing.text == text->second; }) ? 1U : 0U;
    }
  }
  if (judged.empty() && evaluation.signs == 0)
    return fail(ErrorKind::not_found, fmt::format("{} has no labels of these pictures", folder.string()),
                "NAME.txt for each NAME.jpg, or a labels.csv");
  evaluation.things = vision::evaluate(judged, 0.0);
  return evaluation;
}

}  // namespace lapwing::apps::detect
