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

/// PP-OCR's recogniser as setup/text_recogniser.py makes it: the content of its two files. Best on blurred letters.
[[nodiscard]] base::Result<std::unique_ptr<LineReader>> make_recogniser(std::string const& network,
                                                                        std::string const& characters);

}  // namespace lapwing::vision
