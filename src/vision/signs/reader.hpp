#pragma once

#include <memory>
#include <string>

#include <opencv2/core.hpp>

#include "base/error.hpp"

namespace lapwing::vision {

struct Reading {
  std::string text;         ///< UTF-8; empty: nothing
  double confidence = 0.0;  ///< 0 to 1, as the reader sees it
};

/// Reads one line of text, seen from the front.
class LineReader {
 public:
  LineReader() = default;
  LineReader(LineReader const&) = delete;
  LineReader& operator=(LineReader const&) = delete;
  virtual ~LineReader() = default;

  [[nodiscard]] virtual Reading read(cv::Mat const& line) = 0;
};

/// Tesseract with its English data, which it looks for where it was installed. Best on sharp letters.
[[nodiscard]] base::Result<std::unique_ptr<LineReader>> make_tesseract_reader();

/// The content of what setup/text_recogniser.py makes of PP-OCR's recogniser.
struct RecogniserFiles {
  std::string narrow;      ///< the network for lines of up to 160 pixels, at a height of 48
  std::string wide;        ///< for lines of up to 320 pixels; wider ones are narrowed
  std::string characters;  ///< one a line
};

/// Best on blurred letters.
[[nodiscard]] base::Result<std::unique_ptr<LineReader>> make_recogniser(RecogniserFiles const& files);

}  // namespace lapwing::vision
