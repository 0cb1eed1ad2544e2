#include <tesseract/baseapi.h>

#include <algorithm>
#include <cctype>

#include <opencv2/imgproc.hpp>

#include "vision/signs/reader.hpp"

namespace lapwing::vision {

namespace {

/// Letters of some 30 to 40 pixels are what it was trained on; a line has margins round them.
constexpr double line_height = 64.0;

/// Dark letters on light ground, which it reads better.
cv::Mat prepared(cv::Mat const& line) {
  cv::Mat grey;
  if (line.channels() == 1) {
    grey = line;
  } else {
    cv::cvtColor(line, grey, cv::COLOR_BGR2GRAY);
  }
  double const scale = line_height / grey.rows;
  cv::Mat scaled;
  cv::resize(grey, scaled, {}, scale, scale, scale > 1.0 ? cv::INTER_CUBIC : cv::INTER_AREA);
  cv::Mat letters;
  cv::threshold(scaled, letters, 0.0, 255.0, cv::THRESH_BINARY | cv::THRESH_OTSU);
  // The ground is what most of the line's rim is.
  int const rim = std::max(1, scaled.rows / 10);
  double const edge =
      0.5 * (cv::mean(letters.rowRange(0, rim))[0] + cv::mean(letters.rowRange(letters.rows - rim, letters.rows))[0]);
  if (edge < 127.0) scaled = 255 - scaled;
  cv::normalize(scaled, scaled, 0.0, 255.0, cv::NORM_MINMAX);
  return scaled;
}

class TesseractReader final : public LineReader {
 public:
  bool start() {
    if (api_.Init(nullptr, "eng", tesseract::OEM_LSTM_ONLY) != 0) return false;
    api_.SetVariable("debug_file", "/dev/null");
    api_.SetPageSegMode(tesseract::PSM_SINGLE_LINE);
    return true;
  }

  Reading read(cv::Mat const& line) override {
    if (line.empty()) return {};
    auto const picture = prepared(line);
    api_.SetImage(picture.data, picture.cols, picture.rows, 1, static_cast<int>(picture.step));
    constexpr int resolution = 150;
    api_.SetSourceResolution(resolution);
    std::unique_ptr<char[]> const text(api_.GetUTF8Text());
    if (!text) return {};
    Reading reading{.text = text.get(), .confidence = api_.MeanTextConf() / 100.0};
    std::ranges::replace(reading.text, '\n', ' ');
    while (!reading.text.empty() && reading.text.back() == ' ') reading.text.pop_back();
    return reading;
  }

 private:
  tesseract::TessBaseAPI api_;
};

}  // namespace

base::Result<std::unique_ptr<LineReader>> make_tesseract_reader() {
  auto reader = std::make_unique<TesseractReader>();
  if (!reader->start())
    return base::fail(base::ErrorKind::not_found, "Tesseract has no English data",
                      "install Debian's tesseract-ocr-eng, or set TESSDATA_PREFIX");
  return reader;
}

}  // namespace lapwing::vision
