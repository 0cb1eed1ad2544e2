#pragma once

#include <type_traits>

#include <opencv2/core.hpp>

#include "base/error.hpp"

namespace lapwing::perceive {

/// What `work` returns, a result. OpenCV throws on pictures that it did not expect; one of them is not to end the
/// process.
template <class Work>
std::invoke_result_t<Work> without_throwing(Work const& work) {
  try {
    return work();
  } catch (cv::Exception const& error) {
    return base::fail(base::ErrorKind::io, "OpenCV cannot work on a picture: " + error.err);
  }
}

}  // namespace lapwing::perceive
