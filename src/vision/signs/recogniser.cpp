#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>
#include <vector>

#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include "vision/signs/reader.hpp"

namespace lapwing::vision {

namespace {

using base::ErrorKind;
using base::fail;

constexpr int input_height = 48;

/// One of the networks, by how wide a line it takes.
struct Network {
  int width;
  cv::dnn::Net net;
};

int width_of(cv::Mat const& line) {
  return static_cast<int>(std::ceil(static_cast<double>(input_height) * line.cols / line.rows));
}

/// As it was trained: BGR, -1 to 1, what the line does not fill is 0.
cv::Mat blob_of(cv::Mat const& line, int input_width) {
  int const width = std::clamp(width_of(line), 1, input_width);
  cv::Mat colour = line;
  if (line.channels() == 1) cv::cvtColor(line, colour, cv::COLOR_GRAY2BGR);
  cv::Mat scaled;
  cv::resize(colour, scaled, {width, input_height});
  cv::Mat blob(std::vector<int>{1, 3, input_height, input_width}, CV_32F, cv::Scalar(0));
  for (int channel = 0; channel < 3; ++channel) {
    for (int y = 0; y < input_height; ++y) {
      auto* const row = blob.ptr<float>(0, channel, y);
      for (int x = 0; x < width; ++x) row[x] = static_cast<float>(scaled.at<cv::Vec3b>(y, x)[channel]) / 127.5F - 1.0F;
    }
  }
  return blob;
}

/// OpenCV's dnn throws on what it cannot load; so that no half of it gets out, everything of it stays here.
class Recogniser final : public LineReader {
 public:
  /// The narrowest first.
  Recogniser(std::vector<Network> networks, std::vector<std::string> characters)
      : networks_(std::move(networks)), characters_(std::move(characters)) {}

  Reading read(cv::Mat const& line) override {
    if (line.empty()) return {};
    auto const fits = [&](Network const& one) { return width_of(line) <= one.width; };
    auto const narrowest = std::ranges::find_if(networks_, fits);
    auto& [width, net] = narrowest == networks_.end() ? networks_.back() : *narrowest;
    net.setInput(blob_of(line, width));
    cv::Mat const out = net.forward();
    auto const classes = static_cast<std::size_t>(out.size[out.dims - 1]);
    std::span const all(out.ptr<float>(), out.total());
    Reading reading;
    double sum = 0.0;
    int count = 0;
    std::size_t last = 0;
    // Connectionist temporal classification: class 0 is no letter, and a letter that goes on is one.
    for (std::size_t at = 0; at + classes <= all.size(); at += classes) {
      auto const place = all.subspan(at, classes);
      auto const best = static_cast<std::size_t>(std::ranges::max_element(place) - place.begin());
      if (best != 0 && best != last && best < characters_.size()) {
        reading.text += characters_[best];
        sum += place[best];
        ++count;
      }
      last = best;
    }
    if (count > 0) reading.confidence = std::clamp(sum / count, 0.0, 1.0);
    return reading;
  }

 private:
  std::vector<Network> networks_;
  std::vector<std::string> characters_;
};

}  // namespace

base::Result<std::unique_ptr<LineReader>> make_recogniser(RecogniserFiles const& files) {
  std::vector<std::string> names{""};
  std::istringstream lines(files.characters);
  for (std::string line; std::getline(lines, line);) names.push_back(line);
  names.emplace_back(" ");
  try {
    std::vector<Network> networks;
    for (auto const& [width, network] : {std::pair(160, &files.narrow), std::pair(320, &files.wide)}) {
      networks.push_back({.width = width, .net = cv::dnn::readNetFromONNX(network->data(), network->size())});
      networks.back().net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    }
    auto reader = std::make_unique<Recogniser>(networks, std::move(names));
    // What can be loaded may still not fit: a line for each tells.
    for (auto const& [width, net] : networks)
      (void)reader->read(cv::Mat(input_height, width, CV_8UC3, cv::Scalar(128, 128, 128)));
    return reader;
  } catch (cv::Exception const& error) {
    return fail(ErrorKind::invalid_input, "the text recogniser cannot be loaded: " + error.err,
                "make it again: ./lapwing detect does");
  }
}

}  // namespace lapwing::vision
